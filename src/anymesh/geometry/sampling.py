"""Sampling of points on surfaces."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int

from anymesh.types.triangles import normals_and_areas


@dataclass(frozen=True, eq=False)
class SurfacePoints:
    """Points on a surface with the unit normal and the index of the face that each lies on."""

    points: Float[np.ndarray, "n 3"]
    normals: Float[np.ndarray, "n 3"]
    faces: Int[np.ndarray, " n"]

    def __len__(self) -> int:
        return len(self.points)

    def take(self, index: np.ndarray) -> SurfacePoints:
        """Return the points chosen by an index array or a mask."""
        return SurfacePoints(self.points[index], self.normals[index], self.faces[index])

    def joined(self, other: SurfacePoints) -> SurfacePoints:
        """Return these points and then those of the other; the indices of faces are kept."""
        pairs = (self.points, other.points), (self.normals, other.normals), (self.faces, other.faces)
        return SurfacePoints(*(np.concatenate(pair) for pair in pairs))

    @cached_property
    def moments(self) -> Float[np.ndarray, "n 3"]:
        """Return the moment of each normal about the asset frame's origin [m]."""
        return np.cross(self.points, self.normals)


def spread_directions(count: int) -> Float[np.ndarray, "n 3"]:
    """Return unit vectors spread evenly over the sphere (Fibonacci), from the top down."""
    z = 1 - (2 * np.arange(count) + 1) / count
    turn = np.arange(count) * np.pi * (3 - np.sqrt(5))
    return np.stack([np.sqrt(1 - z * z) * np.cos(turn), np.sqrt(1 - z * z) * np.sin(turn), z], 1)


def sample_surface(triangles: Float[np.ndarray, "F 3 3"], count: int, seed: int, at_least: int = 0) -> SurfacePoints:
    """Sample `count` points, with a number per face proportional to its area.

    Systematic sampling is even, and stable for a seed. If no face has an area, all count the same. `at_least` = 1 adds the
    centroid of every face without points, so that small faces are represented.
    """
    normals, areas = normals_and_areas(triangles)
    points, index = spread_points(triangles, areas, count, seed)
    if at_least:
        unseen = np.setdiff1d(np.flatnonzero(areas > 0), index)
        points = np.concatenate([points, triangles[unseen].mean(1)])
        index = np.concatenate([index, unseen])
    return SurfacePoints(points, normals[index], index)


def spread_points(
    triangles: Float[np.ndarray, "F 3 3"], areas: Float[np.ndarray, " F"], count: int, seed: int
) -> tuple[Float[np.ndarray, "n 3"], Int[np.ndarray, " n"]]:
    """Return the points of `sample_surface` and the face of each, if the areas of the faces are known."""
    rng = np.random.default_rng(seed)
    weights = areas if (areas > 0).any() else np.ones(len(areas))
    ticks = (np.arange(count if len(areas) else 0) + rng.random()) / count * weights.sum()
    index = np.minimum(np.searchsorted(np.cumsum(weights), ticks), len(areas) - 1)
    r1, r2 = np.sqrt(rng.random(len(index))), rng.random(len(index))
    t = triangles[index]
    return (1 - r1)[:, None] * t[:, 0] + (r1 * (1 - r2))[:, None] * t[:, 1] + (r1 * r2)[:, None] * t[:, 2], index
