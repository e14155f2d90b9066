"""Parts that are copies of each other in a row: drawers of a chest, the leaves of a window. They open to the same side and in
the same manner, so what one of them hides another may show."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float

from anymesh.geometry.boxes import same_box
from anymesh.geometry.shape import FaceSet
from anymesh.geometry.surroundings import PartContext, body_obb

MAX_ROW_OFFSET_RATIO = 0.25  # of the way from one to the other: a row goes across its way out, but for this share


def same_size(shapes: Sequence[FaceSet], parent: Sequence[int]) -> list[list[int]]:
    """The numbers of all parts but the root (0), those together that have the same parent, sides and directions."""
    groups: list[list[int]] = []
    boxes = [body_obb(shape) for shape in shapes]
    for i in range(1, len(shapes)):
        found = next((g for g in groups if parent[g[0]] == parent[i] and same_box(boxes[g[0]], boxes[i])), None)
        if found is None:
            groups.append([i])
        else:
            found.append(i)
    return groups


def share_opening_directions(arounds: Sequence[PartContext]) -> list[PartContext]:
    """Copies that lie in a row open to the same side of it: the one that is most open over all of them."""
    if len(arounds) == 1:
        return list(arounds)
    return [_with_row_direction(a, [a, *(b for b in arounds if b is not a and in_a_row(a, b))]) for a in arounds]


def in_a_row(a: PartContext, b: PartContext) -> bool:
    """Whether b lies beside a, as one of them at least opens."""
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
        theirs, worth = other.opening_directions
        total = total + worth[(ways @ theirs.T).argmax(1)]
    best = np.where(beside, total, -np.inf).argmax()
    return around if (ways[best] == around.opening_direction).all() else replace(around, shared_opening_direction=ways[best])
