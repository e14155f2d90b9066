"""Pieces of still structures: ladders, railings, roofs, and how an artist joins the pieces [m, Z up, front at -Y]."""

from __future__ import annotations

from training.kinds.model import BASE, Model
from training.kinds.solids import join


def finish(m: Model) -> None:
    """Leave an object as it is, fused to one solid, or with the faces that look down deleted."""
    solids, how = [s for _, s in m.pieces], m.rng.random()
    if how < 0.12 and len(solids) < 60:
        whole = [s for s in solids if s.is_volume]
        m.pieces = [(BASE, s) for s in (join(*whole), *(s for s in solids if not s.is_volume))]
    elif how < 0.3:
        for s in solids:
            s.update_faces((s.face_normals[:, 2] > -0.99) | (len(s.faces) < 5))
