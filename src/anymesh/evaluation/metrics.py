"""Errors of a joint against the true one. Lengths are in the units of the inputs; axes are unit vectors.

The published position error is the distance of two lines in space. It has two flaws. It is ill-conditioned for nearly parallel
lines: hinges a door's width apart that cross far away score 0. Below `NEARLY_PARALLEL` they are therefore compared at the part,
as is common, which makes the error discontinuous there.
And it is insensitive: any two lines in a plane score 0. It is kept because others publish it; `distance_at` and `displacement`
are continuous and capture all errors.
"""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.types import JointType

NEARLY_PARALLEL = np.deg2rad(1.0)  # below this angle, the distance of skew lines is ill-defined
BOTH_WAYS = 0.5  # a range opens both ways if its smaller side is more than this share of the larger
Vector = Float[np.ndarray, " 3"]
Limits = tuple[float, float] | None


def angle_error(a: Vector, b: Vector) -> float:
    """Compute the angle between two axes [deg], ignoring their signs."""
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), abs(float(a @ b)))))


def line_distance(p: Vector, a: Vector, q: Vector, b: Vector, center: Vector | None = None) -> float:
    """Compute the distance of the lines p + s a and q + t b.

    For nearly parallel lines: the mean of their distances from each other, level with `center` (None: between p and q).
    """
    normal = np.cross(a, b)
    sine = float(np.linalg.norm(normal))
    if sine < np.sin(NEARLY_PARALLEL):
        at = (p + q) / 2 if center is None else center
        return (distance_at(at, p, a, q, b) + distance_at(at, q, b, p, a)) / 2
    return abs(float((q - p) @ normal)) / sine


def point_distance(point: Vector, q: Vector, b: Vector) -> float:
    """Compute the distance of a point from the line q + t b."""
    return float(np.linalg.norm(np.cross(point - q, b)))


def distance_at(center: Vector, p: Vector, a: Vector, q: Vector, b: Vector) -> float:
    """Compute the distance of the line p + s a from the true line q + t b, at the point of the true line level with `center`.

    Unlike the distance of the lines, it detects an axis that only crosses the true one somewhere.
    """
    return point_distance(q + float((center - q) @ b) * b, p, a)


def range_iou(a: Limits, b: Limits) -> float:
    """Compute the overlap of two ranges over their union; 1 if both are endless."""
    if a is None or b is None:
        return float(a is None and b is None)
    overlap = max(0.0, min(a[1], b[1]) - max(a[0], b[0]))
    union = max(a[1], b[1]) - min(a[0], b[0])
    return overlap / union if union > 0 else 1.0


def same_motion(a: JointType, b: JointType) -> bool:
    """Return whether two types have the same kind of motion: continuous joints rotate as revolute ones do."""
    turning = (JointType.REVOLUTE, JointType.CONTINUOUS)
    return a is b or (a in turning and b in turning)


def opening_side(limits: Limits) -> int:
    """Return the opening direction of a joint along its axis, 1 or -1: the side with the larger range, or positive."""
    return -1 if limits is not None and limits[0] + limits[1] < 0 else 1


def opens_both_ways(limits: Limits) -> bool:
    """Return whether neither side of the range is the opening one, as for continuous joints."""
    return limits is None or min(limits[1], -limits[0]) > BOTH_WAYS * max(limits[1], -limits[0])
