"""Which predicted part is which true one."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int
from scipy.optimize import linear_sum_assignment


def part_ious(
    predicted: Int[np.ndarray, " F"], true: Int[np.ndarray, " F"], areas: Float[np.ndarray, " F"]
) -> Float[np.ndarray, "P T"]:
    """IoU by surface area of every predicted part (rows) with every true one (columns), the bases (0) included."""
    inside = np.zeros((int(predicted.max()) + 1, int(true.max()) + 1))
    np.add.at(inside, (predicted, true), areas)
    union = inside.sum(1, keepdims=True) + inside.sum(0, keepdims=True) - inside
    return np.divide(inside, union, out=np.zeros_like(inside), where=union > 0)


def match_parts(ious: Float[np.ndarray, "P T"]) -> list[tuple[int, int, float]]:
    """The pairing of movable parts (predicted, true, IoU) with the largest sum of IoUs (Hungarian); pairs without overlap
    are left out."""
    rows, columns = linear_sum_assignment(-ious[1:, 1:])
    return [
        (int(r) + 1, int(c) + 1, float(ious[r + 1, c + 1]))
        for r, c in zip(rows, columns, strict=True)
        if ious[r + 1, c + 1] > 0
    ]
