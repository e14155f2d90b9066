"""Answers of a model as evidence for the motions of parts, in one score with the geometry.

An answerer is taken to give each answer rightly with a probability, its reliability, and to choose at random otherwise. The
score of a motion is the logarithm of its probability by geometry and of the probability of all answers, if it is the true one.
The reliability is not assumed: RELIABILITIES are weighted by how probable they make all answers about an object, that is, by
how well the answers agree with each other and with the geometry.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from anymesh.articulation.motion_classifier import shipped_classifier
from anymesh.prompted.motions.cases import PartCase
from anymesh.prompted.motions.offers import MotionOffers, fits, moves_as
from anymesh.prompted.questions.prompting import JointAppearance

RELIABILITIES = (0.97, 0.9, 0.7, 0.4, 0.1)
SHARES = (0.55, 0.27, 0.1, 0.05, 0.03)  # of answerers with each reliability, before any of their answers is known
MISLED_SHARE = 0.1  # share of the parts about whose motion geometry says nothing
FIXED_SHARE = 0.1  # share of the parts of a model that do not move
KINDS = 4  # kinds of joint that differ: turns, slides out, slides along the surface, fixed
BLOCKED_RATIO = 0.5  # factor on the confidence in an answered motion that the sweep finds blocked
OFFERED_SHARE = 0.98  # share of the parts whose true motion is among the candidates (benchmarks/motions.md)
LINE_RIGHT = 0.6  # share of right answers whose points and arrows lead to exactly the right one of the motions shown
MISSED = 0.02  # probability that the right motion is not recognized although it is shown


@dataclass(frozen=True)
class ShownPick:
    """A pick among motions. shown: indices of the motions in the picture; picked: one of them, None for none of these."""

    shown: tuple[int, ...]
    picked: int | None


@dataclass(frozen=True, eq=False)
class PartAnswers:
    """All answers about the motion of one part."""

    offers: MotionOffers
    picks: tuple[ShownPick, ...] = ()

    def prior(self) -> Float[np.ndarray, " m"]:
        """Return the log-probability of each motion by geometry, of another one and of none, before any answer.

        Where answers are evidence, all motions are swept, which has its own calibration.
        """
        slope = shipped_classifier().manifest["confidence"]["slope, all swept"]
        calibrated = np.maximum(self.offers.shares, 1e-12) ** slope
        shares = (1 - MISLED_SHARE) * calibrated / calibrated.sum() + MISLED_SHARE / len(calibrated)
        moves = (1 - FIXED_SHARE) * np.append(OFFERED_SHARE * shares, 1 - OFFERED_SHARE)
        return np.log(np.append(moves, FIXED_SHARE))

    def likelihood(self, reliability: float) -> Float[np.ndarray, " m"]:
        """Return the log-probability of the answers for each true motion, for another one, and for none."""
        case, motions, answered = self.offers.case, self.offers.motions, self.offers.answered
        fixed = case.kind is JointAppearance.FIXED
        by_kind = np.array([*(float(fits(c, case.kind)) for c in motions), 0.0 if fixed else 1 / (KINDS - 1), float(fixed)])
        total = np.log(_answered(by_kind, reliability, KINDS))
        moves = case.recognized.moves if case.recognized else None
        if moves is not None:
            as_recognized = np.array([*(float(moves_as(c, moves)) for c in motions), 0.5, 0.0])
            total += np.log(_answered(as_recognized, reliability, 2))
        if answered is not None and answers_a_line(case) and by_kind[answered]:
            total += np.log(self._line(by_kind == 1, answered, reliability))
        for pick in self.picks:
            total += np.log(self._pick(pick, reliability))
        return total

    def _line(self, by_kind: Bool[np.ndarray, " m"], answered: int, reliability: float) -> Float[np.ndarray, " m"]:
        """Return the probability of the answered line; after a wrong kind of joint, all motions of this kind are equal."""
        count = int(by_kind.sum())
        miss = (1 - LINE_RIGHT) / (count - 1) if count > 1 else 0.0
        hit = np.where(np.arange(len(by_kind)) == answered, LINE_RIGHT if count > 1 else 1.0, miss)
        return np.where(by_kind, reliability * hit + (1 - reliability) / count, 1 / count)

    def _pick(self, pick: ShownPick, reliability: float) -> Float[np.ndarray, " m"]:
        """Return the probability of a pick for each true motion; "none of these" is right if it is not shown."""
        index = np.arange(len(self.offers.motions) + 2)
        shown = np.isin(index, pick.shown)
        none, one = np.where(shown, MISSED, 1.0), np.where(index == pick.picked, 1 - MISSED, 0.0)
        right = none if pick.picked is None else one
        return reliability * right + (1 - reliability) / (len(pick.shown) + 1)


def _answered(right: Float[np.ndarray, " n"], reliability: float, choices: int) -> Float[np.ndarray, " n"]:
    """Return the probability of an answer. right: of a reliable answerer; choices: number of possible answers."""
    return reliability * right + (1 - reliability) / choices


def answers_a_line(case: PartCase) -> bool:
    """Return whether a model answered the line or direction of a part; the way out is found by geometry."""
    return case.kind not in (JointAppearance.SLIDE_OUT, JointAppearance.FIXED)


def posteriors(parts: Mapping[int, PartAnswers]) -> dict[int, Float[np.ndarray, " m"]]:
    """Return the probability of each motion of each part of an object, of another one and of none, by part number."""
    joint = {n: np.array([p.prior() + p.likelihood(r) for r in RELIABILITIES]) for n, p in parts.items()}
    evidence = np.log(SHARES) + sum(np.logaddexp.reduce(scores, axis=1) for scores in joint.values())
    weights = np.exp(evidence - np.logaddexp.reduce(evidence))
    return {n: weights @ np.exp(scores - np.logaddexp.reduce(scores, axis=1)[:, None]) for n, scores in joint.items()}


def answered_confidence(as_recognized: bool | None, *, line: bool, free: bool = True) -> float:
    """Return the confidence in an answer that is not compared with other motions (`verify` off or free).

    as_recognized: whether it moves as recognized, None if that is not known; line: whether a line or direction was answered;
    free: whether the sweep leaves it free.
    """
    reliability, shares = np.array(RELIABILITIES), np.array(SHARES)
    right = shares * (LINE_RIGHT if line else 1.0) * (reliability + (1 - reliability) / KINDS)
    wrong = shares - right
    if as_recognized is not None:
        agrees = reliability + (1 - reliability) / 2
        right, wrong = right * (agrees if as_recognized else 1 - agrees), wrong / 2
    return float(right.sum() / (right.sum() + wrong.sum())) * (1.0 if free else BLOCKED_RATIO)
