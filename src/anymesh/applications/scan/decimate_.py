"""Fewer faces for a fused surface, by fast-simplification (quadric error, MIT, in the core), with its topology kept clean."""

from __future__ import annotations

import numpy as np

from anymesh.applications.scan.cleaning import Surface, close_small, drop_bits
from anymesh.applications.scan.smoothing import edge_keys

ROUNDS = 6  # of taking off what touches folds, and closing the holes that this opens
ROUND_HOLE = 40.0  # [edges] of such holes


def decimate(surface: Surface, most: int) -> Surface:
    """The surface in about `most` faces, in one piece as it was: no edge of more than two faces, no folded faces.

    `geometry.simplify_` is not used: for pictures of shape it may tear a surface, and every tear is a part boundary later.
    """
    if len(surface.faces) > most:
        from fast_simplification import simplify

        center = surface.vertices.mean(0)  # float32 inside: near the origin it keeps its digits
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
    """Without all that touches a face of no area, two faces of the same corners, or an edge of three; how many faces went.

    What touches it goes as well: the hole is then a simple one, which a fan closes.
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
