"""The loss of a choice: minus the log-probability of its right candidates, if each choice takes exactly one candidate."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from jaxtyping import Float, Int

MIN_CURVATURE = 1e-3  # of a candidate that is certain, so that steps stay finite
Derivatives = tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]


def choice_derivatives(
    counts: Int[np.ndarray, " c"], target: Float[np.ndarray, " n"], weight: Float[np.ndarray, " n"]
) -> Callable[[Float[np.ndarray, " n"]], Derivatives]:
    """Return a function from scores to the first derivatives of the loss and positive bounds of the second ones.

    counts: candidates of each choice, at least one, in the order of `target`; target: 1 right to 0 wrong; weight: of each
    candidate. A choice without a right candidate has no loss.
    """
    start = np.cumsum(counts) - counts

    def total(values: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
        return np.repeat(np.add.reduceat(values, start), counts)

    known = weight * (total(target) > 0)

    def derivatives(score: Float[np.ndarray, " n"]) -> Derivatives:
        likely = np.exp(score - np.repeat(np.maximum.reduceat(score, start), counts))
        share = likely / total(likely)
        right = target * share
        first = share - right / np.maximum(total(right), np.finfo(float).tiny)
        return known * first, known * 2 * np.maximum(share * (1 - share), MIN_CURVATURE)

    return derivatives
