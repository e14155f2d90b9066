"""Thickening of parts for a model that fails on thin ones."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from anymesh.finishing.protocol import PartMesh
from anymesh.geometry.topology import components, weld
from anymesh.geometry.triangle_set import sample_surface

CORE = (0.05, 0.95)  # quantiles of the surface used to measure thickness, so that a handle does not make a door thick
SAMPLES = 4000


@dataclass(frozen=True, eq=False)
class Thickened:
    """mesh: welded; closed: whether it was a solid before; added: [m] by which it was thickened, 0 if not needed."""

    mesh: PartMesh
    closed: bool
    added: float


def thicken(triangles: Float[np.ndarray, "F 3 3"], min_thickness: float) -> Thickened:
    """Thicken a part whose core is thinner than `min_thickness` of its longest side.

    An open surface gets a back and side walls behind it, so that its visible surface does not move. A closed one is stretched
    along its thin direction about its centre.
    """
    vertices, faces = _welded(triangles)
    parts = components(vertices, faces)
    closed = bool((parts.solid & parts.agree).all())
    points = sample_surface(triangles, SAMPLES, 0).points
    middle = points.mean(0)
    axes = np.linalg.svd(points - middle, full_matrices=False)[2]
    along = (points - middle) @ axes.T
    low, high = np.quantile(along, CORE, axis=0)
    sides = high - low
    missing = float(min_thickness * np.ptp(along, axis=0).max() - sides.min())
    if missing <= 0:
        return Thickened(PartMesh(vertices, faces), closed, 0.0)
    if not closed:
        return Thickened(_solid(vertices, faces, missing), closed, missing)
    thin = axes[sides.argmin()]
    height = (vertices - middle) @ thin
    stretch = missing / max(float(sides.min()), 1e-3 * missing)
    return Thickened(PartMesh(vertices + np.outer(stretch * height, thin), faces), closed, missing)


def _welded(triangles: np.ndarray) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "F 3"]]:
    corners = triangles.reshape(-1, 3)
    _, first, number = np.unique(weld(corners), return_index=True, return_inverse=True)
    faces = number.reshape(-1, 3)
    real = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    return corners[first], faces[real]


def _solid(vertices: np.ndarray, faces: np.ndarray, depth: float) -> PartMesh:
    """Return an open surface with a copy `depth` [m] behind it, and walls along its border."""
    t = vertices[faces]
    cross = np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])
    normal = np.zeros_like(vertices)
    for corner in range(3):
        np.add.at(normal, faces[:, corner], cross)
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    back = vertices - depth * np.divide(normal, length, out=np.zeros_like(normal), where=length > 0)
    edges = np.concatenate([faces[:, [k, (k + 1) % 3]] for k in range(3)])
    key = np.sort(edges, axis=1)
    _, first, count = np.unique(key, axis=0, return_index=True, return_counts=True)
    a, b = edges[first[count == 1]].T
    n = len(vertices)
    walls = np.concatenate([np.stack([b, a, a + n], 1), np.stack([b, a + n, b + n], 1)])
    return PartMesh(np.concatenate([vertices, back]), np.concatenate([faces, faces[:, ::-1] + n, walls]))
