"""Limits of a joint from the sweep of its motion, and the closed pose of a part that is modelled open.

Such a part is closed at the stop of its hinge at its parent, or where its front is flush.
"""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float

from anymesh.articulation.candidate_motions import (
    BOX_RIM_ROLES,
    MIN_FREE_ANGLE_RAD,
    MIN_FREE_TRAVEL_RATIO,
    Candidate,
    SlideDirection,
)
from anymesh.config import ALONG_COSINE
from anymesh.geometry.sweep import free_amount
from anymesh.motion.part_context import PartContext
from anymesh.types import JointType, Motion
from anymesh.types.triangles import transformed

FINE_STEPS = 30  # for the limits: three times as many over the range of a hinge, twice as many of a slide
MAX_DOOR_DEG = 110.0  # [deg] upper limit of an unobstructed hinge with an upright axis (common cup hinges)
MAX_FLAP_DEG = 90.0  # [deg] upper limit of an unobstructed hinge with a horizontal axis
HIDDEN_TRAVEL_RATIO = 0.6  # of the parent's depth: travel of a panel whose box is hidden
KEPT_INSIDE_RATIO = 0.1  # of a drawer's depth: what stays inside when it is open
CLOSABLE_ROLES = (*BOX_RIM_ROLES, "barrel", "asked")  # hinges that may be at a rim
MAX_CLOSED_GAP_RATIO = 0.02  # of the tolerance length: a closed part is this near its parent
END_FRACTION, MIN_NEAR_SHARE = 0.8, 0.2  # position where an end of a part begins, and the least share of it near the parent
MIN_CLOSED_ENDS = 3  # of the four ends of its face, of a closed part
FRAME_RATIO = 0.2  # of the front's size: width of the frame beside it with which it is flush when closed
MIN_INSERTED_RATIO = 0.25  # of the travel: a front with less depth behind it stands on its parent and was not pulled out
MIN_OPEN_RATIO = 0.05  # of the tolerance length: a far rim nearer to the parent, or a front that stands out less, is closed
MIN_CLOSING_ANGLE_RAD = float(np.deg2rad(5.0))  # [rad] less free angle in the closing direction is play
MIN_DRAWER_DEPTH_RATIO = 0.35  # of the parent's depth: a slide that is less deep is only a panel
MIN_STROKE_RATIO = 0.1  # of its height: a button with less free space behind it fills its hole
STROKE_RATIO = 0.5  # of its height: stroke of such a button
MIN_HINGE_RANGE_RAD = np.deg2rad(2.0)  # [rad] a hinge with a shorter range, answered or left free, has an error
MIN_SLIDE_FREE_RATIO = 0.05  # of an answered travel: a slide that the sweep leaves less is blocked and keeps its answer
MIN_DEPTH_IN_PARENT_RATIO = 0.3  # of the answered travel: a part less deep inside its parent is only a panel
ANGLE_STEP_RAD = np.deg2rad(1.0)  # [rad] resolution of limits that the sweep finds
Range = tuple[float, float]  # lower, upper [rad or m], lower <= 0 <= upper


def is_closed(context: PartContext, gap: Float[np.ndarray, " n"]) -> bool:
    """Return whether a part is closed: near the parent at both ends of its face.

    gap: distance of each sample of the part to the parent, in the pose in question [m].
    """
    near = gap < MAX_CLOSED_GAP_RATIO * context.tolerance_length
    return sum(ends_near(along, near) for along in _across_face(context)) >= MIN_CLOSED_ENDS


def _across_face(context: PartContext) -> Float[np.ndarray, "2 n"]:
    """Return the position of each sample of the part along the two axes of its face, -1 to 1 from end to end."""
    local = context.body_obb.local(context.part.samples.points) / np.maximum(context.body_obb.half, 1e-9)
    return local[:, context.face_axes].T


def ends_near(along: Float[np.ndarray, " n"], near: Bool[np.ndarray, " n"]) -> int:
    """Count the ends of a part (0..2) that are near its parent.

    along: position of each sample, -1 to 1 from end to end.
    """
    ends = along > END_FRACTION, along < -END_FRACTION
    return sum(bool(near[end].sum() > MIN_NEAR_SHARE * end.sum()) for end in ends)


def closing_angle(context: PartContext, c: Candidate) -> float | None:
    """Return the angle from rest to the closed pose of a hinged part [rad].

    0 for a part that is closed or at a stop, None if no closed pose is known, or if the part would be closed at both stops.
    """
    if c.motion.kind is JointType.PRISMATIC or c.role not in CLOSABLE_ROLES:
        return None
    if is_closed(context, context.gap):
        return 0.0
    off = c.motion.distance(context.part.samples.points)
    far_gap = float(np.median(context.gap[off >= END_FRACTION * off.max()]))  # of the rim opposite the hinge
    if far_gap < MIN_OPEN_RATIO * context.tolerance_length or _closes(context, c.reversed()):
        return None
    if _at_stop(c):
        return 0.0
    return c.closing if _closes(context, c) else None


def _closes(context: PartContext, c: Candidate) -> bool:
    """Return whether a part that is open is closed at the stop behind it."""
    if c.opening_sweep.clear_backward or c.closing < MIN_CLOSING_ANGLE_RAD:
        return False
    moved = transformed(context.part.samples.points, c.motion.transform(-c.opening_sign * c.closing))
    ends = (np.abs(_across_face(context)) > END_FRACTION).any(0)  # others do not count
    gap = np.full(len(moved), np.inf)
    gap[ends] = context.parent.tree.distance(moved[ends])
    return is_closed(context, gap)


def closing_travel(context: PartContext, c: Candidate) -> float:
    """Return how far a part that slides outwards closes until its front is flush with its parent [m].

    0 if it stands out little, or stands on its parent instead of reaching into it.
    """
    axis, core = c.opening_sign * c.motion.axis, context.body_obb
    points, along = context.parent.samples.points, np.abs(core.axes @ axis)
    across = along < ALONG_COSINE
    reach = (1 + FRAME_RATIO) * core.half + context.penetration
    beside = (np.abs(core.local(points)) < reach)[:, across].all(1)
    if not beside.any():
        return 0.0
    travel = float(core.center @ axis + core.half @ along - (points[beside] @ axis).max())
    inserted = 2 * float(core.half @ along) - travel
    pulled = travel > MIN_OPEN_RATIO * context.tolerance_length and inserted > MIN_INSERTED_RATIO * travel
    return travel if pulled else 0.0


def away_from_closed(context: PartContext, c: Candidate) -> Candidate:
    """Return the candidate reversed if it turns towards the only closed pose that is known."""
    back = c.reversed()
    return back if not _at_stop(c) and (closing_angle(context, back) or 0.0) > 0 else c


def _at_stop(c: Candidate) -> bool:
    return not c.opening_sweep.clear_backward and bool(c.closing < MIN_CLOSING_ANGLE_RAD)


def limits(context: PartContext, c: Candidate, kind: JointType, answered: Range | None = None) -> Range | None:
    """Compute (lower, upper) about the opening axis [rad or m]; None for continuous and fixed joints.

    A part that geometry finds to move into its parent has its axis inwards, and limits from 0 to its stroke.

    answered: the answered range about the opening axis; the sweep only shortens it.
    """
    match kind:
        case JointType.CONTINUOUS | JointType.FIXED:
            return None
        case JointType.REVOLUTE if answered is not None:
            return _answered_revolute(context, c, answered)
        case JointType.PRISMATIC if answered is not None:
            return _answered_prismatic(context, c, answered)
        case JointType.REVOLUTE:
            return _revolute(context, c)
        case JointType.PRISMATIC:
            return _prismatic(context, c)


def pressed(c: Candidate, answered: Range | None) -> bool:
    """Return whether a slide goes into its parent by its answered range, as buttons do."""
    return c.slide_direction is SlideDirection.OUTWARDS and answered is not None and -answered[0] > answered[1]


def _answered_revolute(context: PartContext, c: Candidate, answered: Range) -> Range:
    """Shorten an answered range to what the sweep finds free; a blocked hinge keeps the full range."""
    lower, upper = -answered[0], answered[1]
    if max(c.opening, c.closing) < MIN_FREE_ANGLE_RAD:
        return (0.0 - lower, upper)
    ahead, back = free_within(context, c, lower, upper, 3 * FINE_STEPS)
    if ahead + back < MIN_HINGE_RANGE_RAD:
        return (0.0 - lower, upper)
    return (0.0 - back, ahead)


def _answered_prismatic(context: PartContext, c: Candidate, answered: Range) -> Range:
    """Shorten an answered range to what the sweep finds free and, outwards, to the part's depth in its parent.

    A part that is pressed in keeps its stroke, up to its own height, since its mesh may fill the hole that it moves in. A
    negative stroke goes in also if the motion does. A blocked slide keeps the full range.
    """
    if c.slide_direction is SlideDirection.INWARDS and -answered[0] > answered[1]:
        answered = (0.0 - answered[1], -answered[0])
    motion, (lower, upper) = c.opening_motion, (-answered[0], answered[1])
    extent = float(np.ptp(context.part.corners @ motion.axis))
    depth = context.depth_in_parent(motion.axis)
    if c.slide_direction is SlideDirection.OUTWARDS and depth > MIN_DEPTH_IN_PARENT_RATIO * upper:
        upper = min(upper, depth)
    ahead, back = free_within(context, c, lower, upper, 2 * FINE_STEPS)
    if upper < lower and c.slide_direction is SlideDirection.OUTWARDS:
        back = min(lower, extent)
    if ahead + back < MIN_SLIDE_FREE_RATIO * (lower + upper):
        return (0.0 - lower, upper)
    return (0.0 - back, ahead)


def free_within(context: PartContext, c: Candidate, lower: float, upper: float, steps: int) -> tuple[float, float]:
    """Return the free motion ahead, up to `upper`, and back, up to `lower` [rad or m]."""
    motion = c.opening_motion
    obstacles = context.obstacles_of(motion)
    ahead = free_amount(obstacles, motion, 1, upper, steps)[0] if upper > 0 else 0.0
    back = free_amount(obstacles, motion, -1, lower, steps)[0] if lower > 0 else 0.0
    return ahead, back


def _revolute(context: PartContext, c: Candidate) -> tuple[float, float]:
    motion = c.opening_motion
    most = np.deg2rad(MAX_DOOR_DEG if c.vertical > ALONG_COSINE else MAX_FLAP_DEG)
    closing = closing_angle(context, c)
    blocked = max(c.opening, c.closing) < MIN_FREE_ANGLE_RAD
    ajar = closing is not None and closing > 0 and c.opening < MIN_FREE_ANGLE_RAD
    upper = _free_angle(context, motion, 1, max(most - (closing or 0.0), 0.0), np.inf if blocked or ajar else c.opening)
    lower = 0.0 if closing == 0 else _free_angle(context, motion, -1, closing or most, np.inf if blocked else c.closing)
    lower = _whole_degrees(lower) if lower >= MIN_CLOSING_ANGLE_RAD else 0.0
    if upper < (MIN_FREE_ANGLE_RAD if c.at_pivot else MIN_HINGE_RANGE_RAD):
        upper = min(most, c.opening) if c.opening >= MIN_FREE_ANGLE_RAD else most
        upper = upper if lower == 0 else 0.0
    return (0.0 - lower, upper)


def _free_angle(context: PartContext, motion: Motion, sign: int, most: float, swept: float) -> float:
    """Return the free angle up to `most`, in whole degrees where something stops it [rad].

    swept: the free angle found by coarse steps, infinite if it is not known. Fine steps may be too short for a stop to be
    noticed, so they only shorten it.
    """
    far = min(most, swept)
    angle, clear = free_amount(context.obstacles_of(motion), motion, sign, far, 3 * FINE_STEPS)
    return angle if clear and far == most else _whole_degrees(angle)


def _whole_degrees(angle: float) -> float:
    """Return an angle rounded down to ANGLE_STEP_RAD, the resolution of the sweep [rad]."""
    return float(np.floor(angle / ANGLE_STEP_RAD + 1e-9) * ANGLE_STEP_RAD)


def _prismatic(context: PartContext, c: Candidate) -> tuple[float, float]:
    motion = c.opening_motion
    if c.slide_direction is SlideDirection.INWARDS and not c.opening_sweep.clear_forward:
        return (0.0, stroke(context, c))
    outward, least = c.slide_direction is not SlideDirection.ALONG_SURFACE, MIN_FREE_TRAVEL_RATIO * context.tolerance_length
    closing = closing_travel(context, c) if outward else 0.0
    depth = context.depth_in_parent(motion.axis) + closing
    extent = float(np.ptp(context.part.corners @ motion.axis))
    most = max((1 - KEPT_INSIDE_RATIO) * (depth if outward else extent), least)
    if c.captured:
        most = 2 * context.part.box.diagonal
    behind = float(np.ptp(context.parent.samples.points @ motion.axis))
    if outward and extent < MIN_DRAWER_DEPTH_RATIO * behind:
        # a panel whose box is not in the mesh; a knob comes out no further than it is large
        most = min(HIDDEN_TRAVEL_RATIO * behind, context.part.box.diagonal)
    steps = FINE_STEPS * 2
    obstacles = context.obstacles_of(motion)
    upper, _ = free_amount(obstacles, motion, 1, max(most - closing, 0.0), steps)
    lower = 0.0
    if closing or not outward:
        lower, clear = free_amount(obstacles, motion, -1, closing or most, steps)
        if (clear and not outward) or lower < least:
            lower = 0.0
    if upper < least:
        upper = most if lower == 0 else 0.0
    return (0.0 - lower, upper)


def stroke(context: PartContext, c: Candidate) -> float:
    """Return the stroke of a part into its parent [m]: up to its own height, half of it if its mesh fills the hole.

    A sheet has no height; it gets the least travel of a slide.
    """
    motion = c.opening_motion
    extent = max(float(np.ptp(context.part.corners @ motion.axis)), MIN_FREE_TRAVEL_RATIO * context.tolerance_length)
    free, _ = free_amount(context.obstacles, motion, 1, extent, 2 * FINE_STEPS)
    return free if free > MIN_STROKE_RATIO * extent else STROKE_RATIO * extent
