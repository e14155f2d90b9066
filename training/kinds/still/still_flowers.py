"""Flowers in vases, pots and boxes, small trees in trays, and wreaths, of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import trimesh
from trimesh import Trimesh

from training.kinds.furniture.still_seats import sizes, smooth
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, around, ball, box, moved, ring, rod, together, tube, turned, vec
from training.kinds.still.static import boulder
from training.kinds.still.still_lamps import wall_of
from training.kinds.still.still_plants import UP, bent, out
from training.kinds.wheels import beam, lathe

HEADS = "daisy daisy rose tulip pompon lily bell spike lump".split()
VASES = {
    "flask": [(0.5, 0), (0.9, 0.12), (1, 0.3), (0.75, 0.5), (0.3, 0.65), (0.28, 0.9), (0.4, 1)],
    "urn": [(0.5, 0), (0.45, 0.06), (0.3, 0.12), (0.8, 0.4), (1, 0.65), (0.9, 0.8), (0.6, 0.88), (0.8, 1)],
    "cylinder": [(0.7, 0), (0.7, 1)],
    "flared": [(0.45, 0), (0.4, 0.15), (0.42, 0.5), (0.6, 0.8), (1, 1)],
    "cone": [(0.5, 0), (1, 1)],
    "bowl": [(0.4, 0), (0.8, 0.2), (1, 0.5), (1, 0.8), (0.8, 1)],
    "tall": [(0.5, 0), (0.65, 0.3), (0.6, 0.6), (0.35, 0.85), (0.5, 1)],
}


def vase(m: Model, r: float, h: float, how: str, n: int) -> float:
    """Make a vase round the vertical through the origin, perhaps fluted, with bands, ears or a foot; how wide its neck is."""
    side = np.array(VASES[how]) * (r, h)
    z = np.linspace(0, h, 9 if m.chance(0.7) else len(side))
    fine = np.c_[np.interp(z, side[:, 1], side[:, 0]), z]
    outline = smooth(side) if m.chance(0.5) else fine
    m.add(BASE, wall_of(m, [(1e-4, 0), *outline], n), rod((0, 0, 0.001), (0, 0, 0.05 * h), 0.95 * side[0, 0], n))
    bands = np.sort(m.rng.uniform(0.15, 0.95, m.pick(0, 0, 1, 2, 4)))
    m.add(
        BASE,
        *(ring((0, 0, b * h), UP, float(np.interp(b * h, outline[:, 1], outline[:, 0])), 0.02 * r, max(n, 12)) for b in bands),
    )
    ear = [
        (np.interp(s * h, outline[:, 1], outline[:, 0]) + w * r, 0, s * h)
        for s, w in ((0.9, 0), (0.95, 0.4), (0.7, 0.5), (0.55, 0))
    ]
    m.add(BASE, *(around(tube(smooth(ear), 0.06 * r, 6), 2) if m.chance(0.2) else []))
    dots = around(
        ball((float(np.interp(0.5 * h, outline[:, 1], outline[:, 0])), 0, 0.5 * h), (0.06 * r, 0.06 * r, 0.1 * h), 6), 8
    )
    m.add(BASE, *(dots if m.chance(0.15) else []))
    return float(outline[:, 0][outline[:, 1] > 0.6 * h].min())


def leaf(path: Sequence[Point], wide: float, fold: float, side: Point) -> Trimesh:
    """Make a pointed sheet along a path, creased along its middle."""
    line, n = np.asarray(path, float), len(path)
    t = np.linspace(0, 1, n)[:, None]
    across = np.asarray(side, float) / np.linalg.norm(side)
    up = np.cross(across, line[-1] - line[0])
    up = up / (np.linalg.norm(up) + 1e-9)
    w = wide * np.sin(np.pi * (0.06 + 0.92 * t**0.8))
    points = np.concatenate([line, line + w * (across + fold * up), line + w * (fold * up - across)])
    k = np.arange(n - 1)
    faces = [
        np.c_[k, k + 1, k + n + 1],
        np.c_[k, k + n + 1, k + n],
        np.c_[k, k + 2 * n + 1, k + 1],
        np.c_[k, k + 2 * n, k + 2 * n + 1],
    ]
    return Trimesh(points, np.concatenate(faces), process=False)


def blossom(m: Model, r: float, how: str, n: int) -> list[Trimesh]:
    """Make the head of a flower round the vertical, its stem at the origin."""
    k, rise, t = m.pick(4, 5, 6, 8, 12), m.number(-0.1, 0.5), np.linspace(0, 1, 6)
    petal = np.c_[r * t, 0 * t, r * (rise * t - 0.3 * t**2 + 0.05)]
    if how == "rose":
        cups = [np.array([(0.1, 0), (0.7, 0.2), (1, 0.8), (0.8, 1.1)]) * s * r for s in np.linspace(1, 0.35, m.pick(2, 3, 4))]
        return [*(lathe(c, m.pick(5, 6, n)) for c in cups), ball((0, 0, 0.4 * r), (0.3 * r, 0.3 * r, 0.5 * r), 6)]
    if how == "tulip":
        cup = np.c_[r * np.array([0.1, 0.6, 0.7, 0.6, 0.45]), r * np.array([0, 0.3, 0.8, 1.3, 1.7])]
        path = np.c_[cup[:, 0], 0 * cup[:, 0], cup[:, 1]]
        return [
            *around(leaf(path, 0.5 * r, 0.2, (0, 1, 0)), m.pick(4, 6)),
            ball((0, 0, 0.5 * r), (0.4 * r, 0.4 * r, 0.7 * r), n),
        ]
    if how == "pompon":
        return [
            m.pick(ball((0, 0, r), (r, r, r), n), boulder(m, (0, 0, 0.8 * r), (r, r, 0.8 * r))),
            rod((0, 0, 0), (0, 0, 0.3 * r), 0.2 * r, 6),
        ]
    if how == "lump":
        balls = [
            ball(0.6 * r * out(2.4 * i) * np.sin(0.2 * i) + r * (0.5 + 0.6 * np.cos(0.2 * i)) * UP, (0.33 * r,) * 3, 6)
            for i in range(8)
        ]
        return [*balls, ball((0, 0, 0.5 * r), (0.6 * r, 0.6 * r, 0.6 * r), 6)]
    if how == "bell":
        hang = lathe(np.array([(0.15, 0.5), (0.5, 0.3), (0.55, -0.3), (0.9, -0.7)]) * r, n)
        return [hang, ball((0, 0, 0), (0.12 * r, 0.12 * r, 0.7 * r), 6), rod((0, 0, -0.2 * r), (0, 0, 0.5 * r), 0.05 * r, 6)]
    if how == "spike":
        bits = [ball(0.3 * r * out(2.4 * i) + 0.32 * r * i * UP, ((0.34 - 0.02 * i) * r,) * 3, 6) for i in range(9)]
        return [*bits, rod((0, 0, 0), (0, 0, 2.8 * r), 0.07 * r, 6)]
    wide = r * m.number(0.25, 0.5) * 5 / k
    rows = [
        turned(p.copy(), UP, 180 / k, (0, 0, 0)) for p in around(leaf(petal * 0.8 + (0, 0, 0.1 * r), wide, 0.2, (0, 1, 0)), k)
    ]
    core = ball((0, 0, 0.08 * r), (m.number(0.2, 0.45) * r,) * 2 + (0.15 * r,), n)
    stamens = around(rod((0, 0, 0), (0.2 * r, 0, 0.6 * r), 0.03 * r, 5), 5)
    return [*around(leaf(petal, wide, 0.2, (0, 1, 0)), k), *rows[: k * m.pick(0, 1)], *(stamens if how == "lily" else [core])]


def put(solids: Sequence[Trimesh], at: Point, way: Point) -> list[Trimesh]:
    """Copy solids to a place, their vertical along a way."""
    turn = trimesh.geometry.align_vectors([0, 0, 1], np.asarray(way, float) / np.linalg.norm(way))
    return [moved(s.copy().apply_transform(turn), at) for s in solids]


def bunch(m: Model, root: Point, neck: float, spread: Sequence[float], r: float, n: int) -> None:
    """Let stems with heads and leaves rise from a root through a neck, as far outwards and up as `spread` tells."""
    count, kinds, stout = m.pick(3, 5, 7, 9, 12), [m.pick(*HEADS) for _ in range(m.pick(1, 1, 2, 3))], m.number(0.05, 0.12) * r
    heads = [trimesh.util.concatenate(h) if m.chance(0.3) else h for h in (blossom(m, r, k, n) for k in kinds)]
    turn, leaves = m.number(0, 6.3), m.pick(0, 1, 1, 2)
    for i in range(count):
        share = np.sqrt((i + 0.5 * (count < 4)) / count)
        a = out(turn + 2.4 * i)
        end = np.asarray(root) + spread[0] * share * a + spread[1] * m.number(0.85, 1.1) * (1 - 0.4 * share**2) * UP
        path = bent(np.asarray(root) + 0.5 * neck * share * a, end, -0.1 * spread[0] * share * a, 6)
        m.add(BASE, tube(path, stout, 5))
        head = heads[i % len(heads)]
        m.add(BASE, *put(head if isinstance(head, list) else [head], end, path[-1] - path[-2] + 0.02 * a))
        for k in range(leaves):
            start, way = path[2 + k], out(turn + 2.4 * i + m.number(-1, 1), m.number(0.2, 1.2))
            long = m.number(0.2, 0.35) * spread[1]
            m.add(
                BASE,
                leaf(bent(start, start + long * way, 0.1 * long * UP, 5), m.number(0.1, 0.25) * long, 0.2, np.cross(way, UP)),
            )


def ribbon(m: Model, r: float, tail: float) -> list[Trimesh]:
    """Make a bow at the origin that faces the front, with a knot, two loops and two tails."""
    loop, half = smooth([(0, 0, 0), (r, 0, 0.6 * r), (1.5 * r, 0, 0), (r, 0, -0.5 * r), (0, 0, 0)]), vec(0, 0.25 * r, 0)
    parts = [ball((0, 0, 0), (0.25 * r, 0.25 * r, 0.25 * r), 8)]
    for s in (-1, 1):
        rim = loop * (s, 1, 1)
        k, n = np.arange(len(rim) - 1), len(rim)
        faces = np.concatenate([np.c_[k, k + 1, k + n + 1], np.c_[k, k + n + 1, k + n]])
        parts.append(Trimesh(np.concatenate([rim - half, rim + half]), faces, process=False))
        parts.append(beam((0, 0, 0), (s * 0.6 * r, 0, -tail), m.number(0.3, 0.5) * r, 0.03 * r, (1, 0, 0.2)))
    return parts


def fewer(m: Model, most: int) -> None:
    """Join neighbouring pieces where there are more than a number."""
    step = -(-len(m.pieces) // most)
    solids = [s for _, s in m.pieces]
    m.pieces = [(BASE, together(solids[k : k + step])) for k in range(0, len(solids), step)]


def flower_bouquet(m: Model) -> None:
    """Make cut flowers in a vase, a jug, a basket or paper, or tied and laid down; nothing moves."""
    how, n, r, h = (
        m.pick("vase", "vase", "vase", "basket", "paper", "laid"),
        m.pick(6, 8, 12),
        *sizes(m, (0.05, 0.1), (0.12, 0.3)),
    )
    size, spread = m.number(0.02, 0.06), (m.number(0.12, 0.25), h + m.number(0.1, 0.25))
    if how == "vase":
        neck = vase(m, r, h, m.pick(*VASES), m.pick(6, 12, 24))
        side = m.pieces[0][1].vertices
        rim = side[np.abs(side[:, 2] - 0.7 * h).argmin()]
        m.add(BASE, *put(ribbon(m, 0.03, 0.06), (0, -np.hypot(*rim[:2]), rim[2]), UP) if m.chance(0.15) else [])
        bunch(m, (0, 0, 0.03 * h), 0.8 * neck, spread, size, n)
        petals = [ball(1.5 * r * out(2 * i) + 0.003 * UP, (0.02, 0.012, 0.004), 6) for i in range(m.pick(0, 3, 5))]
        cloth = m.pick(rod((0, 0, -0.01), (0, 0, 0), 2 * r, 24), box((-2 * r, 2 * r), (-2 * r, 2 * r), (-0.01, 0)))
        m.add(BASE, *([cloth, *petals] if m.chance(0.4) else []))
    elif how == "basket":
        r, h = 1.5 * r, 0.12
        m.add(
            BASE,
            wall_of(m, [(1e-4, 0), (0.8 * r, 0), (r, h)], 16),
            lathe([(0, 0.7 * h), (0.94 * r, 0.7 * h), (0, 0.75 * h)], 16),
        )
        m.add(BASE, *(ring((0, 0, s * h), UP, (0.8 + 0.2 * s) * r, 0.008) for s in (0.05, 0.35, 0.65, 1)))
        hoop = [(r * np.cos(a), 0, h + 2.2 * r * np.sin(a)) for a in np.linspace(0, np.pi, 15)]
        m.add(BASE, *[tube(hoop, 0.008)][m.pick(0, 0, 1) :])
        bunch(m, (0, 0, 0.7 * h), r, (1.2 * r, 0.2), size, n)
    else:
        one = Model(np.random.default_rng(int(m.rng.integers(1 << 30))))
        bunch(one, (0, 0, 0), 0.02, (spread[0], 0.35), size, n)
        low, wide = (0.02, 0.6 * spread[0]) if how == "paper" else (0.06, 0.4 * spread[0])
        one.add(BASE, wall_of(m, [(0.015, low), (wide, 0.28 if how == "paper" else 0.14)], m.pick(6, 12)))
        one.add(BASE, ring((0, 0, 0.1), UP, 0.03 + 0.1 * spread[0], 0.006), *put(ribbon(m, 0.04, 0.08), (0, -0.05, 0.1), UP))
        for _, s in one.pieces:
            m.add(BASE, turned(s, (1, 0, 0), 80 if how == "laid" else 0, (0, 0, 0)))
        low = min(s.bounds[0, 2] for _, s in m.pieces)
        m.add(
            BASE,
            box((-0.25, 0.25), (-0.45, 0.1), (low - 0.02, low + 0.02))
            if how == "laid"
            else rod((0, 0, -0.01), (0, 0, 0.03), 0.03),
        )
    fewer(m, m.pick(30, 60, 100))
