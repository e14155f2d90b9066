"""Tape dispensers of one artist."""

from __future__ import annotations

from shapely.geometry import Point as Dot
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, prism, rod
from training.kinds.trinket_style import Look, draw_look, screw


def tape_dispenser(m: Model) -> None:
    """A heavy foot, a snail shell or a packing gun that holds a roll of tape which turns."""
    look = draw_look(m)
    r, w, kind = m.number(0.02, 0.04), m.number(0.012, 0.025), m.pick("foot", "snail", "gun", "foot")
    z, n, hub = 1.35 * r, max(look.n, 12), m.number(0.3, 0.65) * r
    gap = w / 2 + 0.0008
    if look.plain and m.chance(0.4):
        m.add("roll", rod((-w / 2, 0, z), (w / 2, 0, z), r, n))
    else:
        m.add("roll", cut(rod((-w / 2, 0, z), (w / 2, 0, z), r, n), rod((-1, 0, z), (1, 0, z), hub, n)))
        m.add("roll", cut(rod((-0.52 * w, 0, z), (0.52 * w, 0, z), 1.1 * hub, n), rod((-1, 0, z), (1, 0, z), 0.9 * hub, n)))
    m.spin("roll", (0, 0, z), (1, 0, 0))
    wall = m.number(0.002, 0.006)
    sides = [tuple(sorted((s * gap, s * (gap + wall)))) for s in (-1, 1)]
    front, tip = -m.number(2.2, 3.2) * r, m.number(1.0, 1.6) * r
    m.add(BASE, rod((-gap - wall / 2, 0, z), (gap + wall / 2, 0, z), hub * (0.8 if kind != "foot" else 0.5), n))
    if kind == "snail":
        shape = (
            Dot(0, z)
            .buffer(1.12 * r, quad_segs=n // 4)
            .union(Polygon([(-0.2 * r, z - 1.12 * r), (-0.9 * r, z + 0.5 * r), (front, z - 0.7 * r), (front, z - 1.12 * r)]))
        )
        m.add(BASE, prism(shape, "x", sides[0]), prism(shape, "x", sides[1])) if look.plain or m.chance(0.5) else m.add(
            BASE, prism(shape, "x", sides[0])
        )
        m.add(BASE, box((sides[0][0], sides[1][1]), (front, -1.05 * r), (z - 1.12 * r, z - 1.02 * r)))
        m.add(BASE, box((-w / 2, w / 2), (front - 0.08 * r, front + 0.05 * r), (z - 1.1 * r, z - 0.6 * r)))
        return
    if kind == "gun":
        _tape_gun(m, look, (r, w, z), sides, front)
        return
    side = [
        (1.3 * r, 0),
        (1.2 * r, 0.5 * r),
        (0.35 * r, z + 0.3 * r),
        (-0.35 * r, z + 0.3 * r),
        (-1.2 * r, 0.6 * r),
        (front, tip),
        (front, 0),
    ]
    for x in sides:
        m.add(BASE, prism(Polygon(side), "x", x))
    foot = 0.28 * r
    m.add(BASE, box((sides[0][0], sides[1][1]), (front, 1.3 * r), (-0.1 * r, foot)))
    m.add(BASE, box((-gap, gap), (front, front + 0.4 * r), (foot, tip)))
    m.add(BASE, box((-w / 2, w / 2), (front - 0.08 * r, front + 0.05 * r), (tip - 0.25 * r, tip + 0.1 * r)))
    if look.style in ("assembly", "old", "hollowed"):
        m.add(BASE, *(screw((s * (gap + wall), 0, z), (s, 0, 0), 0.15 * r) for s in (-1, 1)))
        m.add(BASE, box((sides[0][0] - 0.001, sides[1][1] + 0.001), (front - 0.001, 1.3 * r + 0.001), (-0.15 * r, -0.05 * r)))


def _tape_gun(m: Model, look: Look, size: tuple[float, float, float], sides: list[Span], front: float) -> None:
    """A plate beside the roll, a grip below, a roller that presses the tape down and a blade."""
    r, w, z = size
    plate = [
        (0.4 * r, z - 0.5 * r),
        (0.4 * r, z + 0.5 * r),
        (-0.8 * r, z + 0.5 * r),
        (front, z + 0.6 * r),
        (front, z - 0.2 * r),
        (-0.8 * r, z - 0.5 * r),
    ]
    m.add(BASE, prism(Polygon(plate), "x", sides[0]))
    grip = [(-1.25 * r, z - 0.1 * r), (-1.75 * r, z - 0.1 * r), (-1.5 * r, z - 2.4 * r), (-0.95 * r, z - 2.4 * r)]
    m.add(BASE, prism(Polygon(grip), "x", (sides[0][0], w / 2)))
    y, small = front + 0.3 * r, 0.28 * r
    m.add(BASE, rod((sides[0][0], y, z + 0.35 * r), (w / 2, y, z + 0.35 * r), 0.3 * small, 10))
    roller = rod((-w / 2, y, z + 0.35 * r), (w / 2, y, z + 0.35 * r), small, max(look.n, 10))
    m.add("roller", roller if look.plain else cut(roller, rod((-1, y, z + 0.35 * r), (1, y, z + 0.35 * r), 0.31 * small, 10)))
    m.spin("roller", (0, y, z + 0.35 * r), (1, 0, 0))
    m.add(BASE, box((sides[0][0], w / 2), (front - 0.2 * r, front + 0.02 * r), (z - 0.2 * r, z - 0.1 * r)))
