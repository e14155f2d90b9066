"""How many parts a choice of candidates finds."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Int
from scipy.optimize import linear_sum_assignment

from anymesh.segmentation.part_candidates import Overlap
from training.part_rows import PartRows

RIGHT = 0.5  # IoU from which a part is found


@dataclass(frozen=True)
class Counts:
    """Parts that are right, true and found."""

    right: int = 0
    true: int = 0
    found: int = 0

    def __add__(self, other: Counts) -> Counts:
        return Counts(self.right + other.right, self.true + other.true, self.found + other.found)

    @property
    def precision(self) -> float:
        return self.right / max(self.found, 1)

    @property
    def recall(self) -> float:
        return self.right / max(self.true, 1)

    @property
    def f1(self) -> float:
        return 2 * self.right / max(self.true + self.found, 1)


def overlap_of(rows: PartRows) -> Overlap:
    """Return what the candidates of an object have in common."""
    shared = (rows.members * rows.area.sum(1)) @ rows.members.T.astype(float)
    return Overlap(rows.spread.astype(float), shared)


def owners(rows: PartRows, chosen: list[int]) -> Int[np.ndarray, " P"]:
    """Return the number of the part that has each patch, from 1 by falling size, 0 for none; smaller candidates win."""
    size = rows.members @ rows.area.sum(1)
    owner = np.zeros(len(rows.area), int)
    for number, k in enumerate(sorted(chosen, key=lambda k: (-size[k], k)), start=1):
        owner[rows.members[k]] = number
    return owner


def scored(rows: PartRows, chosen: list[int]) -> Counts:
    """Match the chosen candidates, each without what smaller ones take, with the true parts (Hungarian, by IoU)."""
    owner = owners(rows, chosen)
    both = np.array([rows.area[owner == k].sum(0) for k in range(len(chosen) + 1)]).reshape(len(chosen) + 1, -1)
    iou = both / np.maximum(both.sum(1, keepdims=True) + rows.area.sum(0) - both, 1e-300)
    mine = iou[1:, list(rows.moving)]
    right = int((mine[linear_sum_assignment(-mine)] > RIGHT).sum()) if mine.size else 0
    return Counts(right, len(rows.moving), len(chosen))
