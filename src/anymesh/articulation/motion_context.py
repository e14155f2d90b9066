"""How the score of a motion compares with those of the part's other motions, and of the motions of the part's copies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

NONE = -9.0  # log-odds where there is no such motion
SAME_AXIS = 0.97  # cosine of axes that are one
MIN_LOSS, MAX_LOSS = 0.0, 6.0  # log-odds between the best motion of a copy and its best motion in the same manner
SAME_BALANCE = 0.2  # difference of the feature "balance" below which axes lie alike: through the middle, or at a rim
SIDE = -0.05  # product of two cosines with the opening directions from which both motions go to the same side


@dataclass(frozen=True, eq=False)
class ScoredMotions:
    """The motions of one part after the first step. values: (n,) of some features; axes: (n, 3) unit; score: (n,) log-odds."""

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
        """From the table of all features, whose columns have these names."""
        used = ("prismatic", "balance", "vertical", "outward", "above")
        return cls({name: np.asarray(table[:, list(names).index(name)], float) for name in used}, axes, score)


def context_features(own: ScoredMotions, copies: Sequence[ScoredMotions]) -> dict[str, Float[np.ndarray, " n"]]:
    """Return features of all motions of a part. copies: the motions of parts of the same size in a row with it."""
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
    """Return, for each motion, how much worse a copy does that moves in the same manner than with its best motion."""
    theirs = np.where(in_one_manner(own, copy), copy.score[None], -np.inf).max(1)
    return np.clip(copy.score.max() - theirs, MIN_LOSS, MAX_LOSS)


def in_one_manner(a: ScoredMotions, b: ScoredMotions) -> Bool[np.ndarray, "n m"]:
    """Whether copies that move so look alike: doors hinged left or right do, flaps hinged above or below do not."""
    slides = a.values["prismatic"][:, None] > 0
    same = slides == (b.values["prismatic"][None] > 0)
    same &= np.abs(a.axes @ b.axes.T) > SAME_AXIS
    same &= a.values["outward"][:, None] * b.values["outward"][None] >= SIDE
    same &= slides | (np.abs(a.values["balance"][:, None] - b.values["balance"][None]) < SAME_BALANCE)
    upright = a.values["vertical"][:, None] > SAME_AXIS
    return same & (slides | upright | (a.values["above"][:, None] * b.values["above"][None] >= 0))
