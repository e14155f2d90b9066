"""Learned scores of a part's motions: boosted trees on named features (`training/train_motions.py`).

One classifier scores motions by the part at rest alone, which decides what is swept; the other scores swept motions.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
from jaxtyping import Float, Int

from anymesh.articulation.candidate_motions import Candidate, CandidateMotions, PartFacts
from anymesh.articulation.motion_features import Features, motion_features
from anymesh.articulation.repeated_parts import ScoredMotions, mean_over_copies
from anymesh.motion.part_context import PartContext
from anymesh.scoring.classifier import Classifier


class PartMotionScores:
    """Motions of one part with the scores of the part by itself. features: as from `motion_features`; None computes them."""

    def __init__(
        self, context: PartContext, label: str, candidates: Sequence[Candidate], features: Sequence[Features] | None = None
    ) -> None:
        classifier = shipped_classifier()
        self.facts, self.candidates = PartFacts.of(context, label), tuple(candidates)
        self.table = classifier.table(features or motion_features(context, candidates))
        axes = np.array([c.motion.axis for c in candidates]).reshape(-1, 3)
        self.alone = ScoredMotions.of(classifier.names, self.table, axes, classifier.score(self.table))

    def averaged(self, copies: Sequence[PartMotionScores] = ()) -> CandidateMotions:
        """Return the motions with their scores, averaged over copies.

        copies: parts of the same size in a row with this one.
        """
        scores = mean_over_copies(self.alone, [copy.alone for copy in copies])
        return CandidateMotions(self.facts, self.candidates, scores)


def likeliest(features: Sequence[Features], most: int) -> Int[np.ndarray, " m"]:
    """Return the indices of at most `most` motions, the likeliest by features that need no sweep, in ascending order."""
    if len(features) <= most:
        return np.arange(len(features))
    classifier = unswept_classifier()
    return highest(classifier.score(classifier.table(features)), most)


def highest(score: Float[np.ndarray, " n"], most: int) -> Int[np.ndarray, " m"]:
    """Return the indices of the highest scores, in ascending order."""
    return np.sort(np.argsort(-score, kind="stable")[:most])


@cache
def unswept_classifier() -> Classifier:
    """Read the shipped classifier of motions that have not been swept."""
    return Classifier.read("anymesh.articulation", "unswept_classifier.npz")


@cache
def shipped_classifier() -> Classifier:
    """Read the shipped classifier of swept motions."""
    return Classifier.read("anymesh.articulation", "motion_classifier.npz")
