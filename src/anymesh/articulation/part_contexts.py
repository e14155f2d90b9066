"""The contexts of parts, from the part of each face and the parents of the parts."""

from __future__ import annotations

import numpy as np
from jaxtyping import Int

from anymesh.articulation.barrels import find_barrel_candidates
from anymesh.articulation.tree import descendants, parents
from anymesh.config import ArticulationConfig
from anymesh.geometry.patches import ObjectShape
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.motion.part_context import PartContext


def part_context(
    whole: ObjectShape,
    label: Int[np.ndarray, " F"],
    shapes: list[TriangleSet],
    parent: list[int],
    i: int,
    config: ArticulationConfig,
) -> PartContext:
    """Build the context of part i with its descendants; the root and its ancestors are static."""
    carried = [i, *descendants(parent, i)]
    ancestors, at = [0], parent[i]
    while at > 0:
        ancestors.append(at)
        at = parent[at]
    static = np.isin(label, ancestors)
    moving = np.isin(label, carried)
    others = ~static & ~moving
    return PartContext(
        part=whole.of(np.flatnonzero(moving)),
        parent=shapes[parent[i]],
        rest=whole.of(np.flatnonzero(static)),
        other_surface=whole.of(np.flatnonzero(others)) if others.any() else None,
        without_part=whole.of(np.flatnonzero(~moving)),
        barrel_candidates=find_barrel_candidates(whole, shapes[i], shapes[parent[i]]),
        diagonal=whole.diagonal,
        center=whole.shape.bounds.mean(0),
        config=config,
        other_parts=tuple(shapes[k] for k in range(1, len(shapes)) if k not in carried and k not in ancestors),
        link=shapes[i] if len(carried) > 1 else None,
    )


def context_by_gaps(whole: ObjectShape, label: Int[np.ndarray, " F"], part: int, config: ArticulationConfig) -> PartContext:
    """Build the context of a part where parents are not known yet. label: part index of each face; not all need to occur."""
    numbers, rank = np.unique(label, return_inverse=True)
    shapes = [whole.of(np.flatnonzero(label == k)) for k in numbers]
    number = int(np.searchsorted(numbers, part))
    return part_context(whole, rank, shapes, parents(shapes, whole.diagonal), number, config)
