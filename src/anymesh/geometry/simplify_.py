"""Fewer triangles for the same surface, by fast-simplification (quadric error, MIT)."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.geometry.topology import weld


def simplify(triangles: Float[np.ndarray, "F 3 3"], most: int) -> Float[np.ndarray, "R 3 3"]:
    """The surface in about `most` triangles, wound as before; the input when it has no more, or would collapse."""
    if len(triangles) <= most:
        return triangles
    from fast_simplification import simplify as quadric

    corners = triangles.reshape(-1, 3)
    _, first, inverse = np.unique(weld(corners), return_index=True, return_inverse=True)
    center = corners.mean(0)  # float32 inside: near the origin it keeps its digits
    points, faces = quadric(
        np.ascontiguousarray(corners[first] - center, np.float32),
        np.ascontiguousarray(inverse.reshape(-1, 3), np.int32),
        target_count=most,
    )
    return points.astype(np.float64)[faces] + center if len(faces) else triangles
