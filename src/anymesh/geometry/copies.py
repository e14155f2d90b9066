"""What copies have in common: area and spread, turned or mirrored as they may be; equal boxes; a place in one row."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float

from anymesh.config import SAME_SIZE
from anymesh.geometry.boxes import OrientedBox

MAX_SIDE_DIFFERENCE_RATIO = 0.03  # maximum difference of the sides of copies, over the diagonal
MIN_COPY_COSINE = 0.99  # minimum cosine between the axes of copies
MAX_ROW_OFFSET_RATIO = 0.25  # of the offset between copies in a row: its maximum component along the way that they open


def same_spread(area: Float[np.ndarray, " n"], spread: Float[np.ndarray, "n 3"]) -> Bool[np.ndarray, "n n"]:
    """Return which surfaces have the same area and spread (as from `principal_spread`), in any rotation or mirrored."""
    size = np.log(np.maximum(area, 1e-300))
    same = np.abs(size[:, None] - size) < 2 * SAME_SIZE
    return same & (np.abs(spread[:, None] - spread).max(2) < SAME_SIZE * spread[:, None, 2])


def same_box(a: OrientedBox, b: OrientedBox) -> bool:
    """Return whether two boxes have equal sides along equal directions, as those of (mirrored) copies."""
    cosines = np.abs(a.axes @ b.axes.T)
    if cosines.max(1).min() < MIN_COPY_COSINE:
        return False
    return bool(np.abs(b.half[cosines.argmax(1)] - a.half).max() < MAX_SIDE_DIFFERENCE_RATIO * a.diagonal / 2)


def beside(offset: Float[np.ndarray, " 3"], way: Float[np.ndarray, " 3"]) -> bool:
    """Return whether what is at this offset lies beside a part that opens along `way` (unit), not before or behind it."""
    return bool(abs(float(offset @ way)) < MAX_ROW_OFFSET_RATIO * np.linalg.norm(offset))
