"""Learned score of a part's motions: boosted trees on named features, in two steps (`benchmarks/train_motions.py`)."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
from jaxtyping import Float

from anymesh.articulation.motion_context import ScoredMotions, context_features
from anymesh.articulation.motion_features import motion_features
from anymesh.articulation.motion_question import Candidate, MotionQuestion, PartFacts
from anymesh.motion.part_context import PartContext
from anymesh.scoring.two_steps import TwoStepClassifier


class UnscoredMotions:
    """Motions of one part with their features, after the first step."""

    def __init__(self, around: PartContext, facts: PartFacts, candidates: Sequence[Candidate]) -> None:
        classifier = shipped_classifier()
        self.facts, self.candidates = facts, tuple(candidates)
        self.table = classifier.table(motion_features(around, facts, candidates))
        axes = np.array([c.motion.axis for c in candidates]).reshape(-1, 3)
        self.first = ScoredMotions.of(classifier.names, self.table, axes, classifier.first.score(self.table))

    def question(self, copies: Sequence[UnscoredMotions] = ()) -> MotionQuestion:
        """Return the question with the scores of all motions.

        copies: parts of the same size in a row with this one.
        """
        context = context_features(self.first, [copy.first for copy in copies])
        scores, reasons = shipped_classifier().score(self.table, context)
        return MotionQuestion(self.facts, self.candidates, scores, tuple(reasons))


def score_motions(around: PartContext, facts: PartFacts, candidates: Sequence[Candidate]) -> Float[np.ndarray, " n"]:
    """Return the log-odds of each motion of a part, without regard to its copies."""
    return UnscoredMotions(around, facts, candidates).question().scores


@cache
def shipped_classifier() -> TwoStepClassifier:
    """Read the shipped classifier."""
    return TwoStepClassifier.read("anymesh.articulation", "motion_classifier.npz")
