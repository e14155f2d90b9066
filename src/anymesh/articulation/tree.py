"""Parents of parts."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np
from jaxtyping import Float
from scipy.sparse.csgraph import breadth_first_order, minimum_spanning_tree

from anymesh.geometry.triangle_set import TriangleSet
from anymesh.motion.part_context import MAX_PART_DIAGONALS, MIN_SCALE_RATIO

TOUCHING_RATIO = 0.01  # of the diagonal, or of MAX_PART_DIAGONALS of the part: a part touches another within this distance
MAX_EXACT_GAP = 5.0  # of these distances: the gap of parts that are farther apart is that of their boxes
MIN_CONTACT_SHARE = 0.03  # of the area of the smaller part: smaller contacts hardly differ from none
ROOT_GAIN = 5.0  # contact with the root counts as much as a contact with another part that is this many times larger


def parents(shapes: list[TriangleSet], diagonal: float, answered: Sequence[set[int]] | None = None) -> list[int]:
    """Return the parent's index of every part (-1 for the root, 0).

    The parts form a tree with large contacts and small gaps: the minimum spanning tree of `_separations`.
    answered: the indices of possible parents of each part, which may be empty; the nearest touching one is used.
    """
    size = np.array([np.linalg.norm(np.ptp(s.bounds, axis=0)) for s in shapes])
    reach = TOUCHING_RATIO * np.maximum(np.minimum(diagonal, MAX_PART_DIAGONALS * size), MIN_SCALE_RATIO * diagonal)
    named = _answered_parents(shapes, answered, reach) if answered else {}
    _, over = breadth_first_order(minimum_spanning_tree(_separations(shapes, reach)), 0, directed=False)
    parent = [-1, *(named.get(i, int(over[i])) for i in range(1, len(shapes)))]
    return _without_cycles(parent, named)


def _separations(shapes: Sequence[TriangleSet], reach: Float[np.ndarray, " p"]) -> Float[np.ndarray, "p p"]:
    """Return how little each two parts belong together: it grows with their gap, and falls with their contact.

    reach: distance within which each part touches another [m]. All values but the diagonal are positive.
    """
    low, high = np.array([s.bounds for s in shapes]).transpose(1, 0, 2)
    between = np.maximum(low[:, None] - high, low - high[:, None])
    gap = np.linalg.norm(np.maximum(between, 0), axis=2)  # of the boxes; of the surfaces where it is small
    touching = np.zeros_like(gap)
    for i, j in np.argwhere(gap <= MAX_EXACT_GAP * np.maximum(reach, reach[:, None])):
        if i != j:
            distance = shapes[j].tree.distance(shapes[i].samples.points[::6])
            gap[i, j] = distance.min()
            touching[i, j] = shapes[i].area * (distance < reach[i]).mean()
    area = np.array([s.area for s in shapes])
    share = np.maximum(touching, touching.T) / np.maximum(np.minimum(area, area[:, None]), np.finfo(float).tiny)
    ratio = np.minimum(gap, gap.T) / np.minimum(reach, reach[:, None])
    separation = np.log1p(ratio) - np.log(MIN_CONTACT_SHARE + np.minimum(share, 1)) + np.log(2 * ROOT_GAIN)
    separation[0] -= np.log(ROOT_GAIN)
    separation[:, 0] -= np.log(ROOT_GAIN)
    return separation * ~np.eye(len(shapes), dtype=bool)


def _answered_parents(
    shapes: list[TriangleSet], answered: Sequence[set[int]], reach: Float[np.ndarray, " p"]
) -> dict[int, int]:
    """Return the answered parents that touch their part, by part.

    Parts that name each other, such as the arms of a lamp, form a chain. Those that touch a part outside of it come first, then
    those that touch them. All other parts take the nearest part that they name.
    """
    parent: dict[int, int] = {}
    placed = {j for j in range(len(shapes)) if j == 0 or not answered[j]}
    while True:
        ready = {}
        for i in sorted(set(range(len(shapes))) - placed):
            chain = {j for j in answered[i] if i in answered[j]}
            if chain or answered[i] <= placed:
                nearest = _nearest(shapes[i].samples.points[::6], shapes, (answered[i] - {i}) & placed, reach[i])
                if nearest is not None or not chain:
                    ready[i] = nearest
        if not ready:
            return parent
        parent |= {i: j for i, j in ready.items() if j is not None}
        placed |= ready.keys()


def _nearest(points: np.ndarray, shapes: list[TriangleSet], among: set[int], reach: float) -> int | None:
    """Return the part nearest to these points, None if none is within reach [m]."""
    off = {j: float(shapes[j].tree.distance(points).min()) for j in sorted(among)}
    best = min(off, key=lambda j: off[j], default=None)
    return best if best is not None and off[best] < reach else None


def _without_cycles(parent: list[int], answered: Collection[int]) -> list[int]:
    """Return the parents with the root as parent of one part of each circle, which is not an answered one."""
    for i in sorted(range(1, len(parent)), key=lambda i: i in answered):
        seen, at = set(), parent[i]
        while at > 0 and at != i and at not in seen:
            seen.add(at)
            at = parent[at]
        if at == i:
            parent[i] = 0
    return parent


def descendants(parent: list[int], i: int) -> list[int]:
    """Return all descendants of part i."""
    parts: list[int] = []
    for j in range(len(parent)):
        at = parent[j]
        while at > 0 and at != i:
            at = parent[at]
        if at == i and j != i:
            parts.append(j)
    return parts
