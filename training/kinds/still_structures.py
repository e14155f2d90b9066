"""Pieces of still structures: ladders, railings, roofs, and how an artist joins the pieces [m, Z up, front at -Y]."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, box, join, prism, rod, turned, vec
from training.kinds.still.still_plants import UP, out
from training.kinds.wheels import beam


def finish(m: Model) -> None:
    """Leave an object as it is, fused to one solid, or with the faces that look down deleted."""
    solids, how = [s for _, s in m.pieces], m.rng.random()
    if how < 0.12 and len(solids) < 60:
        whole = [s for s in solids if s.is_volume]
        m.pieces = [(BASE, s) for s in (join(*whole), *(s for s in solids if not s.is_volume))]
    elif how < 0.3:
        for s in solids:
            s.update_faces((s.face_normals[:, 2] > -0.99) | (len(s.faces) < 5))


def ladder(a: Point, b: Point, wide: float, n: int, r: float) -> list[Trimesh]:
    """Two rails and rungs that are fixed between two points."""
    start, way, side = np.asarray(a, float), np.asarray(b, float) - np.asarray(a, float), vec(wide / 2, 0, 0)
    rungs = [start + way * t for t in (np.arange(n) + 0.5) / n]
    return [beam(start + s * side, start + way + s * side, r, 2 * r) for s in (-1, 1)] + [
        rod(q - side, q + side, 0.6 * r, 6) for q in rungs
    ]


def railing(points: Sequence[Point], high: float, r: float, bars: int) -> list[Trimesh]:
    """Posts at points and bars between them."""
    p = [np.asarray(q, float) for q in points]
    posts = [rod(q, q + high * UP, r, 8) for q in p]
    levels = high * np.linspace(1, 0, bars, endpoint=False)
    return posts + [rod(a + z * UP, b + z * UP, 0.8 * r, 6) for a, b in pairwise(p) for z in levels]


def circle(r: float, z: float, n: int) -> list[Point]:
    """A closed ring of points at a height."""
    return [r * out(2 * np.pi * k / n) + z * UP for k in range(n + 1)]


def roof(m: Model, w: float, y: Span, z: float, rise: float) -> None:
    """A gabled roof over half a width: slabs, steps of shingles, corrugated sheets or thatch, perhaps with a ridge."""
    how, over, t = m.pick("slab", "steps", "waves", "thatch"), m.number(0.1, 0.35), m.number(0.04, 0.12)
    t = 0.25 if how == "thatch" else t
    y, low = (y[0] - over, y[1] + over), vec(w + over, 0, z - over * rise / w)
    for s in (-1, 1):
        foot = low * (s, 1, 1)
        m.add(BASE, prism([foot[::2], (0, z + rise), (0, z + rise + t), (foot[0], foot[2] + t)], "y", y))
        for u in np.linspace(0, 1, m.pick(6, 9), endpoint=False) if how == "steps" else ():
            at = foot + u * (vec(0, 0, z + rise) - foot) + t * UP
            m.add(BASE, turned(box((-0.15, 0.15), y, (-0.03, 0.04)), (0, 1, 0), s * 25, (0, 0, 0)).apply_translation(at))
        for b in np.linspace(*y, m.pick(8, 14)) if how == "waves" else ():
            m.add(BASE, rod(foot + vec(0, b, t), (0, b, z + rise + t), 0.05, 8))
    if m.chance(0.5):
        m.add(BASE, rod((0, y[0], z + rise + t), (0, y[1], z + rise + t), m.number(0.06, 0.14), m.pick(4, 6, 12)))
