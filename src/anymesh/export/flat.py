"""Volume for flat meshes and points, which engines refuse."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int

from anymesh.export.settings import ExportConfig

POINT = 1e-4  # [m] side of a link without any extent


def flat_normal(points: Float[np.ndarray, "n 3"], *, share: float) -> Float[np.ndarray, " 3"] | None:
    """Return the unit normal of points within `share` of their diagonal of a plane, None if they are not plane."""
    spread = points - points.mean(0)
    normal = np.linalg.eigh(spread.T @ spread)[1][:, 0]
    if float(np.ptp(spread @ normal)) > share * float(np.linalg.norm(np.ptp(points, axis=0))):
        return None
    return normal if normal[np.abs(normal).argmax()] > 0 else -normal


def small_box(
    triangles: Float[np.ndarray, "n 3 3"], config: ExportConfig
) -> tuple[Float[np.ndarray, "8 3"], Int[np.ndarray, "12 3"]]:
    """Return the bounding box of points without area, with sides of at least the wall thickness and POINT."""
    corners = triangles.reshape(-1, 3)
    side = max(config.wall(float(np.linalg.norm(np.ptp(corners, axis=0)))), POINT)
    center = (corners.min(0) + corners.max(0)) / 2
    half = np.maximum(np.ptp(corners, axis=0), side) / 2
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return center + signs * half, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
