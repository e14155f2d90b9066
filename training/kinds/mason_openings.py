"""Openings in walls: frames with heads, walls with their ornaments, sills, and how leaves hang in them."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point, Polygon

from training.kinds.mason_style import frame, plate, slab
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rectangle, rod, vec


def knuckles(m: Model, style: str, part: str, x: float, y: float, c: Span, side: float, parent: str = BASE) -> None:
    """Hinges on the line of a leaf at x, y: rods and plates, as far as a style shows them; side: away from the leaf."""
    if style in ("sheet", "block") or m.chance(0.3):
        return
    r, long = m.number(0.006, 0.012), m.number(0.05, 0.12)
    for s in m.pick((0.15, 0.85), (0.12, 0.5, 0.88)):
        z = c[0] + s * (c[1] - c[0])
        m.add(parent, rod((x, y, z - long / 2), (x, y, z), r, 8))
        m.add(part, rod((x, y, z + 0.001), (x, y, z + long / 2), r, 8))
        if style == "assembly":
            m.add(parent, box((x, x + side * 0.03), (y - 0.002, y + 0.002), (z - long / 2, z)))
            m.add(part, box((x, x - side * 0.03), (y - 0.002, y + 0.002), (z + 0.001, z + long / 2)))


def swing(m: Model, part: str, x: float, y: float, side: float, degrees: float | tuple[float, float], out: bool = True) -> None:
    """A leaf hung at its left (side -1) or right edge (1) that opens to the front, or to the back."""
    m.hinge(part, vec(x, y, 0), (0, 0, side if out else -side), degrees)


def _fan(m: Model, style: str, a: Span, z: float, y: Span, w: float) -> Polygon:
    """A half round light that stands above an opening, with spokes; returns its outline."""
    x, r, deep = (a[0] + a[1]) / 2, (a[1] - a[0]) / 2 + w, y[1] - y[0]
    upper = rectangle((x - 2 * r, x + 2 * r), (z - 0.001, z + 2 * r))
    whole = Point(x, z).buffer(r, quad_segs=m.pick(4, 8, 12)).intersection(upper)
    inner = Point(x, z).buffer(r - w, quad_segs=8).intersection(upper)
    m.add(BASE, plate(style, whole.difference(inner), y))
    m.add(BASE, plate(style, inner.buffer(0.002), (y[0] + 0.45 * deep, y[0] + 0.5 * deep)))
    for turn in np.linspace(0, np.pi, m.pick(3, 4, 5))[1:-1]:
        way, side = np.array([np.cos(turn), np.sin(turn)]), np.array([-np.sin(turn), np.cos(turn)]) * 0.2 * w
        line = [np.array([x, z]) + q for q in (side, -side, (r - 0.8 * w) * way - side, (r - 0.8 * w) * way + side)]
        m.add(BASE, plate(style, line, (y[0] + 0.3 * deep, y[0] + 0.7 * deep)))
    return whole


def _bricks(m: Model, wall: Polygon, y: float) -> None:
    """Some bricks that stand out of a wall."""
    low_x, low_z, high_x, high_z = wall.bounds
    long, course = m.number(0.14, 0.3), m.number(0.06, 0.12)
    for _ in range(m.pick(10, 25, 40)):
        x = low_x + long * 0.5 * int(m.number(0, 2 * (high_x - low_x) / long))
        z = low_z + course * int(m.number(0, (high_z - low_z) / course))
        brick = rectangle((x, x + 0.94 * long), (z, z + 0.88 * course))
        if wall.contains(brick):
            m.add(BASE, prism(brick, "y", (y - 0.006, y + 0.004)))


def _wall(m: Model, style: str, hole: Polygon, y: Span, foot: bool) -> None:
    """A wall about an opening with a level top, a gable or an arch; bricks, stones at its corners, a plinth."""
    low_x, low_z, high_x, high_z = hole.bounds
    more, over = m.number(0.15, 0.5), m.number(0.1, 0.4)
    a = (low_x - more, high_x + more)
    c = ((0.0 if foot else low_z - m.number(0.2, 0.7)), high_z + over)
    outline = rectangle(a, c)
    top = m.pick("level", "level", "gable", "steps")
    if top == "gable":
        outline = outline.union(
            Polygon([(a[0], c[1] - 0.01), (a[1], c[1] - 0.01), ((a[0] + a[1]) / 2, c[1] + 0.35 * (a[1] - a[0]))])
        )
    elif top == "steps":
        outline = outline.union(rectangle((a[0] + 0.2 * (a[1] - a[0]), a[1] - 0.2 * (a[1] - a[0])), (c[1] - 0.01, c[1] + 0.2)))
    wall = outline.difference(hole.buffer(-0.001, join_style="mitre"))
    deep = (y[0] + m.pick(0.0, 0.02), y[1] - m.pick(0.0, 0.02))
    m.add(BASE, plate(style, wall, deep))
    if m.chance(0.4):
        _bricks(m, wall, deep[0])
    if m.chance(0.3):
        h = m.number(0.1, 0.2)
        for k, z in enumerate(np.arange(c[0], c[1] - h, 1.04 * h)):
            long = min((0.16, 0.1)[k % 2], more - 0.02)
            m.add(
                BASE,
                *(
                    slab(style, x, (deep[0] - 0.012, deep[0] + 0.01), (z, z + h))
                    for x in ((a[0], a[0] + long), (a[1] - long, a[1]))
                ),
            )


def portal(m: Model, style: str, a: Span, c: Span, y: Span, w: float, foot: bool, wall: float) -> None:
    """The frame about an opening with a head, a wall and a sill perhaps; foot: open at the floor."""
    below = 0.0 if foot else w
    m.add(BASE, *frame(style, (a[0] - w, a[1] + w), (c[0] - below, c[1] + w), y, (w, w, below, w)))
    hole = rectangle((a[0] - w, a[1] + w), (c[0] - below - (0.01 if foot else 0), c[1] + w))
    head, top = m.pick("plain", "plain", "lintel", "fan", "hood", "gable"), c[1] + w
    if head == "fan" and a[1] - a[0] < 2.0:
        hole = hole.union(_fan(m, style, a, top, y, w)).buffer(0)
    elif head == "lintel":
        m.add(BASE, slab(style, (a[0] - 1.5 * w, a[1] + 1.5 * w), (y[0] - 0.03, y[1]), (top - 0.001, top + 0.9 * w)))
    elif head == "hood":
        side = [(y[0] + 0.02, top), (y[0] - 0.25, top), (y[0] - 0.25, top + 0.02), (y[0] + 0.02, top + m.number(0.03, 0.15))]
        m.add(BASE, prism(side, "x", (a[0] - 2 * w, a[1] + 2 * w)))
    elif head == "gable":
        x, rise = (a[0] + a[1]) / 2, m.number(0.08, 0.2) * (a[1] - a[0])
        line = [
            (a[0] - 1.6 * w, top - 0.001),
            (a[1] + 1.6 * w, top - 0.001),
            (a[1] + 1.6 * w, top + 0.03),
            (x, top + 0.03 + rise),
        ]
        m.add(BASE, plate(style, [*line, (a[0] - 1.6 * w, top + 0.03)], (y[0] - 0.04, y[1] - 0.01)))
    if m.chance(wall):
        _wall(m, style, hole, y, foot)
    if not foot and m.chance(0.6):
        z, out = c[0] - below, m.number(0.03, 0.1)
        m.add(BASE, slab(style, (a[0] - 1.4 * w, a[1] + 1.4 * w), (y[0] - out, y[1]), (z - 0.04, z + 0.002)))
        if m.chance(0.3):
            x = (a[0] + 0.1 * (a[1] - a[0]), a[1] - 0.1 * (a[1] - a[0]))
            m.add(BASE, slab(style, x, (y[0] - out - 0.16, y[0] - 0.01), (z - 0.22, z - 0.039)))
