"""Fewer triangles for the same surface, by fast-simplification (quadric error, MIT)."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.geometry.topology import weld
from anymesh.types.triangles import normals_and_areas

OFF = 0.1  # a triangle whose middle is further off the surface, as a share of its size, spans what is open


def simplify(triangles: Float[np.ndarray, "F 3 3"], most: int) -> Float[np.ndarray, "R 3 3"]:
    """The surface in about `most` triangles, wound as before; the input when it has no more, or would collapse."""
    if len(triangles) <= most:
        return triangles
    from fast_simplification import simplify as quadric

    corners = triangles.reshape(-1, 3)
    _, first, inverse = np.unique(weld(corners), return_index=True, return_inverse=True)
    center = corners.mean(0)  # float32 inside: near the origin it keeps its digits
    before, corner = corners[first] - center, inverse.reshape(-1, 3)
    points, faces = quadric(np.ascontiguousarray(before, np.float32), np.ascontiguousarray(corner, np.int32), target_count=most)
    found = points.astype(np.float64)[faces]
    if len(faces) and _has_border(corner):
        found = found[_on_surface(found, before, corner)]
    return found + center if len(found) else triangles


def _has_border(faces: Int[np.ndarray, "F 3"]) -> bool:
    ends = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), 1).astype(np.int64)
    return bool((np.unique(ends[:, 0] * (int(faces.max()) + 1) + ends[:, 1], return_counts=True)[1] == 1).any())


def _on_surface(found: np.ndarray, vertices: np.ndarray, faces: np.ndarray) -> Bool[np.ndarray, " R"]:
    """Which triangles lie on the surface. Quadrics know no border: in a plane, a triangle may close a notch or a frame."""
    size = np.sqrt(normals_and_areas(found)[1])
    return distance_to_mesh(found.mean(1), vertices, faces)[0] <= OFF * size
