"""The closed pose of a part that is modelled open: the stop of its hinge at its parent, or a front that is flush."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float

from anymesh.articulation.motion_question import BOX_RIM_ROLES, Candidate
from anymesh.config import ALONG_COSINE
from anymesh.motion.part_context import PartContext
from anymesh.types import JointType

CLOSABLE_ROLES = (*BOX_RIM_ROLES, "barrel", "asked")  # hinges that may be at a rim
MAX_CLOSED_GAP_RATIO = 0.02  # of the tolerance length: a closed part is this near its parent
END_FRACTION, MIN_NEAR_SHARE = 0.8, 0.2  # position where an end of a part begins, and the least share of it near the parent
MIN_CLOSED_ENDS = 3  # of the four ends of its face, of a closed part
FRAME_RATIO = 0.2  # of the front's size: width of the frame beside it with which it is flush when closed
MIN_INSERTED_RATIO = 0.25  # of the travel: a front with less depth behind it stands on its parent and was not pulled out
MIN_OPEN_RATIO = 0.05  # of the tolerance length: a far rim nearer to the parent, or a front that stands out less, is closed
MIN_CLOSING_ANGLE_RAD = float(np.deg2rad(5.0))  # [rad] less free angle in the closing direction is play


def is_closed(context: PartContext, gap: Float[np.ndarray, " n"]) -> bool:
    """Return whether a part is closed: near the parent at both ends of its face.

    gap: distance of each sample of the part to the parent, in the pose in question [m].
    """
    near = gap < MAX_CLOSED_GAP_RATIO * context.tolerance_length
    local = context.body_obb.local(context.part.samples.points) / np.maximum(context.body_obb.half, 1e-9)
    return sum(ends_near(local[:, axis], near) for axis in context.face_axes) >= MIN_CLOSED_ENDS


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
    if _far_gap(context, c) < MIN_OPEN_RATIO * context.tolerance_length or _closes(context, c.reversed()):
        return None
    if _at_stop(c):
        return 0.0
    return c.closing if _closes(context, c) else None


def _closes(context: PartContext, c: Candidate) -> bool:
    """Return whether a part that is open is closed at the stop behind it."""
    if c.opening_sweep.clear_backward or c.closing < MIN_CLOSING_ANGLE_RAD:
        return False
    T = c.motion.transform(-c.opening_sign * c.closing)
    moved = context.part.samples.points @ T[:3, :3].T + T[:3, 3]
    return is_closed(context, context.parent.tree.distance(moved))


def _far_gap(context: PartContext, c: Candidate) -> float:
    """Return the median distance of the rim opposite the hinge to the parent [m]."""
    off = c.motion.distance(context.part.samples.points)
    return float(np.median(context.gap[off >= END_FRACTION * off.max()]))


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
