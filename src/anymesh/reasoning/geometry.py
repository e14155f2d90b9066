"""The answerer that needs nothing: it weighs the evidence that geometry gives, the same way every time."""

from __future__ import annotations

import numpy as np

from anymesh.reasoning.movable import judge
from anymesh.reasoning.questions import Candidate, MotionAnswer, MotionQuestion, PartAnswer, PartEvidence, PartFacts
from anymesh.reasoning.vocabulary import Habit, habit_of
from anymesh.types import JointType, MotionKind

BLOCKED = np.deg2rad(12)  # a hinge that opens less is no hinge
LITTLE = 0.008  # a slide that is free for less, as a share of the diagonal, is no slide
FLAT = 0.9  # a control lower than this share of its radius is a button
LEAST = -1.0  # below this score nothing moves
SMALL = 0.06  # a part with less of the object's diagonal is a control, not a door
CONTROL = 0.25  # a part with less of it may be a lever
ROUND = 0.8  # an outline this round may turn about its axis


class GeometryAnswerer:
    """Answers from the facts alone; no key, no weights, no network."""

    name = "geometry"

    def is_part(self, evidence: PartEvidence) -> PartAnswer:
        """Weighs the evidence for a candidate part."""
        return judge(evidence)

    def which_motion(self, question: MotionQuestion) -> MotionAnswer:
        """Scores every candidate; the best one wins, its lead over other motions is the confidence."""
        habit = habit_of(question.part.label)
        scores = np.array([score(question.part, c, habit) for c in question.candidates])
        ranking = tuple(int(i) for i in np.argsort(-scores, kind="stable"))
        best = question.candidates[ranking[0]]
        top = float(scores[ranking[0]])
        if top < LEAST:
            return MotionAnswer(ranking, JointType.FIXED, 0.3, "no candidate motion is free and plausible")
        rivals = [float(scores[i]) for i in ranking[1:] if _differs(best, question.candidates[i])]
        lead = top - max(rivals, default=top - 3)
        confidence = float(np.clip(1 / (1 + np.exp(-1.6 * lead)) * min(1.0, 0.55 + 0.15 * top), 0.05, 0.99))
        return MotionAnswer(ranking, joint_type(question.part, best), confidence, reason(question.part, best))


def _differs(a: Candidate, b: Candidate) -> bool:
    """Whether two candidates would be different joints to a user."""
    if a.motion.kind is not b.motion.kind or abs(float(a.motion.axis @ b.motion.axis)) < 0.97:
        return True
    apart = np.linalg.norm(np.cross(b.motion.origin - a.motion.origin, a.motion.axis))
    return a.motion.kind is MotionKind.TURN and float(apart) > 0.1 * float(np.linalg.norm(a.motion.origin) + 1)


def score(part: PartFacts, c: Candidate, habit: Habit | None) -> float:
    """How plausible a candidate is; the unit is one clear piece of evidence."""
    if c.motion.kind is MotionKind.SLIDE:
        return _score_slide(part, c, habit)
    if c.role == "round":
        return _score_round(part, c, habit)
    return _score_hinge(part, c, habit)


def _score_round(part: PartFacts, c: Candidate, habit: Habit | None) -> float:
    free = min(c.opening, c.closing)
    if part.roundness < ROUND - (0.2 if habit is Habit.SPIN else 0.0):
        return -3.0
    value = 2.0 + 4.0 * (part.roundness - ROUND) / (1 - ROUND)
    value += 1.0 if free > 3.0 else -3.0 * (1 - free / 3.0)
    if part.size < SMALL and part.flatness < FLAT:
        value -= 6.0  # a low round control is pressed
    if habit is Habit.SPIN:
        value += 2.5
    elif habit in (Habit.SLIDE, Habit.PRESS, Habit.HINGE, Habit.BAIL):
        value -= 2.5
    return value


def _score_hinge(part: PartFacts, c: Candidate, habit: Habit | None) -> float:
    value = -0.5 + 1.6 * c.support + 1.5 * min(c.opening, np.pi / 2) / (np.pi / 2)
    if c.opening < BLOCKED:
        value -= 4.0
    value -= 0.8 * c.sibling * (1 if c.sibling > c.support - 0.2 else 0.5)
    value += 1.8 * c.handle_side
    value += {"edge": 0.5, "edge_mid": 0.35, "contact": 0.3, "bail": 2.2, "barrel": 1.6, "center": -1.2}.get(c.role, 0.0)
    if part.thinness > 0.5 and c.role in ("edge", "edge_mid"):
        value -= 0.8
    if c.role in ("edge", "edge_mid") and abs(float(c.motion.axis @ part.outward)) > 0.5:
        value -= 3.0  # about the way out: a plate does not turn in its own plane
    value += 1.2 * (max(c.outward, -0.5) - 0.5) if c.role != "bail" else 0.0
    value -= 3.0 * min(part.buried, 1.0) if c.role != "bail" else 0.0
    value -= 3.0 * _central(part)
    if part.size < SMALL and part.handle is None and c.role != "bail":
        value -= 3.0  # small things on a surface are pressed, slid or turned about their middle
    if part.handle is None or abs(c.handle_side) < 0.3:
        value += _habitual_side(part, c)
    if part.handle is not None and part.handle.along is not None:
        value += 0.3 if c.handle_side > 0.3 else 0.0
    if habit in (Habit.HINGE, Habit.BAIL):
        value += 1.5
    elif habit in (Habit.SLIDE, Habit.PRESS):
        value -= 2.0
    elif habit is Habit.SPIN:
        value -= 1.5
    return value


def _habitual_side(part: PartFacts, c: Candidate) -> float:
    """Where hinges usually are when no handle tells: upright on tall plates, above on wide ones, at a lid's long side."""
    if part.horizontal:
        return 0.2
    if c.vertical > 0.7:
        return 0.4
    return 0.1 + 0.5 * c.above  # a flap hangs from its upper edge


def _central(part: PartFacts) -> float:
    """0..1: how near the middle of the face the grip sits; in the middle it pulls, at the side it swings."""
    return 0.0 if part.handle is None else 1 - max(abs(a) for a in part.handle.across)


def _score_slide(part: PartFacts, c: Candidate, habit: Habit | None) -> float:
    value = -0.6 + 1.4 * c.guided
    if max(c.opening, c.closing) < LITTLE:
        value -= 4.0
    out = abs(c.outward) > 0.7
    if out and part.size < SMALL:
        value += 1.5
    elif out:
        value += 2.4 * min(c.depth, 0.6) / 0.6 * (0.4 + 0.6 * c.guided) * max(0.0, abs(c.outward) - 0.7) / 0.3
    elif abs(c.outward) < 0.3:
        value += 0.6 if c.guided > 0.7 else -1.0
        if c.captured and c.guided > 0.4:
            value += 1.5 if part.size < CONTROL or c.vertical < 0.7 else 0.5
    if out and part.buried > 0.5 and part.size > CONTROL:
        value += 0.8  # what lies in a cavity comes out of it
    if out:
        value += 4.0 * _central(part) * max(0.0, abs(c.outward) - 0.7) / 0.3
    value += 0.3 if c.role in ("slide", "asked") else -1.2
    if habit is Habit.SLIDE:
        value += 2.0
    elif habit is Habit.PRESS:
        value += 2.0 if abs(c.outward) > 0.7 else 0.0
    elif habit in (Habit.HINGE, Habit.SPIN, Habit.BAIL):
        value -= 2.0
    return value


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
