"""Bolts, nuts and washers of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from functools import partial

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.furniture.still_seats import repeat
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, moved, prism, rectangle, ring, rod, rounded, tube, turned, vec
from training.kinds.wheels import lathe


def _bolt(m: Model, r: float) -> None:
    """Make a lying bolt or screw along x, its axis at z = 0, its head at 0."""
    long, head, n = r * m.number(3, 7), m.pick("hex", "hex", "round", "socket", "flat", "wing"), m.pick(8, 12, 16)
    shaft = [rod((0, 0, 0), (long, 0, 0), r, n)]
    if m.chance(0.3):
        shaft = [
            rod((0, 0, 0), (long, 0, 0), r, n),
            turned(lathe([(0, 0), (r, 0), (0, 1.5 * r)], n), (0, 1, 0), 90, (0, 0, 0)).apply_translation((long, 0, 0)),
        ]
    turns, begin = m.pick(0, 6, 10, 14), m.pick(0.1, 0.5)
    shaft += [ring((c * long, 0, 0), (1, 0, 0), r, 0.1 * r, n) for c in np.linspace(begin, 0.97, turns)] if turns else []
    top = {
        "hex": [rod((-1.3 * r, 0, 0), (0.05 * r, 0, 0), 2 * r, 6), rod((-1.4 * r, 0, 0), (-1.2 * r, 0, 0), 1.5 * r, n)],
        "round": [
            ball((0, 0, 0), (1.2 * r, 2 * r, 2 * r), n),
            box((-1.25 * r, -1.1 * r), (-1.0 * r, 1.0 * r), (-0.2 * r, 0.2 * r)),
        ],
        "socket": [rod((-2 * r, 0, 0), (0.05 * r, 0, 0), 1.6 * r, 2 * n), rod((-2.02 * r, 0, 0), (-1.9 * r, 0, 0), 0.8 * r, 6)],
        "flat": [
            turned(lathe([(0, 0), (2 * r, 0), (r, 1.2 * r), (0, 1.2 * r)], n), (0, 1, 0), 90, (0, 0, 0)).apply_translation(
                (-1.2 * r, 0, 0)
            )
        ],
        "wing": [ring((-2.2 * r, 0, 0), (0, 0, 1), 1.8 * r, 0.7 * r, n)],
    }[head]
    m.add(BASE, *shaft, *top)


def _lying_bolt(m: Model, r: float) -> list[Trimesh]:
    """Make a bolt along x that lies on the ground."""
    one = Model(m.rng)
    _bolt(one, r)
    low = min(s.bounds[0][2] for _, s in one.pieces)
    return [moved(s, (0, 0, -low)) for _, s in one.pieces]


def _nut(m: Model, r: float) -> None:
    """Make a lying nut or washer about the z axis from 0 upward."""
    how, n, high = (
        m.pick("hex", "hex", "square", "washer", "spring", "cap", "flange", "star"),
        m.pick(8, 12, 16),
        r * m.number(1.0, 1.8),
    )
    sides = {"hex": 6, "square": 4, "cap": 6, "flange": 6}.get(how, 2 * n)
    t, k = 2 * np.pi * np.arange(sides) / sides, 2 * np.pi * np.arange(n) / n
    out = 2 * r * np.c_[np.cos(t), np.sin(t)] * (1 - 0.15 * (np.arange(sides) % 2)[:, None] if how == "star" else 1)
    hole = [] if how == "cap" else [r * np.c_[np.cos(k), np.sin(k)]]
    if how == "spring":
        a = np.linspace(0.2, 2 * np.pi, 20)
        return m.add(BASE, tube(np.c_[1.6 * r * np.cos(a), 1.6 * r * np.sin(a), 0.35 * r + 0.06 * r * a], 0.4 * r, 4))
    m.add(BASE, prism(Polygon(out, hole), "z", (0, 0.25 * r if how in ("washer", "star") else high)))
    if how == "cap":
        m.add(BASE, ball((0, 0, high), (1.5 * r, 1.5 * r, 1.4 * r), n))
    if how == "flange":
        m.add(BASE, prism(Polygon(2.6 * r * np.c_[np.cos(k), np.sin(k)], hole), "z", (-0.0, 0.3 * r)))
    return None


def _standing(m: Model, count: int, r: float) -> None:
    """Make bolts that stand on their heads side by side with washers and nuts slipped over, or nuts in a heap."""
    n, long, turns = m.pick(12, 16, 24), r * m.number(4, 8), m.pick(0, 8, 12)
    k = 2 * np.pi * np.arange(n) / n
    hole, t = [1.02 * r * np.c_[np.cos(k), np.sin(k)]], np.pi * np.arange(6) / 3
    nut, washer = Polygon(1.9 * r * np.c_[np.cos(t), np.sin(t)], hole), Polygon(1.8 * r * np.c_[np.cos(k), np.sin(k)], hole)
    heap = m.chance(0.3)
    for j in range(3 if heap else count):
        at = vec(3.78 * r * j, 0, 0) if not heap or j < 2 else vec(1.89 * r, 0, 1.2 * r)
        pieces = [prism(nut, "z", (0, 1.21 * r))]
        if not heap:
            head = m.pick(
                rod((0, 0, -1.2 * r), (0, 0, 0.01 * r), 1.9 * r, 6), rod((0, 0, -1.2 * r), (0, 0, 0.01 * r), 1.9 * r, n)
            )
            pieces = [head, rod((0, 0, -0.5 * r), (0, 0, long), r, n)]
            pieces += [ring((0, 0, c * long), (0, 0, 1), r, 0.08 * r, n) for c in np.linspace(0.4, 0.97, turns)]
            over = [
                prism(washer, "z", (0, 0.25 * r)),
                prism(nut, "z", (0.24 * r, 1.5 * r)),
                prism(washer, "z", (1.49 * r, 1.8 * r)),
            ]
            pieces += over[: m.pick(0, 1, 2, 3)]
        m.add(BASE, *(moved(s, at) for s in pieces))
    if heap:
        m.add(BASE, moved(prism(washer, "z", (0, 0.3 * r)), (1.89 * r, 0, 2.4 * r)))
        m.add(BASE, *(moved(s, (0, -3.9 * r, 0)) for s in _lying_bolt(m, r)))
    if heap or m.chance(0.3):
        m.add(BASE, box((-4 * r, 3.78 * r * count + 4 * r), (-6 * r, 3 * r), (-1.6 * r, 0.01 * r if heap else -1.18 * r)))


def mechanical_nuts(m: Model) -> None:
    """Make bolts, nuts and washers lying in rows, scattered or in fields of a tray, or screwed in a plate; nothing moves."""
    how, r, cols, rows = (
        m.pick("rows", "scatter", "tray", "plate", "standing", "standing"),
        m.number(0.003, 0.008),
        m.pick(2, 3, 4, 5),
        m.pick(2, 3, 4),
    )
    if how == "standing":
        return _standing(m, cols, 4 * r)
    step = m.number(8.5, 10) * r
    x, y = (-step / 2, (cols - 0.5) * step), (-step / 2, (rows - 0.5) * step)
    m.add(BASE, m.pick(box(x, y, (-r, 0)), prism(rounded(x, y, 2 * r), "z", (-r, 0))))
    if how == "tray":
        m.add(BASE, prism(rectangle(x, y, 0.8 * r), "z", (-0.5 * r, 3 * r)))
        at = [step * (c - 0.5) for c in range(1, max(cols, rows))]
        m.add(BASE, *(box((c - 0.3 * r, c + 0.3 * r), shrunk(y, 0.5 * r), (-0.1 * r, 2.5 * r)) for c in at[: cols - 1]))
        m.add(BASE, *(box(shrunk(x, 0.5 * r), (c - 0.3 * r, c + 0.3 * r), (-0.1 * r, 2.4 * r)) for c in at[: rows - 1]))
    kinds = [m.chance(0.5) for _ in range(cols * rows)]
    for k, bolt in enumerate(kinds):
        a, b, turn = (k % cols) * step, (k // cols) * step, m.number(0, 360) if how == "scatter" else 0
        size = r * (m.number(0.6, 1.0) if how != "rows" else 1 - 0.5 * (k // cols) / rows)
        if how == "plate":
            make, place = (_bolt, ((a, b, 0.05 * r), 90)) if bolt else (_nut, ((a, b, 0), 0))
            repeat(m, partial(make, r=size), [place], (0, 1, 0))
        elif bolt and m.chance(0.85):
            lying = [moved(s, (-3 * size, 0, -0.02 * r)) for s in _lying_bolt(m, 0.7 * size)]
            m.add(BASE, *(moved(turned(s, (0, 0, 1), turn, (0, 0, 0)), (a, b, 0)) for s in lying))
        else:
            repeat(m, partial(_nut, r=size), [((a, b, -0.02 * r), turn)])
    if m.chance(0.4):
        middle = float(np.mean(x))
        m.add(BASE, box((middle - step, middle + step), (y[0] - 0.1 * step, y[0] + 0.1 * step), (-2 * r, 0.5 * r)))
    return None
