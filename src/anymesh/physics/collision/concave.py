"""Planes of faces at concave edges, along which a solid is divided into convex pieces."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.geometry.topology import edge_pairs
from anymesh.types.triangles import normals_and_areas

MIN_CONCAVE_ANGLE_DEG = 10.0  # [deg] minimum fold at an edge that counts as concave
DIGITS = 9  # of lengths that are compared; planes with equal ones keep the order of the faces
SAME_PLANE = (0.9999, 1e-5)  # cosine of the normals, and offset as a share of the diagonal


def concave_planes(triangles: Float[np.ndarray, "n 3 3"], most: int) -> list[tuple[np.ndarray, float]]:
    """Return the distinct planes (normal, offset) of faces that meet at concave edges, at most one more than `most`.

    They are ordered by the total length of these edges, longest first.
    """
    corners = triangles.reshape(-1, 3)
    pairs = edge_pairs(corners, np.arange(len(corners)).reshape(-1, 3))
    normals, middle = normals_and_areas(triangles)[0], triangles.mean(1)
    f, g = pairs.faces.T
    inward = np.einsum("ij,ij->i", middle[g] - middle[f], normals[f] - normals[g])
    folded = np.einsum("ij,ij->i", normals[f], normals[g]) < np.cos(np.deg2rad(MIN_CONCAVE_ANGLE_DEG))
    concave = np.flatnonzero((inward > 0) & folded)
    ends = corners[pairs.vertices[concave]]
    length = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    normal = np.concatenate([normals[f[concave]], normals[g[concave]]])
    offset = np.einsum("ij,ij->i", normal, np.tile(ends[:, 0], (2, 1)))
    return _distinct(normal, offset, np.tile(length, 2), float(np.linalg.norm(np.ptp(corners, axis=0))), most)


def _distinct(
    normal: np.ndarray, offset: np.ndarray, weight: np.ndarray, size: float, most: int
) -> list[tuple[np.ndarray, float]]:
    """Return planes without near-duplicates, at most one more than `most`.

    They are ordered by the sum of the weights of each and its duplicates.
    """
    weight = np.round(weight / max(float(weight.sum()), 1e-300), DIGITS)
    left = np.argsort(-weight, kind="stable")
    planes: list[tuple[float, np.ndarray, float]] = []
    while len(left) and len(planes) <= most:
        n, o = normal[left[0]], float(offset[left[0]])
        along = normal[left] @ n
        same = (np.abs(along) > SAME_PLANE[0]) & (np.abs(offset[left] * np.sign(along) - o) < SAME_PLANE[1] * size)
        same[0] = True
        planes.append((float(weight[left[same]].sum()), n, o))
        left = left[~same]
    return [(n, o) for _, n, o in sorted(planes, key=lambda plane: -round(plane[0], DIGITS))]
