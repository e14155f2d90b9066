"""The learned score of candidate parts: boosted trees on named features, in two steps (`benchmarks/train_parts.py`)."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.reasoning.boosted_trees import BoostedTrees
from anymesh.segmentation.part_context import context_features
from anymesh.segmentation.part_tree import Overlap

WEIGHTS = "part_classifier.npz"


@dataclass(frozen=True, eq=False)
class PartClassifier:
    """first: scores a candidate by its own features; second: by these and by the first scores of the others.

    names: of the features, in the order of columns; those of the context follow. manifest: what it was trained on.
    """

    first: BoostedTrees
    second: BoostedTrees
    names: tuple[str, ...]
    manifest: dict[str, Any]

    def score(self, overlap: Overlap, features: list[dict[str, float]]) -> tuple[Float[np.ndarray, " n"], list[str]]:
        """Return the log-odds that each candidate is a part, and the features that raised each the most, in words."""
        if not features:
            return np.zeros(0), []
        own = np.array([[row[name] for name in self.names] for row in features])
        context = context_features(overlap, self.first.score(own))
        table = np.concatenate([own, np.stack(list(context.values()), 1)], 1)
        gain = self.second.contributions(table)[:, : len(self.names)]
        return self.second.score(table), [self._reason(row, g) for row, g in zip(own, gain, strict=True)]

    def _reason(self, row: Float[np.ndarray, " k"], gain: Float[np.ndarray, " k"], most: int = 3) -> str:
        best = [int(k) for k in np.argsort(-gain, kind="stable")[:most] if gain[k] > 0]
        return ", ".join(f"{self.names[k]} {row[k]:.2g}" for k in best) or "the other candidates"


@cache
def shipped_classifier() -> PartClassifier:
    """Read the classifier that is shipped."""
    with (files("anymesh.segmentation") / WEIGHTS).open("rb") as file:
        arrays = dict(np.load(file))
    manifest = json.loads(bytes(arrays["manifest"]).decode())
    first, second = (BoostedTrees.from_arrays(name, arrays) for name in ("first", "second"))
    return PartClassifier(first, second, tuple(manifest["features"]), manifest)
