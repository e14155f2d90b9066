"""The answerer that needs nothing: it weighs the evidence that geometry gives, the same way every time."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.reasoning.questions import Candidate, MotionAnswer, MotionQuestion, PartFacts
from anymesh.reasoning.vocabulary import habit_of
from anymesh.reasoning.weighing import BLOCKED, LITTLE, score
from anymesh.types import JointType, MotionKind

UNSURE = 0.3  # confidence of a joint that no motion speaks for
SAME_AXIS = 0.97  # cosine of axes that are one to a user
OWN_WAY = 2.0  # what it takes, in units of clear evidence, for a part to move in another manner than its copy
SAME_LINE = 0.1  # and the share of the part's own size that their lines may be apart


class GeometryAnswerer:
    """Answers from the facts alone; no key, no weights, no network."""

    name = "geometry"

    def which_motion(self, question: MotionQuestion) -> MotionAnswer:
        """Scores every candidate; the best one wins, its lead over other motions is the confidence."""
        scores = _scores(question)
        for twin in question.twins:
            scores = scores - _against(question, twin)
        ranking = tuple(int(i) for i in np.argsort(-scores, kind="stable"))
        best = question.candidates[ranking[0]]
        if not is_free(best):
            return MotionAnswer(ranking, JointType.FIXED, UNSURE, "no candidate motion is free and plausible")
        likely = np.exp(scores - scores.max())
        alike = np.array([not _differs(best, c, question.part) for c in question.candidates])
        confidence = float(np.clip(likely[alike].sum() / likely.sum(), 0.05, 0.99))
        return MotionAnswer(ranking, joint_type(question.part, best), confidence, reason(question.part, best))


def _scores(question: MotionQuestion) -> Float[np.ndarray, " k"]:
    habit = habit_of(question.part.label)
    return np.array([score(question.part, c, habit) for c in question.candidates])


def _against(question: MotionQuestion, twin: MotionQuestion) -> Float[np.ndarray, " k"]:
    """What each candidate costs because a copy of the part would have to move in the same manner: OWN_WAY at most."""
    theirs = _scores(twin)
    loss = np.minimum(theirs.max() - theirs, OWN_WAY)
    alike = np.array([[_in_one_manner(c, other) for other in twin.candidates] for c in question.candidates])
    return np.where(alike, loss, OWN_WAY).min(1)


def _in_one_manner(a: Candidate, b: Candidate) -> bool:
    """Whether copies that move so look alike: doors hinged left or right do, flaps hinged above or below do not."""
    if a.motion.kind is not b.motion.kind or (a.role == "round") != (b.role == "round"):
        return False
    if abs(float(a.motion.axis @ b.motion.axis)) < SAME_AXIS:
        return False
    if a.motion.kind is MotionKind.SLIDE or a.role == "round":
        return True
    return a.outward * b.outward >= 0 and (a.vertical > SAME_AXIS or a.above * b.above >= 0)


def is_free(c: Candidate) -> bool:
    """Whether the sweep lets a motion open at all, or a small part be pressed in."""
    if c.motion.kind is MotionKind.TURN:
        return bool(max(c.opening, c.closing if c.role == "round" else 0.0) >= BLOCKED)
    return bool(max(c.opening, c.closing) >= LITTLE)


def _differs(a: Candidate, b: Candidate, part: PartFacts) -> bool:
    """Whether two candidates would be different joints to a user."""
    if a.motion.kind is not b.motion.kind or abs(float(a.motion.axis @ b.motion.axis)) < SAME_AXIS:
        return True
    apart = np.linalg.norm(np.cross(b.motion.origin - a.motion.origin, a.motion.axis))
    return a.motion.kind is MotionKind.TURN and float(apart) > SAME_LINE * part.size * part.diagonal


def joint_type(part: PartFacts, c: Candidate) -> JointType:
    """The joint's type that goes with a candidate."""
    if c.motion.kind is MotionKind.SLIDE:
        return JointType.PRISMATIC
    if c.role == "round" and turns_freely(c):
        return JointType.CONTINUOUS
    return JointType.REVOLUTE


def turns_freely(c: Candidate) -> bool:
    """Whether nothing stops a turn, either way."""
    return min(c.opening, c.closing) > 3.0


def reason(part: PartFacts, c: Candidate) -> str:
    """The evidence in words."""
    if c.motion.kind is MotionKind.SLIDE:
        held = f"held on {round(4 * c.guided)} of 4 sides"
        way = "outwards" if c.outward > 0.7 else "inwards" if c.outward < -0.7 else "along the surface"
        return f"slides {way}, {held}, free for {100 * c.opening:.0f} % of the object's diagonal ({c.motion.source})"
    free = f"free {-np.degrees(c.closing):.0f}..{np.degrees(c.opening):.0f} deg"
    if c.role == "round":
        return f"round outline ({100 * part.roundness:.0f} %), turns about its axis, {free}"
    told = [c.motion.source]
    if c.handle_side > 0.3:
        told.insert(0, "hinge opposite the handle")
    if c.support > 0.5:
        told.append("the parent runs along it")
    return ", ".join([*told, free])
