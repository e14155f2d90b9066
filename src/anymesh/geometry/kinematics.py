"""Forward kinematics of an asset."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from jaxtyping import Float

from anymesh.types import Asset, Joint, JointType, KnownJoint, Mesh, Motion
from anymesh.types.motion import SLIDING, led
from anymesh.types.triangles import transformed

Position = float | Float[np.ndarray, " 3"]  # [rad or m]; of a ball also a rotation vector [rad], in the asset frame at rest


def joint_motion(joint: Joint | KnownJoint) -> Motion:
    """Return the motion of a joint that is not fixed and has a unit axis.

    A ball swings about a line across its arm, and what is free lifts off along its axis.
    """
    kind = JointType.PRISMATIC if joint.type in SLIDING else JointType.REVOLUTE
    axis = joint.axis
    if joint.type is JointType.BALL:
        across = np.cross(axis, np.eye(3)[np.abs(axis).argmin()])
        axis = across / np.linalg.norm(across)
    return Motion(kind, axis, joint.origin, "joint", joint.pitch)


def joint_transform(joint: Joint | KnownJoint, position: Position) -> Float[np.ndarray, "4 4"]:
    """Return the transform of a joint's child at `position`, in the asset frame at rest."""
    if isinstance(position, np.ndarray):
        angle = float(np.linalg.norm(position))
        return Motion(JointType.REVOLUTE, position / angle, joint.origin, "turn").transform(angle) if angle else np.eye(4)
    return np.eye(4) if joint.type is JointType.FIXED else joint_motion(joint).transform(position)


def link_transforms(asset: Asset, positions: Mapping[str, Position]) -> dict[str, Float[np.ndarray, "4 4"]]:
    """Return the transform from rest of each part, for joint positions by name (0 by default); followers are led."""
    positions = led(asset.joints, positions)
    by_child = {j.child: j for j in asset.joints}
    transforms = {asset.segmentation.parts[0].name: np.eye(4)}

    def of(name: str) -> np.ndarray:
        if name not in transforms:
            joint = by_child[name]
            transforms[name] = of(joint.parent) @ joint_transform(joint, positions.get(joint.name, 0.0))
        return transforms[name]

    for part in asset.segmentation.parts:
        of(part.name)
    return transforms


def carried_links(asset: Asset, joint: Joint) -> list[str]:
    """Return the names of the links that a joint moves: its child and all its descendants."""
    children: dict[str, list[str]] = {}
    for j in asset.joints:
        children.setdefault(j.parent, []).append(j.child)
    links = [joint.child]
    for name in links:
        links += children.get(name, ())
    return links


def posed(asset: Asset, positions: Mapping[str, Position]) -> Mesh:
    """Return the mesh with its parts moved; face indices stay, vertices are shared within a part only."""
    transforms, mesh, face_part = link_transforms(asset, positions), asset.mesh, asset.segmentation.face_part
    vertices, faces, count = [], np.empty_like(mesh.faces), 0
    normal = None if mesh.corner_normal is None else mesh.corner_normal.copy()
    for number, part in enumerate(asset.segmentation.parts):
        mine, T = np.flatnonzero(face_part == number), transforms[part.name]
        used = np.zeros(len(mesh.vertices), bool)
        used[mesh.faces[mine]] = True
        faces[mine] = (np.cumsum(used) - 1 + count)[mesh.faces[mine]]
        vertices.append(transformed(mesh.vertices[used], T))
        count += len(vertices[-1])
        if normal is not None:
            normal[mine] = normal[mine] @ T[:3, :3].T.astype(np.float32)
    return replace(mesh, vertices=np.concatenate(vertices), faces=faces, corner_normal=normal)
