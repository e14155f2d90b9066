"""Feature-preserving denoising of a fused surface: bilateral filtering of face normals, then vertex updates.

Zheng, Fu, Au and Tai 2011 (local, iterative scheme); vertices by Sun, Rosin, Martin and Langbein 2007.
"""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int

from anymesh.types.triangles import face_cross

NORMAL_ROUNDS, VERTEX_ROUNDS = 20, 12
SIGMA = 0.35  # difference of unit normals at which a neighbour has weight 0.6
STEP = 0.9  # share of a vertex update that is applied per iteration


def smooth(
    vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], most: float,
    rounds: tuple[int, int] = (NORMAL_ROUNDS, VERTEX_ROUNDS),
) -> Float[np.ndarray, "V 3"]:  # fmt: skip
    """Return the vertices of the denoised surface; border vertices are fixed. most: largest displacement of a vertex [m]."""
    pairs = neighbours(faces)
    cross = face_cross(vertices[faces])
    double = np.linalg.norm(cross, axis=1)
    normal = cross / np.maximum(double, 1e-30)[:, None]
    a, b = pairs.T
    for _ in range(rounds[0]):
        gap = np.einsum("ij,ij->i", normal[a] - normal[b], normal[a] - normal[b])
        weight = np.exp(-gap / (2 * SIGMA**2))
        summed = normal * double[:, None]
        for k in range(3):
            summed[:, k] += np.bincount(a, weight * double[b] * normal[b, k], len(faces))
            summed[:, k] += np.bincount(b, weight * double[a] * normal[a, k], len(faces))
        normal = summed / np.maximum(np.linalg.norm(summed, axis=1, keepdims=True), 1e-30)
    count = np.maximum(np.bincount(faces.reshape(-1), minlength=len(vertices)), 1)
    free = ~border_vertices(faces, len(vertices))
    moved = vertices.copy()
    for _ in range(rounds[1]):
        corners = moved[faces]
        toward = np.einsum("fk,fck->fc", normal, corners.mean(1, keepdims=True) - corners)
        step = np.stack(
            [np.bincount(faces.reshape(-1), (toward * normal[:, k, None]).reshape(-1), len(vertices)) for k in range(3)], 1
        )
        moved[free] += STEP * (step / count[:, None])[free]
    shift = moved - vertices
    length = np.linalg.norm(shift, axis=1, keepdims=True)
    return vertices + shift * np.minimum(1, most / np.maximum(length, 1e-30))


def neighbours(faces: Int[np.ndarray, "F 3"]) -> Int[np.ndarray, "m 2"]:
    """Return pairs of faces that share an edge, ignoring edges of more than two faces."""
    key, owner = edge_keys(faces)
    order = np.argsort(key, kind="stable")
    key, owner = key[order], owner[order]
    first = np.flatnonzero(np.r_[True, key[1:] != key[:-1]])
    two = first[np.diff(np.r_[first, len(key)]) == 2]
    return np.stack([owner[two], owner[two + 1]], 1)


def border_vertices(faces: Int[np.ndarray, "F 3"], count: int) -> np.ndarray:
    """Return whether each vertex lies on an edge of only one face."""
    key, _ = edge_keys(faces)
    unique, times = np.unique(key, return_counts=True)
    lone = unique[times == 1]
    on_border = np.zeros(count, bool)
    base = int(faces.max()) + 1
    on_border[lone // base] = on_border[lone % base] = True
    return on_border


def edge_keys(faces: Int[np.ndarray, "F 3"]) -> tuple[np.ndarray, np.ndarray]:
    """Return a key for each side of each face, equal for shared edges, and the face of each."""
    ends = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), 1).astype(np.int64)
    return ends[:, 0] * (int(faces.max()) + 1) + ends[:, 1], np.repeat(np.arange(len(faces)), 3)
