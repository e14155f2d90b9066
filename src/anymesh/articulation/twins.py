"""Parts that are copies of each other in a row: drawers of a chest, the leaves of a window. They open to the same side and in
the same manner, so what one of them hides another may show."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float

from anymesh.geometry.boxes import alike
from anymesh.geometry.shape import Shape
from anymesh.geometry.surroundings import Surroundings, core_box

LEVEL = 0.25  # of the way from one to the other: a row goes across its way out, but for this share


def same_size(shapes: Sequence[Shape], parent: Sequence[int]) -> list[list[int]]:
    """The numbers of all parts but the root (0), those together that have the same parent, sides and directions."""
    groups: list[list[int]] = []
    boxes = [core_box(shape) for shape in shapes]
    for i in range(1, len(shapes)):
        found = next((g for g in groups if parent[g[0]] == parent[i] and alike(boxes[g[0]], boxes[i])), None)
        if found is None:
            groups.append([i])
        else:
            found.append(i)
    return groups


def agree(arounds: Sequence[Surroundings]) -> list[Surroundings]:
    """Copies that lie in a row open to the same side of it: the one that is most open over all of them."""
    if len(arounds) == 1:
        return list(arounds)
    return [_agreed(a, [a, *(b for b in arounds if b is not a and in_a_row(a, b))]) for a in arounds]


def in_a_row(a: Surroundings, b: Surroundings) -> bool:
    """Whether b lies beside a, as one of them at least opens."""
    return _beside(a, b, a.outward) or _beside(a, b, b.outward)


def _beside(a: Surroundings, b: Surroundings, way: Float[np.ndarray, " 3"]) -> bool:
    offset = b.core.center - a.core.center
    return bool(abs(float(offset @ way)) < LEVEL * np.linalg.norm(offset))


def _agreed(around: Surroundings, row: list[Surroundings]) -> Surroundings:
    ways, total = around.ways_out
    beside = np.array([all(_beside(around, other, way) for other in row[1:]) for way in ways])
    if len(row) == 1 or not beside.any():
        return around
    for other in row[1:]:
        theirs, worth = other.ways_out
        total = total + worth[(ways @ theirs.T).argmax(1)]
    best = np.where(beside, total, -np.inf).argmax()
    return around if (ways[best] == around.outward).all() else replace(around, agreed=ways[best])
