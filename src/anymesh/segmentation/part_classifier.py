"""Learned score of candidate parts: boosted trees on named features, in two steps (`benchmarks/train_parts.py`)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache

import numpy as np
from jaxtyping import Float

from anymesh.scoring.classifier import Classifier
from anymesh.segmentation.candidate_context import context_features
from anymesh.segmentation.part_tree import Overlap

Reasons = Callable[[Sequence[int]], list[str]]


def score_parts(overlap: Overlap, features: list[dict[str, float]]) -> tuple[Float[np.ndarray, " n"], Reasons]:
    """Return the log-odds that each candidate is a part, and a function that names what decided for some of them."""
    if not features:
        return np.zeros(0), lambda chosen: []
    classifier = shipped_classifier()
    own = classifier.table(features)
    context = context_features(overlap, classifier.score(own))

    def reasons(chosen: Sequence[int]) -> list[str]:
        rows = list(chosen)
        return classifier.reasons(own[rows], {name: values[rows] for name, values in context.items()})

    return classifier.score(own, context), reasons


@cache
def shipped_classifier() -> Classifier:
    """Read the shipped classifier."""
    return Classifier.read("anymesh.segmentation", "part_classifier.npz")
