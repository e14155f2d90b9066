"""Samples with some of their joints moved."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from jaxtyping import Float

from anymesh.evaluation.ground_truth import EvalSample, TrueJoint
from anymesh.geometry.kinematics import carried_links, joint_motion
from anymesh.geometry.surface import mesh_surface
from anymesh.geometry.sweep import Obstacles, free_amount
from anymesh.types import JointType
from anymesh.types.triangles import unshared

MOVED_SHARE = 0.5  # probability that a joint is moved
PENETRATION = 0.003  # of the object's diagonal [m]: depth behind a surface at which a joint is stopped


def posed(sample: EvalSample, positions: Mapping[str, float]) -> EvalSample:
    """Move joints, given by the names of their children, to positions in the truth's units; the others stay at rest.

    The new pose becomes the rest pose of joints and limits: a half open door closes to its lower limit.
    """
    T = link_transforms(sample, positions)
    triangles = sample.mesh.triangles.copy()
    for number, part in enumerate(sample.truth.parts):
        mine = sample.labels == number
        triangles[mine] = triangles[mine] @ T[part.name][:3, :3].T + T[part.name][:3, 3]
    vertices, faces = unshared(triangles)
    mesh = replace(sample.mesh, vertices=vertices, faces=faces, corner_normal=None)
    back = np.linalg.inv(sample.T)
    joints = tuple(_moved(j, back @ T[j.parent] @ sample.T, positions.get(j.child, 0.0)) for j in sample.truth.joints)
    return replace(sample, truth=replace(sample.truth, joints=joints), mesh=mesh, diagonal=2 * sample.unit)


def ajar(sample: EvalSample, rng: np.random.Generator) -> EvalSample:
    """Move about half of the joints, one after the other, to random positions in their ranges, as far as the rest lets them."""
    for child in [j.child for j in sample.truth.joints]:
        (joint,) = (j for j in sample.truth.joints if j.child == child)
        if joint.limits is None or not joint.range_known or rng.random() >= MOVED_SHARE:
            continue
        position = float(rng.uniform(*joint.limits))
        placed = sample.joint(replace(joint, limits=(0.0, position)))
        _, reach = placed.limits or (0.0, 0.0)
        free, _ = free_amount(_obstacles(sample, child), joint_motion(placed), int(np.sign(reach)) or 1, abs(reach), steps=36)
        sample = posed(sample, {child: position * free / max(abs(reach), 1e-12)})
    return sample


def _obstacles(sample: EvalSample, child: str) -> Obstacles:
    """Return the rest of the object around a part and the parts that it carries."""
    asset = sample.asset()
    carried = carried_links(asset, next(j for j in asset.joints if j.child == child))
    moves = np.isin(sample.labels, [k for k, part in enumerate(sample.truth.parts) if part.name in carried])
    shape = mesh_surface(sample.mesh).shape
    moves = moves[shape.faces]
    return Obstacles(shape.take(moves), shape.take(~moves), PENETRATION * 2 * sample.unit)


def link_transforms(sample: EvalSample, positions: Mapping[str, float]) -> dict[str, Float[np.ndarray, "4 4"]]:
    """Return part name -> transform from rest in the mesh's frame; parts that are not a joint's child are static."""
    by_child = {j.child: j for j in sample.truth.joints}
    transforms: dict[str, np.ndarray] = {}

    def of(name: str) -> np.ndarray:
        if name not in transforms:
            joint = by_child.get(name)
            transforms[name] = (
                np.eye(4) if joint is None else of(joint.parent) @ _motion(sample, joint, positions.get(name, 0.0))
            )
        return transforms[name]

    for part in (*sample.truth.parts, *(j.parent for j in sample.truth.joints)):
        of(part if isinstance(part, str) else part.name)
    return transforms


def _motion(sample: EvalSample, joint: TrueJoint, position: float) -> np.ndarray:
    placed = sample.joint(joint)
    slides = joint.type is JointType.PRISMATIC
    scale = float(np.linalg.norm(sample.T[:3, :3] @ joint.axis)) if slides else 1.0
    return joint_motion(placed).transform(position * scale)


def _moved(joint: TrueJoint, T: np.ndarray, position: float) -> TrueJoint:
    """Return the joint moved with its parent (T in the truth's coordinates), with limits relative to its position."""
    limits = None if joint.limits is None else (joint.limits[0] - position, joint.limits[1] - position)
    return replace(joint, origin=T[:3, :3] @ joint.origin + T[:3, 3], axis=T[:3, :3] @ joint.axis, limits=limits)
