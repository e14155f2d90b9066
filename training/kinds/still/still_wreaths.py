"""Small trees in trays, and wreaths, of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np

from training.kinds.furniture.still_seats import repeat, sizes, smooth
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, around, ball, box, prism, rectangle, ring, rod, rounded, tube, turned, vec
from training.kinds.still.static import boulder
from training.kinds.still.still_flowers import HEADS, blossom, fewer, leaf, put, ribbon
from training.kinds.still.still_plants import UP, bent, limb, out, spots
from training.kinds.wheels import lathe


def _foliage(m: Model, at: Point, r: float, how: str) -> None:
    """Make a cloud of leaves of a small tree: a lump, lumps, or leaf cards on a lump."""
    q = r * m.rng.uniform(0.8, 1.2, 3) * (1, 1, 0.45)
    m.add(BASE, ball(at, q, 8) if how == "balls" else boulder(m, at, q))
    for i in range({"lumps": 4, "cards": 14}.get(how, 0)):
        a = out(2.4 * i, m.number(0, 0.9))
        p = np.asarray(at) + 0.45 * q * a
        m.add(
            BASE,
            boulder(m, p, 0.45 * q)
            if how == "lumps"
            else leaf([p, p + 0.3 * r * a, p + 0.6 * r * a], 0.2 * r, 0.2, np.cross(a, UP)),
        )


def _small_tree(m: Model, tall: float, form: str, how: str, n: int) -> None:
    """Grow a small old tree at the origin: upright, windswept, hanging over, or a bare one."""
    lean = {"upright": 0.1, "swept": 0.8, "over": 1.0}[form] * out(m.number(0, 1))
    drop = -0.8 if form == "over" else 1.0
    line = smooth(
        [(0, 0, -0.03), 0.25 * tall * UP, 0.5 * tall * (UP + lean) + 0.12 * tall * out(2.5), tall * (drop * UP + 0.8 * lean)]
    )
    m.add(BASE, limb(line, tall * np.linspace(0.11, 0.03, len(line)), n))
    m.add(
        BASE,
        *(
            limb(np.array([0.1 * tall * UP, 0.17 * tall * out(a, -0.1)]), [0.05 * tall, 0.015 * tall], 6)
            for a in (0, 2, 4.2)
            if form != "over"
        ),
    )
    for i, s in enumerate(np.linspace(0.4, 0.9, m.pick(2, 3, 5))):
        root = line[int(s * (len(line) - 1))]
        end = root + tall * m.number(0.25, 0.5) * (1.2 - 0.5 * s) * out(2.6 * i + 0.6, m.number(0, 0.3))
        m.add(BASE, limb(bent(root, end, 0.06 * tall * UP), tall * np.linspace(0.045, 0.015, 4), 6))
        _foliage(m, end, tall * m.number(0.18, 0.28), how)
    _foliage(m, line[-1], tall * m.number(0.2, 0.3), how)


def bonsai(m: Model) -> None:
    """Make one small tree or a grove in a tray, a deep pot or on a rock, with moss, stones and a table; nothing moves."""
    x, y, h = sizes(m, (0.12, 0.25), (0.08, 0.14), (0.03, 0.08))
    form, how, n = m.pick("upright", "upright", "swept", "over"), m.pick("lump", "lumps", "balls", "cards"), m.pick(6, 8, 12)
    count, shape = m.pick(1, 1, 1, 3, 5) if form == "upright" else 1, m.pick("box", "oval", "round")
    x, y, h = (0.09, 0.09, 0.18) if form == "over" else (x, y, h)
    outline = rounded((-x, x), (-y, y), {"box": 0.005, "oval": 0.95 * min(x, y), "round": 0.03}[shape])
    m.add(
        BASE,
        prism(outline, "z", (0.01, h * 0.9)),
        prism(outline.buffer(0.008).difference(outline.buffer(-0.006)), "z", (m.number(0, 0.8) * h, h)),
    )
    feet = [(s * 0.7 * x, t * 0.6 * y) for s in (-1, 1) for t in (-1, 1)]
    m.add(BASE, *(box((a - 0.02, a + 0.02), (b - 0.015, b + 0.015), (0, 0.02)) for a, b in feet))
    m.add(BASE, boulder(m, (0, 0, 0.88 * h), (0.85 * x, 0.85 * y, 0.03)))
    for at in spots(m, count, 0.4 * y):
        tall = m.number(0.2, 0.4) * (1 if count == 1 else 0.7)
        repeat(
            m,
            lambda one, tall=tall: _small_tree(one, tall, form, how, n),
            [(at * (1.5, 1, 1) + h * UP, m.pick(0, 180, m.number(0, 360)))],
        )
    for _ in range(m.pick(0, 0, 2, 4)):
        s = m.number(0.015, 0.04)
        m.add(BASE, boulder(m, (m.number(-0.8, 0.8) * x, m.number(-0.8, 0.3) * y, h), (s, s, s)))
    if m.chance(0.25):
        house = [
            lathe(np.array([(0, 0), (1, 0), (0.25, 0.6), (0, 0.6)]) * 0.03, 6, (0.75 * x, 0, h + 0.03 * i + 0.02))
            for i in range(3)
        ]
        m.add(BASE, *house, rod((0.75 * x, 0, h - 0.01), (0.75 * x, 0, h + 0.1), 0.012, 6))
    if m.chance(0.4):
        a, b, legs = 1.3 * x, 1.4 * y, m.number(0.03, 0.3)
        m.add(
            BASE,
            box((-a, a), (-b, b), (-0.02, 0)),
            *(box((s * a - s * 0.03, s * a), (t * b - t * 0.03, t * b), (-legs, 0)) for s in (-1, 1) for t in (-1, 1)),
        )
        m.add(BASE, *[prism(rectangle((-a, a), (-b, b), 0.03), "z", (-0.7 * legs, -0.7 * legs + 0.01))][m.pick(0, 1) :])
    fewer(m, m.pick(30, 60, 100))


def wreath(m: Model) -> None:
    """Make a wreath of leaves, twigs, needles or flowers, hung or laid, with a bow, baubles or candles; nothing moves."""
    big, thick, n = m.number(0.12, 0.25), m.number(0.02, 0.05), m.pick(8, 12, 16)
    how, laid, k = m.pick("leaves", "twigs", "straw", "needles", "flowers"), m.chance(0.35), m.pick(4, 6, 8, 12)
    one, u = Model(np.random.default_rng(int(m.rng.integers(1 << 30)))), np.linspace(0, 2 * np.pi, 40)
    begin, end = m.pick((0, 1), (0, 1), (0.15, 0.85), (0.5, 1))
    if how == "twigs":
        one.add(BASE, ring((0, 0, 0), UP, big, 0.3 * thick, 3 * n))
        for i in range(m.pick(3, 5, 8)):
            r, z = big + 0.6 * thick * np.cos(m.pick(3, 4, 5) * u + i), 0.6 * thick * np.sin(m.pick(3, 4, 5) * u + 2 * i)
            one.add(BASE, tube(np.c_[r * np.cos(u), r * np.sin(u), z], 0.25 * thick, 5))
    else:
        one.add(BASE, ring((0, 0, 0), UP, big, thick if how == "straw" else 0.4 * thick, 3 * n))
    if how == "straw":
        one.add(BASE, *around(ring((big, 0, 0), (0, 1, 0), 1.02 * thick, 0.1 * thick, 12), 2 * k))
    head = blossom(m, thick * m.number(0.8, 1.5), m.pick(*HEADS[:6]), 8)
    small = thick * m.number(0.2, 0.5)
    for i in range({"leaves": 60, "needles": 90, "flowers": 24, "twigs": 12, "straw": 5}[how]):
        a = 6.283 * (begin + (end - begin) * ((i * 0.618) % 1))
        side = out(a, 0) * np.cos(2.4 * i) + UP * np.abs(np.sin(2.4 * i))
        at, way = big * out(a) + 0.3 * thick * side, np.cross(UP, out(a)) * m.pick(0.7, 1.2) + 0.8 * side
        if how == "flowers":
            one.add(BASE, *put(head, at, side + 0.3 * UP))
            continue
        long, wide = (thick * m.number(1.2, 2), 0.08 if how == "needles" else 0.3)
        one.add(
            BASE, leaf([at, at + 0.5 * long * way, at + long * way - 0.1 * long * UP], wide * long, 0.3, np.cross(way, side))
        )
    for i in range(k if m.chance(0.6) else 0):
        a, s = out(6.283 * (i + 0.3) / k), m.pick(small, 1.6 * small)
        one.add(BASE, ball(big * a + 0.6 * thick * UP, (s,) * 3, 8), rod(big * a, big * a + 0.6 * thick * UP, 0.2 * s, 5))
    if laid and m.chance(0.7):
        c = rod((big, 0, 0), (big, 0, thick + m.number(0.04, 0.12)), 0.6 * thick, n)
        one.add(BASE, *around(c, 4), *around(rod((big, 0, 0), (big, 0, c.bounds[1, 2] + 0.015), 0.003, 5), 4))
    if not laid:
        for _, s in one.pieces:
            turned(s, (1, 0, 0), 90, (0, 0, 0))
        one.add(BASE, *put(ribbon(m, 2 * thick, 4 * thick), (0, -thick, m.pick(-1, 1) * big), UP) if m.chance(0.6) else [])
        one.add(BASE, *[box((-1.6 * big, 1.6 * big), (0.3 * thick, thick), (-1.8 * big, 1.8 * big))][m.pick(0, 1, 1) :])
        one.add(
            BASE,
            *[tube([vec(-0.01, 0, big), vec(-0.01, 0, 1.5 * big), vec(0.01, 0, 1.5 * big), vec(0.01, 0, big)], 0.003, 5)][
                m.pick(0, 1) :
            ],
        )
    m.add(BASE, *(s for _, s in one.pieces))
    m.add(BASE, *[rod((0, 0, -0.5 * thick - 0.01), (0, 0, -0.2 * thick), 1.25 * big, 24)][: laid and m.pick(0, 1)])
    fewer(m, m.pick(30, 60, 100))
