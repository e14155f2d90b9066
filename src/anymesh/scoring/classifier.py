"""Learned scores of candidates: boosted trees on named features, in one step or in two."""

from __future__ import annotations

import json
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.scoring.boosted_trees import BoostedTrees

REASONS = 3  # number of features named in a reason
MIN_CONFIDENCE, MAX_CONFIDENCE = 0.05, 0.99  # range of confidences
MISSING = -9.0  # value of a feature that does not apply to a candidate
STEPS = ("first", "second")  # names of the steps in a file


@dataclass(frozen=True, eq=False)
class Classifier:
    """Classifier of candidates.

    steps: trees on the candidate's own features, then, if there are two, on these and on its context, which is computed from
    the first scores of other candidates; names: features in the order of columns; manifest: training data and settings.
    """

    steps: tuple[BoostedTrees, ...]
    names: tuple[str, ...]
    manifest: dict[str, Any]

    @classmethod
    def read(cls, package: str, file: str) -> Classifier:
        """Read an .npz file of a package."""
        with (files(package) / file).open("rb") as opened:
            arrays = dict(np.load(opened))
        manifest = json.loads(bytes(arrays["manifest"]).decode())
        steps = tuple(BoostedTrees.from_arrays(name, arrays) for name in STEPS if f"{name}.root" in arrays)
        return cls(steps, tuple(manifest["features"]), manifest)

    def table(self, features: list[dict[str, float]]) -> Float[np.ndarray, "n k"]:
        """Return the features of all candidates in the order of columns."""
        return np.array([[row[name] for name in self.names] for row in features]).reshape(-1, len(self.names))

    def score(
        self, own: Float[np.ndarray, "n k"], context: dict[str, Float[np.ndarray, " n"]] | None = None
    ) -> Float[np.ndarray, " n"]:
        """Return the log-odds of each candidate: by the first step, or with a context by the second."""
        return self.steps[0].score(own) if context is None else self.steps[1].score(_joined(own, context))

    def reasons(self, own: Float[np.ndarray, "n k"], context: dict[str, Float[np.ndarray, " n"]] | None = None) -> list[str]:
        """Return the names of the features that raised each score the most."""
        trees, table = (self.steps[0], own) if context is None else (self.steps[1], _joined(own, context))
        gain = trees.contributions(table)[:, : len(self.names)]
        return [self._reason(row, g) for row, g in zip(own, gain, strict=True)]

    def _reason(self, row: Float[np.ndarray, " k"], gain: Float[np.ndarray, " k"]) -> str:
        best = [int(k) for k in np.argsort(-gain, kind="stable") if gain[k] > 0 and row[k] != MISSING][:REASONS]
        return ", ".join(f"{self.names[k]} {row[k] + 0.0:.2g}" for k in best) or "no feature of its own"


def _joined(own: Float[np.ndarray, "n k"], context: dict[str, Float[np.ndarray, " n"]]) -> Float[np.ndarray, "n c"]:
    return np.concatenate([own, np.stack(list(context.values()), 1)], 1)


def confidence_of(log_odds: float, slope: float, offset: float) -> float:
    """Return the probability that a choice with these log-odds is right.

    slope, offset: calibration, fitted to held-out data.
    """
    return float(np.clip(1 / (1 + np.exp(-slope * log_odds - offset)), MIN_CONFIDENCE, MAX_CONFIDENCE))
