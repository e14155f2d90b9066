"""Exact distances from points to triangles, by libigl (MPL-2)."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int

from anymesh.types.triangles import unshared


def distance_to_mesh(
    points: Float[np.ndarray, "n 3"], vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"]
) -> tuple[Float[np.ndarray, " n"], Int[np.ndarray, " n"], Float[np.ndarray, "n 3"]]:
    """Return the distance to the closest triangle [units of the input], its index, and the closest point on it.

    Raise ValueError for no triangles.
    """
    if len(points) == 0:
        return np.zeros(0), np.zeros(0, np.int64), np.zeros((0, 3))
    return TriangleTree(vertices[faces]).nearest(points)


class TriangleTree:
    """A bounding box tree over triangles, built once for many queries. Raise ValueError for no triangles."""

    def __init__(self, triangles: Float[np.ndarray, "F 3 3"]) -> None:
        import igl

        if not len(triangles):  # libigl's search would end the process
            raise ValueError("found no triangles to measure distances to; at least one is needed")
        vertices, self._faces = unshared(triangles)
        self._vertices = np.ascontiguousarray(vertices, np.float64)
        self._tree = igl.AABB()
        self._tree.init(self._vertices, self._faces)

    def nearest(
        self, points: Float[np.ndarray, "n 3"]
    ) -> tuple[Float[np.ndarray, " n"], Int[np.ndarray, " n"], Float[np.ndarray, "n 3"]]:
        """Return the distance to the closest triangle [units of the input], its index, and the closest point on it."""
        if len(points) == 0:
            return np.zeros(0), np.zeros(0, np.int64), np.zeros((0, 3))
        probe = np.ascontiguousarray(points, np.float64)
        squared, face, closest = self._tree.squared_distance(self._vertices, self._faces, probe)
        return np.sqrt(np.maximum(np.atleast_1d(squared), 0)), np.atleast_1d(face).astype(np.int64), np.atleast_2d(closest)

    def distance(self, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, " n"]:
        """Return the distance of each point to the closest triangle."""
        return self.nearest(points)[0]


def distance_to_triangles(points: Float[np.ndarray, "n 3"], triangles: Float[np.ndarray, "F 3 3"]) -> Float[np.ndarray, " n"]:
    """Return the distance of each point to the closest of some triangles."""
    return TriangleTree(triangles).distance(points) if len(points) else np.zeros(0)


def winding_number(
    points: Float[np.ndarray, "n 3"], vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"]
) -> Float[np.ndarray, " n"]:
    """Return the winding number of the surface about each point: 1 inside a closed, outward surface, 0 outside."""
    import igl

    winding = igl.winding_number(
        np.ascontiguousarray(vertices, np.float64),
        np.ascontiguousarray(faces, np.int64),
        np.ascontiguousarray(points, np.float64),
    )
    return np.atleast_1d(winding)
