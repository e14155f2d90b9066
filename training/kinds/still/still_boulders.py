"""Boulders, cairns and outcrops of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, moved, prism
from training.kinds.still.static import boulder
from training.kinds.still_cladding import maybe_one


def boulder_group(m: Model) -> None:
    """Make boulders in a group, a cairn, a ring, an outcrop, a stone arch or hoodoos; nothing moves."""
    how, r = m.pick("group", "cairn", "ring", "outcrop", "arch", "slabs"), m.number(0.2, 1.5)
    if how == "cairn":
        top = 0.0
        for k in range(m.pick(3, 4, 6)):
            s = r * (1 - 0.12 * k) * m.number(0.85, 1.1)
            one = boulder(m, (0, 0, 0), (s, 0.9 * s, m.number(0.35, 0.6) * s))
            m.add(BASE, moved(one, (m.number(-0.08, 0.08) * r, 0, top - one.bounds[0, 2] - 0.12 * s)))
            top = m.pieces[-1][1].bounds[1, 2]
    elif how in ("group", "ring"):
        count = m.pick(3, 5, 8, 12)
        turns = np.linspace(0, 2 * np.pi, count + 1)[:-1]
        for k, t in enumerate(turns):
            out = (0.0 if k == 0 else m.number(0.6, 1.3)) * r if how == "group" else 1.0 * r
            s = r * (1.0 if k == 0 and how == "group" else m.number(0.3, 0.7))
            s = s if how == "group" else 1.15 * np.pi * r / count * m.number(0.9, 1.2)
            m.add(
                BASE,
                boulder(m, (out * np.cos(t), out * np.sin(t), 0.4 * s), (s, s * m.number(0.7, 1.1), s * m.number(0.6, 1.1))),
            )
    elif how == "slabs":
        top = 0.0
        for k in range(m.pick(3, 5, 8)):
            slab = boulder(m, (0, 0, 0), (r * m.number(0.8, 1.2), r * m.number(0.6, 1.0), 0.2 * r))
            m.add(BASE, moved(slab, (0.1 * r * k, 0, top - slab.bounds[0, 2] - 0.06 * r)))
            top = m.pieces[-1][1].bounds[1, 2]
    else:
        turns = np.linspace(0, np.pi, m.pick(7, 9, 11)) if how == "arch" else np.linspace(0, 2.5, m.pick(5, 7))
        for t in turns:
            s = r * m.number(0.35, 0.5)
            at = (1.2 * r * np.cos(t), 0, 1.2 * r * np.sin(t)) if how == "arch" else (r * t, 0.2 * r * np.cos(5 * t), 0.5 * r)
            m.add(
                BASE,
                boulder(m, at, (1.2 * s, 1.1 * s, 1.3 * s) if how == "arch" else (0.6 * r, 0.5 * r, r * m.number(0.6, 1.6))),
            )
    low = min(s.bounds[0, 2] for _, s in m.pieces)
    if m.chance(0.5):
        points = np.concatenate([s.vertices for _, s in m.pieces])
        ground = Polygon(points[:, :2]).convex_hull.buffer(m.number(0.1, 0.5) * r, quad_segs=m.pick(1, 3))
        m.add(BASE, prism(ground, "z", (low - 0.05, low + 0.15 * r)))
    for t in m.rng.uniform(0, 2 * np.pi, m.pick(0, 0, 3, 6)) if len(m.pieces) > 4 else ():
        at = m.pieces[0][1].bounds.mean(0)
        half = 0.45 * np.ptp(m.pieces[0][1].bounds, axis=0)
        m.add(BASE, ball((at[0] + half[0] * np.cos(t), at[1] + half[1] * np.sin(t), at[2]), (0.12 * r,) * 3, 6))
    maybe_one(m, 0.15)
