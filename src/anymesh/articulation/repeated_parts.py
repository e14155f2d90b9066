"""Repeated parts in a row, such as the drawers of a chest or the sashes of a window.

They open to the same side in the same manner, so evidence for one of them is evidence for all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float

from anymesh.geometry.body_obb import body_obb
from anymesh.geometry.boxes import same_box
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.motion.part_context import PartContext

# maximum component of the offset along the opening direction, over its length, between parts in a row
MAX_ROW_OFFSET_RATIO = 0.25


def same_size(shapes: Sequence[TriangleSet], parent: Sequence[int]) -> list[list[int]]:
    """Group all parts but the root (0) by parent, side lengths and directions."""
    groups: list[list[int]] = []
    boxes = [body_obb(shape) for shape in shapes]
    for i in range(1, len(shapes)):
        group = next((g for g in groups if parent[g[0]] == parent[i] and same_box(boxes[g[0]], boxes[i])), None)
        if group is None:
            groups.append([i])
        else:
            group.append(i)
    return groups


def share_opening_directions(arounds: Sequence[PartContext]) -> list[PartContext]:
    """Give repeated parts in a row a common opening direction: the one with the highest total visibility."""
    if len(arounds) == 1:
        return list(arounds)
    return [_with_row_direction(a, [a, *(b for b in arounds if b is not a and in_a_row(a, b))]) for a in arounds]


def in_a_row(a: PartContext, b: PartContext) -> bool:
    """Return whether b lies beside a with respect to the opening direction of one of them."""
    return _beside(a, b, a.opening_direction) or _beside(a, b, b.opening_direction)


def _beside(a: PartContext, b: PartContext, way: Float[np.ndarray, " 3"]) -> bool:
    offset = b.body_obb.center - a.body_obb.center
    return bool(abs(float(offset @ way)) < MAX_ROW_OFFSET_RATIO * np.linalg.norm(offset))


def _with_row_direction(around: PartContext, row: list[PartContext]) -> PartContext:
    ways, total = around.opening_directions
    beside = np.array([all(_beside(around, other, way) for other in row[1:]) for way in ways])
    if len(row) == 1 or not beside.any():
        return around
    for other in row[1:]:
        theirs, weights = other.opening_directions
        total = total + weights[(ways @ theirs.T).argmax(1)]
    best = np.where(beside, total, -np.inf).argmax()
    return around if (ways[best] == around.opening_direction).all() else replace(around, shared_opening_direction=ways[best])
