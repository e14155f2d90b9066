"""Tests whether the surfaces of two links cross at a pose, in which case contacts of their shapes are real."""

from __future__ import annotations

from itertools import product

import numpy as np
from jaxtyping import Float

from anymesh.geometry.raycast_ import RayScene
from anymesh.physics.collision.split import outline
from anymesh.types.triangles import normals_and_areas

CORNERS = np.array(list(product((0, 1), repeat=3)))  # of a box: index of its lower or upper bound along x, y, z


class LinkSurface:
    """The triangles of a link in its frame with their edges, for tests of crossing."""

    def __init__(self, triangles: Float[np.ndarray, "n 3 3"]) -> None:
        self.normals, _ = normals_and_areas(triangles)
        self.triangles = triangles
        points, ends = outline(triangles)
        self.bounds = np.stack([points.min(0), points.max(0)])
        self._start, self._end = points[ends[:, 0]], points[ends[:, 1]]
        self._low, self._high = np.minimum(self._start, self._end).T.copy(), np.maximum(self._start, self._end).T.copy()
        self._scene: RayScene | None = None

    def edges_near(self, bounds: Float[np.ndarray, "2 3"]) -> tuple[Float[np.ndarray, "m 3"], Float[np.ndarray, "m 3"]]:
        """Return both ends of the edges that come within some bounds."""
        kept = np.arange(len(self._start))
        for low, high, least, most in zip(self._low, self._high, *bounds, strict=True):
            kept = kept[(high[kept] >= least) & (low[kept] <= most)]
        return self._start[kept], self._end[kept]

    def crossed_by(self, start: Float[np.ndarray, "m 3"], end: Float[np.ndarray, "m 3"], depth: float) -> bool:
        """Return whether an edge, in this frame, crosses a triangle and ends more than `depth` [m] away on both sides."""
        if len(start) == 0:
            return False
        if self._scene is None:
            corners = self.triangles.reshape(-1, 3)
            self._scene = RayScene(corners, np.arange(len(corners)).reshape(-1, 3))
        for origin, direction in ((start, end - start), (end, start - end)):  # the first hit from either end
            hits = self._scene.first_hit(origin, direction, 1.0)
            met = np.flatnonzero(hits.face >= 0)
            slope = np.abs(np.einsum("ij,ij->i", direction[met], self.normals[hits.face[met]]))
            before, behind = slope * hits.distance[met], slope * (1 - hits.distance[met])
            if bool((np.minimum(before, behind) > depth).any()):
                return True
        return False


def cross(a: LinkSurface, T_a: Float[np.ndarray, "4 4"], b: LinkSurface, T_b: Float[np.ndarray, "4 4"], depth: float) -> bool:
    """Return whether the surfaces of two links, placed by their transforms, penetrate by more than `depth` [m]."""
    for one, T_one, other, T_other in ((a, T_a, b, T_b), (b, T_b, a, T_a)):
        T = np.linalg.inv(T_other) @ T_one
        back = np.linalg.inv(T)
        start, end = (p @ T[:3, :3].T + T[:3, 3] for p in one.edges_near(placed_bounds(other, back)))
        if other.crossed_by(start, end, depth):
            return True
    return False


def placed_bounds(surface: LinkSurface, T: Float[np.ndarray, "4 4"]) -> Float[np.ndarray, "2 3"]:
    """Return the bounds of the transformed bounding box of a surface."""
    corners = np.take_along_axis(surface.bounds, CORNERS, axis=0) @ T[:3, :3].T + T[:3, 3]
    return np.stack([corners.min(0), corners.max(0)])
