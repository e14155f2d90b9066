"""Doors of spaceships, whose leaves part into a hollow wall."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon
from shapely.geometry import box as window

from training.kinds.kitchen_trims import button
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rectangle, rod, rounded, tube


def airlock_door(m: Model) -> None:
    """A door of a spaceship: two or four leaves that part into a hollow wall, straight, slanted or toothed; panels, lamps."""
    half, high, t = m.number(0.6, 1.3), m.number(1.9, 2.6), m.number(0.04, 0.09)
    corner, style = m.number(0.1, 0.45) * half, m.pick("sides", "sides", "sides", "up", "four")
    gap, plate, low = m.number(0.012, 0.03), m.number(0.05, 0.12), m.pick(0.02, 0.1)
    hole = _octagon(half, (low, low + high), corner)
    side, top = (
        (m.number(0.2, 0.4) if style == "up" else half + 0.2),
        low + high + (m.number(0.2, 0.4) if style == "sides" else 0.5 * high + 0.2),
    )
    wall = rectangle((-half - side, half + side), (-(0.5 * high + 0.2) if style in ("up", "four") else 0.0, top))
    for y in ((-gap - t / 2 - plate, -gap - t / 2), (gap + t / 2, gap + t / 2 + plate)):
        m.add(BASE, prism(wall.difference(hole), "y", y))
    m.add(BASE, prism(wall.difference(wall.buffer(-0.05, join_style="mitre")), "y", (-gap - t / 2, gap + t / 2)))
    rim = m.number(0.06, 0.15)
    for f, sign in ((-gap - t / 2 - plate, -1), (gap + t / 2 + plate, 1)):
        m.add(
            BASE,
            prism(
                hole.buffer(rim, join_style="mitre").difference(hole).intersection(wall),
                "y",
                (f, f + sign * m.number(0.03, 0.1)),
            ),
        )
    middle, leap = low + high / 2, m.pick(0.0, 0.0, 0.1, 0.2) * half
    room = hole.buffer(0.02, join_style="mitre")
    splits = _splits(m, style, half + 0.1, middle, high, leap)
    for k, (area, way) in enumerate(splits):
        part, shape = f"leaf_{k}", room.intersection(area)
        m.add(part, prism(shape, "y", (-t / 2, t / 2)))
        _leaf_trims(m, part, shape, (t, 0.7 * gap), bool(way[0]), style == "four")
        travel = (half if way[0] else 0.5 * high) * 0.96
        m.slide(part, (way[0], 0, way[1]), travel - (leap if way[0] else 0))
    face = -gap - t / 2 - plate
    a = m.pick(-1, 1) * (half + rim + 0.12)
    if style == "up":
        a = m.pick(-1, 1) * (half + 0.5 * (side + rim))
    _door_panel(m, a, face, low + m.number(1.0, 1.2))
    for s in (-1, 1) if m.chance(0.6) else ():
        m.add(
            BASE,
            box((s * 0.3 * half, s * 0.6 * half), (face - 0.05, face), (low + high + rim * 0.3, low + high + rim * 0.3 + 0.06)),
        )
    if m.chance(0.4) and style != "up":
        for s in (-1, 1):
            m.add(
                BASE,
                tube([(s * (half + side - 0.08), face - 0.03, 0.0), (s * (half + side - 0.08), face - 0.03, top)], 0.03, 8),
            )


def _octagon(half: float, z: Span, cut_off: float) -> Polygon:
    """A rectangle with its corners cut off."""
    a, (low, high) = half - cut_off, z
    upper = [(half, high - cut_off), (a, high), (-a, high), (-half, high - cut_off)]
    return Polygon([(-half, low + cut_off), (-a, low), (a, low), (half, low + cut_off), *upper])


def _splits(
    m: Model, style: str, half: float, middle: float, high: float, leap: float
) -> list[tuple[Polygon, tuple[int, int]]]:
    """The share of each leaf in the opening, and the direction to which it goes."""
    z = np.linspace(middle - high, middle + high, 2) if not leap else middle + high * np.linspace(-0.7, 0.7, m.pick(4, 6, 8))
    sign = np.where(np.arange(len(z)) % 2, 1, -1) if leap and m.chance(0.5) else np.linspace(-1, 1, len(z))
    line = [(leap * s, c) for s, c in zip(sign, z, strict=True)]
    left = Polygon(
        [
            (-2 * half, middle - 2 * high),
            *[(p[0], p[1]) for p in [(line[0][0], middle - 2 * high), *line, (line[-1][0], middle + 2 * high)]],
            (-2 * half, middle + 2 * high),
        ]
    )
    if style == "sides":
        return [(left, (-1, 0)), (window(-2 * half, middle - 2 * high, 2 * half, middle + 2 * high).difference(left), (1, 0))]
    lower = window(-2 * half, middle - 2 * high, 2 * half, middle)
    upper = window(-2 * half, middle, 2 * half, middle + 2 * high)
    if style == "up":
        return [(upper, (0, 1)), (lower, (0, -1))]
    flat = Polygon([(-2 * half, middle - 2 * half), (0, middle), (-2 * half, middle + 2 * half)])
    other = Polygon([(2 * half, middle - 2 * half), (0, middle), (2 * half, middle + 2 * half)])
    both = flat.union(other)
    return [(flat, (-1, 0)), (other, (1, 0)), (upper.difference(both), (0, 1)), (lower.difference(both), (0, -1))]


def _leaf_trims(m: Model, part: str, shape: Polygon, size: tuple[float, float], wide: bool, plain: bool) -> None:
    """Sunk or thin pieces on a leaf that still pass into the wall."""
    inner = shape.buffer(-0.12, join_style="mitre")
    if inner.is_empty or plain:
        return
    style = m.pick("plate", "strips", "window", "none")
    a, b, c, d = inner.bounds
    t, thin = size
    if style == "plate":
        m.add(part, *(prism(g, "y", (-t / 2 - thin, t / 2 + thin)) for g in getattr(inner, "geoms", [inner])))
    elif style == "strips":
        bands = [inner.intersection(window(a, e, c, e + 0.06)) for e in np.linspace(b, d, 7)[:-1]]
        m.add(part, *(prism(g, "y", (-t / 2 - thin, t / 2 + thin)) for g in bands if isinstance(g, Polygon) and g.area > 1e-3))
    elif style == "window" and wide:
        x, z = (a + 0.3 * (c - a), a + 0.75 * (c - a)), (b + 0.62 * (d - b), b + 0.85 * (d - b))
        m.add(part, prism(rectangle(x, z, 0.02), "y", (-t / 2 - thin, t / 2 + thin)))


def _door_panel(m: Model, x: float, face: float, z: float) -> None:
    """The panel beside a door: a screen, buttons, a card slot, a lever behind a cover."""
    m.add(BASE, prism(rounded((x - 0.08, x + 0.08), (z - 0.14, z + 0.14), 0.02), "y", (face - 0.025, face)))
    if m.chance(0.7):
        m.add(BASE, box((x - 0.055, x + 0.055), (face - 0.028, face - 0.025), (z + 0.02, z + 0.11)))
    rows, cols = m.pick((1, 2), (2, 3), (1, 1))
    for k in range(rows * cols):
        at = (x + 0.045 * (k % cols - (cols - 1) / 2), face - 0.025, z - 0.03 - 0.04 * (k // cols))
        button(m, f"button_{k}", at, (0, -1, 0), 0.028)
    if m.chance(0.3):
        m.add(
            "lever",
            rod((x + 0.1, face - 0.03, z - 0.3), (x - 0.1, face - 0.03, z - 0.3), 0.016, 10),
            box((x - 0.1, x - 0.06), (face - 0.09, face - 0.03), (z - 0.31, z - 0.29)),
        )
        m.add(BASE, box((x - 0.05, x + 0.05), (face - 0.03, face), (z - 0.35, z - 0.25)))
        m.hinge("lever", (x, face - 0.03, z - 0.3), (1, 0, 0), m.number(60, 90))
