"""How far a joint is from the true one. Positions are shares of the object's diagonal."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.types import JointType

NEARLY_PARALLEL = np.deg2rad(1.0)  # below, the distance of skew lines is ill-defined


def angle_error(a: Float[np.ndarray, " 3"], b: Float[np.ndarray, " 3"]) -> float:
    """Angle between two axes [deg], whatever their signs."""
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), abs(float(a @ b)))))


def line_distance(
    p: Float[np.ndarray, " 3"], a: Float[np.ndarray, " 3"], q: Float[np.ndarray, " 3"], b: Float[np.ndarray, " 3"]
) -> float:
    """Distance of the lines p + s a and q + t b; of q to the first line where they are nearly parallel."""
    normal = np.cross(a, b)
    sine = float(np.linalg.norm(normal))
    if sine < np.sin(NEARLY_PARALLEL):
        return float(np.linalg.norm(np.cross(q - p, a)))
    return abs(float((q - p) @ normal)) / sine


def distance_at(
    center: Float[np.ndarray, " 3"],
    p: Float[np.ndarray, " 3"],
    a: Float[np.ndarray, " 3"],
    q: Float[np.ndarray, " 3"],
    b: Float[np.ndarray, " 3"],
) -> float:
    """Distance of the line p + s a from the true line q + t b, at the point of the true line level with `center`.

    Unlike the distance of the lines it sees an axis that only crosses the true one somewhere.
    """
    there = q + float((center - q) @ b) * b
    return float(np.linalg.norm(np.cross(there - p, a)))


def range_iou(a: tuple[float, float] | None, b: tuple[float, float] | None) -> float:
    """Overlap of two ranges over their union; 1 when both are endless."""
    if a is None or b is None:
        return float(a is None and b is None)
    overlap = max(0.0, min(a[1], b[1]) - max(a[0], b[0]))
    union = max(a[1], b[1]) - min(a[0], b[0])
    return overlap / union if union > 0 else 1.0


def same_motion(a: JointType, b: JointType) -> bool:
    """Whether two types move alike: a continuous joint turns as a revolute one does."""
    turning = (JointType.REVOLUTE, JointType.CONTINUOUS)
    return a is b or (a in turning and b in turning)
