"""Snowmobiles."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, MultiPolygon, Point, Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, loft, prism, rod, tube, vec
from training.kinds.vehicles.vehicles import prisms
from training.kinds.wheels import beam


def hull(stations: list[tuple[float, float, float, float]], n: int, power: float) -> np.ndarray:
    """Rings of a body along y from (y, half width, low z, high z), with round or boxy sections."""
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    c, s = (np.sign(f) * np.abs(f) ** (2 / power) for f in (np.cos(t), np.sin(t)))
    return np.array([np.c_[w * c, np.full(n, y), (a + b) / 2 + (b - a) / 2 * s] for y, w, a, b in stations])


def handlebar(m: Model, at: np.ndarray, way: np.ndarray, wide: float) -> None:
    """A bar with grips, levers and a pad on a slanted column that turns."""
    way = way / np.linalg.norm(way)
    rise, back = m.number(0.02, 0.09), m.number(0.04, 0.12)
    path = [
        at + vec(s * x, b, z)
        for s, x, b, z in (
            (-1, wide, back, rise),
            (-1, 0.45 * wide, 0, rise),
            (-1, 0.15 * wide, 0, 0),
            (1, 0.15 * wide, 0, 0),
            (1, 0.45 * wide, 0, rise),
            (1, wide, back, rise),
        )
    ]
    m.add("handlebar", tube(path, 0.013, 8), rod(at - 0.16 * way, at + 0.01 * way, 0.025, 10))
    for p, q in ((path[0], path[1]), (path[-1], path[-2])):
        m.add("handlebar", rod(p, p + 0.45 * (q - p), 0.02, 10))
        if m.chance(0.6):
            m.add("handlebar", rod(p + 0.5 * (q - p), p + vec(0, -0.05, 0.0), 0.006, 6))
    if m.chance(0.6):
        m.add("handlebar", box((-0.09, 0.09), (at[1] - 0.04, at[1] + 0.03), (at[2] - 0.02, at[2] + 0.04)))
    m.hinge("handlebar", at, way, (-35, 35))


def _ski(m: Model, name: str, x: float, y: float, top: float) -> None:
    """A ski with its turned-up tip, a loop, and the leg that steers it."""
    back, front, w = y + 0.4, y - 0.5, m.number(0.06, 0.085)
    line = LineString([(back, 0.03), (front, 0.02), (front - 0.15, 0.07), (front - 0.26, 0.18)])
    m.add(name, *prisms(line.buffer(0.014, cap_style=2), "x", (x - w, x + w)))
    m.add(
        name,
        box((x - 0.015, x + 0.015), (front, back), (0.0, 0.02)),
        box((x - 0.025, x + 0.025), (y - 0.15, y + 0.15), (0.03, 0.1)),
    )
    if m.chance(0.6):
        m.add(name, tube([vec(x, front - 0.25, 0.17), vec(x, front - 0.12, 0.22), vec(x, front + 0.15, 0.05)], 0.012, 6))
    m.add(name, beam((x, y, 0.08), (x, y + 0.06, top), 0.045, 0.06))
    m.hinge(name, (x, y, 0.1), (0, 0.06, top - 0.1), (-35, 35))


def _belt(m: Model, y: Span, half: float) -> None:
    """The track under a snowmobile: a band round wheels that turn, with lugs."""
    r = 0.09
    spots = [
        (y[0], 0.27, 0.13),
        *((c, r + 0.03, r) for c in np.linspace(y[0] + 0.28, y[1] - 0.25, m.pick(2, 3, 4))),
        (y[1], 0.16, 0.13),
    ]
    band = MultiPolygon([Point(a, b).buffer(q + 0.025, quad_segs=5) for a, b, q in spots]).convex_hull
    m.add(BASE, *prisms(band.difference(band.buffer(-0.022)), "x", (-half, half)))
    line = band.exterior
    for d in np.arange(0, line.length, m.pick(0.09, 0.14)):
        a, b = (np.array(line.interpolate(e).coords[0]) for e in (d, d + 0.04))
        p = vec(0, *((a + b) / 2))
        m.add(BASE, beam(p - (half, 0, 0), p + vec(half, 0, 0), 0.02, 0.03, (0, *(b - a))))
    for k, (a, b, q) in enumerate(spots):
        part = f"wheel_{k}"
        m.add(
            part,
            *(rod((s * 0.55 * half - 0.025, a, b), (s * 0.55 * half + 0.025, a, b), q, 14) for s in (-1, 1)),
            rod((-0.7 * half, a, b), (0.7 * half, a, b), 0.02, 8),
        )
        m.spin(part, (0, a, b), (1, 0, 0))
    m.add(
        BASE,
        *(
            beam((s * 0.7 * half, spots[1][0], spots[1][1]), (s * 0.7 * half, spots[-2][0], spots[-2][1]), 0.02, 0.05)
            for s in (-1, 1)
        ),
    )
    m.add(
        BASE,
        *(
            beam((s * 0.7 * half, a, b), (s * 0.7 * half, a + 0.1, 0.42), 0.02, 0.04)
            for s in (-1, 1)
            for a, b, _ in (spots[1], spots[-2])
        ),
    )


def _front_skis(m: Model) -> None:
    """Two skis and the arms that carry them."""
    spread, y = m.number(0.42, 0.55), -0.35
    for s in (-1, 1):
        x = s * spread
        _ski(m, f"ski_{'lr'[s > 0]}", x, y, 0.34)
        m.add(
            BASE,
            rod((s * 0.15, y - 0.1, 0.36), (x - s * 0.02, y + 0.06, 0.3), 0.02, 8),
            rod((s * 0.15, y + 0.2, 0.36), (x - s * 0.02, y + 0.06, 0.3), 0.02, 8),
        )
        m.add(BASE, rod((s * 0.18, y + 0.05, 0.55), (x - s * 0.05, y + 0.05, 0.34), 0.035, 10))


def _snow_rear(m: Model, half: float, long: float) -> None:
    """A rail and a flap behind."""
    end = long + 0.12
    if m.chance(0.6):
        m.add(
            BASE,
            tube(
                [vec(-half, long - 0.4, 0.5), vec(-half, end, 0.56), vec(half, end, 0.56), vec(half, long - 0.4, 0.5)], 0.016, 8
            ),
        )
    flap = beam((0, long - 0.1, 0.47), (0, end + 0.1, 0.12), 2 * half, 0.012)
    m.add("flap" if m.chance(0.4) else BASE, flap)
    if any(p == "flap" for p, _ in m.pieces):
        m.hinge("flap", (0, long - 0.1, 0.47), (1, 0, 0), (0, 50))


def snowmobile(m: Model) -> None:
    """A snowmobile: two skis that steer, a track round wheels, a bonnet that opens, handlebar, seat, screen, rack."""
    half, long, track = m.number(0.2, 0.26), m.number(1.5, 2.0), m.number(0.17, 0.21)
    nose, seat, top = -0.75, m.number(0.66, 0.78), m.number(0.82, 0.95)
    _belt(m, (0.1, long), track)
    m.add(
        BASE,
        box((-half, half), (-0.2, long - 0.1), (0.43, 0.5)),
        *(box((s * half, s * (half + 0.17)), (-0.1, 0.85), (0.3, 0.34)) for s in (-1, 1)),
    )
    m.add(BASE, *(box((s * (half - 0.02), s * half), (-0.1, long - 0.2), (0.3, 0.5)) for s in (-1, 1)))
    _front_skis(m)
    low = 0.46
    m.add(
        BASE,
        loft(
            hull(
                [
                    (nose - 0.05, 0.12, 0.34, 0.42),
                    (nose + 0.12, half + 0.04, 0.3, low),
                    (-0.1, half + 0.12, 0.3, low),
                    (0.25, half + 0.05, 0.34, low),
                ],
                16,
                m.pick(2.5, 5),
            )
        ),
    )
    shape = Polygon(
        [(nose - 0.04, low - 0.02), (nose + 0.1, low + 0.12), (-0.2, top), (0.02, top), (0.08, low + 0.06), (0.08, low - 0.02)]
    )
    x, part = half + m.number(0.02, 0.08), "bonnet" if m.chance(0.75) else BASE
    m.add(part, *_narrowed(prism(shape, "x", (-x, x)), nose))
    m.add(
        part,
        *(box((s * 0.5 * x - 0.06, s * 0.5 * x + 0.06), (nose + 0.02, nose + 0.1), (low + 0.03, low + 0.09)) for s in (-1, 1)),
    )
    screen = part if m.chance(0.5) else BASE
    if m.chance(0.8):
        m.add(screen, beam((0, -0.24, top - 0.03), (0, 0.0, top + m.number(0.12, 0.3)), 1.3 * x, 0.012))
    if part != BASE:
        m.hinge(part, (0, nose - 0.02, low), (1, 0, 0), m.pick(55, 75))
        m.add(BASE, box((-0.7 * half, 0.7 * half), (nose + 0.25, -0.05), (low - 0.05, low + 0.13)))
    m.add(BASE, beam((0, 0.1, 0.48), (0, 0.16, top - 0.06), 0.14, 0.1))
    handlebar(m, vec(0, 0.14, top + 0.1), vec(0, -0.35, 0.9), m.number(0.3, 0.38))
    saddle(m, half, (0.25, long - m.pick(0.25, 0.6)), 0.5, seat)
    _snow_rear(m, half, long)


def _narrowed(solid, nose: float) -> list:
    """A bonnet drawn in towards its nose."""
    v = solid.vertices
    v[:, 0] *= np.clip(0.55 + 0.45 * (v[:, 1] - nose) / 0.6, 0.5, 1)
    solid.vertices = v
    return [solid]


def saddle(m: Model, half: float, y: Span, low: float, top: float) -> None:
    """A long seat, in some with a step and a back rest, in some hinged at its front over a box."""
    step = m.pick(0.0, 0.06)
    c = 0.55 * y[0] + 0.45 * y[1]
    shape = Polygon(
        [
            (y[0], low),
            (y[0] + 0.02, top - 0.04),
            (y[0] + 0.1, top),
            (c, top),
            (c + 0.05, top + step),
            (y[1] - 0.03, top + step),
            (y[1], top + step - 0.04),
            (y[1], low),
        ]
    )
    part = "seat" if m.chance(0.5) else BASE
    cut_at = low + 0.35 * (top - low)
    upper = shape.intersection(Polygon([(-9, cut_at + 0.003), (9, cut_at + 0.003), (9, 9), (-9, 9)]))
    m.add(BASE, *prisms(shape.difference(upper), "x", (-0.8 * half, 0.8 * half)))
    m.add(part, *prisms(upper, "x", (-0.8 * half, 0.8 * half)))
    if part != BASE:
        front = m.chance(0.7)
        m.hinge(part, (0, y[0] if front else y[1], cut_at), (1 if front else -1, 0, 0), m.pick(60, 75))
    if m.chance(0.35):
        m.add(part, box((-0.6 * half, 0.6 * half), (y[1] - 0.06, y[1]), (top, top + 0.25)))
