"""Motions taken from answers without verification: the paper's method, and a variant that replaces blocked motions."""

from __future__ import annotations

from anymesh.articulation.evidence import sweep_candidates
from anymesh.articulation.motion_classifier import PartMotionScores
from anymesh.articulation.motion_question import SlideDirection
from anymesh.config import FACING_COSINE
from anymesh.prompted.motions.answer_evidence import answered_confidence, answers_a_line
from anymesh.prompted.motions.cases import PartCase
from anymesh.prompted.motions.decode import prismatic
from anymesh.prompted.motions.offers import moves_as
from anymesh.prompted.motions.verify import Choice
from anymesh.prompted.questions.prompting import JointAppearance
from anymesh.types import JointType, Motion

MIN_GUIDED_SHARE = 0.4  # minimum share of the sideways directions in which an outward slide is guided


def normal_outwards(case: PartCase) -> Motion:
    """Return the slide along the normal of the connecting area's plane, outwards (paper, 3.3)."""
    normal = case.shown.normal
    outward = normal if normal @ case.context.opening_direction >= 0 else -normal
    return prismatic(outward, case.context, "normal of the connecting area's plane")


def opening_slide(case: PartCase) -> Motion:
    """Return the plane's normal if the part is free and guided along it, else the best guided free direction.

    On real drawers the connecting area consists of rim and sides, and its plane's normal may be off by 80 degrees and more.
    """
    context = case.context
    outward = context.opening_direction
    directions = [s * a for a in context.body_obb.axes for s in (1.0, -1.0) if s * a @ outward > FACING_COSINE] + [outward]
    ways = [normal_outwards(case)] + [prismatic(d, context, "free way out") for d in directions]
    candidates = sweep_candidates(context, [("asked", way) for way in ways])[::2]
    normal = candidates[0]
    if normal.is_free and normal.slide_direction is SlideDirection.OUTWARDS and normal.guided > MIN_GUIDED_SHARE:
        return ways[0]
    return ways[max(range(1, len(ways)), key=lambda k: (candidates[k].guided, candidates[k].opening, -k))]


def as_answered(case: PartCase) -> Choice:
    """Return the answered motion unchanged."""
    motion = case.asked or prismatic(case.context.opening_direction, case.context, "nothing moves")
    both = sweep_candidates(case.context, [("asked", motion)])
    scores = PartMotionScores(case.context, case.label, both).alone.score
    best = both[max((0, 1), key=lambda k: (both[k].is_free, scores[k]))] if motion.kind is JointType.REVOLUTE else both[0]
    moves = case.recognized.moves if case.recognized else None
    answer = f"answered: {case.kind.words}; {motion.source}"
    if case.kind is JointAppearance.FIXED:
        return Choice(best, answer, answered_confidence(None if moves is None else False, line=False), moves=False)
    as_recognized = None if moves is None else moves_as(best, moves)
    return Choice(best, answer, answered_confidence(as_recognized, line=answers_a_line(case), free=best.is_free))
