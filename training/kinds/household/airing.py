"""Racks on which clothes dry: with wings, in tiers, on the wall."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from training.kinds.carts.trolleys import castors
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, box, prism, rod, rounded, tube, vec


def _grid(m: Model, part: str, a: Sequence[np.ndarray], r: float, bars: int, lying: bool) -> None:
    """A frame over four corners with bars across it; a: corners in turn."""
    m.add(part, *(rod(a[k], a[(k + 1) % 4], r, 8) for k in range(4)))
    for s in np.linspace(0, 1, bars + 2)[1:-1]:
        p, q = ((0, 3), (1, 2)) if lying else ((0, 1), (3, 2))
        ends = [a[i] + s * (a[j] - a[i]) for i, j in (p, q)]
        m.add(part, rod(*ends, 0.55 * r, 6))


def _washing(m: Model, part: str, x: Span, y: float, z: float) -> None:
    """A towel over a bar along x."""
    drop, t = m.number(0.2, 0.4), 0.012
    m.add(
        part,
        box(x, (y - t, y - 0.5 * t), (z - drop, z + t)),
        box(x, (y + 0.5 * t, y + t), (z - m.number(0.6, 1) * drop, z + t)),
    )
    m.add(part, box(x, (y - t, y + t), (z + 0.5 * t, z + t)))


def _winged(m: Model) -> None:
    """A grid on two pairs of legs with a wing at each end, that hangs down and is lifted level or higher on stays."""
    long, deep, high, r = m.number(0.5, 0.75), m.number(0.48, 0.6), m.number(0.85, 1.0), m.number(0.007, 0.011)
    bars, lying, wing = m.pick(5, 7, 9), m.chance(0.6), m.number(0.42, 0.6)
    x, y = (-long / 2, long / 2), (-deep / 2, deep / 2)
    top = [vec(a, b, high) for a, b in ((x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1]))]
    _grid(m, BASE, top, r, bars, lying)
    lean, inset = m.number(0.0, 0.12), 2.2 * r
    legs = m.pick("fixed", "folding", "folding", "crossed", "crossed")
    for s, side in ((-1, "left"), (1, "right")):
        a, part = s * (long / 2 - 0.03), BASE if legs == "fixed" else f"legs_{side}"
        b = deep / 2 - inset * (1 + (s < 0) * (legs == "crossed"))
        foot = {"fixed": a - s * 0.05, "crossed": -1.2 * a}.get(legs, a + s * lean)
        m.add(part, tube([(a, -b, high - 2 * r), (foot, -b, 0.01), (foot, b, 0.01), (a, b, high - 2 * r)], 1.1 * r, 8))
        m.add(part, rod((a, -b, high - 2 * r), (a, b, high - 2 * r), 0.8 * r, 8))
        m.add(part, rod((0.5 * (a + foot), -b, high / 2), (0.5 * (a + foot), b, high / 2), 0.8 * r, 8))
        m.add(
            BASE,
            *(
                box(
                    (a - 1.5 * r, a + 1.5 * r),
                    (c - 0.5 * r, c + 1.8 * r) if c < 0 else (c - 1.8 * r, c + 0.5 * r),
                    (high - 3.2 * r, high + r),
                )
                for c in y
            ),
        )
        m.add(part, *(box((foot - 1.5 * r, foot + 1.5 * r), (c - 1.5 * r, c + 1.5 * r), (0, 0.03)) for c in (-b, b)))
        if part != BASE:
            fold = float(np.degrees(np.arctan2(high, abs(a - foot)))) if legs == "crossed" else m.number(75, 85)
            m.hinge(part, (a, 0, high - 2 * r), (0, s, 0), 0.97 * fold)
        _wing(m, s, long / 2 + 2.2 * r, (shrunk(y, 0.012), high), (wing, lean), (r, bars, lying))
    if lying and m.chance(0.4):
        _washing(m, BASE, (-0.2, 0.1), 0.0, high)


def _wing(
    m: Model, s: int, at: float, place: tuple[Span, float], size: tuple[float, float], make: tuple[float, int, bool]
) -> None:
    """A wing hung on its axle beside the grid at the distance `at` from the middle; s: its side."""
    (y, z), (long, lean), (r, bars, lying) = place, size, make
    part, down = ("wing_left" if s < 0 else "wing_right"), np.deg2rad(m.pick(4.0, 8.0, 12.0)) + np.arctan(lean)
    way = vec(s * np.sin(down), 0, -np.cos(down))
    hinge = vec(s * at, 0, z)
    corners = [hinge + d * way + vec(0, b, 0) for d, b in ((0.0, y[0]), (long, y[0]), (long, y[1]), (0.0, y[1]))]
    _grid(m, part, corners, r, bars, lying)
    m.add(
        BASE,
        *(
            box(
                (min(s * at, s * (at - 3 * r)), max(s * at, s * (at - 3 * r))),
                (c - 0.012, c + 0.012),
                (z - 0.8 * r, z + 0.8 * r),
            )
            for c in (0.6 * y[0], 0.6 * y[1])
        ),
    )
    m.hinge(part, hinge, (0, -s, 0), float(90 - np.degrees(down)) + m.pick(0, 0, 15, 30))


def _tower(m: Model) -> None:
    """Posts on castors or feet with tiers, each of two wings that lift level or hang down beside the posts."""
    wide, deep, high = m.number(0.12, 0.22), m.number(0.5, 0.65), m.number(1.2, 1.6)
    r, low, tiers, reach = 0.009, 0.07, m.pick(2, 3), m.number(0.24, 0.32)
    x, y = (-wide / 2, wide / 2), (-deep / 2, deep / 2)
    for b in y:
        m.add(BASE, tube([(x[0], b, low), (x[0], b, high), (x[1], b, high), (x[1], b, low)], 1.2 * r, 8))
        m.add(BASE, box((-0.28, 0.28), (b - 0.012, b + 0.012), (low - 0.005, low + 0.02)))
    for z in (0.12, high - 0.03):
        m.add(BASE, *(rod((a, y[0], z), (a, y[1], z), r, 8) for a in x))
    castors(m, (-0.28, 0.28), (y[0] - 0.02, y[1] + 0.02), low)
    pitch, lying = (high - 0.25) / tiers, False
    for k in range(tiers):
        z = 0.25 + (k + 0.85) * pitch * 0.95
        for s, side in ((-1, "left"), (1, "right")):
            part, a = f"wing_{side}_{k}", s * (wide / 2 + 3 * r)
            long = min(reach, 0.8 * pitch)
            corners = [
                vec(a, c, z - d) for d, c in ((0.0, 0.95 * y[0]), (long, 0.95 * y[0]), (long, 0.95 * y[1]), (0.0, 0.95 * y[1]))
            ]
            _grid(m, part, corners, 0.7 * r, m.pick(4, 6), not lying)
            m.add(BASE, rod((s * wide / 2, y[0], z), (s * wide / 2, y[1], z), r, 8))
            m.add(
                BASE,
                *(
                    box(tuple(sorted((s * wide / 2, a))), (c - 0.012, c + 0.012), (z - 0.8 * r, z + 0.8 * r))
                    for c in (0.5 * y[0], 0.5 * y[1])
                ),
            )
            m.hinge(part, (a, 0, z), (0, -s, 0), m.pick(88, 90))
    if m.chance(0.5):
        m.add(BASE, *(rod((a, y[0], high), (a, y[1], high), 0.7 * r, 6) for a in np.linspace(*x, 4)))


def _on_wall(m: Model) -> None:
    """A frame on the wall: a rack that comes down level on stays, or a row of bars that swing out each on its own."""
    wide, high = m.number(0.5, 0.8), m.number(0.4, 0.65)
    z = (1.2, 1.2 + high)
    if m.chance(0.5):
        m.add(
            BASE,
            prism(rounded((-wide / 2, wide / 2), z, 0.01), "y", (0.02, 0.038))
            if m.chance(0.5)
            else box((-wide / 2, wide / 2), (0.02, 0.038), (z[0] - 0.03, z[0] + 0.06)),
        )
        r, half = 0.009, wide / 2 - 0.03
        y = -0.01
        corners = [
            vec(a, y, c) for a, c in ((-half, z[0] + 0.02), (half, z[0] + 0.02), (half, z[1] - 0.02), (-half, z[1] - 0.02))
        ]
        _grid(m, "rack", corners, r, m.pick(5, 7), True)
        m.add(
            BASE,
            *(box((a - 0.012, a + 0.012), (y - 0.008, 0.021), (z[0] + 0.01, z[0] + 0.03)) for a in (-0.7 * half, 0.7 * half)),
        )
        m.hinge("rack", (0, y, z[0] + 0.02), (1, 0, 0), m.pick(88, 90))
        if m.chance(0.5):
            m.add(
                BASE,
                *(
                    rod((a, 0.02, z[0] - 0.01), (a, -0.03, z[0] - 0.01), 0.005, 8)
                    for a in np.linspace(-0.8 * half, 0.8 * half, 4)
                ),
            )
        return
    long, count = m.number(0.4, 0.6), m.pick(3, 4, 5)
    m.add(BASE, box((-0.04, 0.04), (0.02, 0.035), z), rod((0, -0.005, z[0] + 0.02), (0, -0.005, z[1] - 0.02), 0.007, 10))
    m.add(BASE, *(box((-0.012, 0.012), (-0.014, 0.021), (c, c + 0.016)) for c in (z[0] + 0.012, z[1] - 0.028)))
    side = m.pick(-1, 1)
    for k, c in enumerate(np.linspace(z[0] + 0.08, z[1] - 0.08, count)):
        at: Point = (0, -0.005, c)
        part, end = f"arm_{k}", (side * long, -0.005, c)
        m.add(part, rod(at, end, 0.006, 8), rod((0, -0.005, c - 0.018), (0, -0.005, c + 0.018), 0.013, 12))
        m.add(part, rod((side * (long - 0.015), -0.005, c), (side * (long + 0.004), -0.005, c), 0.009, 10))
        m.hinge(part, at, (0, 0, -side), m.pick(120, 150, 175))


def airing_rack(m: Model) -> None:
    """A clothes airer with two wings on folding legs, a tower of wings on castors, a rack or arms on the wall."""
    kind = m.pick("wings", "wings", "wings", "tower", "tower", "wall", "wall")
    {"wings": _winged, "tower": _tower, "wall": _on_wall}[kind](m)
