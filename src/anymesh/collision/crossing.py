"""Whether the surfaces of two links go through each other at a pose: the collision that shapes may show, too."""

from __future__ import annotations

from itertools import product

import numpy as np
from jaxtyping import Float

from anymesh.collision.split import outline
from anymesh.rendering.raycast_ import RayScene
from anymesh.types.triangles import normals_and_areas

CORNERS = np.array(list(product((0, 1), repeat=3)))  # of a box: which of its two bounds each takes along x, y, z


class Surface:
    """The triangles of a link in its frame, with its edges, ready to be crossed."""

    def __init__(self, triangles: Float[np.ndarray, "n 3 3"]) -> None:
        self.normals, _ = normals_and_areas(triangles)
        self.triangles = triangles
        points, ends = outline(triangles)
        self.low, self.high = points.min(0), points.max(0)
        self.edges = points[ends]
        self._scene: RayScene | None = None

    def crossed_by(self, edges: Float[np.ndarray, "m 2 3"], depth: float) -> bool:
        """Whether an edge, in this frame, goes through a triangle and ends more than `depth` [m] behind and before it."""
        near = (edges.max(1) >= self.low).all(1) & (edges.min(1) <= self.high).all(1)
        start, way = edges[near, 0], edges[near, 1] - edges[near, 0]
        if self._scene is None:
            corners = self.triangles.reshape(-1, 3)
            self._scene = RayScene(corners, np.arange(len(corners)).reshape(-1, 3))
        for origin, direction in ((start, way), (start + way, -way)):  # the first hit from either end
            hits = self._scene.first_hit(origin, direction, 1.0)
            met = np.flatnonzero(hits.face >= 0)
            slope = np.abs(np.einsum("ij,ij->i", direction[met], self.normals[hits.face[met]]))
            before, behind = slope * hits.distance[met], slope * (1 - hits.distance[met])
            if bool((np.minimum(before, behind) > depth).any()):
                return True
        return False


def cross(a: Surface, T_a: Float[np.ndarray, "4 4"], b: Surface, T_b: Float[np.ndarray, "4 4"], depth: float) -> bool:
    """Whether the surfaces of two links, placed by their transforms, go more than `depth` [m] through each other."""
    for one, T_one, other, T_other in ((a, T_a, b, T_b), (b, T_b, a, T_a)):
        T = np.linalg.inv(T_other) @ T_one
        corners = np.array([one.low, one.high])[CORNERS, [0, 1, 2]] @ T[:3, :3].T + T[:3, 3]
        if (corners.max(0) < other.low).any() or (corners.min(0) > other.high).any():
            return False
        if other.crossed_by(one.edges @ T[:3, :3].T + T[:3, 3], depth):
            return True
    return False
