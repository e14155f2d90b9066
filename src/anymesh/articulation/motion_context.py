"""Features that compare the score of a motion with the part's other motions and with the motions of its copies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

NONE = -9.0  # [log-odds] value if there is no such motion
SAME_AXIS = 0.97  # minimum cosine between axes with the same direction
# [log-odds] clipping range of the loss of a copy that moves in the same manner instead of in its best one
MIN_LOSS, MAX_LOSS = 0.0, 6.0
SAME_BALANCE = 0.2  # maximum difference of the feature "balance" of axes in a similar position: through the center, or at a rim
SIDE = -0.05  # minimum product of the cosines with the opening directions of two motions to the same side


@dataclass(frozen=True, eq=False)
class ScoredMotions:
    """Motions of one part after the first step.

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


def context_features(own: ScoredMotions, copies: Sequence[ScoredMotions]) -> dict[str, Float[np.ndarray, " n"]]:
    """Return features of all motions of a part.

    copies: the motions of parts of the same size in a row with it.
    """
    score, slides = own.score, own.values["prismatic"] > 0
    best = float(score.max())
    share = np.exp(score - best)
    lost = [_lost(own, copy) for copy in copies]
    count = len(score)
    return {
        "score": score,
        "lead": score - best,
        "share": share / share.sum(),
        "lead over the other kind": score - np.where(slides, _best(score, ~slides), _best(score, slides)),
        "loss of copies": np.mean(lost, axis=0) if lost else np.zeros(count),
        "copies": np.full(count, float(len(copies))),
        "best motion": np.full(count, best),
    }


def _best(score: Float[np.ndarray, " n"], mask: Bool[np.ndarray, " n"]) -> float:
    return float(score[mask].max(initial=NONE))


def _lost(own: ScoredMotions, copy: ScoredMotions) -> Float[np.ndarray, " n"]:
    """Return, for each motion, how much lower a copy scores with a motion in the same manner than with its best motion."""
    theirs = np.where(in_one_manner(own, copy), copy.score[None], -np.inf).max(1)
    return np.clip(copy.score.max() - theirs, MIN_LOSS, MAX_LOSS)


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
