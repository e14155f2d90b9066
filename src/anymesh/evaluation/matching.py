"""Matching of predicted and true parts."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int
from scipy.optimize import linear_sum_assignment


def part_ious(
    predicted: Int[np.ndarray, " F"], true: Int[np.ndarray, " F"], areas: Float[np.ndarray, " F"]
) -> Float[np.ndarray, "P T"]:
    """Compute the IoU by surface area of predicted (rows) and true parts (columns), including the bases (0)."""
    inside = np.zeros((int(predicted.max()) + 1, int(true.max()) + 1))
    np.add.at(inside, (predicted, true), areas)
    union = inside.sum(1, keepdims=True) + inside.sum(0, keepdims=True) - inside
    return np.divide(inside, union, out=np.zeros_like(inside), where=union > 0)


def match_parts(ious: Float[np.ndarray, "P T"]) -> list[tuple[int, int, float]]:
    """Match movable parts (predicted, true, IoU) to maximize the sum of IoUs (Hungarian); omit pairs without overlap."""
    rows, columns = linear_sum_assignment(-ious[1:, 1:])
    return [
        (int(r) + 1, int(c) + 1, float(ious[r + 1, c + 1]))
        for r, c in zip(rows, columns, strict=True)
        if ious[r + 1, c + 1] > 0
    ]
