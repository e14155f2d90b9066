"""Ferris wheels."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, ring, rod, rounded, tube, vec
from training.kinds.wheels import beam, lathe

Vector = Float[np.ndarray, " 3"]


def ferris_wheel(m: Model) -> None:
    """A wheel of two rims between two frames with gondolas that hang in it, or one rim with pods before it."""
    r, count, n = m.number(2.5, 9.0), m.pick(6, 8, 10, 12), m.pick(12, 16, 24)
    single = m.chance(0.25)
    size = min(1.2 * np.pi * r / count, 0.42 * r) * m.number(0.55, 0.75)
    half = 0.7 * size + 0.03 * r
    hub = vec(0, 0, r + 1.5 * size + m.number(0.1, 0.25) * r)
    _rims(m, r, count, half, hub, n)
    m.spin("wheel", hub, (0, -1, 0))
    look = m.pick("cabin", "tub", "bench", "pod", "bucket")
    y = -half - 0.06 * r - 0.55 * size if single else 0.0
    for k in range(count):
        t = 2 * np.pi * k / count
        pin = hub + vec(r * np.cos(t), 0, r * np.sin(t))
        part = f"gondola_{k}"
        m.add(part, *(s.apply_translation(pin + vec(0, y, 0)) for s in _gondola(look, size, n)))
        if single:
            m.add("wheel", rod(pin + vec(0, -half - 0.001, 0), pin + vec(0, y + 0.35 * size, 0), 0.05 * size, 8))
        m.spin(part, pin + vec(0, y, 0), (0, 1, 0), "wheel")
    _stand(m, r, half + 0.04 * r, hub, single, n)


def _rims(m: Model, r: float, count: int, half: float, hub: Vector, n: int) -> None:
    """Rims, round or of bars, spokes, ties and an axle."""
    thin, inner = 0.018 * r, m.pick(0.0, 0.0, 0.6, 0.8)
    sides = (-1, 1)
    straight, crossed = m.chance(0.4), m.chance(0.35)
    turn = 2 * np.pi * np.arange(count) / count
    points = np.c_[np.cos(turn), 0 * turn, np.sin(turn)]
    for s in sides:
        c = hub + vec(0, s * half, 0)
        for radius in (r, inner * r) if inner else (r,):
            if straight:
                m.add(
                    "wheel",
                    *(
                        beam(c + radius * a, c + radius * b, 1.6 * thin, 1.6 * thin, (0, 1, 0))
                        for a, b in zip(points, np.roll(points, -1, 0), strict=True)
                    ),
                )
            else:
                m.add("wheel", ring(c, (0, 1, 0), radius, thin, max(24, 2 * n)))
        for p in points:
            m.add("wheel", rod(hub + vec(0, s * half, 0), c + r * p, 0.7 * thin, 6))
    for p in points:
        a = hub + r * p
        m.add("wheel", rod(a - vec(0, half, 0), a + vec(0, half, 0), 0.8 * thin, 8))
        if crossed:
            m.add("wheel", rod(hub + 0.5 * r * p - vec(0, half, 0), hub + 0.5 * r * p + vec(0, half, 0), 0.6 * thin, 6))
    m.add("wheel", rod(hub - vec(0, half + 0.02 * r, 0), hub + vec(0, half + 0.02 * r, 0), m.number(0.06, 0.1) * r, n))
    if m.chance(0.4):
        m.add(
            "wheel",
            *(rod(hub + vec(0, s * (half - 0.005 * r), 0), hub + vec(0, s * (half + 0.012 * r), 0), 0.2 * r, n) for s in sides),
        )
    m.add(BASE, rod(hub - vec(0, half + 0.09 * r, 0), hub + vec(0, half + 0.09 * r, 0), 0.035 * r, 10))


def _gondola(look: str, q: float, n: int) -> list[Trimesh]:
    """A seat of size q that hangs below the origin."""
    low, w = -1.25 * q, 0.5 * q
    bar = rod((0, -0.62 * q, 0), (0, 0.62 * q, 0), 0.035 * q, 8)
    ties = [beam((0, s * 0.45 * q, 0), (0, s * 0.45 * q, low + 0.45 * q), 0.04 * q, 0.04 * q) for s in (-1, 1)]
    if look == "pod":
        return [
            ball((0, 0, -0.5 * q), (0.55 * q, 0.5 * q, 0.5 * q), max(n, 10)),
            bar,
            rod((0, 0, -0.95 * q), (0, 0, -1.05 * q), 0.3 * q, n),
        ]
    if look == "tub":
        tub = lathe(
            [(0, 0), (0.4 * q, 0), (w, 0.45 * q), (0.44 * q, 0.45 * q), (0.36 * q, 0.06 * q), (0, 0.06 * q)], n, (0, 0, low)
        )
        return [
            tub,
            lathe([(0, 0), (0.56 * q, 0), (0, 0.28 * q)], n, (0, 0, -0.3 * q)),
            rod((0, 0, low + 0.03 * q), (0, 0, 0.02 * q), 0.035 * q, 8),
            bar,
        ]
    if look == "bench":
        seat = [
            box((-0.3 * q, 0.3 * q), (-w, w), (low, low + 0.06 * q)),
            box((0.25 * q, 0.32 * q), (-w, w), (low, low + 0.55 * q)),
        ]
        seat += [
            prism([(-0.3 * q, low), (0.3 * q, low), (0.03 * q, 0.03 * q), (-0.03 * q, 0.03 * q)], "y", (s * w, s * 0.46 * q))
            for s in (-1, 1)
        ]
        return [*seat, bar]
    if look == "bucket":
        body = prism(rounded((-w, w), (low, low + 0.5 * q), 0.1 * q), "y", (-w, w))
        return [
            cut(body, box((-0.42 * q, 0.42 * q), (-0.42 * q, 0.42 * q), (low + 0.08 * q, 1))),
            bar,
            *ties,
            box((-w, w), (-w, w), (-0.22 * q, -0.16 * q)),
        ]
    return [bar, *_cabin(q, low, w)]


def _cabin(q: float, low: float, w: float) -> list[Trimesh]:
    """A closed box with openings on four sides, on two straps."""
    frame = prism(
        Polygon([(-w, low), (w, low), (w, -0.2 * q), (0.6 * w, -0.05 * q), (-0.6 * w, -0.05 * q), (-w, -0.2 * q)]), "y", (-w, w)
    )
    views = [
        box((-9, 9), (-0.4 * q, 0.4 * q), (low + 0.5 * q, -0.3 * q)),
        box((-0.4 * q, 0.4 * q), (-9, 9), (low + 0.5 * q, -0.3 * q)),
    ]
    return [
        cut(frame, *views),
        *(box((-0.04 * q, 0.04 * q), (s * 0.42 * q, w * s), (-0.1 * q, 0.02 * q)) for s in (-1, 1)),
    ]


def _stand(m: Model, r: float, half: float, hub: Vector, single: bool, n: int) -> None:
    """Legs on both sides, or behind, and a floor."""
    spread, thick, floor = m.number(0.35, 0.6) * r, m.number(0.025, 0.045) * r, m.number(0.03, 0.08) * r
    form = m.pick("legs", "legs", "tower", "lattice")
    back = half + 0.05 * r
    for s in (1,) if single else (-1, 1):
        y = s * back
        lean = s * m.pick(0.0, 0.15) * r
        if form == "tower":
            m.add(BASE, beam((0, y + lean, 0), (0, y, hub[2] + 0.06 * r), 0.16 * r, 0.08 * r, taper=0.7))
        else:
            for x in (-spread, spread):
                m.add(BASE, rod((x, y + lean, 0), (0, y, hub[2]), thick, n // 2))
            for q in (0.35, 0.6) if form == "lattice" else (0.3,):
                m.add(
                    BASE,
                    rod(
                        (-spread * (1 - q), y + lean * (1 - q), q * hub[2]),
                        (spread * (1 - q), y + lean * (1 - q), q * hub[2]),
                        0.6 * thick,
                        8,
                    ),
                )
        m.add(BASE, rod((0, y - 0.05 * r, hub[2]), (0, y + 0.05 * r, hub[2]), 0.07 * r, n))
    if single:
        m.add(BASE, rod((0, back, hub[2]), (0, back + 0.5 * r, 0.1), thick, 8))
    _floor(m, r, back + 0.25 * r, single, floor)


def _floor(m: Model, r: float, deep: float, single: bool, floor: float) -> None:
    """A floor, with steps, a rail and a booth in some."""
    wide = 0.75 * r
    m.add(
        BASE,
        m.pick(
            box((-wide, wide), (-deep, deep + (0.35 * r if single else 0)), (0, floor)),
            prism(rounded((-wide, wide), (-deep, deep + 0.3 * r), 0.2 * r), "z", (0, floor)),
        ),
    )
    if m.chance(0.5):
        m.add(
            BASE,
            *(
                box((-0.2 * r, 0.2 * r), (-deep - (k + 1) * 0.06 * r, -deep + 0.01), (0, floor * (1 - (k + 1) / 3)))
                for k in range(2)
            ),
        )
    if not single and m.chance(0.4):
        y, x = -deep + 0.01 * r, 0.72 * r
        m.add(
            BASE,
            tube(
                [
                    (-x, y + 0.02 * r, floor),
                    (-x, y + 0.02 * r, floor + 0.12 * r),
                    (-0.2 * r, y + 0.02 * r, floor + 0.12 * r),
                    (-0.2 * r, y + 0.02 * r, floor),
                ],
                0.008 * r,
                6,
            ),
        )
    if not single and m.chance(0.35):
        m.add(BASE, box((0.55 * r, 0.73 * r), (-deep + 0.02 * r, -deep + 0.18 * r), (floor, floor + 0.28 * r)))
