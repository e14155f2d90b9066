"""Sheds and lofts: a shed for tools, a loft hatch with its ladder."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.mason_openings import knuckles, swing
from training.kinds.mason_style import grip, leaf, plate, slab, style_of
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rectangle, rod, turned


def _tools(m: Model, wide: float, deep: float, high: float) -> None:
    """A shelf and long tools that stand in a shed."""
    z = m.number(0.4, 0.65) * high
    m.add(BASE, box((0.02, wide - 0.02), (0.65 * deep, deep - 0.02), (z, z + 0.02)))
    for k in range(m.pick(1, 2, 3)):
        x = (0.2 + 0.25 * k) * wide
        m.add(BASE, rod((x, 0.55 * deep, 0.03), (x, 0.64 * deep, 0.95 * z), 0.014, 8))
        m.add(BASE, box((x - 0.08, x + 0.08), (0.54 * deep, 0.57 * deep), (0.03, 0.2)))
    m.add(BASE, box((0.6 * wide, 0.85 * wide), (0.7 * deep, 0.9 * deep), (z + 0.019, z + 0.2)))


def _shed_doors(m: Model, style: str, a: Span, c: Span, t: float, pair: bool) -> None:
    gap, look = max(m.gap(0.5), 0.002), m.pick("boards", "boards", "panels", "flat", "slats")
    middle = (a[0] + a[1]) / 2
    spans = ((a[0] + gap, middle - gap / 2), (middle + gap / 2, a[1] - gap)) if pair else ((a[0] + gap, a[1] - gap),)
    y = m.pick((-t, 0.0), (-0.002, t - 0.002))
    for k, (b, side) in enumerate(zip(spans, (-1, 1) if pair else (m.pick(-1, 1),), strict=True)):
        part = f"door_{k}" if pair else "door"
        m.add(part, *leaf(m, style, look, b, (c[0] + gap, c[1] - gap), y))
        x = b[(side + 1) // 2]
        knuckles(m, style, part, x, y[0], c, side)
        swing(m, part, x, y[0], side, m.pick(90, 110, 130) if y[0] < -0.01 else 95)
        m.add(part, *grip(m, style, b[(1 - side) // 2] + side * 0.07, c[0] + 0.5 * (c[1] - c[0]), y[0], -1.0, 0.8))


def garden_tool_shed(m: Model) -> None:
    """A shed with a gable, a sloping or a flat roof, doors, a window; or a low one with a lid as its roof."""
    style, design = style_of(m), m.pick("gable", "gable", "slope", "chest", "locker")
    wide, deep = m.number(1.2, 2.6), m.number(0.8, 2.0)
    high, t, rise = m.number(1.75, 2.1), m.number(0.02, 0.04), m.number(0.15, 0.5)
    if design == "chest":
        wide, deep, high, rise = m.number(1.2, 1.9), m.number(0.6, 0.9), m.number(0.9, 1.3), m.number(0.03, 0.12)
    if design == "locker":
        wide, deep, rise = m.number(0.7, 1.1), m.number(0.45, 0.8), m.number(0.06, 0.15)
    pair, foot = m.chance(0.5) or design == "chest", 0.06
    door = m.number(0.85, 1.0) * (min(wide - 0.2, 1.5) if pair else 0.8)
    left = (wide - door) / 2 if m.chance(0.6) or pair else 0.12
    a, c = (left, left + door), (foot + 0.02, high - m.number(0.06, 0.14))
    peak = [(wide / 2, high + rise)] if design == "gable" else []
    front = Polygon([(0, foot), (wide, foot), (wide, high), *peak, (0, high)])
    m.add(BASE, plate(style, front.difference(rectangle(a, c)), (0, t)))
    back = high if design == "gable" else high + (rise if design == "chest" else -rise)
    m.add(BASE, plate(style, front if peak else [(0, foot), (wide, foot), (wide, back), (0, back)], (deep - t, deep)))
    for x in ((0, t), (wide - t, wide)):
        side = Polygon([(t, foot), (deep - t, foot), (deep - t, back), (t, high)])
        wall = turned(plate("prop", side, (0, t)), (0, 0, 1), 90, (0, 0, 0))
        wall.apply_translation((x[1], 0, 0))
        m.add(BASE, wall)
    m.add(BASE, box((-0.02, wide + 0.02), (0, deep), (0, foot + 0.002)))
    _shed_doors(m, style, a, c, t, pair)
    if m.chance(0.5):
        _tools(m, wide, deep, min(high, back))
    eave, thick = m.number(0.06, 0.18), m.number(0.02, 0.05)
    if design == "gable":
        slope = rise / (wide / 2)
        line = [(-eave, high - slope * eave), (wide / 2, high + rise), (wide + eave, high - slope * eave)]
        up = [(x, z + thick) for x, z in line[::-1]]
        m.add(BASE, plate("prop", line + up, (-eave, deep + eave)))
    else:
        low, far = high - eave * (back - high) / deep, back + eave * (back - high) / deep
        side = [(-eave, low + 0.001), (deep + eave, far + 0.001), (deep + eave, far + thick), (-eave, low + thick)]
        roof = turned(plate("prop", side, (-wide - eave, eave)), (0, 0, 1), 90, (0, 0, 0))
        m.add("roof" if design == "chest" else BASE, roof)
        if design == "chest":
            m.hinge("roof", (wide / 2, deep, back), (-1, 0, 0), m.pick(50, 70, 85))
    _trims(m, style, wide, deep, min(high, back), high + rise if design == "gable" else 0.0)
    _shed_window(m, style, wide, (min(a[1] + 0.12, wide - 0.1), wide - 0.12), high)


def _trims(m: Model, style: str, wide: float, deep: float, high: float, ridge: float) -> None:
    """Boards at the corners, a ridge, a blind window at a side, a ramp, a box beside it; all of them stay."""
    t = m.number(0.012, 0.03)
    if m.chance(0.5):
        for x in ((-t, 0.06), (wide - 0.06, wide + t)):
            m.add(BASE, *(slab(style, x, y, (0.06, high)) for y in ((-0.9 * t, 0.004), (deep - 0.004, deep + t))))
    if ridge and m.chance(0.5):
        m.add(BASE, slab("prop", (wide / 2 - 0.06, wide / 2 + 0.06), (-0.05, deep + 0.05), (ridge - 0.01, ridge + 0.07)))
    if m.chance(0.4):
        blind = leaf(m, style, "glass", (0.3 * deep, 0.7 * deep), (0.5 * high, 0.8 * high), (-0.02, 0.002))
        for solid in blind:
            m.add(BASE, turned(solid, (0, 0, 1), 90, (0, 0, 0)))
            solid.apply_translation((wide, 0, 0))
    if m.chance(0.25):
        m.add(BASE, prism([(0.005, 0.0), (0.005, 0.06), (-0.45, 0.0)], "x", (0.2 * wide, 0.8 * wide)))
    if m.chance(0.25):
        m.add(BASE, slab(style, (-0.4, -t + 0.002), (0.3 * deep, 0.8 * deep), (0, 0.5)))
    if m.chance(0.3):
        m.add(
            BASE,
            *(box((-0.012, 0.002), (0.4 * deep, 0.6 * deep), (z, z + 0.02)) for z in np.arange(0.7 * high, 0.8 * high, 0.035)),
        )


def _shed_window(m: Model, style: str, wide: float, a: Span, high: float) -> None:
    """A light beside the door when there is room; it opens at its top now and then."""
    if a[1] - a[0] < 0.25:
        return
    c, y = (0.55 * high, 0.8 * high), (-0.025, 0.001)
    part = "window" if m.chance(0.5) else BASE
    m.add(part, *leaf(m, style, "glass", a, c, y))
    if part != BASE:
        m.hinge("window", (wide / 2 + a[0] / 2, y[0], c[1]), (-1, 0, 0), m.pick(30, 50))
        m.add("window", *grip(m, style, (a[0] + a[1]) / 2, c[0] + 0.02, y[0], -1.0, 0.3))
