"""Repeated parts in a row, such as the drawers of a chest or the sashes of a window.

They open to the same side in the same manner, so evidence for one of them is evidence for all.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float

from anymesh.config import SAME_AXIS_COSINE
from anymesh.geometry.boxes import same_box
from anymesh.geometry.triangle_set import TriangleSet, body_obb
from anymesh.motion.part_context import PartContext, best_direction

# maximum component of the offset along the opening direction, over its length, between parts in a row
MAX_ROW_OFFSET_RATIO = 0.25
SAME_BALANCE = 0.2  # maximum difference of the feature "balance" of axes in a similar position: through the center, or at a rim
MIN_SAME_SIDE_PRODUCT = -0.05  # minimum product of two directions or offsets to the same side; 0 is on no side


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


def share_opening_directions(contexts: Sequence[PartContext]) -> list[PartContext]:
    """Give repeated parts in a row a common opening direction: the one with the highest total visibility."""
    if len(contexts) == 1:
        return list(contexts)
    return [_with_row_direction(a, [a, *(b for b in contexts if b is not a and in_a_row(a, b))]) for a in contexts]


def in_a_row(a: PartContext, b: PartContext) -> bool:
    """Return whether b lies beside a with respect to the opening direction of one of them."""
    return _beside(a, b, a.opening_direction) or _beside(a, b, b.opening_direction)


def _beside(a: PartContext, b: PartContext, way: Float[np.ndarray, " 3"]) -> bool:
    offset = b.body_obb.center - a.body_obb.center
    return bool(abs(float(offset @ way)) < MAX_ROW_OFFSET_RATIO * np.linalg.norm(offset))


def _with_row_direction(context: PartContext, row: list[PartContext]) -> PartContext:
    ways, total = context.opening_directions
    beside = np.array([all(_beside(context, other, way) for other in row[1:]) for way in ways])
    if len(row) == 1 or not beside.any():
        return context
    for other in row[1:]:
        theirs, weights = other.opening_directions
        total = total + weights[(ways @ theirs.T).argmax(1)]
    off = np.mean([a.off_the_middle for a in row], axis=0)
    best = best_direction(np.where(beside, total / len(row), -np.inf), ways @ off)
    return context if (ways[best] == context.opening_direction).all() else replace(context, shared_opening_direction=ways[best])


@dataclass(frozen=True, eq=False)
class ScoredMotions:
    """Motions of one part.

    values: (n,) arrays of some features; axes: (n, 3) unit; score: (n,) log-odds.
    """

    values: dict[str, Float[np.ndarray, " n"]]
    axes: Float[np.ndarray, "n 3"]
    score: Float[np.ndarray, " n"]

    @classmethod
    def of(
        cls,
        names: Sequence[str],
        table: Float[np.ndarray, "n k"],
        axes: Float[np.ndarray, "n 3"],
        score: Float[np.ndarray, " n"],
    ) -> ScoredMotions:
        """Select the used features from the table of all features, whose columns have these names."""
        used = ("prismatic", "balance", "vertical", "outward", "above")
        return cls({name: np.asarray(table[:, list(names).index(name)], float) for name in used}, axes, score)


def mean_over_copies(own: ScoredMotions, copies: Sequence[ScoredMotions]) -> Float[np.ndarray, " n"]:
    """Return, for each motion of a part, the mean of its score and of the best scores of the copies in the same manner.

    A copy that cannot move in this manner, or hardly, counts as the worst motion of the part.
    """
    total = own.score.astype(float)
    for copy in copies:
        theirs = np.where(in_one_manner(own, copy), copy.score[None], -np.inf).max(1)
        total = total + np.maximum(theirs, own.score.min())
    return total / (1 + len(copies))


def in_one_manner(a: ScoredMotions, b: ScoredMotions) -> Bool[np.ndarray, "n m"]:
    """Return for each pair of motions whether copies may move so together.

    Doors hinged left or right may, flaps hinged above or below may not.
    """
    slides = a.values["prismatic"][:, None] > 0
    same = slides == (b.values["prismatic"][None] > 0)
    same &= np.abs(a.axes @ b.axes.T) > SAME_AXIS_COSINE
    same &= a.values["outward"][:, None] * b.values["outward"][None] >= MIN_SAME_SIDE_PRODUCT
    same &= slides | (np.abs(a.values["balance"][:, None] - b.values["balance"][None]) < SAME_BALANCE)
    upright = a.values["vertical"][:, None] > SAME_AXIS_COSINE
    level = a.values["above"][:, None] * b.values["above"][None] >= MIN_SAME_SIDE_PRODUCT
    return same & (slides | upright | level)
