"""Learned scores of a part's motions: boosted trees on named features (`benchmarks/train_motions.py`).

One classifier scores motions by the part at rest alone, which decides what is swept; the other scores swept motions.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
from jaxtyping import Float, Int

from anymesh.articulation.motion_features import motion_features, unswept_features
from anymesh.articulation.motion_question import Candidate, MotionQuestion, PartFacts
from anymesh.articulation.repeated_parts import ScoredMotions, mean_over_copies
from anymesh.motion.part_context import PartContext
from anymesh.scoring.classifier import Classifier


class PartMotionScores:
    """Motions of one part, with their features and the scores of the part by itself."""

    def __init__(self, around: PartContext, facts: PartFacts, candidates: Sequence[Candidate]) -> None:
        classifier = shipped_classifier()
        self.facts, self.candidates = facts, tuple(candidates)
        self.table = classifier.table(motion_features(around, facts, candidates))
        axes = np.array([c.motion.axis for c in candidates]).reshape(-1, 3)
        self.alone = ScoredMotions.of(classifier.names, self.table, axes, classifier.score(self.table))

    def question(self, copies: Sequence[PartMotionScores] = ()) -> MotionQuestion:
        """Return the question with the scores of all motions.

        copies: parts of the same size in a row with this one.
        """
        scores = mean_over_copies(self.alone, [copy.alone for copy in copies])
        return MotionQuestion(self.facts, self.candidates, scores, self._reason)

    def _reason(self, k: int) -> str:
        (reason,) = shipped_classifier().reasons(self.table[k : k + 1])
        return reason


def likeliest(around: PartContext, facts: PartFacts, candidates: Sequence[Candidate], most: int) -> list[Candidate]:
    """Return at most `most` of the motions, the likeliest by features that need no sweep, in the given order."""
    if len(candidates) <= most:
        return list(candidates)
    classifier = unswept_classifier()
    score = classifier.score(classifier.table(unswept_features(around, facts, candidates)))
    return [candidates[k] for k in likeliest_indices(score, most)]


def likeliest_indices(score: Float[np.ndarray, " n"], most: int) -> Int[np.ndarray, " m"]:
    """Return the indices of the highest scores, in ascending order."""
    return np.sort(np.argsort(-score, kind="stable")[:most])


def score_motions(around: PartContext, facts: PartFacts, candidates: Sequence[Candidate]) -> Float[np.ndarray, " n"]:
    """Return the log-odds of each motion of a part, without regard to its copies."""
    return PartMotionScores(around, facts, candidates).alone.score


@cache
def unswept_classifier() -> Classifier:
    """Read the shipped classifier of motions that have not been swept."""
    return Classifier.read("anymesh.articulation", "unswept_classifier.npz")


@cache
def shipped_classifier() -> Classifier:
    """Read the shipped classifier of swept motions."""
    return Classifier.read("anymesh.articulation", "motion_classifier.npz")
