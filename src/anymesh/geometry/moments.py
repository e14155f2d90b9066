"""Moments of a surface: its area, first and second moments, which add up over its pieces."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.types.triangles import normals_and_areas


def surface_moments(triangles: Float[np.ndarray, "F 3 3"]) -> Float[np.ndarray, "4 4"]:
    """Return the integral of p p^T over the surface for homogeneous points p = (x, y, z, 1); its last entry is the area."""
    corners = np.concatenate([triangles, np.ones((*triangles.shape[:2], 1))], axis=2)
    total = corners.sum(1)
    weight = normals_and_areas(triangles)[1] / 12
    return np.einsum("f,fki,fkj->ij", weight, corners, corners) + np.einsum("f,fi,fj->ij", weight, total, total)


def principal_spread(moments: Float[np.ndarray, "n 4 4"]) -> Float[np.ndarray, "n 3"]:
    """Return the standard deviations of surfaces along their principal axes, the largest last, in any rotation."""
    mean = moments / np.maximum(moments[:, 3:, 3:], 1e-300)
    return np.sqrt(np.maximum(np.linalg.eigvalsh(mean[:, :3, :3] - mean[:, :3, 3:] * mean[:, 3:, :3]), 0))
