"""Caravans: a door, windows that hang at the top, steadies, hatches."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
from shapely.geometry import Point, Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, prism, rectangle, rod, rounded, vec
from training.kinds.vehicles.vehicles import prisms
from training.kinds.wheels import axled, beam, wheel_maker


def _top_hung(m: Model, part: str, s: int, face: float, y: Span, z: Span) -> None:
    """A window in a side that opens at its bottom."""
    radius, thick = m.pick(0.03, 0.08), 0.03
    x = tuple(sorted((s * (face + 0.003), s * (face + thick))))
    frame = rounded(y, z, radius)
    if m.chance(0.5):
        m.add(part, prism(frame, "x", x))
    else:
        m.add(part, prism(Polygon(frame.exterior.coords, [frame.buffer(-0.05).exterior.coords]), "x", x))
        m.add(part, prism(frame.buffer(-0.045), "x", tuple(sorted((s * (face + 0.01), s * (face + 0.016))))))
    m.add(BASE, box((s * face, s * (face + 0.035)), (y[0] + 0.03, y[1] - 0.03), (z[1] + 0.002, z[1] + 0.03)))
    m.hinge(part, (s * (face + 0.5 * thick), y[0], z[1]), (0, -s, 0), m.pick(45, 60, 70))


def _steadies(m: Model, half: float, y: Span, z: float) -> None:
    """A leg at each corner that swings down from below the floor."""
    length, foot = m.number(0.46, 0.54), m.pick(0.04, 0.08)
    turn = float(np.degrees(np.arcsin(0.93 * z / length)))
    for s, a in ((-1, "left"), (1, "right")):
        for at, way, b in ((y[0] + 0.2, 1, "front"), (y[1] - 0.2, -1, "rear")):
            x, part = s * (half - 0.18), f"steady_{b}_{a}"
            m.add(BASE, box((x - 0.05, x + 0.05), (at - 0.05, at + 0.05), (z - 0.02, z + 0.06)))
            m.add(part, beam((x, at, z - 0.03), (x, at + way * length, z - 0.03), 0.045, 0.03))
            m.add(
                part, box((x - foot, x + foot), (at + way * (length - 0.02), at + way * (length + 0.01)), (z - 0.09, z + 0.01))
            )
            m.hinge(part, (x, at, z - 0.03), (-way, 0, 0), turn)


def _drawbar(m: Model, half: float, z: float, make: Callable[..., None]) -> None:
    """The frame to the coupling with a jockey wheel and perhaps a locker whose lid lifts."""
    tip = vec(0, -m.number(1.0, 1.3), z + 0.05)
    m.add(BASE, *(beam((s * 0.6 * half, 0.1, z), tip, 0.06, 0.09) for s in (-1, 1)))
    m.add(BASE, rod(tip + vec(0, 0.1, 0), tip - (0, 0.15, 0), 0.045, 10), ball(tip - (0, 0.17, 0), (0.06, 0.07, 0.06), 10))
    m.add(
        BASE,
        rod(tip + vec(0.09, 0.2, -0.25), tip + vec(0.09, 0.2, 0.3), 0.025, 10),
        beam(tip + vec(0.09, 0.2, 0.3), tip + vec(0.2, 0.2, 0.3), 0.02, 0.02, (0, 1, 0)),
    )
    m.add(
        BASE,
        *(
            box((0.09 + c - 0.006, 0.09 + c + 0.006), (tip[1] + 0.16, tip[1] + 0.24), (0.1, tip[2] - 0.2))
            for c in (-0.045, 0.045)
        ),
    )
    make("jockey_wheel", (0.09, tip[1] + 0.2, 0.11), (1, 0, 0), 0.11, 0.06)
    if m.chance(0.6):
        x, y, top = 0.6 * half, (-0.6, -0.03), z + m.number(0.4, 0.55)
        m.add(BASE, box((-x, x), y, (z + 0.05, top)))
        m.add(
            "locker_lid",
            prism(
                [
                    (y[0] - 0.02, top + 0.005),
                    (y[1], top + 0.005),
                    (y[1], top + 0.14),
                    (y[0] + 0.1, top + 0.1),
                    (y[0] - 0.02, top + 0.03),
                ],
                "x",
                (-x - 0.02, x + 0.02),
            ),
        )
        m.hinge("locker_lid", (0, y[1], top + 0.005), (-1, 0, 0), m.pick(60, 75))


def _caravan_door(m: Model, shell: Trimesh, s: int, half: float, y: Span, z: Span) -> Trimesh:
    """A door in one side, whole or in two leaves; returns the shell with its opening."""
    edge, split = m.pick(0, 1), m.chance(0.3)
    leaves = [z] if not split else [(z[0], z[0] + 0.5 * (z[1] - z[0]) - 0.004), (z[0] + 0.5 * (z[1] - z[0]) + 0.004, z[1])]
    for k, span in enumerate(leaves):
        part = f"door_{k}" if split else "door"
        panel = rectangle((y[0] + 0.006, y[1] - 0.006), (span[0] + 0.005, span[1] - 0.005))
        pane = rounded((y[0] + 0.12, y[1] - 0.12), (max(span[0], z[0] + 0.55 * (z[1] - z[0])) + 0.12, span[1] - 0.12), 0.05)
        glass = (k == len(leaves) - 1) and m.chance(0.7)
        m.add(part, prism(panel.difference(pane) if glass else panel, "x", tuple(sorted((s * half, s * (half - 0.035))))))
        if glass and m.chance(0.7):
            m.add(part, prism(pane.buffer(0.004), "x", tuple(sorted((s * (half - 0.012), s * (half - 0.02))))))
        free = y[1 - edge] + (0.1 if edge else -0.1)
        grip = span[0] + 0.45 * (span[1] - span[0])
        m.add(part, box((s * half, s * (half + 0.035)), (free - 0.06, free + 0.06), (grip - 0.015, grip + 0.015)))
        for c in (0.15, 0.85):
            h = span[0] + c * (span[1] - span[0])
            m.add(BASE, rod((s * half, y[edge], h - 0.05), (s * half, y[edge], h + 0.05), 0.012, 8))
        m.hinge(part, (s * half, y[edge], span[0]), (0, 0, -s if edge == 0 else s), m.pick(90, 120, 160))
    m.add(
        BASE,
        box((s * (half - 0.1), s * (half + 0.25)), (y[0] + 0.08, y[1] - 0.08), (z[0] - 0.2, z[0] - 0.16)),
        *(box((s * (half - 0.1), s * (half - 0.05)), (c, c + 0.04), (z[0] - 0.2, z[0])) for c in (y[0] + 0.15, y[1] - 0.2)),
    )
    return cut(shell, box((s * (half - 0.08), s * (half + 1)), y, z))


def caravan(m: Model) -> None:
    """Make a box, rounded or teardrop caravan: door whole or split, top-hung windows, steadies, hatches, axles."""
    form = m.pick("box", "round", "drop", "box")
    long, half, high = m.number(3.8, 6.0), m.number(1.0, 1.15), m.number(2.35, 2.65)
    if form == "drop":
        long, half, high = m.number(2.9, 3.5), m.number(0.8, 0.95), m.number(1.6, 1.9)
    low, r, wall = 0.45, m.number(0.28, 0.33), 0.045
    shape = Polygon([(0, low), (0, 1.15), (m.number(0.1, 0.4), high), (long - m.pick(0.0, 0.15), high), (long, low)])
    if form == "round":
        shape = rounded((0, long), (low, high), m.number(0.35, 0.6), 5)
    elif form == "drop":
        shape = Polygon(
            [
                (0, low),
                (0, 0.9),
                (0.12, 1.3),
                (0.45, high - 0.1),
                (1.0, high),
                (1.6, high - 0.02),
                (long - 0.5, 1.15),
                (long, 0.7),
                (long, low),
            ]
        )
    axle, pair = 0.55 * long, long > 5 and m.chance(0.6)
    spots = [axle - 1.1 * r, axle + 1.1 * r] if pair else [axle]
    inside = shape.buffer(-wall)
    for y in spots:
        shape, inside = (p.difference(Point(y, r).buffer(k * r, quad_segs=6)) for p, k in ((shape, 1.18), (inside, 1.4)))
    shell = prism(max(getattr(shape, "geoms", [shape]), key=lambda p: p.area), "x", (-half, half))
    if m.chance(0.6):
        shell = cut(shell, *prisms(inside, "x", (-half + wall, half - wall)))
    door = (
        (axle - 1.3 * r - 0.85 - 0.4 * pair, axle - 1.3 * r - 0.2 - 0.4 * pair)
        if form == "drop" or m.chance(0.5)
        else (long - 1.0, long - 0.4)
    )
    side, sill = m.pick(-1, 1), low + 0.1
    m.add(
        BASE,
        _caravan_door(m, shell, side, half, door, (sill, sill + min(1.75, high - sill - (0.55 if form == "drop" else 0.2)))),
    )
    _caravan_windows(m, form, long, half, high, side, door)
    make = wheel_maker(m, ("tyre", "rim", "lathed", "disc"), 0.0)
    for k, y in enumerate(spots):
        axled(m, make, (-half + 0.03, half - 0.03), y, r, 0.18, f"axle_{k}")
    _drawbar(m, half, low - 0.02, make)
    _steadies(m, half, (0.1, long - 0.1), low - 0.02)
    for s in (-1, 1):
        m.add(BASE, box((s * (half - 0.25), s * (half - 0.08)), (long - 0.05, long + 0.02), (low + 0.12, low + 0.3)))


def _caravan_windows(m: Model, form: str, long: float, half: float, high: float, side: int, door: Span) -> None:
    """Windows in the sides, flaps, a rooflight, stripes."""
    z = (1.25, min(high - 0.35, 1.9)) if form != "drop" else (1.0, 1.3)
    ends = (0.5, long - 0.35) if form != "drop" else (0.6, 0.55 * long)
    for s in (-1, 1):
        free = [ends] if s != side else [(ends[0], door[0] - 0.15), (door[1] + 0.15, ends[1])]
        for a, b in free:
            count = int((b - a) / m.number(0.75, 1.2))
            edges = np.linspace(a, b, count + 1)
            for k, (c, d) in enumerate(pairwise(edges)):
                _top_hung(m, f"window_{'lr'[s > 0]}_{int(10 * c)}_{k}", s, half, (c + 0.06, d - 0.06), z)
        m.add(BASE, box((s * half, s * (half + 0.004)), (0.2, door[0] - 0.05 if s == side else long - 0.3), (0.95, 1.0)))
        if m.chance(0.6):
            y = door[0] - 0.75 if s == side and door[0] > 1.2 else 0.35
            m.add(
                f"flap_{'lr'[s > 0]}",
                box((s * half, s * (half + 0.015)), (y, y + 0.5), (0.6, 0.85)),
                box((s * half, s * (half + 0.025)), (y + 0.22, y + 0.28), (0.8, 0.83)),
            )
            m.hinge(f"flap_{'lr'[s > 0]}", (s * (half + 0.01), y, 0.6), (0, s, 0), m.pick(90, 120))
    if form == "drop":
        return
    y = m.number(0.4, 0.6) * long
    m.add(BASE, prism(rectangle((-0.3, 0.3), (y - 0.3, y + 0.3), 0.04), "z", (high - 0.01, high + 0.05)))
    m.add("rooflight", prism(rounded((-0.3, 0.3), (y - 0.3, y + 0.3), 0.05), "z", (high + 0.052, high + 0.1)))
    edge = m.pick(-1, 1)
    m.hinge("rooflight", (0, y + edge * 0.3, high + 0.05), (-edge, 0, 0), m.pick(40, 60))
    if m.chance(0.5):
        m.add(
            BASE,
            rod((0.4 * half, y + 0.8, high - 0.02), (0.4 * half, y + 0.8, high + 0.4), 0.015, 6),
            box((0.4 * half - 0.25, 0.4 * half + 0.25), (y + 0.78, y + 0.82), (high + 0.38, high + 0.41)),
        )
