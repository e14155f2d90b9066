"""Label of a part from its motion."""

from __future__ import annotations

from anymesh.articulation.motion_question import Candidate, SlideDirection
from anymesh.config import FACING_COSINE, LEVEL_COSINE
from anymesh.motion.part_context import PartContext
from anymesh.types import JointType

MIN_LARGE_RATIO = 0.15  # of the object's diagonal: a smaller part that slides in is a button, one that spins is a knob
MIN_DRAWER_TRAVEL_RATIO = 0.1  # of its size: a slide with less travel is not labelled as a drawer
# of its height: a part with a level hinge that rises higher than this above its parent is a lid modelled open
MIN_OPEN_LID_RISE_RATIO = 0.5


def label_of(context: PartContext, best: Candidate) -> str:
    """Return drawer, button, slider, knob, wheel, handle, lid or door, or "" for a part that hardly moves.

    best: the motion of the part.
    """
    size = context.part.box.diagonal / context.diagonal
    if best.motion.kind is JointType.PRISMATIC:
        if best.slide_direction is SlideDirection.ALONG_SURFACE:
            return "slider"
        if size <= MIN_LARGE_RATIO and best.outward < 0:
            return "button"
        return (
            "drawer" if best.opening * context.tolerance_length >= MIN_DRAWER_TRAVEL_RATIO * context.part.box.diagonal else ""
        )
    if best.role == "round":
        return "knob" if size < MIN_LARGE_RATIO else "wheel"
    if best.role == "two_pivot":
        return "handle" if context.part.slender else "lid"  # a plate on two pivots is the lid of a laptop
    low, high = context.part.bounds[:, 2]
    raised = best.vertical < FACING_COSINE and high - context.parent.bounds[1, 2] > MIN_OPEN_LID_RISE_RATIO * (high - low)
    return "lid" if context.opening_direction[2] > LEVEL_COSINE or raised else "door"
