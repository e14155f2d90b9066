"""Distance by which a joint misplaces its part: type, axis, origin and opening side in one length."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from jaxtyping import Float

from anymesh.evaluation.ground_truth import TrueJoint
from anymesh.evaluation.metrics import opening_side, opens_both_ways, same_motion
from anymesh.geometry.kinematics import joint_transform
from anymesh.types import Joint, JointType

TURNED = np.pi / 6  # [rad] by which rotating joints are opened
TRAVEL = 0.5  # share of the travel by which slides are opened


def displacement(points: Float[np.ndarray, "N 3"], predicted: Joint, true: TrueJoint, size: float) -> float:
    """Compute the mean distance of the true part's points between the poses of the found and the true joint.

    Hinges are opened by 30 degrees, slides by half the true travel, each joint towards its own opening side, so that a wrong
    side adds to the distance.
    A found joint of another type moves by 30 degrees, or half its own travel. If the true joint opens both ways, is continuous,
    or has no known range, the better of both directions counts.
    `size` of the part replaces an unknown travel. `true`: in the frame of the points, with a unit axis.
    """
    true = true if true.range_known else replace(true, limits=None)
    sides = (1, -1) if opens_both_ways(true.limits) else (opening_side(true.limits),)
    return min(_apart(points, predicted, true, side, size) for side in sides)


def _apart(points: Float[np.ndarray, "N 3"], predicted: Joint, true: TrueJoint, side: int, size: float) -> float:
    ours = opening_side(predicted.limits)
    amount = _amount(true, side, size)
    own = amount if same_motion(predicted.type, true.type) else _amount(predicted, ours, size)
    T = joint_transform(true, side * amount) - joint_transform(predicted, ours * own)
    return float(np.linalg.norm(points @ T[:3, :3].T + T[:3, 3], axis=1).mean())


def _amount(joint: Joint | TrueJoint, side: int, size: float) -> float:
    """Return the amount by which a joint is opened [rad or m], without sign."""
    if joint.type is not JointType.PRISMATIC:
        return TURNED
    return TRAVEL * (size if joint.limits is None else side * joint.limits[0 if side < 0 else 1])
