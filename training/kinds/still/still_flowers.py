"""Flowers in vases, pots and boxes, small trees in trays, and wreaths, of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import trimesh
from trimesh import Trimesh

from training.kinds.furniture.still_seats import smooth
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, around, ball, moved, rod, together, turned, vec
from training.kinds.still.static import boulder
from training.kinds.still.still_plants import UP, out
from training.kinds.wheels import beam, lathe

HEADS = "daisy daisy rose tulip pompon lily bell spike lump".split()


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
