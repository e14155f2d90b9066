"""Shapes of boxes, and rigid transforms for invariance tests."""

from __future__ import annotations

import numpy as np
from assets import mesh_of
from scipy.spatial.transform import Rotation

from anymesh.geometry.surface import mesh_surface
from anymesh.geometry.triangle_set import TriangleSet


def move(seed: int, far: float = 3.0) -> np.ndarray:
    """Return a random rigid transform (4, 4)."""
    T = np.eye(4)
    T[:3, :3] = Rotation.random(random_state=seed).as_matrix()
    T[:3, 3] = np.random.default_rng(seed).uniform(-far, far, 3)
    return T


def apply(T: np.ndarray, points: np.ndarray) -> np.ndarray:
    return points @ T[:3, :3].T + T[:3, 3]


def shape_of(*pieces, T: np.ndarray | None = None) -> TriangleSet:
    """Return the shape of (vertices, faces) pieces, moved by T."""
    mesh, _ = mesh_of(pieces)
    return mesh_surface(mesh if T is None else mesh.transformed(T)).shape
