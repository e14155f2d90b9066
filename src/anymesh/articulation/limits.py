"""Limits of a joint, from the sweep of its motion."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float

from anymesh.geometry.surroundings import Surroundings
from anymesh.geometry.sweep import free_amount
from anymesh.reasoning.questions import Candidate
from anymesh.types import JointType, Motion

FRONT = 0.35  # a slide less deep than this share of its parent is only a front
ROUND = 0.8  # a part this round that slides outwards without a grip is a button
STROKE = 0.5  # of its height: how far a button goes in at least
BUTTON = 0.06  # a part with less of the object's diagonal that slides outwards is a button, whatever is behind it
CONTROL = 0.25  # a part with less of the object's diagonal may be a button or a trigger


def limits(around: Surroundings, c: Candidate, kind: JointType) -> tuple[float, float] | None:
    """(lower, upper) about the opening axis [rad or m]; None for continuous and fixed joints."""
    match kind:
        case JointType.CONTINUOUS | JointType.FIXED:
            return None
        case JointType.REVOLUTE:
            return _turn(around, c)
        case JointType.PRISMATIC:
            return _slide(around, c)


def opening_motion(c: Candidate) -> Motion:
    """The candidate's motion with the axis turned so that positive opens."""
    return Motion(c.motion.kind, c.motion.axis * c.opens, c.motion.origin, c.motion.source)


def _turn(around: Surroundings, c: Candidate) -> tuple[float, float]:
    config, motion = around.config, opening_motion(c)
    most = np.deg2rad(config.door_most if c.vertical > 0.7 else config.flap_most)
    steps = config.fine_steps * 3
    upper, clear = free_amount(around.obstacles(c.slack), motion, 1, most, steps)
    lower, _ = free_amount(around.obstacles(c.slack), motion, -1, most, steps)
    if not clear:
        upper = _floor(upper, np.deg2rad(1))
    closed = c.role in ("edge", "edge_mid", "asked") and _shut(around)
    lower = 0.0 if closed or lower < np.deg2rad(5) else _floor(lower, np.deg2rad(1))
    if upper < np.deg2rad(2):
        upper = most if lower == 0 else 0.0
    return (0.0 - lower, upper)


def _shut(around: Surroundings) -> bool:
    """Whether the part lies shut: near the parent at both ends of its face, so that inwards is where it came from."""
    near = around.gap < 0.02 * around.scale
    local = around.core.local(around.part.samples.points) / np.maximum(around.core.half, 1e-9)
    return sum(ends_near(local[:, axis], near) for axis in around.face_axes) >= 3


def ends_near(along: Float[np.ndarray, " n"], near: Bool[np.ndarray, " n"]) -> int:
    """Count the ends of a part, of two, that lie near its parent. along: place of each sample, -1 to 1 from end to end."""
    return sum(bool(near[end].sum() > 0.2 * end.sum()) for end in (along > 0.8, along < -0.8))


def _tiny(around: Surroundings) -> bool:
    return around.part.box.diagonal < BUTTON * around.diagonal


def _pressed(around: Surroundings, c: Candidate, inward: float, clear: bool) -> bool:
    """Whether a part is pushed in rather than pulled out: it has no grip, and is a button, or small with room behind it."""
    if around.handle is not None:
        return False
    small = around.part.box.diagonal < CONTROL * around.diagonal
    return _button(around) or (small and not clear and inward > 0.1 * around.part.box.diagonal)


def _button(around: Surroundings) -> bool:
    """Whether what slides outwards can only be a button, whatever is behind it: a tiny part or a round one."""
    return _tiny(around) or around.outline.roundness > ROUND


def _floor(value: float, step: float) -> float:
    return float(np.floor(value / step + 1e-9) * step)


def _slide(around: Surroundings, c: Candidate) -> tuple[float, float]:
    motion = opening_motion(c)
    depth = around.inside_depth(motion.axis)
    extent = float(np.ptp(around.part.corners @ motion.axis))
    outward = c.outward > 0.7
    most = max((1 - around.config.slide_keep) * (depth if outward else extent), 0.01 * around.scale)
    if c.captured:
        most = 2 * around.part.box.diagonal
    behind = float(np.ptp(around.parent.samples.points @ motion.axis))
    if outward and not _tiny(around) and extent < FRONT * behind and around.core.half[2] < 0.3 * around.core.half[1]:
        most = around.config.slide_hidden * behind  # a front whose box the surface does not show
    steps = around.config.fine_steps * 2
    upper, _ = free_amount(around.obstacles(c.slack), motion, 1, most, steps)
    lower, clear = free_amount(around.obstacles(c.slack), motion, -1, most, steps)
    if outward and _pressed(around, c, lower, clear):
        return (0.0 - max(lower, STROKE * extent if _button(around) else 0.0), 0.0)
    if outward or clear or lower < 0.01 * around.scale:
        lower = 0.0
    if upper < 1e-3 * around.scale:
        upper = most if lower == 0 else 0.0
    return (0.0 - lower, upper)
