"""The rotation about the vertical that turns the upright faces of a shape along x and y, so that its yaw does not matter."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from jaxtyping import Float

from anymesh.types import Joint, Mesh

MIN_ALIGNED_SHARE = 0.3  # minimum length of the mean direction of upright faces, modulo a quarter turn; 1 if all agree
MIN_YAW_RAD = float(np.deg2rad(0.5))  # [rad] smaller angles are left, so that files that are nearly straight stay as they are


def straightening(normals: Float[np.ndarray, "F 3"], areas: Float[np.ndarray, " F"]) -> Float[np.ndarray, "4 4"]:
    """Return the rotation about z, by 45 degrees at most, after which most upright faces face along x or y.

    The identity if no direction prevails. areas: of the faces [m^2].
    """
    upright = areas * np.hypot(normals[:, 0], normals[:, 1]) ** 4  # a level face has no direction, and a sloping one hardly any
    mean = np.sum(upright * np.exp(4j * np.arctan2(normals[:, 1], normals[:, 0]))) / max(float(upright.sum()), 1e-300)
    yaw = -float(np.angle(mean)) / 4
    T = np.eye(4)
    if abs(mean) >= MIN_ALIGNED_SHARE and abs(yaw) >= MIN_YAW_RAD:
        T[:2, :2] = [[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]]
    return T


def straight_mesh(mesh: Mesh) -> tuple[Mesh, Float[np.ndarray, "4 4"]]:
    """Return the mesh turned straight, and the rotation; the mesh itself if it is straight."""
    T = straightening(mesh.face_normals, mesh.face_areas)
    return (mesh if (np.eye(4) == T).all() else mesh.transformed(T)), T


def turned_back(joint: Joint, T: Float[np.ndarray, "4 4"]) -> Joint:
    """Return a joint of the turned mesh in the frame from which T turned it."""
    return joint if (np.eye(4) == T).all() else replace(joint, origin=joint.origin @ T[:3, :3], axis=joint.axis @ T[:3, :3])
