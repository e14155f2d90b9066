"""Walls and generators of spaceships of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely.geometry import Polygon

from training.kinds.furniture.still_seats import sizes, smooth
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, around, ball, box, moved, prism, ring, rod, tube
from training.kinds.still_cladding import clad, maybe_one
from training.kinds.wheels import beam, lathe


def chamfered(x: Span, z: Span, cut: float, corners: tuple[int, ...] = (0, 1, 2, 3)) -> Polygon:
    """Make a rectangle with some of its corners cut off."""
    points: list[tuple[float, float]] = []
    for k, (a, c, s, t) in enumerate(((x[0], z[0], 1, 1), (x[1], z[0], -1, 1), (x[1], z[1], -1, -1), (x[0], z[1], 1, -1))):
        both = [(a, c + t * cut), (a + s * cut, c)]
        points += [(a, c)] if k not in corners else both if k % 2 == 0 else both[::-1]
    return Polygon(points)


def _plates(m: Model, cells: list[tuple[Span, Span]]) -> None:
    """Fill the cells of a wall with plates, vents, frames, light strips, facings or small boxes."""
    for a, c in cells:
        rim = 0.08 * min(a[1] - a[0], c[1] - c[0])
        look, inner = m.pick("plate", "plate", "vent", "frame", "greebles", "strip", "clad"), (shrunk(a, rim), shrunk(c, rim))
        if look in ("plate", "frame", "strip"):
            shape = chamfered(*inner, 2 * rim, m.pick((0, 2), (1, 3), (0, 1, 2, 3), (2,)))
            m.add(BASE, prism(shape if look == "plate" else shape.difference(shape.buffer(-rim)), "y", (-0.04, 0.01)))
            heads = [(p, q) for p in shrunk(inner[0], 3 * rim) for q in shrunk(inner[1], 3 * rim)] if look == "plate" else []
            m.add(BASE, *(rod((p, -0.05, q), (p, -0.03, q), 0.4 * rim, 6) for p, q in heads))
            m.add(
                BASE,
                *[box(shrunk(inner[0], 3 * rim), (-0.03, 0.01), (np.mean(c) - 0.5 * rim, np.mean(c) + 0.5 * rim))][
                    : look == "strip"
                ],
            )
        elif look == "vent":
            m.add(
                BASE,
                *(
                    prism([(0.01, q), (-0.05, q), (0.01, q + 0.8 * rim)], "x", inner[0])
                    for q in np.linspace(*shrunk(inner[1], rim), m.pick(4, 7))
                ),
            )
        elif look == "clad":
            clad(m, *(inner[0], 0.0, inner[1]), m.pick("bolts", "diamonds", "reeds", "tiles"), m.pick(1, 2))
        else:
            for _ in range(m.pick(3, 6)):
                p, q, s = m.number(*shrunk(inner[0], rim)), m.number(*shrunk(inner[1], rim)), rim * m.number(0.5, 2)
                m.add(BASE, box((p - s, p + s), (-m.number(0.02, 0.1), 0.01), (q - 0.6 * s, q + 0.6 * s)))


def sci_fi_wall_panel(m: Model) -> None:
    """Make a wall of a spaceship: plates with cut corners, ribs, pipes, vents, light strips and bolts; nothing moves."""
    wide, high, t = sizes(m, (0.8, 4.0), (1.2, 3.0), (0.05, 0.3))
    x, z, form = (-wide / 2, wide / 2), (0.0, high), m.pick("flat", "ribbed", "slanted", "hex", "trench")
    m.add(BASE, prism(chamfered(x, z, m.pick(0.01, 0.15), m.pick((0, 1, 2, 3), (2, 3), (1, 3))), "y", (0, t)))
    columns, rows = m.pick(1, 2, 3, 4), m.pick(1, 2, 3, 4)
    cells = [
        (a, c)
        for a in pairwise(np.linspace(*shrunk(x, 0.08), columns + 1))
        for c in pairwise(np.linspace(*shrunk(z, 0.1), rows + 1))
    ]
    if form == "ribbed":
        side = [(0.02, 0), (-0.25, 0), (-0.12, 0.25 * high), (-0.08, 0.75 * high), (-0.2, high), (0.02, high)]
        m.add(BASE, *(prism(side, "x", (a - 0.05, a + 0.05)) for a in np.linspace(*shrunk(x, 0.05), columns + 1)))
    elif form == "slanted":
        m.add(
            BASE,
            prism([(0.01, 0), (-0.4, 0), (-0.4, 0.1), (0.01, 0.35 * high)], "x", x),
            prism([(0.01, high), (-0.3, high), (0.01, 0.8 * high)], "x", x),
        )
    elif form == "trench":
        m.add(BASE, *(box(x, (-0.15, 0.01), c) for c in ((0, 0.12 * high), (0.88 * high, high), (0.46 * high, 0.54 * high))))
    if form == "hex":
        r = min(wide / 5, high / 5)
        for j, c in enumerate(np.arange(r, high - r, 1.55 * r)):
            for a in np.arange(x[0] + r + 0.9 * r * (j % 2), x[1] - r, 1.8 * r)[:6]:
                m.add(BASE, moved(rod((0, -m.number(0.01, 0.06), 0), (0, 0.01, 0), r, 6), (a, 0, c)))
        cells = []
    _plates(m, cells)
    for k in range(m.pick(0, 0, 2, 3)):
        q, r = (0.9 - 0.07 * k) * high, 0.025
        m.add(
            BASE,
            rod((x[0], -0.07, q), (x[1], -0.07, q), r, 10),
            *(box((a - 0.02, a + 0.02), (-0.1, 0.01), (q - 1.4 * r, q + 1.4 * r)) for a in shrunk(x, 0.15)),
        )
    maybe_one(m, 0.12)


def _arms(m: Model, form: str, r: float, foot: float, top: float, n: int) -> None:
    """Set fins, pipes, pylons or pods round a core."""
    arms = m.pick(3, 4, 6)
    how = m.pick("fins", "pipes", "pylons", "none") if form in ("column", "crystal", "sphere") else m.pick("pods", "none")
    if how == "fins":
        side = [(1.45 * r, 0.5 * foot), (0.3 * r, 0.5 * foot), (0.3 * r, 0.75 * top), (0.85 * r, 0.75 * top)]
        m.add(BASE, *around(prism(side, "y", (-0.04 * r, 0.04 * r)), arms))
    elif how == "pipes":
        path = [(1.35 * r, 0, 0.5 * foot), (1.35 * r, 0, 0.6 * top), (0.2 * r, 0, 0.6 * top)]
        m.add(
            BASE, *around(tube(smooth(path), 0.07 * r, 8), arms), *around(ball((1.35 * r, 0, foot), (0.12 * r,) * 3, 8), arms)
        )
    elif how == "pylons":
        m.add(BASE, *around(beam((1.35 * r, 0, 0.5 * foot), (1.1 * r, 0, top), 0.2 * r, 0.2 * r, (0, 1, 0), 0.6), arms))
        m.add(BASE, *(ring((0, 0, c), (0, 0, 1), 1.12 * r, 0.06 * r, 24) for c in (top, 0.7 * top)[: m.pick(1, 2)]))
    elif how == "pods":
        m.add(
            BASE,
            *around(
                lathe([(0, 0), (0.25 * r, 0), (0.25 * r, 0.5), (0.15 * r, 0.6), (0, 0.62)], n, (1.3 * r, 0, 0.55 * foot)), arms
            ),
        )


def _drum(m: Model, foot: float, r: float, n: int) -> None:
    """Lay a ribbed drum with two end plates on a base."""
    c, long = foot + 0.9 * r, 1.3 * r
    m.add(
        BASE,
        rod((-long, 0, c), (long, 0, c), r, n),
        *(rod((s * long, 0, c), (s * (long + 0.15), 0, c), 0.7 * r, n) for s in (-1, 1)),
    )
    m.add(BASE, *(ring((a, 0, c), (1, 0, 0), r, 0.06 * r, 24) for a in np.linspace(-0.9 * long, 0.9 * long, m.pick(3, 5, 9))))


def sci_fi_generator(m: Model) -> None:
    """Make a reactor or generator: core, coils, rings, fins, pipes, pylons and a base, all fixed; nothing moves."""
    r, high, n = m.number(0.25, 0.9), m.number(0.8, 3.0), m.pick(6, 8, 12, 24)
    form, foot = m.pick("column", "column", "lying", "sphere", "crystal", "block"), m.number(0.08, 0.3)
    sides, top = m.pick(6, 8, 24), foot + high
    m.add(BASE, lathe([(0, 0), (1.5 * r, 0), (1.5 * r, 0.6 * foot), (1.25 * r, foot), (0, foot)], sides))
    if form == "column":
        u = np.linspace(0, 1, 9)
        side = np.c_[r * (0.7 + m.number(-0.2, 0.2) * np.sin(np.pi * u)), foot + u * high]
        m.add(BASE, lathe([(0, foot), *side, (0, top)], n))
        coils = side[1:-1][:: m.pick(1, 2, 3)]
        m.add(BASE, *(ring((0, 0, c), (0, 0, 1), a, 0.1 * r, 24) for a, c in coils))
        m.add(BASE, lathe([(0, -0.02), (0.9 * r, -0.02), (1.2 * r, 0.15), (0.6 * r, 0.3), (0, 0.3)], sides, (0, 0, top)))
    elif form == "lying":
        _drum(m, foot, r, n)
        top = foot + 1.9 * r
    elif form == "sphere":
        c = foot + 1.05 * r
        m.add(BASE, ball((0, 0, c), (r, r, r), max(n, 8)), rod((0, 0, foot - 0.02), (0, 0, c), 0.4 * r, n))
        m.add(
            BASE,
            *(ring((0, 0, c), way, 1.02 * r, 0.07 * r, 24) for way in ((0, 0, 1), (1, 0, 0), (0, 1, 0))[: m.pick(1, 2, 3)]),
        )
        top = c + r
    elif form == "crystal":
        shape = [(0, foot), (0.25 * r, foot), (0.5 * r, foot + 0.4 * high), (0.35 * r, foot + 0.8 * high), (0, top)]
        m.add(BASE, lathe(shape, m.pick(5, 6)))
    else:
        m.add(BASE, prism(chamfered((-r, r), (foot - 0.01, top), 0.25 * r), "y", (-0.8 * r, 0.8 * r)))
        clad(
            m,
            (-0.7 * r, 0.7 * r),
            -0.8 * r,
            (foot + 0.2 * r, top - 0.3 * r),
            m.pick("bolts", "reeds", "frames", "diamonds", "boards"),
            m.pick(1, 2),
        )
        m.add(BASE, *(rod((a, 0, top - 0.02), (a, 0, top + 0.3 * r), 0.2 * r, n) for a in (-0.4 * r, 0.4 * r)))
    _arms(m, form, r, foot, top, n)
    if m.chance(0.4):
        m.add(
            BASE,
            box((-2 * r, 2 * r), (-2 * r, 2 * r), (-0.1, 0)),
            *(ball((a, b, 0), (0.08 * r,) * 3, 6) for a in (-1.8 * r, 1.8 * r) for b in (-1.8 * r, 1.8 * r)),
        )
    maybe_one(m, 0.12)
