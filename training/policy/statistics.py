"""Success rates over seeds: mean, confidence interval, and a paired test."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

CONFIDENCE = 0.95


@dataclass(frozen=True)
class Interval:
    """Mean with the bounds of its confidence interval."""

    mean: float
    low: float
    high: float

    def __str__(self) -> str:
        return f"{self.mean:.3f} ({self.low:.3f} to {self.high:.3f})"


def interval(values: Sequence[float], confidence: float = CONFIDENCE) -> Interval:
    """Return the mean and its t interval over independent trainings; without width for a single value."""
    data = np.asarray(values, float)
    mean = float(data.mean())
    if len(data) < 2:
        return Interval(mean, mean, mean)
    half = float(stats.t.ppf((1 + confidence) / 2, len(data) - 1) * data.std(ddof=1) / np.sqrt(len(data)))
    return Interval(mean, mean - half, mean + half)


def paired_p(first: Sequence[float], second: Sequence[float]) -> float:
    """Return the two-sided p of the paired t test between trainings with equal seeds; 1 if all are equal, NaN for one pair."""
    difference = np.asarray(second, float) - np.asarray(first, float)
    if len(difference) < 2:
        return float("nan")
    if np.ptp(difference) < 1e-12:
        return 1.0 if abs(difference[0]) < 1e-12 else 0.0
    return float(stats.ttest_rel(second, first).pvalue)
