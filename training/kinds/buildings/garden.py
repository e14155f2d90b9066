"""Garden sheds."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely.geometry import Polygon
from shapely.geometry import box as window
from shapely.ops import unary_union

from training.kinds.joinery import alike
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, glazed, handle, hang, leaf, opening
from training.kinds.solids import (
    Span,
    box,
    prism,
    rectangle,
    rod,
)
from training.kinds.wheels import beam


def garden_shed(m: Model) -> None:
    """A wooden shed with one or two doors, windows that open or not, a gable or pent roof, cladding, a step."""
    half, deep, t, low = m.number(0.75, 1.35), m.number(1.2, 2.2), m.number(0.03, 0.05), m.pick(0.03, 0.08, 0.12)
    high, rise, roof = low + m.number(1.85, 2.05), m.number(0.25, 0.5), m.pick("gable", "ridge", "pent")
    front = [(-half, low), (half, low), (half, high), (-half, high)]
    wide = (m.number(0.7, 0.85),) if half < 0.95 or m.chance(0.5) else (m.number(0.55, 0.65),) * 2
    room = 2 * half - sum(wide)
    start = -half + m.pick(0.15, 0.5, 0.85) * room if room < 0.8 else m.pick(-half + 0.12, half - 0.12 - sum(wide))
    door = ((start, start + sum(wide)), (low + 0.04, high - m.number(0.1, 0.16)))
    rooms = [door]
    free = max((-half, start), (start + sum(wide), half), key=lambda s: s[1] - s[0])
    if free[1] - free[0] > 0.6:
        rooms.append(((free[0] + 0.13, free[1] - 0.13), (low + m.number(0.85, 1.1), high - 0.2)))
    _shed_shell(m, (half, deep, t), (low, high, rise), roof, front, rooms)
    hands, seeds = m.pick(("left",), ("right",)) if len(wide) == 1 else ("left", "right"), int(m.rng.integers(1 << 30))
    y, clear = m.pick((0.0, t), (-0.012, t - 0.012)), 0.004
    for k, side in enumerate(hands):
        x = start + k * wide[0] + clear, start + (k + 1) * wide[0] - clear
        _shed_door(m, f"door_{k}", x, y, (door[1][0] + clear, door[1][1] - clear), side, seeds)
    for x, z in rooms[1:]:
        side = m.pick("top", "fixed", *(("left", "right") if x[1] - x[0] < z[1] - z[0] else ()))
        inner, tall = (x[0] + 0.006, x[1] - 0.006), (z[0] + 0.006, z[1] - 0.006)
        part = BASE if side == "fixed" else "window"
        glazed(m, part, inner, (0.0, t), tall, 0.05, (m.pick(0, 1), m.pick(0, 1)))
        if side != "fixed":
            hang(m, part, inner, (0.0, t), tall, side, OUT, m.pick(35, 60, 90) if side != "top" else m.pick(30, 45))
        opening(m, x, (-0.02, 0.02), z, 0.035)
        if m.chance(0.4):
            m.add(BASE, box(x, (-0.18, -0.02), (z[0] - 0.22, z[0] - 0.06)))
    if low > 0.05:
        m.add(BASE, box((start - 0.1, start + sum(wide) + 0.1), (-m.number(0.25, 0.5), 0.0), (0, 0.6 * low)))


def _shed_shell(m: Model, size: tuple, levels: tuple, roof: str, front: list, rooms: list) -> None:
    (half, deep, t), (low, high, rise), lap = size, levels, m.number(0.06, 0.15)
    peak = [(0, high + rise)] if roof == "gable" else []
    top = high + rise if roof == "pent" else high
    face = Polygon([front[0], front[1], (half, top), *peak, (-half, top)])
    back = Polygon([front[0], front[1], front[2], *peak, front[3]])
    holes = unary_union([rectangle(*r) for r in rooms])
    m.add(BASE, prism(face.difference(holes), "y", (0, t)), prism(back, "y", (deep - t, deep)))
    tops = {"gable": [], "ridge": [(deep / 2, high + rise)], "pent": []}[roof]
    side = [(t, low), (deep - t, low), (deep - t, high), *tops, (t, top)]
    m.add(BASE, *(prism(side, "x", (a, a + t)) for a in (-half, half - t)), box((-half, half), (0, deep), (low - 0.03, low)))
    m.add(BASE, *(box((-half, half), (c - 0.04, c + 0.04), (0, low)) for c in np.linspace(0.1, deep - 0.1, 3)))
    span = {"gable": (-half - lap, 0, half + lap), "ridge": (-lap, deep / 2, deep + lap), "pent": (-lap, deep + lap)}[roof]
    slope = rise / (half if roof == "gable" else deep / 2 if roof == "ridge" else deep)
    ends = (top + lap * slope, high - lap * slope) if roof == "pent" else (high - lap * slope, high + rise, high - lap * slope)
    line, axis = list(zip(span, ends, strict=True)), "y" if roof == "gable" else "x"
    reach = (-lap, deep + lap) if roof == "gable" else (-half - lap, half + lap)
    for p, q in pairwise(line):
        m.add(BASE, prism([p, q, (q[0], q[1] + 0.035), (p[0], p[1] + 0.035)], axis, reach))
        for s in np.linspace(0.15, 0.85, m.pick(1, 3, 5)):
            at = np.array(p) + s * (np.array(q) - p) + (0, 0.03)
            m.add(BASE, prism(window(at[0] - 0.02, at[1] - 0.01, at[0] + 0.02, at[1] + 0.015), axis, reach))
    clad = m.pick("none", "lying", "upright", "upright")
    if clad != "none":
        bands = [window(-half, z, half, z + 0.1) for z in np.arange(low, top, 0.13)]
        if clad == "upright":
            bands = [window(x, low, x + 0.04, high + rise) for x in np.arange(-half, half, 0.16)]
        left = unary_union(bands).intersection(face).difference(holes.buffer(0.036, join_style="mitre"))
        m.add(BASE, *(prism(g, "y", (-0.011, 0.0)) for g in getattr(left, "geoms", [left]) if g.area > 1e-4))
        for s in (-1, 1) if clad == "lying" else ():
            m.add(
                BASE, *(box((s * half, s * (half + 0.011)), (0, deep), (z, z + 0.1)) for z in np.arange(low, high - 0.1, 0.13))
            )
    if m.chance(0.5):
        m.add(BASE, *(box((s * half - 0.03, s * half + 0.03), (-0.02, 0.02), (low, high)) for s in (-1, 1)))


def _shed_door(m: Model, part: str, x: Span, y: Span, z: Span, side: str, seed: int) -> None:
    same = alike(m, seed)
    inward, wide = (-1 if side == "left" else 1), x[1] - x[0]
    leaf(same, part, x, y, z)
    near, far = (x[0], x[1]) if side == "left" else (x[1], x[0])
    if same.chance(0.5):
        zs = np.linspace(z[0] + 0.25, z[1] - 0.25, same.pick(2, 3))
        m.add(
            part, *(box(sorted((near, near - inward * 0.6 * wide)), (y[0] - 0.005, y[0]), (c - 0.025, c + 0.025)) for c in zs)
        )
    if same.chance(0.4):
        m.add(part, beam((near, y[0] - 0.006, z[0] + 0.3), (far, y[0] - 0.006, z[1] - 0.3), 0.09, 0.012, (0, 0, 1)))
    hang(same, part, x, y, z, side, OUT, m.pick(90, 110, 150))
    if side == "left" or same.chance(0.6):
        handle(same, part, (far + inward * 0.08, z[0] + 0.95), y, inward, same.pick("front", "both"))
    if part == "door_0" and m.chance(0.4):
        at, c = far + inward * 0.13, z[0] + 1.3
        m.add(
            "bolt",
            rod((at, y[0] - 0.02, c), (at - inward * 0.19, y[0] - 0.02, c), 0.009, 8),
            rod((at, y[0] - 0.02, c), (at, y[0] - 0.06, c), 0.007, 8),
        )
        m.add(
            part,
            *(
                box((d - 0.01, d + 0.01), (y[0] - 0.035, y[0]), (c - 0.02, c + 0.02))
                for d in (at + inward * 0.02, at - inward * 0.06)
            ),
        )
        m.slide("bolt", (inward, 0, 0), 0.07, part)
