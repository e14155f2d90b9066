"""Simplification of a fused surface by fast-simplification (quadric error, MIT, a core dependency), keeping it manifold."""

from __future__ import annotations

import numpy as np

from anymesh.applications.scan.cleaning import Surface, close_small, drop_bits
from anymesh.applications.scan.smoothing import edge_keys

ROUNDS = 6  # iterations of removing folded faces and closing the holes that result
ROUND_HOLE = 40.0  # [edges] perimeter of holes that are closed


def decimate(surface: Surface, most: int) -> Surface:
    """Simplify the surface to about `most` faces, without non-manifold edges and folded faces.

    `geometry.simplify_` is not used: it is meant for rendering and may tear a surface, and tears later become part boundaries.
    """
    if len(surface.faces) > most:
        from fast_simplification import simplify

        center = surface.vertices.mean(0)  # simplify computes in float32, which is most precise near the origin
        vertices, faces = simplify(
            (surface.vertices - center).astype(np.float32), surface.faces.astype(np.int32), target_count=most
        )
        surface = Surface(vertices.astype(np.float64) + center, faces.astype(np.int64))
    for _ in range(ROUNDS):
        surface, bad = _without_folds(surface)
        if not bad:
            break
        edge = float(np.sqrt(np.median(surface.areas)))
        surface = close_small(drop_bits(surface)[0], edge, ROUND_HOLE)[0]
    return drop_bits(surface)[0]


def _without_folds(surface: Surface) -> tuple[Surface, int]:
    """Remove degenerate, duplicate and non-manifold faces and all faces that touch them; return the number of removed faces.

    Faces that touch them are removed too, so that the hole is simple and can be closed with a fan.
    """
    faces = surface.faces
    flat = (faces == np.roll(faces, 1, axis=1)).any(1) | (surface.areas <= 0)
    _, inverse, count = np.unique(np.sort(faces, 1), axis=0, return_inverse=True, return_counts=True)
    twice = count[inverse.reshape(-1)] > 1
    key, owner = edge_keys(faces)
    crowded = np.zeros(len(faces), bool)
    _, where, sides = np.unique(key, return_inverse=True, return_counts=True)
    crowded[owner[sides[where.reshape(-1)] > 2]] = True
    bad = np.unique(faces[flat | twice | crowded])
    gone = np.any(np.isin(faces, bad), axis=1)
    return surface.keeping(~gone), int(gone.sum())
