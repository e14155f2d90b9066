"""Decode picked points, normals and arrows into motions (paper, 3.3).

Points give a hinge line, a plane normal gives an axis, and arrows give a slide.
"""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.motion.part_context import PartContext
from anymesh.types import JointType, Motion

TRIALS = 200  # planes tried by RANSAC


def plane_normal(points: Float[np.ndarray, "n 3"], tolerance: float, seed: int) -> Float[np.ndarray, " 3"]:
    """Fit a plane to points by RANSAC with `tolerance` [m]; return its unit normal."""
    rng = np.random.default_rng(seed)
    best, most = np.arange(len(points)), 2
    for trio in rng.integers(0, len(points), (TRIALS, 3)) if len(points) > 3 else ():
        a, b, c = points[trio]
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal)
        if length < 1e-12:
            continue
        on = np.flatnonzero(np.abs((points - a) @ (normal / length)) < tolerance)
        if len(on) > most:
            best, most = on, len(on)
    mine = points[best]
    normal = np.linalg.svd(mine - mine.mean(0), full_matrices=True)[2][2]
    return normal / np.linalg.norm(normal)


def hinge(
    picked: Float[np.ndarray, "k 3"], normal: Float[np.ndarray, " 3"], axis: Float[np.ndarray, " 3"] | None = None
) -> Motion:
    """Return the line through two or more points, or through one point along its axis.

    axis: axis of a single picked point. If it is None or NaN, the normal of the connecting area's plane is used.
    """
    if len(picked) == 1:
        own = axis is not None and not np.isnan(axis).any()
        along, source = (axis, "axis at the point picked") if own else (normal, "normal at the point picked")
        return Motion(JointType.REVOLUTE, along / np.linalg.norm(along), picked[0], source)
    middle = picked.mean(0)
    axis = np.linalg.svd(picked - middle, full_matrices=False)[2][0]
    return Motion(JointType.REVOLUTE, axis / np.linalg.norm(axis), middle, f"line through the {len(picked)} points picked")


def surface_directions(context: PartContext) -> Float[np.ndarray, "4 3"]:
    """Return both directions along the two sides of the part that are parallel to the surface."""
    a, b = (context.body_obb.axes[k] for k in context.face_axes)
    return np.stack([a, -a, b, -b])


def prismatic(direction: Float[np.ndarray, " 3"], context: PartContext, source: str) -> Motion:
    """Return the prismatic motion of a part along a direction."""
    return Motion(JointType.PRISMATIC, direction / np.linalg.norm(direction), context.part.box.center, source)
