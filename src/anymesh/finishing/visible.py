"""Visibility of a mesh from outside at rest."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float

from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.triangle_set import SurfacePoints, sample_surface, spread_directions
from anymesh.types import Mesh

PROBES = 20_000  # points on the surface, besides the centroid of every face
DIRECTIONS = 96  # directions from which each point is viewed
GRAZE = 0.02  # minimum share of directions in which a point must be visible from a side; less is through a gap
RAYS = 50_000  # rays per batch
OFF = 1e-5  # share of the diagonal: distance of ray origins from the surface


def seen_from_outside(
    scene: RayScene, points: Float[np.ndarray, "n 3"], normals: Float[np.ndarray, "n 3"], diagonal: float
) -> Bool[np.ndarray, " n"]:
    """Return which points are visible from far away, from either side. diagonal: of the whole scene."""
    return (escapes(scene, points, normals, diagonal) != 0).any(1)


def escapes(
    scene: RayScene, points: Float[np.ndarray, "n 3"], normals: Float[np.ndarray, "n 3"], diagonal: float
) -> Float[np.ndarray, "n 2"]:
    """Compute the share of all directions in which a point is unobstructed, on the side of its normal and on the other."""
    counts = np.zeros((len(points), 2))
    directions = spread_directions(DIRECTIONS)
    for ways in np.array_split(directions, min(len(directions), 1 + len(points) * len(directions) // RAYS)):
        front = ways @ normals.T > 0
        start = points + OFF * diagonal * np.where(front, 1.0, -1.0)[:, :, None] * normals
        rays = np.repeat(ways * 2 * diagonal, len(points), 0)
        free = scene.first_hit(start.reshape(-1, 3), rays, 1.0).face.reshape(front.shape) < 0
        counts[:, 0] += (free & front).sum(0)
        counts[:, 1] += (free & ~front).sum(0)
    return counts / len(directions)


def visible_faces(mesh: Mesh) -> Bool[np.ndarray, " F"]:
    """Return which faces are at least partly visible from outside, for any winding."""
    scene = RayScene(mesh.vertices, mesh.faces)
    middles = SurfacePoints(mesh.triangles.mean(1), mesh.face_normals, np.arange(len(mesh.faces)))
    seen = np.zeros(len(mesh.faces), bool)
    for probe in (middles, sample_surface(mesh.triangles, PROBES, 0)):
        seen[probe.faces[seen_from_outside(scene, probe.points, probe.normals, mesh.diagonal)]] = True
    return seen
