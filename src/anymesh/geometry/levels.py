"""Surface beyond a level: its area and its extent, exact for flat faces.

Heights are those of the corners of faces along some direction [m].
"""

from __future__ import annotations

import numpy as np
from jaxtyping import Float


def shares_above(heights: Float[np.ndarray, "F 3"], level: float) -> Float[np.ndarray, " F"]:
    """Return the share of each face that is above a level."""
    low, middle, high = np.sort(heights, axis=1).T
    with np.errstate(divide="ignore", invalid="ignore"):
        below = (level - low) ** 2 / ((middle - low) * (high - low))  # a corner is below
        above = (high - level) ** 2 / ((high - low) * (high - middle))  # a corner is above
    return np.where(level < low, 1.0, np.where(level >= high, 0.0, np.where(level < middle, 1 - below, above)))


def points_above(
    triangles: Float[np.ndarray, "F 3 3"], heights: Float[np.ndarray, "F 3"], level: float
) -> Float[np.ndarray, "n 3"]:
    """Return the corners of the faces' parts above a level [m]."""
    start, end = heights, np.roll(heights, -1, axis=1)
    face, edge = np.nonzero((start > level) != (end > level))
    share = (level - start[face, edge]) / (end[face, edge] - start[face, edge])
    a, b = triangles[face, edge], triangles[face, (edge + 1) % 3]
    return np.concatenate([triangles[heights > level], a + share[:, None] * (b - a)])
