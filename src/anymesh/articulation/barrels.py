"""Find components that may be the barrels of a hinge."""

from __future__ import annotations

import numpy as np

from anymesh.geometry.patches import ObjectShape
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.motion.part_context import MAX_PART_DIAGONALS

BARREL_REACH_RATIO = 0.015  # of the reference length of tolerances: a barrel is this near to the part and to its parent
MIN_BARREL_FACES, MAX_EXAMINED = 6, 60  # faces of a barrel; patches examined on each side
MAX_BARREL_LENGTH_RATIO, MAX_BARREL_RADIUS_RATIO = 1.1, 0.05  # of the part's diagonal
MIN_BARREL_SQUARENESS, MIN_BARREL_ASPECT = 0.7, 1.5  # smaller over larger side across; length over the larger side across


def find_barrel_candidates(whole: ObjectShape, part: TriangleSet, parent: TriangleSet) -> tuple[TriangleSet, ...]:
    """Find patches near both part and parent that are long, thin and small: possible hinge barrels."""
    diagonal = part.box.diagonal
    reach = BARREL_REACH_RATIO * min(whole.diagonal, MAX_PART_DIAGONALS * diagonal)
    label = whole.patch
    barrels = []
    for own, other in ((part, parent), (parent, part)):
        low, high = other.bounds[0] - reach, other.bounds[1] + reach
        center = own.triangles.mean(1)
        near = ((center > low) & (center < high)).all(1)
        candidates, count = np.unique(label[own.faces[near]], return_counts=True)
        for c in candidates[count >= MIN_BARREL_FACES][:MAX_EXAMINED]:
            mine = own.take(label[own.faces] == c)
            half_length, half_width, half_height = mine.box.half
            small = 2 * half_length <= MAX_BARREL_LENGTH_RATIO * diagonal and half_width <= MAX_BARREL_RADIUS_RATIO * diagonal
            if not small or half_height < MIN_BARREL_SQUARENESS * half_width or half_length < MIN_BARREL_ASPECT * half_width:
                continue
            if other.tree.distance(mine.samples.points[::10]).min() < reach:
                barrels.append(mine)
    return tuple(barrels)
