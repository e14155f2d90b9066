"""The connecting area of two parts (paper, section 3.3)."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float
from scipy.spatial import KDTree


def connecting_area(
    points_a: Float[np.ndarray, "n 3"], points_b: Float[np.ndarray, "m 3"], threshold: float
) -> tuple[Bool[np.ndarray, " n"], Bool[np.ndarray, " m"], float]:
    """Points of each part closer than `threshold` [m] to the other; doubled until there is one (paper, 3.3).

    Returns both masks and the threshold that gave them.
    """
    if threshold <= 0:
        raise ValueError(f"the threshold of a connecting area must be positive, found {threshold}")
    near_a = KDTree(points_b).query(points_a, workers=-1)[0]
    near_b = KDTree(points_a).query(points_b, workers=-1)[0]
    while not ((near_a < threshold).any() or (near_b < threshold).any()):
        threshold *= 2
    return near_a < threshold, near_b < threshold, threshold
