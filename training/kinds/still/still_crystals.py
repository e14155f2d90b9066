"""Clusters of crystals of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
import trimesh
from trimesh import Trimesh

from training.kinds.buildings.still_buildings import stage
from training.kinds.clay import curve, skin
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, around, box, loft, moved, ring, rod, vec
from training.kinds.still.static import boulder
from training.kinds.still.still_plants import UP, out
from training.kinds.still_structures import finish


def _crystal(a: Point, way: Point, r: float, long: float, sides: int, tip: float, turn: float) -> Trimesh:
    """A pointed prism from a point along a way, its point off the middle."""
    t = 2 * np.pi * np.arange(sides) / sides + turn
    c, off = np.c_[np.cos(t), np.sin(t), 0 * t], 0.12 * r
    rings = [(0.75, 0, 0), (1.0, 1 - tip, 0), (0.08, 1, off)]
    solid = loft(np.array([r * a * c + (o, 0, long * u) for a, u, o in rings]))
    solid.apply_transform(trimesh.geometry.align_vectors([0, 0, 1], np.asarray(way, float)))
    return moved(solid, a)


def _ground(m: Model, form: str, r: float, long: float) -> None:
    """The shell of a geode, a wall of rock or a rock under crystals."""
    if form == "geode":
        t, lumps = np.linspace(0, 2 * np.pi, 14, endpoint=False), m.rng.uniform(0.92, 1.1, (4, 14, 1))
        shape = [(0.85, 0.0), (1.15, 0.0), (1.0, 0.7), (0.3, 0.95)]
        shell = np.array([np.c_[a * long * np.cos(t), 0 * t + b * long, a * long * np.sin(t)] for a, b in shape]) * (
            lumps * (1, 0, 1) + (0, 1, 0)
        )
        m.add(BASE, loft(shell, caps=False), rod((0, 0.3 * long, 0), (0, 0.4 * long, 0), 0.95 * long, 14))
        m.add(BASE, box((-0.6 * long, 0.6 * long), (0, 0.9 * long), (-1.2 * long, -0.85 * long)))
    elif form == "wall":
        m.add(BASE, boulder(m, (0, 0.35, 0.5 * long), (1.5 * long, 0.4, 0.85 * long)))
    elif form in ("rock", "field"):
        wide = (3.2 if form == "rock" else 11) * r
        m.add(
            BASE,
            boulder(m, (0, 0, -0.6 * r), (wide, wide, 1.6 * r)),
            rod((0, 0, -0.8 * r), (0, 0, 0.05 * r), 0.9 * wide, m.pick(6, 9, 14)),
        )
        m.add(
            BASE,
            *(
                boulder(m, 0.85 * wide * out(t), r * m.rng.uniform(0.5, 1.4, 3))
                for t in np.linspace(0, 6.28, m.pick(1, 5, 8))[:-1]
            ),
        )


def _single(m: Model, r: float, long: float, sides: int, tip: float) -> None:
    """One big crystal on a stand, perhaps in claws, with a ring and small ones about it."""
    m.add(
        BASE, _crystal((0, 0, 0.1), (0, 0, 1), 2 * r, long, sides, tip, 0), stage([(4 * r, 0), (3 * r, 0.12)], m.pick(4, 6, 16))
    )
    claws = around(
        skin(curve((0, -3 * r, 0.1), (0, -3.4 * r, 0.3 * long), (0, -1.7 * r, 0.45 * long)), np.linspace(0.4, 0.15, 6) * r, 6),
        m.pick(3, 4, 5),
    )
    m.add(
        BASE, *(claws if m.chance(0.6) else []), *[ring((0, 0, 0.1 + 0.25 * long), UP, 1.95 * r, 0.15 * r, 18)][: m.pick(0, 1)]
    )
    m.add(
        BASE,
        *(
            _crystal((1.9 * r * np.cos(t), 1.9 * r * np.sin(t), 0.1), out(t, 1.5), 0.6 * r, 0.3 * long, sides, tip, t)
            for t in np.linspace(0, 6.28, m.pick(1, 6))[:-1]
        ),
    )


def crystal_cluster(m: Model) -> None:
    """Crystals in a star, on a rock, in an open geode, along a floor or as one big one on a stand; nothing moves."""
    form, sides, tip = m.pick("star", "rock", "geode", "field", "single", "wall"), m.pick(4, 5, 6, 6, 8), m.number(0.12, 0.5)
    count, r, long = m.pick(5, 9, 16, 30), m.number(0.05, 0.12), m.number(0.4, 1.2)
    thin, spread = m.pick(1, 1, 0.6, 1.6), m.number(0.5, 1.5)
    if form == "single":
        _single(m, r, long, sides, tip)
        finish(m)
        return
    for k in range(count):
        turn, u = 2.4 * k, np.sqrt(k / count)
        size = thin * r * m.number(0.4, 1.2) * (1.3 - u)
        way, at = out(turn, 1.6 / (spread * u + 0.05)), (0.5 if form == "star" else 2) * r * u * out(turn)
        reach = long * m.number(0.5, 1.1) * (1.15 - 0.8 * u)
        if form == "geode":
            a, inner = m.number(0, 6.28), m.number(0, 0.75) * long
            at = vec(inner * np.cos(a), 0.32 * long, inner * np.sin(a))
            way, reach = vec(-0.5 * at[0], -1.2 * long, -0.5 * at[2]) + m.rng.normal(size=3) * 0.15, m.number(0.2, 0.4) * long
        elif form == "field":
            at, way, reach = 9 * r * u * out(turn), out(m.number(0, 6.28), m.number(1.5, 9)), long * m.number(0.2, 0.8)
        elif form == "wall":
            at, way = (
                vec(m.number(-0.8, 0.8) * long, 0.3, m.number(0.2, 0.8) * long),
                vec(m.number(-0.6, 0.6), -1, m.number(-0.2, 0.9)),
            )
            reach = 0.3 + 0.4 * reach
        m.add(BASE, _crystal(at, way / np.linalg.norm(way), size, reach, sides, tip, m.number(0, 1)))
    _ground(m, form, r, long)
    finish(m)
