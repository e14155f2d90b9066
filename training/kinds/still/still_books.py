"""Books and ornaments, of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np

from training.kinds.furniture.still_seats import repeat
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, ball, box, moved, prism, rectangle, ring, rod, tube, turned, vec
from training.kinds.still.static import boulder
from training.kinds.still.still_flowers import VASES, leaf, vase
from training.kinds.still.still_plants import UP, bent, out, spots
from training.kinds.wheels import beam, lathe


def _fluted(m: Model, r: float, h: float) -> None:
    """Make a jar with flutes, perhaps in steps."""
    k, t = m.pick(5, 7, 10), np.linspace(0, 2 * np.pi, 60, endpoint=False)
    flute = (1 + 0.12 * np.cos(k * t))[:, None] * np.c_[np.cos(t), np.sin(t)]
    for i in range(tiers := m.pick(1, 2, 3)):
        m.add(BASE, prism(r * (1 - 0.2 * i) * flute, "z", (i * h / tiers, (i + 1) * h / tiers)))
    m.add(BASE, ring((0, 0, h), UP, 0.6 * r, 0.08 * r, 16))


def ornament(m: Model, r: float, n: int, what: str = "") -> None:
    """Make an ornament, drawn or as told: a vase with or without twigs, a fluted jar, a bowl of balls, a candle, a figure."""
    how, h = what or m.pick("vase", "vase", "vase", "twigs", "fluted", "bowl", "candle", "ring", "stones"), r * m.number(1.5, 5)
    if how in ("vase", "twigs"):
        neck = vase(m, r, h, m.pick(*VASES), n)
        for i in range(m.pick(3, 5, 8) if how == "twigs" else 0):
            a = out(2.4 * i)
            path = bent(
                0.3 * neck * a + 0.03 * h * UP, m.number(0.5, 1.5) * r * a + h * m.number(1.4, 2.2) * UP, -0.2 * r * a, 5
            )
            m.add(BASE, tube(path, 0.02 * r + 0.0008, 5))
            tips = [(path[2], 1), (path[3], -1), (path[4], 1)][: m.pick(0, 1, 3)]
            m.add(
                BASE,
                *(
                    leaf([p, p + 0.3 * r * a + 0.2 * r * UP, p + 0.7 * r * a], 0.2 * r, 0.1, s * np.cross(a, UP))
                    for p, s in tips
                ),
            )
    elif how == "fluted":
        _fluted(m, r, h)
    elif how == "bowl":
        m.add(BASE, lathe(np.array([(0, 0), (0.6, 0), (1.3, 0.6), (1.4, 1), (1.3, 1), (1.2, 0.7), (0, 0.25)]) * r, n))
        m.add(BASE, *(ball(p + 0.6 * r * UP, (0.36 * r,) * 3, 8) for p in spots(m, m.pick(1, 4, 7), 0.4 * r)))
    elif how == "candle":
        foot = [(0, 0), (r, 0), (0.9 * r, 0.1 * r), (0.2 * r, 0.3 * r), (0.2 * r, 0.6 * h), (0.5 * r, 0.65 * h), (0, 0.65 * h)]
        m.add(BASE, lathe(foot, n))
        m.add(BASE, rod((0, 0, 0.6 * h), (0, 0, h), 0.22 * r, n), rod((0, 0, h), (0, 0, 1.05 * h), 0.02 * r, 5))
    elif how == "ring":
        m.add(
            BASE,
            box((-0.6 * r, 0.6 * r), (-0.4 * r, 0.4 * r), (0, 0.3 * r)),
            ring((0, 0, 1.4 * r), (0, 1, 0), r, 0.25 * r, 2 * n),
        )
    else:
        s, z = r, 0.0
        for _ in range(m.pick(3, 4, 5)):
            m.add(BASE, boulder(m, (0, 0, z + 0.35 * s), (s, s, 0.45 * s)))
            s, z = 0.8 * s, z + 0.65 * s


def _book(m: Model, wide: float, deep: float, thick: float, how: str) -> None:
    """Make a closed book that lies, its spine at -Y: a block, or boards, pages and a spine, perhaps with raised bands."""
    x, y = (-wide / 2, wide / 2), (-deep / 2, deep / 2)
    if how == "block":
        m.add(BASE, box(x, y, (0, thick)))
        return
    t = min(0.004, 0.15 * thick)
    m.add(BASE, box((x[0] + 0.004, x[1] - 0.004), (y[0], y[1] - 0.005), (t, thick - t)))
    m.add(BASE, box(x, y, (0, t)), box(x, y, (thick - t, thick)))
    if how == "round":
        a = np.linspace(0, np.pi, 9)
        spine = np.c_[y[0] + 0.002 - 0.3 * thick * np.sin(a), thick / 2 - thick / 2 * np.cos(a)]
        m.add(BASE, prism(spine, "x", x))
    else:
        m.add(BASE, box(x, (y[0] - 0.003, y[0]), (0, thick)))
    deepest = y[0] - 0.003 - 0.3 * thick * (how == "round")
    for s in np.linspace(x[0] + 0.1 * wide, x[1] - 0.1 * wide, m.pick(0, 0, 3, 5)):
        m.add(BASE, box((s - 0.003, s + 0.003), (deepest, y[0] + 0.01), (0.2 * thick, 0.8 * thick)))
    m.add(BASE, *[beam((0, y[1] - 0.03, thick / 2), (0.01, y[1] + 0.02, thick / 2 - 0.005), 0.01, 0.001)][m.pick(0, 1, 1, 1) :])


def pile(m: Model, at: Point, count: int, size: float) -> float:
    """Pile up lying books at a place; how high they reach."""
    z, how, neat = float(at[2]), m.pick("block", "flat", "flat", "round"), m.pick(3, 12, 40)
    for i in range(count):
        thick, wide = m.number(0.012, 0.05), size * m.number(1.6, 2) * (1 - 0.03 * i)
        turn = m.number(-neat, neat) + m.pick(0, 0, 180)
        repeat(m, lambda one, wide=wide, thick=thick: _book(one, wide, 0.72 * wide, thick, how), [((at[0], at[1], z), turn)])
        z += thick
    return z


def book_row(m: Model, x: Span, z: float, high: float, deep: float) -> float:
    """Stand books in a row between two places, the last ones perhaps leaning; where the row ends."""
    how, at, low = m.pick("block", "flat", "round", "flat"), x[0], m.number(0.65, 0.9)
    lean, depth = m.pick(0, 0, 12), 0.75 * deep
    while at < x[1] - 0.05:
        thick, tall = m.number(0.012, 0.045), high * m.number(low, 1)
        one = Model(np.random.default_rng(int(m.rng.integers(1 << 30))))
        _book(one, tall, depth * m.number(0.85, 1), thick, how)
        for _, s in one.pieces:
            turned(s, (0, 1, 0), -90, (0, 0, 0))
            m.add(BASE, moved(s, (at + thick, 0, z + tall / 2)))
        at += thick
    if lean and at + 0.1 < x[1] + 0.1:
        tilt = turned(box((0, 0.02), (-depth / 2, depth / 2), (0, 0.8 * high)), (0, 1, 0), -lean, (0, 0, 0))
        m.add(BASE, moved(tilt, (at + 0.8 * high * np.sin(np.deg2rad(lean)), 0, z)))
    return at


def book_stack(m: Model) -> None:
    """Make books: piled up, several piles, a row between ends, or a row and a pile, with a thing on top; nothing moves."""
    how, size, n = m.pick("pile", "pile", "piles", "row", "mixed", "tower"), m.number(0.08, 0.14), m.pick(8, 12, 20)
    top = vec(0, 0, 0)
    if how in ("pile", "tower"):
        top = vec(0, 0, pile(m, (0, 0, 0), m.pick(3, 4, 6) if how == "pile" else m.pick(8, 12), size))
    elif how == "piles":
        for at in spots(m, m.pick(2, 3), 2.6 * size):
            top = vec(at[0], at[1], pile(m, at, m.pick(2, 4, 7), size))
    if how in ("row", "mixed"):
        high, x = m.number(0.18, 0.28), m.number(0.15, 0.4)
        end = book_row(m, (0, x), 0, high, 1.4 * size)
        y, style = 0.6 * size, m.pick("angle", "block", "ball", "steps")
        for at, s in ((0, -1), (end, 1) if how == "row" else (0, -1)):
            b = sorted((at, at + s * 0.04))
            m.add(
                BASE,
                box(b, (-y, y), (0, high * (0.6 if style == "block" else 0.05))),
                box(sorted((at, at + s * 0.005)), (-y, y), (0, 0.6 * high)),
            )
            m.add(BASE, *[ball((at + s * 0.045, 0, 0.045 + 0.03), (0.045, 0.045, 0.05), n)][: style == "ball"])
            m.add(
                BASE,
                *(
                    box(sorted((at, at + s * 0.02 * k)), (-0.5 * y, 0.5 * y), (0, high * 0.6 / k))
                    for k in (1, 2, 3)
                    if style == "steps"
                ),
            )
        top = (
            vec(end + 1.2 * size, 0, pile(m, (end + 1.1 * size, 0, 0), m.pick(1, 3, 5), size))
            if how == "mixed"
            else vec(0.1, 0, 0.6 * high)
        )
    low, high = np.min([s.bounds[0] for _, s in m.pieces], 0) - 0.03, np.max([s.bounds[1] for _, s in m.pieces], 0) + 0.03
    board = box((low[0], high[0]), (low[1], high[1]), (-0.03, 0))
    m.add(BASE, *[board][: 1 if how == "piles" else m.pick(0, 0, 1)])
    if m.chance(0.5) and how != "row":
        repeat(m, lambda one: ornament(one, 0.4 * size, n), [(top, 0)])
    strap = [prism(rectangle((-2.05 * size, 2.05 * size), (-0.002, top[2] + 0.002), 0.003), "y", (-0.01, 0.01))]
    m.add(BASE, *strap[: how == "pile" and m.chance(0.15)])
