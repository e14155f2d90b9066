"""Confidence that says how often an answer is right: fitted to scores of what was left out of training, and measured."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from scipy.optimize import minimize

BINS = 10  # of the confidence, for the calibration error
COVERED = 0.8  # share of the answers, those of highest confidence, among which right ones are counted


@dataclass(frozen=True, eq=False)
class Scored:
    """Answers with their log-odds before calibration, whether they are right, and the data set of each."""

    odds: Float[np.ndarray, " n"]
    right: Bool[np.ndarray, " n"]
    group: Sequence[str]

    @property
    def weight(self) -> Float[np.ndarray, " n"]:
        """Every data set counts the same."""
        counts = Counter(self.group)
        return np.array([1 / counts[g] for g in self.group])


def fit_confidence(found: Scored) -> tuple[float, float]:
    """Return slope and offset of the log-odds that make them those of being right, by maximum likelihood."""

    def loss(w: np.ndarray) -> float:
        z = w[0] * found.odds + w[1]
        return float(np.average(np.logaddexp(0, z) - found.right * z, weights=found.weight))

    slope, offset = minimize(loss, [1.0, 0.0]).x
    return float(slope), float(offset)


def calibration_table(found: Scored, slope: float, offset: float) -> list[str]:
    """Return lines of a table: per data set, how far the confidence is from the share that is right, in bins of a tenth."""
    lines = [
        "| | answers | mean confidence | right | calibration error | right among the surest 80 % |",
        "|---|---|---|---|---|---|",
    ]
    confidence, group = 1 / (1 + np.exp(-slope * found.odds - offset)), np.array(found.group)
    for name in [*sorted(set(found.group)), ""]:
        mine = np.flatnonzero((group == name) | (name == ""))
        w, c, right = found.weight[mine], confidence[mine], found.right[mine]
        of = np.minimum((c * BINS).astype(int), BINS - 1)
        error = sum(abs(np.sum(w * (c - right) * (of == k))) for k in range(BINS)) / w.sum()
        order = np.argsort(-c, kind="stable")
        sure = order[: max(1, int((np.cumsum(w[order]) <= COVERED * w.sum() + 1e-9).sum()))]
        values = [np.average(c, weights=w), np.average(right, weights=w), error, np.average(right[sure], weights=w[sure])]
        lines.append(f"| {name or 'all, each set alike'} | {len(mine)} | {' | '.join(f'{v:.2f}' for v in values)} |")
    return lines


def log_odds(share: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
    """Return the log-odds of probabilities, those of 0 and 1 bounded."""
    share = np.clip(share, 1e-6, 1 - 1e-6)
    return np.log(share / (1 - share))
