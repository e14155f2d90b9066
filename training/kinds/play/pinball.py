"""Pinball machines."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely.geometry import Point as Dot
from trimesh import Trimesh

from training.kinds.electronics.controls import tilted
from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import button
from training.kinds.model import BASE, Model
from training.kinds.panels import sheet
from training.kinds.solids import Span, ball, box, cut, prism, rectangle, rod, vec
from training.kinds.wheels import beam, lathe, upright


def pinball_machine(m: Model) -> None:
    """A leaning playfield under glass in a box on legs, with flippers, a plunger, buttons, a coin door, perhaps a back box."""
    wide, long = m.number(0.52, 0.62), m.number(1.1, 1.35)
    small = m.chance(0.2)
    if small:
        wide, long = 0.55 * wide, 0.55 * long
    x, wall, low, rise = (-wide / 2, wide / 2), 0.02, 0.0 if small else m.number(0.45, 0.55), m.number(5, 7)
    front, rear = low + (0.12 if small else m.number(0.38, 0.44)), 0.0
    rear = front + np.tan(np.deg2rad(rise)) * long
    floor = low + m.number(0.0, 0.1)
    side = [(0, low), (0.55 * long, low), (long, floor), (long, rear), (0, front)]
    for s in (-1, 1):
        m.add(BASE, prism(side, "x", (s * wide / 2, s * (wide / 2 - wall))))
        m.add(BASE, beam((s * (wide / 2 - 0.004), 0, front), (s * (wide / 2 - 0.004), long, rear), 0.03, 0.012))
    inner = shrunk(x, wall)
    m.add(BASE, box(inner, (0, 0.02), (low, front - 0.01)), box(inner, (long - 0.02, long), (floor, rear)))
    under = [(0.02, low + 0.002), (0.55 * long, low + 0.002), (long - 0.02, floor + 0.002), (long - 0.02, floor + 0.02)]
    m.add(BASE, prism([*under, (0.02, low + 0.02)], "x", inner))
    field = Model(m.rng)
    _playfield(field, shrunk(inner, 0.002), long, 0.45 if small else 1.0)
    tilted(field, rise, (0, 0, 0))
    up = vec(0, 0, front - (0.05 if small else 0.07))
    for part, solid in field.pieces:
        m.add(part, solid.apply_translation(up))
    for part, j in field.joints.items():
        m.hinge(part, j.origin + up, j.axis, (0.0, float(np.rad2deg(j.limits[1]))))
    if m.chance(0.75):
        pane = [(0.025, front - 0.008), (long - 0.025, rear - 0.008), (long - 0.025, rear - 0.003), (0.025, front - 0.003)]
        m.add(BASE if m.chance(0.5) else "glass", prism(pane, "x", shrunk(inner, 0.001)))
        if m.pieces[-1][0] == "glass":
            m.slide("glass", (0, -np.cos(np.deg2rad(rise)), -np.sin(np.deg2rad(rise))), 0.6 * long)
    if any(p == "glass" for p, _ in m.pieces):
        m.add("lock_bar", box((-wide / 2, wide / 2), (-0.012, 0.024), (front - 0.002, front + 0.01)))
        m.slide("lock_bar", (0, 0, 1), 0.06)
    else:
        m.add(BASE, box((-wide / 2, wide / 2), (-0.012, 0.024), (front - 0.004, front + 0.01)))
    _cabinet_front(m, wide, front, low, small)
    for a in (-wide / 2 + 0.03, wide / 2 - 0.03) if not small else ():
        for y, top in ((0.02, front - 0.1), (long - 0.02, rear - 0.14)):
            s, t = np.sign(a), -1 if y < 0.1 else 1
            m.add(BASE, beam((a + s * 0.035, y + t * 0.03, top), (a + s * 0.035, y + t * 0.06, 0.03), 0.045, 0.045, taper=0.6))
            m.add(BASE, rod((a + s * 0.035, y + t * 0.06, 0), (a + s * 0.035, y + t * 0.06, 0.04), 0.02, 10))
    if m.chance(0.8):
        _back_box(m, wide, long, rear, small)


def _playfield(m: Model, x: Span, long: float, size: float) -> None:
    """The board with its bumpers, lanes and flippers, level at z = 0."""
    m.add(BASE, box(x, (0.03, long - 0.03), (-0.012, 0)))
    h, lane = 0.028 * size + 0.008, x[1] - 0.045 * size - 0.012
    m.add(BASE, box((lane, lane + 0.006), (0.03, 0.75 * long), (0, h)))
    c, half = (x[0] + lane) / 2, (lane - x[0]) / 2
    arm, y = 0.075 * size + 0.01, 0.16 * long
    for s in (-1, 1):
        pivot = vec(c + s * (arm + 0.022 * size + 0.004), y, 0)
        tip = pivot + arm * vec(-s * np.cos(0.5), -np.sin(0.5), 0)
        r = 0.012 * size + 0.002
        outline = Dot(*pivot[:2]).buffer(r).union(Dot(*tip[:2]).buffer(0.6 * r)).convex_hull
        m.add(f"flipper_{s}", prism(outline, "z", (0.004, 0.8 * h)), rod(pivot, pivot + vec(0, 0, 0.85 * h), 0.6 * r, 10))
        m.hinge(f"flipper_{s}", pivot, (0, 0, -s), m.number(45, 55))
        guide = [
            pivot[:2] + vec(s * r * 1.3, 0.008, 0)[:2],
            (c + s * half * 0.92, y + 0.09 * long),
            (c + s * half * 0.92, y + 0.14 * long),
        ]
        m.add(BASE, *(beam((*a, h / 2), (*b, h / 2), 0.006, h, (1, 1, 0)) for a, b in pairwise(guide)))
    for _ in range(m.pick(2, 3, 4)):
        at = vec(c + m.number(-0.6, 0.6) * half, m.number(0.55, 0.85) * long, 0)
        m.add(
            BASE,
            rod(at, at + vec(0, 0, h), 0.02 * size, 12),
            rod(at + vec(0, 0, h), at + vec(0, 0, h + 0.008), 0.036 * size, 16),
        )
    for k in range(m.pick(3, 5, 8)):
        at = vec(c + m.number(-0.8, 0.8) * half, m.number(0.38, 0.5) * long, 0)
        m.add(BASE, box((at[0] - 0.012, at[0] + 0.012), (at[1] + 0.001 * k, at[1] + 0.004 + 0.001 * k), (0, h)))
    t = np.linspace(0.15, np.pi - 0.15, 9)
    arc = np.c_[c + half * 0.95 * np.cos(t), 0.78 * long + 0.17 * long * np.sin(t), np.full(9, 0.5 * h)]
    m.add(BASE, *(beam(a, b, 0.005, h, (1, 1, 0.1)) for a, b in pairwise(arc)))
    if m.chance(0.5):
        m.add(BASE, ball((lane + 0.024 * size + 0.006, 0.09 * long, 0.0135), (0.0135,) * 3, 12))


def _cabinet_front(m: Model, wide: float, front: float, low: float, small: bool) -> None:
    """The plunger, the buttons at both sides and the front, the coin door."""
    r = 0.5 if small else 1.0
    a, z = wide / 2 - 0.02 - 0.035 * r, front - 0.06 * (0.7 if small else 1.0)
    m.add(BASE, rod((a, 0, z), (a, -0.012, z), 0.022 * r, 16))
    m.add("plunger", rod((a, 0.02, z), (a, -0.07 * r, z), 0.006 * r, 8), lathe_knob(a, -0.07 * r, z, 0.018 * r))
    m.slide("plunger", (0, -1, 0), m.number(0.05, 0.08) * r)
    for s in (-1, 1):
        button(m, f"side_button_{s}", (s * wide / 2, 0.09 * r + 0.02, front - 0.05 * r), (s, 0, 0), 0.028 * r)
    if m.chance(0.6):
        button(m, "start_button", (-wide / 2 + 0.06 * r + 0.02, 0, z), (0, -1, 0), 0.024 * r)
    if small:
        return
    c, tall = m.number(0.1, 0.14), 0.13
    mid = (low + front - 0.08) / 2
    x, zz = (-c, c), (mid - tall + 0.02, mid + tall - 0.02)
    m.add(BASE, prism(rectangle((-c - 0.015, c + 0.015), (zz[0] - 0.015, zz[1] + 0.015), 0.014), "y", (-0.006, 0)))
    m.add("coin_door", box(x, (-0.006, -0.0005), zz))
    for b in (-0.4 * c, 0.4 * c):
        m.add("coin_door", box((b - 0.025, b + 0.025), (-0.016, -0.006), (mid, mid + 0.07)))
        m.add("coin_door", box((b - 0.025, b + 0.025), (-0.01, -0.006), (mid - 0.07, mid - 0.03)))
    s = m.pick(-1, -1, 1)
    m.add("coin_door", rod((-s * (c - 0.015), -0.006, mid), (-s * (c - 0.015), -0.011, mid), 0.009, 10))
    m.hinge("coin_door", (s * c, -0.006, mid), (0, 0, s), m.number(90, 130))


def lathe_knob(x: float, y: float, z: float, r: float) -> Trimesh:
    """A round grip at the end of a rod to the front."""
    return upright([lathe([(0, 0), (0.5 * r, 0), (r, 0.6 * r), (r, 1.2 * r), (0.6 * r, 1.7 * r), (0, 1.7 * r)], 14)],
                   (0, -1, 0), (x, y, z))[0]  # fmt: skip


def _back_box(m: Model, wide: float, long: float, rear: float, small: bool) -> None:
    """The head that stands at the rear with its lit picture: upright for good, or folding down on the glass."""
    k = 0.5 if small else 1.0
    half, deep, high = wide / 2 + m.pick(0.0, 0.04, 0.06) * k, m.number(0.14, 0.22) * k, m.number(0.55, 0.75) * k
    y, z = (long - deep, long), (rear + 0.006, rear + high)
    if m.chance(0.4):
        part = "back_box"
        m.hinge(part, (0, y[0] if m.chance(0.5) else y[0] + 0.02 * k, z[0]), (1, 0, 0), m.pick(80, 85))
    else:
        part = BASE
    frame = 0.02 * k
    m.add(
        part,
        cut(
            box((-half, half), y, z),
            box((-half + frame, half - frame), (y[0] - 1, y[0] + 0.02 * k), (z[0] + 0.16 * k, z[1] - frame)),
        ),
    )
    m.add(
        BASE,
        *(
            box((s * (wide / 2 - 0.05 * k), s * (wide / 2 - 0.1 * k)), (y[0] + 0.02, y[1] - 0.01), (rear - 0.02, z[0] + 0.001))
            for s in (-1, 1)
        ),
    )
    m.add(part, sheet((-half + frame, half - frame), y[0] + 0.004 * k, (z[0] + 0.16 * k, z[1] - frame)))
    m.add(part, box((-0.6 * half, 0.6 * half), (y[0] - 0.003, y[0]), (z[0] + 0.03 * k, z[0] + 0.12 * k)))
    if m.chance(0.3):
        m.add(part, box((-0.5 * half, 0.5 * half), (y[0] + 0.02, y[1] - 0.02), (z[1], z[1] + 0.12 * k)))
