"""Dressing tables with three mirrors."""

from __future__ import annotations

from shapely.geometry import Polygon

from training.kinds.carcass import clutter, legs
from training.kinds.furniture.seating import cushion
from training.kinds.kitchen_parts import Look, fill
from training.kinds.kitchen_trims import feet
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang, middle
from training.kinds.shells import manner, place, shell
from training.kinds.solids import Span, arch, box, prism, rectangle, rod, rounded


def dressing_table_triple_mirror(m: Model) -> None:
    """A table with drawers below and three mirrors above, the outer two hinged to the middle one; perhaps a stool."""
    wide, deep, high, how = m.number(0.9, 1.4), m.number(0.4, 0.5), m.number(0.7, 0.78), manner(m)
    style, t, x, y = m.pick("knee", "knee", "legs", "side", "bench"), 0.02, (0.0, wide), (0.0, deep)
    low = high - m.number(0.11, 0.15)
    n = m.pick(1, 2, 3)
    if style == "legs":
        for k, (room,) in enumerate(shell(m, x, y, (low, high), [(1.0, [1.0])] * n, t)):
            place(m, f"drawer_{k}", "drawer", room, how, deep, t)
        legs(m, x, y, low, m.number(0.035, 0.05))
    else:
        _pedestals(m, wide, deep, (low, high), style, how)
    top = high + m.number(0.018, 0.03)
    outline = (-0.015, wide + 0.015), (-0.02, deep)
    m.add(BASE, prism(m.pick(rounded(*outline, 0.04), rectangle(*outline)), "z", (high, top)))
    _mirrors(m, wide, deep, top, how)
    if m.chance(0.4):  # a stool before it
        c, s = middle((0.3 * wide, 0.7 * wide)), 0.2
        b = -0.35
        m.add(
            BASE,
            cushion(m, (c - s, c + s), (b - 0.15, b + 0.15), (0.4, 0.46)),
            box((c - s, c + s), (b - 0.15, b + 0.15), (0.37, 0.4)),
        )
        m.add(BASE, *(rod((c + e, b + f, 0), (c + e, b + f, 0.38), 0.018, 10) for e in (-0.17, 0.17) for f in (-0.12, 0.12)))


def _pedestals(m: Model, wide: float, deep: float, z: Span, style: str, how: Look) -> None:
    """Drawers at one or both ends of a table, on the floor or on legs, and one between them."""
    (low, high), y, t = z, (0.0, deep), 0.02
    ends = [(0.0, m.number(0.28, 0.36) * wide)]
    ends += [(wide - ends[0][1], wide)] if style != "side" else []
    floor = 0.06
    for i, span in enumerate(ends):
        rows = m.pick(2, 3) if style != "bench" else 1
        bottom = floor if style != "bench" else high - 0.3
        rooms = shell(m, span, y, (bottom, high), [(1.0, [1.0] * rows)], t)[0]
        job = m.pick("drawer", "drawer", "door")
        for k, room in enumerate(rooms):
            side = "left" if i == 0 else "right"
            what = side if job == "door" and k == 0 and rows < 3 else "drawer"
            place(m, f"{'drawer' if what == 'drawer' else 'door'}_{i}_{k}", what, room, how, deep, t)
        if style == "bench":
            m.add(
                BASE,
                *(
                    box((a, a + 0.04), (b, b + 0.04), (0, bottom))
                    for a in (span[0], span[1] - 0.04)
                    for b in (0.0, deep - 0.04)
                ),
            )
        else:
            feet(m, span, y, floor)
    middle_x = (ends[0][1], ends[1][0] if len(ends) > 1 else wide - 0.04)
    if len(ends) == 1:
        m.add(BASE, box((wide - 0.04, wide), (0.0, deep), (0, high)))
    if m.chance(0.6):
        room = ((middle_x[0] + 0.003, middle_x[1] - 0.003), (low, high - 0.002))
        place(m, "knee_drawer", "drawer", room, how, deep, 0.002)
    if m.chance(0.5):
        m.add(BASE, box(middle_x, (deep - 0.01, deep), (high - 0.35, high)))


def _pane(m: Model, part: str, shape: Polygon, y: Span, plain: bool) -> None:
    """A mirror in its frame, or a bare one on its backing."""
    m.add(part, prism(shape, "y", (y[0] + 0.004, y[1])))
    inside = shape.buffer(-0.004 if plain else -0.03)
    if plain:
        m.add(part, prism(inside, "y", (y[0], y[0] + 0.004)))
    else:
        m.add(part, prism(Polygon(shape.exterior.coords, [inside.exterior.coords]), "y", (y[0] - 0.004, y[0] + 0.004)))
        m.add(part, prism(inside.buffer(0.002), "y", (y[0] + 0.001, y[0] + 0.004)))


def _trinkets(m: Model, wide: float, deep: float, level: float, how: Look) -> float:
    """Small drawers at both ends of a ledge; return its height."""
    base = level + 0.1
    for i, span in enumerate(((0.02, 0.28 * wide), (0.72 * wide, wide - 0.02))):
        room = shell(m, span, (deep - 0.2, deep), (level, base), [(1.0, [1.0])], 0.012)[0][0]
        inner = (room[0][0] + 0.002, room[0][1] - 0.002), (room[1][0] + 0.002, room[1][1] - 0.002)
        part = f"trinket_{i}"
        fill(m, part, inner[0], (deep - 0.2 + 0.002, deep - 0.184), inner[1], how, "middle")
        m.add(
            part,
            box((inner[0][0] + 0.004, inner[0][1] - 0.004), (deep - 0.184, deep - 0.02), (inner[1][0], inner[1][0] + 0.006)),
        )
        m.slide(part, (0, -1, 0), 0.12)
    m.add(BASE, box((0.28 * wide, 0.72 * wide), (deep - 0.06, deep), (level, base)))
    return base


def _mirrors(m: Model, wide: float, deep: float, level: float, how: Look) -> None:
    """Three mirrors, perhaps over small drawers; the middle one is fixed or tilts."""
    half, tall, at = m.number(0.18, 0.26) * wide, m.number(0.5, 0.75), wide / 2
    base = _trinkets(m, wide, deep, level, how) if m.chance(0.5) else level
    y, low, plain = (deep - 0.04, deep - 0.018), base + m.pick(0.0, 0.02), m.chance(0.4)
    shape, side = m.pick("square", "arch", "round"), 0.6 * 2 * half
    span = (at - half, at + half)
    center = (
        arch(span, (low, low + tall), m.number(0.05, 0.2))
        if shape == "arch"
        else rounded(span, (low, low + tall), 0.02 if shape == "round" else 0.001)
    )
    tilts = m.chance(0.25)
    part = "mirror" if tilts else BASE
    _pane(m, part, center, y, plain)
    m.add(
        BASE,
        *(
            box((a, a + 0.03), (y[1], y[1] + 0.016), (level, low + 0.6 * tall))
            for a in (at - 0.6 * half, at + 0.6 * half - 0.03)
        ),
    )
    if tilts:
        m.hinge("mirror", (at, y[1], low + 0.5 * tall), (1, 0, 0), (-5, 15))
    short = m.pick(1.0, 0.85, 0.8)
    for name, a, way in (("left", at - half, -1), ("right", at + half, 1)):
        edges: Span = (a - side, a - 0.002) if way < 0 else (a + 0.002, a + side)
        up = (low, low + short * (tall - (0.05 if shape == "arch" else 0.0)))
        leaf = rounded(edges, up, 0.02) if shape == "round" else rectangle(edges, up)
        if shape == "arch":
            rise = [(edges[0 if way < 0 else 1], up[1] - 0.12), (edges[1 if way < 0 else 0], up[1])]
            outer, inner = rise
            leaf = Polygon([(outer[0], low), outer, inner, (inner[0], low)])
        _pane(m, f"wing_{name}", leaf, y, plain)
        hang(m, f"wing_{name}", edges, y, up, "right" if way < 0 else "left", OUT, m.pick(60, 75, 90), part)
    if m.chance(0.4):
        clutter(m, (0.02, 0.25 * wide), (0.03, deep - 0.25), level)
