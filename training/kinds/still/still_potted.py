"""Flowers in pots and boxes, of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np

from training.kinds.furniture.still_seats import repeat, smooth
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, around, ball, box, prism, rectangle, ring, rod, tube
from training.kinds.still.static import boulder
from training.kinds.still.still_flowers import HEADS, blossom, bunch, fewer, leaf, put
from training.kinds.still.still_lamps import wall_of
from training.kinds.still.still_plants import UP, bent, out, spots
from training.kinds.wheels import lathe


def _pot(m: Model, r: float, h: float, n: int) -> None:
    """Make a round or square pot with earth, perhaps with a rim, a saucer, feet or a band."""
    how, wide = m.pick("rim", "rim", "plain", "square", "bowl"), m.number(0.6, 0.95)
    if how == "square":
        m.add(BASE, prism(rectangle((-r, r), (-r, r), 0.1 * r), "z", (0.02 * h, h)), box((-r, r), (-r, r), (0, 0.1 * h)))
        m.add(BASE, box((-0.95 * r, 0.95 * r), (-0.95 * r, 0.95 * r), (0.05 * h, 0.85 * h)))
        m.add(
            BASE, *[prism(rectangle((-1.06 * r, 1.06 * r), (-1.06 * r, 1.06 * r), 0.14 * r), "z", (0.9 * h, h))][m.pick(0, 1) :]
        )
        return
    side = {
        "rim": [(wide, 0), (0.95, 0.8), (1.06, 0.8), (1.08, 1), (0.9, 1)],
        "bowl": [(0.5, 0), (0.95, 0.4), (1, 0.8), (0.92, 1)],
    }
    m.add(BASE, wall_of(m, [(1e-4, 0), *(np.array(side.get(how, [(wide, 0), (1, 1)])) * (r, h))], n))
    m.add(BASE, lathe([(0, 0.05 * h), (0.6 * wide * r, 0.05 * h), (0.94 * r, 0.85 * h), (0, 0.9 * h)], n))
    m.add(
        BASE, *[lathe(np.array([(0, 0), (1.1, 0), (1.3, 0.12), (1.2, 0.12), (1, 0.02), (0, 0.02)]) * (r, h), n)][m.pick(0, 1) :]
    )
    m.add(BASE, *[ring((0, 0, 0.5 * h), UP, (0.5 + 0.5 * wide) * r, 0.03 * r, 16)][m.pick(0, 1, 1) :])


def _rosette(m: Model, at: Point, count: int, long: float, wide: float) -> None:
    """Let leaves fan out from a place."""
    for i in range(count):
        way = out(2.4 * i + m.number(0, 0.4), m.number(0.1, 1.2))
        line = bent(at, np.asarray(at) + long * m.number(0.7, 1.1) * way, 0.25 * long * UP, 6)
        m.add(BASE, leaf(line, wide * long, m.number(0, 0.4), np.cross(way, UP)))


def _plant(m: Model, r: float, z: float, n: int) -> None:
    """Let a plant grow at a height: a bunch, an orchid, bulbs, a bush of blossoms or leaves that hang over."""
    how, tall = m.pick("bunch", "orchid", "bulbs", "bush", "hanging"), r * m.number(2, 4)
    head = blossom(m, r * m.number(0.2, 0.4), m.pick(*HEADS), n)
    if how == "bunch":
        bunch(m, (0, 0, z - 0.05 * r), 0.8 * r, (r, tall), 0.3 * r, n)
    elif how == "orchid":
        _rosette(m, (0, 0, z - 0.03 * r), m.pick(4, 6), 1.3 * r, 0.22)
        for k in range(m.pick(1, 2)):
            a = out(2.5 * k + m.number(0, 1))
            path = smooth(
                [
                    (0, 0, z - 0.05 * r),
                    z * UP + 0.8 * tall * UP,
                    0.4 * r * a + tall * UP + z * UP,
                    1.6 * r * a + (0.8 * tall + z) * UP,
                ]
            )
            m.add(BASE, tube(path, 0.03 * r, 6))
            for i in np.linspace(0.55, 1, m.pick(3, 5)) * (len(path) - 1):
                m.add(BASE, *put(head, path[int(i)], a + 0.3 * UP + 0.4 * (-1) ** int(i) * np.cross(a, UP)))
        m.add(BASE, *[rod((0.1 * r, 0, z - 0.1 * r), (0.05 * r, 0, z + 0.8 * tall), 0.025 * r, 6)][m.pick(0, 1) :])
    elif how == "bulbs":
        for at in spots(m, m.pick(1, 3, 5), 0.35 * r):
            top = at + (z + tall * m.number(0.6, 0.9)) * UP
            m.add(BASE, tube(bent(at + (z - 0.1 * r) * UP, top, 0.05 * r * out(1)), 0.05 * r, 6), *put(head, top, (0.05, 0, 1)))
            for k in range(m.pick(2, 3)):
                a = out(2.1 * k + at[0], m.number(1.2, 3))
                line = bent(at + (z - 0.1 * r) * UP, at + z * UP + 0.3 * tall * a / a[2] * m.number(1, 2), 0.1 * r * UP, 5)
                m.add(BASE, leaf(line, 0.12 * r, 0.4, np.cross(a, UP)))
    else:
        crown = (z + 0.5 * r) * UP
        m.add(BASE, m.pick(boulder(m, crown, (1.1 * r, 1.1 * r, 0.8 * r)), ball(crown, (r, r, 0.8 * r), n)))
        for i in range(m.pick(8, 14, 20)):
            s = 0.1 + 0.8 * ((i * 0.618) % 1)
            a = np.sqrt(1 - s * s) * out(2.4 * i) + s * UP
            at = crown + 0.9 * a * (r, r, 0.75 * r)
            m.add(BASE, *put(head, at, a))
        for i in range(7 if how == "hanging" else 0):
            a = out(0.9 * i)
            path = bent(crown + 0.3 * r * a, crown + 1.4 * r * a - m.number(0.5, 1.3) * z * UP, 0.6 * r * UP, 7)
            m.add(BASE, tube(path, 0.03 * r, 5))
            m.add(
                BASE,
                *(leaf([p, p + 0.2 * r * a, p + 0.4 * r * a - 0.1 * r * UP], 0.12 * r, 0.2, np.cross(a, UP)) for p in path[2:]),
            )


def potted_flowers(m: Model) -> None:
    """Make flowers in a pot, in several on a tray or steps, or in a window box; nothing moves."""
    r, n, how = m.number(0.06, 0.14), m.pick(6, 8, 12), m.pick("one", "one", "row", "steps", "box")
    h, k, fine = r * m.number(1.2, 2.0), m.pick(2, 3), m.pick(6, 12, 24)

    def potted(one: Model) -> None:
        _pot(one, r, h, fine)
        _plant(one, r, 0.87 * h, n)

    if how == "one":
        potted(m)
        legs = around(box((1.2 * r, 1.4 * r), (-0.1 * r, 0.1 * r), (-0.2, -0.02)), 4)
        m.add(BASE, *([box((-1.5 * r, 1.5 * r), (-1.5 * r, 1.5 * r), (-0.03, 0)), *legs] if m.chance(0.25) else []))
    elif how == "box":
        x = 1.3 * r * k
        m.add(
            BASE,
            prism(rectangle((-x, x), (-r, r), 0.1 * r), "z", (0, h)),
            box((-0.98 * x, 0.98 * x), (-0.95 * r, 0.95 * r), (0, 0.87 * h)),
        )
        m.add(
            BASE,
            *(
                box((a - 0.02, a + 0.02), (-1.1 * r, -0.98 * r), (0, h))
                for a in np.linspace(-0.9 * x, 0.9 * x, m.pick(0, 2, 3, 5))
            ),
        )
        m.add(
            BASE,
            *[prism(rectangle((-1.04 * x, 1.04 * x), (-1.1 * r, 1.1 * r), 0.15 * r), "z", (0.92 * h, 1.02 * h))][
                m.pick(0, 1) :
            ],
        )
        for a in np.linspace(-0.75 * x, 0.75 * x, k):
            repeat(m, lambda one: _plant(one, 0.9 * r, 0.87 * h, n), [((a, 0, 0), 0)])
    else:
        step = (0, 0.0) if how == "row" else (1, 1.3 * r)
        for i in range(k):
            z, y = step[1] * i, 2.6 * r * i * step[0]
            at = (0, y, z) if how == "steps" else (2.8 * r * i, 0, 0)
            repeat(m, potted, [(at, 0)])
            m.add(BASE, *[box((-1.6 * r, 1.6 * r), (y - 1.3 * r, y + 1.3 * r), (-0.03, z))][: step[0]])
        m.add(BASE, *[box((-1.5 * r, 2.8 * r * (k - 1) + 1.5 * r), (-1.5 * r, 1.5 * r), (-0.02, 0))][step[0] :])
    fewer(m, m.pick(30, 60, 100))
