"""Lamps that hang from a ceiling, of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.furniture.still_seats import repeat, sizes
from training.kinds.model import BASE, Model
from training.kinds.solids import around, ball, box, moved, prism, ring, rod, vec
from training.kinds.still.still_lamps import SHADES, chain, shade, wall_of
from training.kinds.still.still_plants import UP, out
from training.kinds.wheels import beam, lathe


def canopy(m: Model, r: float, z: float, n: int) -> None:
    """Make the plate at the ceiling, perhaps with a rose, screws or a piece of ceiling."""
    m.add(
        BASE,
        m.pick(
            rod((0, 0, z - 0.03), (0, 0, z), r, n),
            lathe([(0, -0.06), (0.3 * r, -0.05), (r, -0.01), (r, 0), (0, 0)], n, (0, 0, z)),
        ),
    )
    m.add(BASE, *(around(ball((0.7 * r, 0, z - 0.03), (0.01, 0.01, 0.015), 6), 3) if m.chance(0.3) else []))
    rose = [
        *around(ball((1.6 * r, 0, z), (0.8 * r, 0.35 * r, 0.02), 8), 8),
        lathe([(0, -0.02), (1.5 * r, -0.02), (2 * r, 0), (0, 0)], n, (0, 0, z)),
    ]
    slab = box((-4 * r, 4 * r), (-4 * r, 4 * r), (z, z + 0.03))
    m.add(BASE, *m.pick([], [], rose, [slab]))


def lantern(m: Model, r: float, h: float, k: int) -> None:
    """Make a glazed box of bars with a roof, a floor, glass and a candle, its floor at 0."""
    corners = [r * out(2 * np.pi * (i + 0.5) / k) for i in range(k)]
    wide, t, n = m.number(0.8, 1.2), 0.04 * r, max(k, 6)
    turn = [np.array([c * s + z * UP for c in corners]) for s, z in ((1.1, 0), (1.1, t), (1.2, h), (0.15, 1.4 * h))]
    m.add(BASE, *(beam(a, wide * a + h * UP, 2 * t, 2 * t) for a in corners), prism(turn[0][:, :2], "z", (-t, t)))
    for i in range(k):
        a, b = corners[i], corners[(i + 1) % k]
        m.add(BASE, beam(wide * a + h * UP, wide * b + h * UP, 2 * t, 2 * t, UP))
        m.add(
            BASE,
            *[beam((a + b) / 2, wide * (a + b) / 2 + h * UP, 1.3 * np.linalg.norm(a - b), 0.3 * t, b - a)][: m.pick(0, 1, 1)],
        )
    roof = lathe(
        [(0, 0), (1.25 * wide * r, 0), (m.number(0.2, 0.6) * r, 0.25 * h), (0.1 * r, 0.4 * h), (0, 0.4 * h)], k if k > 5 else 6
    )
    pyramid = Trimesh(
        np.concatenate([[wide * 1.2 * c + h * UP for c in corners], [1.4 * h * UP]]),
        [(i, (i + 1) % k, k) for i in range(k)],
        process=False,
    )
    m.add(BASE, *[pyramid] if k < 6 else [moved(roof, (0, 0, h))], ball((0, 0, 1.4 * h), (0.1 * r,) * 3, 8))
    m.add(BASE, rod((0, 0, 0), (0, 0, 0.5 * h), 0.2 * r, n), ball((0, 0, 0.55 * h), (0.09 * r, 0.09 * r, 0.1 * h), 8))


def _bowl(m: Model, r: float, top: float, n: int) -> None:
    """Make a bowl with bulbs that hangs by cords or chains."""
    deep, z, k = r * m.number(0.3, 0.9), 1.0, m.pick(3, 4, 6)
    t = np.linspace(0.05, 1, 9)
    m.add(BASE, wall_of(m, np.c_[1.3 * r * t, z - deep + deep * t ** m.pick(2, 3, 6)], n), ring((0, 0, z), UP, 1.3 * r, 0.012))
    m.add(BASE, *(c for p in chain(m, (0, 0, top - 0.2), (1.3 * r, 0, z), 0.004) for c in around(p, k)))
    m.add(
        BASE, rod((0, 0, top - 0.22), (0, 0, top), 0.015, n), ball((0, 0, z - deep), (0.06 * r, 0.06 * r, 0.08 * r + 0.02), 8)
    )
    m.add(BASE, *around(ball((0.5 * r, 0, z), (0.05, 0.05, deep), 8), m.pick(1, 3)), rod((0, 0, z - deep), (0, 0, z), 0.01))
    m.add(BASE, *(rod((0, 0, z), 0.5 * r * out(2.1 * a) + z * UP, 0.01, 6) for a in range(3)))


def _long_light(m: Model, plate: float, top: float, n: int) -> None:
    """Make a long light with bands that hangs by two rods."""
    x, t, w = m.number(0.4, 0.8), m.number(0.02, 0.06), m.number(0.03, 0.1)
    m.add(BASE, m.pick(box((-x, x), (-w, w), (1, 1 + 2 * t)), rod((-x, 0, 1 + t), (x, 0, 1 + t), t, n)))
    m.add(
        BASE,
        *(box((a - 0.01, a + 0.01), (-1.1 * w, 1.1 * w), (0.99, 1.01 + 2 * t)) for a in np.linspace(-x, x, m.pick(2, 3, 7))),
    )
    m.add(BASE, *(rod((a, 0, 1 + t), (a * m.pick(1, 0.2), 0, top), 0.004, 6) for a in (-0.7 * x, 0.7 * x)))
    m.add(BASE, box((-x, x), (-plate, plate), (top - 0.02, top)))
    m.add(BASE, *(ball((a, 0, 1), (0.03,) * 3, 8) for a in np.linspace(-0.8 * x, 0.8 * x, m.pick(0, 3, 5))))


def pendant_lamp(m: Model) -> None:
    """Make one hanging lamp, a bar or a cluster of them, a bowl on chains, a lantern or a long light; nothing moves."""
    r, drop, plate = sizes(m, (0.1, 0.3), (0.3, 1.0), (0.04, 0.08))
    how, style, n = m.pick("one", "one", "bar", "cluster", "bowl", "lantern", "beam"), m.pick(*SHADES), m.pick(8, 12, 20, 32)
    h, trims, top = r * m.number(0.7, 2.0), m.chance(0.6), drop + 1.0

    def one_shade(one: Model) -> None:
        shade(one, r, h, style, n, trims)

    if how in ("one", "lantern"):
        m.add(BASE, *chain(m, (0, 0, 1.0), (0, 0, top), m.number(0.004, 0.01)))
        end = (0, 0, 1.0 - 1.01 * h)
        repeat(m, one_shade if how == "one" else lambda one: lantern(one, r, 0.71 * h, one.pick(4, 4, 6, 8)), [(end, 0)])
    elif how == "bowl":
        _bowl(m, r, top, n)
    elif how == "beam":
        _long_light(m, plate, top, n)
    else:
        k, gap, r = m.pick(2, 3, 4, 5), m.number(1.2, 1.6) * r, r * (0.9 if style == "bare" else 0.5)
        places = [
            vec(gap * (i - (k - 1) / 2), 0, 1) if how == "bar" else gap * 0.7 * out(2.4 * i) + m.number(0.7, 1.2) * UP
            for i in range(k)
        ]
        reach = max(np.linalg.norm(p[:2]) for p in places) + 0.03
        m.add(
            BASE,
            *[rod((0, 0, top - 0.03), (0, 0, top), reach, n)]
            if how == "cluster"
            else [box((-reach, reach), (-0.03, 0.03), (top - 0.03, top))],
        )
        h = min(h, 0.5)
        m.add(BASE, *(rod(p, (p[0], p[1], top - 0.01), 0.004, 6) for p in places))
        repeat(m, one_shade, [(p - 1.01 * h * UP, 0) for p in places])
    canopy(m, plate, top, n) if how in ("one", "lantern", "bowl") else None
