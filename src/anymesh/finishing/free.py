"""Check whether a completed part still moves as far as before."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.config import ArticulationConfig
from anymesh.finishing.scenes import Growing
from anymesh.geometry.kinematics import joint_motion
from anymesh.geometry.sweep import Obstacles, free_amount
from anymesh.geometry.topology import components
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.types import Joint, JointType
from anymesh.types.triangles import normals_and_areas

STEPS = 24  # steps of a sweep from rest to a limit
LOSS = 0.02  # share of its range that a joint may lose


NONE = np.zeros((0, 3, 3))


def moves_freely(
    part: int,
    growing: Growing,
    before: Growing,
    *,
    added: Float[np.ndarray, "n 3 3"] = NONE,
    beside: Float[np.ndarray, "m 3 3"] = NONE,
) -> bool:
    """Return whether a part still moves as far towards both limits as it did `before`.

    The part moves with its descendants and the triangles `added`, among the other parts and the triangles `beside`.
    """
    joint = growing.scenes.joint[part]
    if joint.type is JointType.FIXED:
        return True
    scenes = growing.scenes
    carried = [k for k in scenes.order if k == part or part in scenes.carriers(k)]
    others = [k for k in scenes.order if k not in carried]
    tolerance = ArticulationConfig().penetration * scenes.diagonal
    own, rest = (np.concatenate([growing.triangles(*k), new]) for k, new in ((carried, added), (others, beside)))
    after = Obstacles(shape_of(own), shape_of(rest), tolerance)
    motion = joint_motion(joint)
    for sign, most in limits_of(joint):
        now = free_amount(after, motion, sign, most, STEPS)[0]
        if now < (1 - LOSS) * most:
            old, about = (shape_of(before.triangles(*k)) for k in (carried, others))
            if now < free_amount(Obstacles(old, about, tolerance), motion, sign, most, STEPS)[0] - LOSS * most:
                return False
    return True


def limits_of(joint: Joint) -> list[tuple[int, float]]:
    """Return sign and distance to each limit that is not at rest [rad or m]; half a turn each way without limits."""
    low, high = (-np.pi, np.pi) if joint.limits is None else joint.limits
    return [(sign, amount) for sign, amount in ((1, float(high)), (-1, -float(low))) if amount > 0]


def shape_of(triangles: Float[np.ndarray, "n 3 3"]) -> TriangleSet:
    """Convert triangles to a set for sweeps; closed components are oriented outwards."""
    corners = triangles.reshape(-1, 3)
    surface_components = components(corners, np.arange(len(corners)).reshape(-1, 3))
    normals = normals_and_areas(triangles)[0]
    return TriangleSet(
        triangles,
        np.where(surface_components.flip[:, None], -normals, normals),
        surface_components.solid[surface_components.label],
        np.arange(len(triangles)),
    )
