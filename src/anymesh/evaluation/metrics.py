"""How far a joint is from the true one. Lengths in the units of what goes in; axes are unit vectors.

What is published for positions is the distance of two lines in space. It has two faults. Near parallel its formula is
ill-conditioned: hinges a door's width apart that happen to cross a mile off score 0; below `NEARLY_PARALLEL` they are
compared at the part instead, as the field does, so the figure jumps there. And it is nearly blind: any two lines in a plane
score 0. Both are the price of a figure that others publish; `distance_at` and `displacement` are continuous and see all.
"""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.types import JointType

NEARLY_PARALLEL = np.deg2rad(1.0)  # below, the distance of skew lines is ill-defined
BOTH_WAYS = 0.5  # a range whose smaller side is more than this share of the larger opens both ways
Vector = Float[np.ndarray, " 3"]
Limits = tuple[float, float] | None


def angle_error(a: Vector, b: Vector) -> float:
    """Angle between two axes [deg], whatever their signs."""
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), abs(float(a @ b)))))


def line_distance(p: Vector, a: Vector, q: Vector, b: Vector, center: Vector | None = None) -> float:
    """Distance of the lines p + s a and q + t b.

    Where they are nearly parallel: the mean of how far each is from the other, level with `center` (None: between p and q).
    """
    normal = np.cross(a, b)
    sine = float(np.linalg.norm(normal))
    if sine < np.sin(NEARLY_PARALLEL):
        at = (p + q) / 2 if center is None else center
        return (distance_at(at, p, a, q, b) + distance_at(at, q, b, p, a)) / 2
    return abs(float((q - p) @ normal)) / sine


def point_distance(point: Vector, q: Vector, b: Vector) -> float:
    """Distance of a point from the line q + t b."""
    return float(np.linalg.norm(np.cross(point - q, b)))


def distance_at(center: Vector, p: Vector, a: Vector, q: Vector, b: Vector) -> float:
    """Distance of the line p + s a from the true line q + t b, at the point of the true line level with `center`.

    Unlike the distance of the lines it sees an axis that only crosses the true one somewhere.
    """
    return point_distance(q + float((center - q) @ b) * b, p, a)


def range_iou(a: Limits, b: Limits) -> float:
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


def opening_side(limits: Limits) -> int:
    """The way along its axis in which a joint opens, 1 or -1: where its range is larger, or positive."""
    return -1 if limits is not None and limits[0] + limits[1] < 0 else 1


def opens_both_ways(limits: Limits) -> bool:
    """Whether neither side of the range is the opening one; so it is with an endless joint."""
    return limits is None or min(limits[1], -limits[0]) > BOTH_WAYS * max(limits[1], -limits[0])
