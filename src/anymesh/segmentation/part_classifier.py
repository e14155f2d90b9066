"""Learned score of candidate parts: boosted trees on named features, in two steps (`benchmarks/train_parts.py`)."""

from __future__ import annotations

from functools import cache

import numpy as np
from jaxtyping import Float

from anymesh.scoring.two_steps import TwoStepClassifier
from anymesh.segmentation.candidate_context import context_features
from anymesh.segmentation.part_tree import Overlap


def score_parts(overlap: Overlap, features: list[dict[str, float]]) -> tuple[Float[np.ndarray, " n"], list[str]]:
    """Return the log-odds that each candidate is a part, and the names of the features that raised each score the most."""
    if not features:
        return np.zeros(0), []
    classifier = shipped_classifier()
    own = classifier.table(features)
    return classifier.score(own, context_features(overlap, classifier.first.score(own)))


@cache
def shipped_classifier() -> TwoStepClassifier:
    """Read the shipped classifier."""
    return TwoStepClassifier.read("anymesh.segmentation", "part_classifier.npz")
