"""Contact between a part and its parent during a motion: retention and hinge support."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.motion.part_context import PartContext
from anymesh.types import JointType, Motion

LINE_POINTS = 21  # sample points along a hinge line
MAX_RETENTION_POINTS = 120  # sample points of the contact that are followed during a motion
WATCHED_ANGLE_RAD = np.deg2rad(30)  # [rad] opening of a hinge at which contact is measured
WATCHED_TRAVEL_RATIO = 0.5  # travel of a slide at which contact is measured, relative to the part's extent along it
MIN_GAP_FACTOR = 1.5  # a part that touches nothing is in contact within this multiple of its smallest gap
RETAINED_FACTOR = 1.5  # contact is retained within this multiple of the distance that counts as contact at rest
CONTACT_RATIO = 0.008  # of the tolerance length: points closer to the parent are in contact


def contact_tolerance(context: PartContext) -> float:
    """Return the distance to the parent within which a point is in contact [m]; it grows with the gap of a part with none."""
    return max(CONTACT_RATIO * context.tolerance_length, MIN_GAP_FACTOR * float(context.gap.min()))


def contact_points(context: PartContext) -> Float[np.ndarray, "n 3"]:
    """Return the part's samples in contact with the parent [m]."""
    return context.part.samples.points[context.gap <= contact_tolerance(context)]


def contact_retention(context: PartContext, motions: list[Motion], signs: list[int]) -> np.ndarray:
    """Return the share of the contact that stays near the parent at a small opening, one per motion.

    signs: sign of the opening, one per motion.
    """
    contact = contact_points(context)
    if len(contact) < 3 or not motions:
        return np.zeros(len(motions))
    contact = contact[:: max(1, len(contact) // MAX_RETENTION_POINTS)]
    moved = []
    for motion, sign in zip(motions, signs, strict=True):
        extent = float(np.ptp(context.part.corners @ motion.axis))
        amount = WATCHED_ANGLE_RAD if motion.kind is JointType.REVOLUTE else WATCHED_TRAVEL_RATIO * extent
        T = motion.transform(sign * amount)
        moved.append(contact @ T[:3, :3].T + T[:3, 3])
    off = context.parent.tree.distance(np.concatenate(moved))
    return (off.reshape(len(motions), -1) < RETAINED_FACTOR * contact_tolerance(context)).mean(1)


def hinge_support(context: PartContext, motions: list[Motion]) -> np.ndarray:
    """Return the support of each hinge line, as long as the part: an array (motions, 3).

    The columns are the shares of the line near the parent and near another movable part, and the share near the parent of the
    line mirrored at the part's center (its free side, if there is one).
    """
    if not motions:
        return np.zeros((0, 3))
    points, lines = context.part.samples.points, []
    for motion in motions:
        along = points @ motion.axis
        at = np.linspace(along.min(), along.max(), LINE_POINTS) - motion.origin @ motion.axis
        line = motion.origin + at[:, None] * motion.axis
        arm = context.body_obb.center - motion.origin
        lines += [line, line + 2 * (arm - (arm @ motion.axis) * motion.axis)]
    probe = np.concatenate(lines)
    reach = context.config.support * context.tolerance_length
    parent = (context.parent.tree.distance(probe) < reach).reshape(len(motions), 2, LINE_POINTS).mean(2)
    other = np.zeros(len(motions))
    if context.other_surface is not None:
        near = context.other_surface.tree.distance(probe) < reach
        other = near.reshape(len(motions), 2, LINE_POINTS).mean(2)[:, 0]
    return np.stack([parent[:, 0], other, parent[:, 1]], 1)
