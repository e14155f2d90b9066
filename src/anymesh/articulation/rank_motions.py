"""Score the candidate motions of a part, rank them by the score and its label, or label the part by its motion.

The learned scores are boosted trees on named features (`training/train_motions.py`).
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.articulation.candidate_motions import (
    BOX_RIM_ROLES,
    MIN_FREE_TRAVEL_RATIO,
    MIN_LARGE_RATIO,
    ON_PIVOT_RATIO,
    Candidate,
    CandidateMotions,
    MotionChoice,
    PartFacts,
    SlideDirection,
)
from anymesh.articulation.motion_features import Features, motion_features
from anymesh.articulation.part_contexts import ScoredMotions, mean_over_copies
from anymesh.config import FACING_COSINE, LEVEL_COSINE, SAME_AXIS_COSINE
from anymesh.motion.part_context import PartContext
from anymesh.names import CHECK, SURE
from anymesh.scoring import by_hand
from anymesh.scoring.classifier import Classifier
from anymesh.types import JointType
from anymesh.vocabulary import typical_motion


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


def likeliest(features: Sequence[Features], most: int, fits: Bool[np.ndarray, " n"] | None = None) -> Int[np.ndarray, " m"]:
    """Return the indices of at most `most` motions, the likeliest by features that need no sweep, in ascending order.

    fits: motions that fit the label; if none of these is among them, the likeliest of these are returned.
    """
    if len(features) <= most:
        return np.arange(len(features))
    classifier = unswept_classifier()
    score = classifier.score(classifier.table(features))
    likely = highest(score, most)
    if fits is None or fits[likely].any():
        return likely
    return np.intersect1d(highest(np.where(fits, score, -np.inf), most), np.flatnonzero(fits))


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


DRAWER = "drawer"  # the label of parts that slide out of the body
NO_MOTION_CONFIDENCE = 0.3  # confidence of a joint without a plausible motion
SAME_LINE_RATIO = 0.1  # of the part's size: maximum distance between lines that a user sees as one
SIDES = "on no side", "on one side", "on two sides", "on three sides", "on all sides"  # by how many of four guide a slide
MIN_DRAWER_TRAVEL_RATIO = 0.1  # of its size: a slide with less travel is not labelled as a drawer
# [rad] a door is stopped at some side; a lid that lies on its parent, at once
MAX_SWING_RAD, MAX_LID_SWING_RAD = float(np.deg2rad(270)), float(np.deg2rad(215))
# confidence of a motion from which it tells these labels, by how often they are right (docs/decisions/0043); others always
MIN_LABEL_CONFIDENCE = {"door": SURE, "drawer": SURE, "knob": SURE, "wheel": SURE, "lid": CHECK}
# of its height: a part with a level hinge that rises higher than this above its parent is a lid modelled open
MIN_OPEN_LID_RISE_RATIO = 0.5


def rank_motions(motions: CandidateMotions) -> MotionChoice:
    """Rank the candidates by score.

    An endless rotation is about the axis of the round outline, if that is the same joint to a user; it has no opening side, so
    its axis keeps the sign that it is proposed with. The confidence comes from the probability of the candidates that a user
    sees as the best one; a label does not count, unless it is a name that decides against the geometry: then the probability is
    that among the motions that fit it.
    """
    scores, fits = motion_scores(motions), fits_name(motions)
    order = [int(i) for i in np.lexsort((-scores, ~fits))]
    same = same_joints(motions.part, motions.candidates, order[0])
    if motions.candidates[order[0]].is_endless:
        outlined = [bool(s) and c.role == "round" and c.is_endless for s, c in zip(same, motions.candidates, strict=True)]
        order.sort(key=lambda k: (not outlined[k], outlined[k] and motions.candidates[k].opening_sign < 0))
    ranking, best, plain = tuple(order), motions.candidates[order[0]], _scores_by_geometry(motions)
    if not best.is_free:
        free = any(c.is_free for c in motions.candidates)
        why = f"blocked in every motion of a {motions.part.label}" if free else "blocked whichever way it is moved"
        return MotionChoice(ranking, best.motion.kind if best.at_pivot else JointType.FIXED, NO_MOTION_CONFIDENCE, why)
    counted = fits | fits[scores.argmax()]
    share = np.clip(share_of_best(np.where(counted, plain, -np.inf), same), 1e-6, 1 - 1e-6)
    confidence = shipped_classifier().confidence(float(np.log(share / (1 - share))))
    return MotionChoice(ranking, joint_type(best, motions.part.label), confidence, reason(best))


def fits_name(motions: CandidateMotions) -> Bool[np.ndarray, " k"]:
    """Return which motions fit the name of their part, all if it has none."""
    return fits_label(motions.part.label if motions.part.named else "", motions.candidates)


def fits_label(label: str, candidates: Sequence[Candidate]) -> Bool[np.ndarray, " k"]:
    """Return which motions are of the kind that a label names, all if none is or if it names no kind.

    A drawer slides outwards if it can; a door turns, if possible not about the axis of a round outline.
    """
    kind, every = typical_motion(label), np.ones(len(candidates), bool)
    if kind is None:
        return every
    fits = np.array([(c.motion.kind is JointType.PRISMATIC) == (kind is JointType.PRISMATIC) for c in candidates], bool)
    if label == DRAWER:
        better = np.array([c.slide_direction is SlideDirection.OUTWARDS for c in candidates], bool)
    else:
        better = np.array([kind is not JointType.REVOLUTE or c.role != "round" for c in candidates], bool)
    return next(some for some in (fits & better, fits, every) if some.any())


def _scores_by_geometry(motions: CandidateMotions) -> Float[np.ndarray, " k"]:
    """Return the log-odds of each candidate, with a penalty for blocked motions and for those off the pivot."""
    penalty = np.array([0.0 if c.is_free else by_hand.BLOCKED_SCORE for c in motions.candidates])
    at_pivot = np.array([c.at_pivot for c in motions.candidates], bool)
    if at_pivot.any():
        slides = np.array([c.motion.kind is JointType.PRISMATIC for c in motions.candidates])
        penalty += np.where(at_pivot, 0.0, np.where(slides, by_hand.PIVOT_SLIDE_SCORE, by_hand.OFF_PIVOT_SCORE))
        penalty[np.where(at_pivot, motions.scores, -np.inf).argmax()] = 0.0
    stuck = [c.slide_direction is SlideDirection.INWARDS and c.opening < MIN_FREE_TRAVEL_RATIO for c in motions.candidates]
    return motions.scores + np.where(np.array(stuck) & (not motions.part.pressed), by_hand.STUCK_SCORE, penalty)


def motion_scores(motions: CandidateMotions) -> Float[np.ndarray, " k"]:
    """Return the log-odds of each candidate, with a penalty for blocked motions and a prior from the label."""
    scores = _scores_by_geometry(motions)
    prior = by_hand.LABEL_PRIOR.get(typical) if (typical := typical_motion(motions.part.label)) else None
    if prior is None:
        return scores
    kinds = [2 if c.motion.kind is JointType.PRISMATIC else int(c.role == "round") for c in motions.candidates]
    return scores + np.array(prior)[kinds]


def same_joints(part: PartFacts, candidates: Sequence[Candidate], best: int) -> Bool[np.ndarray, " k"]:
    """Return which candidates a user could not distinguish from `best`.

    They are of its kind, about the same line, opening to the same side. A motion that is free both ways has no side.
    """
    first = candidates[best]
    axes = np.array([c.motion.axis * c.opening_sign for c in candidates])
    same_side = axes @ (first.motion.axis * first.opening_sign) > 0
    return same_lines(part, candidates, best) & (first.is_endless | same_side)


def same_lines(part: PartFacts, candidates: Sequence[Candidate], best: int) -> Bool[np.ndarray, " k"]:
    """Return which candidates are of the kind of `best` and about its line, or along its axis, to either side."""
    motions, motion = [c.motion for c in candidates], candidates[best].motion
    same = np.array([m.kind is motion.kind for m in motions])
    same &= np.abs(np.array([m.axis for m in motions]) @ motion.axis) >= SAME_AXIS_COSINE
    if motion.kind is JointType.REVOLUTE:
        same &= motion.distance(np.array([m.origin for m in motions])) <= SAME_LINE_RATIO * part.size
    return same


def share_of_best(scores: Float[np.ndarray, " k"], same: Bool[np.ndarray, " k"]) -> float:
    """Return the probability of the candidates that are the same joint, if exactly one of all is right."""
    likely = np.exp(scores - scores.max())
    return float(likely[same].sum() / likely.sum())


def joint_type(c: Candidate, label: str = "part") -> JointType:
    """Return the type of joint of a candidate. A rotation that is free all round is endless, unless the label names a hinge."""
    if c.motion.kind is JointType.PRISMATIC:
        return JointType.PRISMATIC
    spins = c.spins and typical_motion(label) is not JointType.REVOLUTE
    return JointType.CONTINUOUS if (c.role == "round" and c.is_endless) or spins else JointType.REVOLUTE


def reason(c: Candidate) -> str:
    """Describe a motion in a short note: how the part moves, how far, and what holds it."""
    if c.motion.kind is JointType.PRISMATIC:
        way = 100 * c.opening_sweep.forward
        return f"slides {way:.{int(way < 10)}f} cm {c.slide_direction}, guided {SIDES[round(4 * c.guided)]}"
    range_ = "endlessly" if c.is_endless else f"from {-round(np.degrees(c.closing))} to {round(np.degrees(c.opening))} degrees"
    if c.spins:
        return f"turns {range_} about the {c.motion.source}"
    if c.role == "round":
        return f"turns {range_} about the axis of its round outline"
    notes = [f"swings {range_} about the {c.motion.source}"]
    if c.at_pivot:
        notes.append(f"with the file's pivot of its node {'on' if c.off_pivot < ON_PIVOT_RATIO else 'beside'} this axis")
    if c.handle_side > 0.3:
        notes.append("opposite its handle")
    if c.hinge_support > 0.5:
        notes.append("held all along it")
    return ", ".join(notes)


def label_of(context: PartContext, best: Candidate) -> str:
    """Return drawer, button, slider, knob, wheel, handle, lid or door, else "part"; "" for a part that hardly moves.

    best: the motion of the part.
    """
    size = context.part.box.diagonal / context.diagonal
    if best.motion.kind is JointType.PRISMATIC:
        if best.slide_direction is SlideDirection.ALONG_SURFACE:
            return "slider"
        if size <= MIN_LARGE_RATIO and best.outward < 0:
            return "button"
        if best.opening * context.tolerance_length < MIN_DRAWER_TRAVEL_RATIO * context.part.box.diagonal:
            return ""
        return DRAWER if best.vertical < FACING_COSINE else "part"
    if best.role == "round":
        upright, flat = best.vertical < FACING_COSINE, context.outline.radius >= context.outline.height
        # lying, a handwheel has spokes; a plate has none
        return "knob" if size < MIN_LARGE_RATIO else "wheel" if flat and (upright or context.part.slender) else "part"
    if best.role == "two_pivot":
        return "handle" if context.part.slender else "lid"  # a plate on two pivots is the lid of a laptop
    low, high = context.part.bounds[:, 2]
    raised = best.vertical < FACING_COSINE and high - context.parent.bounds[1, 2] > MIN_OPEN_LID_RISE_RATIO * (high - low)
    lid, swing = context.opening_direction[2] > LEVEL_COSINE, best.opening + best.closing
    if best.role not in (*BOX_RIM_ROLES, "barrel") or swing > (MAX_LID_SWING_RAD if lid and not raised else MAX_SWING_RAD):
        return "part"
    return "lid" if lid or raised else "door"
