"""Find components that may be the barrels of a hinge."""

from __future__ import annotations

import numpy as np

from anymesh.geometry.patches import ObjectShape
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.motion.part_context import MAX_PART_DIAGONALS


def find_barrel_candidates(whole: ObjectShape, part: TriangleSet, parent: TriangleSet) -> tuple[TriangleSet, ...]:
    """Find patches near both part and parent that are long, thin and small: possible hinge barrels."""
    diagonal = part.box.diagonal
    reach = 0.015 * min(whole.diagonal, MAX_PART_DIAGONALS * diagonal)
    label = whole.patch
    barrels = []
    for own, other in ((part, parent), (parent, part)):
        low, high = other.bounds[0] - reach, other.bounds[1] + reach
        center = own.triangles.mean(1)
        near = ((center > low) & (center < high)).all(1)
        candidates, count = np.unique(label[own.faces[near]], return_counts=True)
        for c in candidates[count >= 6][:60]:
            mine = own.take(label[own.faces] == c)
            half = mine.box.half
            if 2 * half[0] > 1.1 * diagonal or half[1] > 0.05 * diagonal or half[2] < 0.7 * half[1] or half[0] < 1.5 * half[1]:
                continue
            if other.tree.distance(mine.samples.points[::10]).min() < reach:
                barrels.append(mine)
    return tuple(barrels)
