"""Parents of parts."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from anymesh.geometry.triangle_set import TriangleSet

# a part depends on another part instead of the root if it is this many times closer to it, or touches it this much more
MIN_PARENT_GAIN = 3.0


def parents(shapes: list[TriangleSet], diagonal: float, answered: Sequence[set[int]] | None = None) -> list[int]:
    """Return the parent's index of every part (-1 for the root, 0).

    The parent is the root, unless the part clearly depends on a larger part.
    answered: the indices of possible parents of each part, which may be empty; the nearest touching one is used.
    """
    size = [float(np.linalg.norm(s.bounds[1] - s.bounds[0])) for s in shapes]
    reach = [0.01 * min(diagonal, 5 * s) for s in size]
    named = _answered_parents(shapes, answered, reach) if answered else {}
    rest = (named[i] if i in named else _touching(shapes, i, size, reach[i]) for i in range(1, len(shapes)))
    return _without_circles([-1, *rest])


def _touching(shapes: list[TriangleSet], i: int, size: Sequence[float], tolerance: float) -> int:
    """Return the larger part on which part i clearly depends, or the root if there is none.

    tolerance: of touching [m].
    """
    points = shapes[i].samples.points[::6]
    best, best_score = 0, 0.0
    base = shapes[0].tree.distance(points)
    touch_base = float((base < tolerance).mean())
    for j in range(1, len(shapes)):
        if j == i or size[j] < 1.15 * size[i] or not _boxes_near(shapes[i], shapes[j], tolerance):
            continue
        to = shapes[j].tree.distance(points)
        touch = float((to < tolerance).mean())
        nearer = base.min() > max(MIN_PARENT_GAIN * to.min(), 0.4 * tolerance) and to.min() < tolerance
        more = touch > MIN_PARENT_GAIN * touch_base + 0.01
        if (nearer or more) and touch > best_score:
            best, best_score = j, touch
    return best


def _answered_parents(shapes: list[TriangleSet], answered: Sequence[set[int]], reach: Sequence[float]) -> dict[int, int]:
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


def _boxes_near(a: TriangleSet, b: TriangleSet, reach: float) -> bool:
    """Return whether two shapes may have points within `reach` of each other [m]."""
    return bool((a.bounds[0] - reach <= b.bounds[1]).all() and (b.bounds[0] - reach <= a.bounds[1]).all())


def _nearest(points: np.ndarray, shapes: list[TriangleSet], among: set[int], reach: float) -> int | None:
    """Return the part nearest to these points, None if none is within reach [m]."""
    off = {j: float(shapes[j].tree.distance(points).min()) for j in sorted(among)}
    best = min(off, key=lambda j: off[j], default=None)
    return best if best is not None and off[best] < reach else None


def _without_circles(parent: list[int]) -> list[int]:
    for i in range(1, len(parent)):
        seen, at = {i}, parent[i]
        while at > 0:
            if at in seen:
                parent[i] = 0
                break
            seen.add(at)
            at = parent[at]
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
