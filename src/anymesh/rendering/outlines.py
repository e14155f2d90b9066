"""Lines of a drawing: outlines (steps in depth, and the background) and creases (steps in the normal)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32, Int, UInt8

from anymesh.geometry.raycast_ import SurfaceHits
from anymesh.rendering.smooth import CREASE_ANGLE

# [px] distance of a surface behind its neighbour's plane at which a line begins, and at which it has full strength
STEP = (0.6, 1.6)
FULL_CREASE = float(np.deg2rad(50))  # [rad] angle between faces at which a crease has full strength; it begins at CREASE_ANGLE


@dataclass(frozen=True, eq=False)
class Steps:
    """Pairs of neighbouring rays between which the surface changes.

    pairs: (m, 2) rows of the hits; outline, crease: (m,) strength of the line between them, 0..1.
    """

    pairs: Int[np.ndarray, "m 2"]
    outline: Float32[np.ndarray, " m"]
    crease: Float32[np.ndarray, " m"]


def changes(value: Int[np.ndarray, "H W"], row: Int[np.ndarray, "H W"]) -> Int[np.ndarray, "m 2"]:
    """Return the rows of horizontal and vertical neighbours with different values; pixels whose row is -1 are ignored."""
    neighbours = []
    for near, far in (((slice(None), slice(None, -1)), (slice(None), slice(1, None))), (slice(None, -1), slice(1, None))):
        at = np.flatnonzero(value[near] != value[far])
        pairs = np.stack([row[near].reshape(-1)[at], row[far].reshape(-1)[at]], 1)
        neighbours.append(pairs[(pairs >= 0).all(1)])
    return np.concatenate(neighbours)


def find_steps(
    hits: SurfaceHits,
    directions: Float32[np.ndarray, "n 3"],
    normal: Float32[np.ndarray, "n 3"],
    pairs: Int[np.ndarray, "m 2"],
    pixel: float,
) -> Steps:
    """Find the lines between neighbouring rays that hit different faces; pairs without a line are left out.

    directions: of the rays, which share one origin; normal: for shading; pixel: size of a pixel at depth 1.
    Two hits lie on one surface if either is near the other's tangent plane, even at grazing angles.
    """
    outline = (hits.face[pairs] < 0).any(1).astype(np.float32)
    crease = np.zeros(len(pairs), np.float32)
    inner = np.flatnonzero(outline == 0)
    p, q = pairs[inner].T
    offset = hits.depth[q, None] * directions[q] - hits.depth[p, None] * directions[p]
    apart = np.minimum(*(np.abs(np.einsum("ij,ij->i", offset, hits.normal[k])) for k in (p, q)))
    apart /= pixel * np.minimum(hits.depth[p], hits.depth[q])
    outline[inner] = np.clip((apart - STEP[0]) / (STEP[1] - STEP[0]), 0, 1)
    angle = np.arccos(np.clip(np.einsum("ij,ij->i", normal[p], normal[q]), -1, 1))
    crease[inner] = np.clip((angle - CREASE_ANGLE) / (FULL_CREASE - CREASE_ANGLE), 0, 1)
    lines = np.flatnonzero(np.maximum(outline, crease) > 0)
    return Steps(pairs[lines], outline[lines], crease[lines])


def stroke(
    shape: tuple[int, int], at: Int[np.ndarray, " n"], strength: UInt8[np.ndarray, " n"], width: int
) -> UInt8[np.ndarray, "H W"]:
    """Draw lines through pixels (flat indices), widened by `width` pixels on either side."""
    drawn = np.zeros(shape, np.uint8)
    order = np.argsort(strength, kind="stable")  # where lines meet, the strongest one counts
    drawn.reshape(-1)[at[order]] = strength[order]
    for _ in range(width):
        grown = drawn.copy()
        np.maximum(grown[1:], drawn[:-1], out=grown[1:])
        np.maximum(grown[:-1], drawn[1:], out=grown[:-1])
        np.maximum(grown[:, 1:], drawn[:, :-1], out=grown[:, 1:])
        np.maximum(grown[:, :-1], drawn[:, 1:], out=grown[:, :-1])
        drawn = grown
    return drawn
