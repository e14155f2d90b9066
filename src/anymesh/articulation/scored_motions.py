"""Scores of a part's motions, and their mean over the copies of the part, which move in the same manner."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

SAME_AXIS = 0.97  # minimum cosine between axes with the same direction
SAME_BALANCE = 0.2  # maximum difference of the feature "balance" of axes in a similar position: through the center, or at a rim
SIDE = -0.05  # minimum product of the cosines with the opening directions of two motions to the same side
MAX_LOSS = 3.0  # [log-odds] a copy that cannot move in a manner counts as this much below the worst motion of the part


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
    """Return, for each motion of a part, the mean of its score and of the best scores of the copies in the same manner."""
    least = own.score.min(initial=0.0) - MAX_LOSS
    total = own.score.astype(float)
    for copy in copies:
        theirs = np.where(in_one_manner(own, copy), copy.score[None], -np.inf).max(1, initial=-np.inf)
        total = total + np.maximum(theirs, least)
    return total / (1 + len(copies))


def in_one_manner(a: ScoredMotions, b: ScoredMotions) -> Bool[np.ndarray, "n m"]:
    """Return for each pair of motions whether copies may move so together.

    Doors hinged left or right may, flaps hinged above or below may not.
    """
    slides = a.values["prismatic"][:, None] > 0
    same = slides == (b.values["prismatic"][None] > 0)
    same &= np.abs(a.axes @ b.axes.T) > SAME_AXIS
    same &= a.values["outward"][:, None] * b.values["outward"][None] >= SIDE
    same &= slides | (np.abs(a.values["balance"][:, None] - b.values["balance"][None]) < SAME_BALANCE)
    upright = a.values["vertical"][:, None] > SAME_AXIS
    return same & (slides | upright | (a.values["above"][:, None] * b.values["above"][None] >= 0))
