"""Connecting area of two parts (paper, section 3.3)."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float


def connecting_area(
    gap_a: Float[np.ndarray, " n"], gap_b: Float[np.ndarray, " m"], threshold: float
) -> tuple[Bool[np.ndarray, " n"], Bool[np.ndarray, " m"], float]:
    """Return the points of each part closer than `threshold` [m] to the other (paper, 3.3).

    The threshold is doubled until there is at least one point.

    gap_a, gap_b: distance of the points of each part to the other [m].

    Return both masks and the threshold used.
    """
    if threshold <= 0:
        raise ValueError(f"the threshold of a connecting area must be positive, found {threshold}")
    if not (np.isfinite(gap_a).any() or np.isfinite(gap_b).any()):
        raise ValueError("a connecting area needs points of both parts, found none")
    while not ((gap_a < threshold).any() or (gap_b < threshold).any()):
        threshold *= 2
    return gap_a < threshold, gap_b < threshold, threshold
