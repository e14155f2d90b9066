"""Exact distances from points to triangles, by libigl (MPL-2)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int

from anymesh.types import Brief
from anymesh.types.triangles import bounds_of, boxes_meet, unshared


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


def distances_within(
    points: Float[np.ndarray, "n 3"], triangles: Float[np.ndarray, "F 3 3"], limit: float
) -> Float[np.ndarray, " n"]:
    """Return the distance of each point to the closest of some triangles, inf if it is `limit` or more.

    The search for a point ends once nothing is left within the limit, which takes less time than finding what is farther.
    """
    import igl

    if not len(points) or not len(triangles):
        return np.full(len(points), np.inf)
    vertices, faces = (np.ascontiguousarray(array) for array in unshared(triangles))
    probe, kind = np.ascontiguousarray(points, np.float64), igl.SignedDistanceType.SIGNED_DISTANCE_TYPE_UNSIGNED
    distance = np.atleast_1d(igl.signed_distance(probe, vertices, faces, kind, 0.0, limit)[0])
    return np.where(np.isnan(distance), np.inf, distance)


GUESSED_STRIDE, GUESSED_SHARE = 30, 0.62  # one of so many points is measured; share of them within the distance of half of all


@dataclass(frozen=True, eq=False)
class NearestSearch(Brief):
    """The search for the triangles nearest to some points.

    Triangles that are further from the bounds of the points than any of them is from one corner are left out before a tree is
    built, which takes longer than the search.

    corners: of the triangles; boxes: lower and upper corner of the axis-aligned box of each triangle.
    """

    points: Float[np.ndarray, "n 3"]
    triangles: Float[np.ndarray, "F 3 3"]
    corners: Float[np.ndarray, "k 3"]
    boxes: tuple[Float[np.ndarray, "F 3"], Float[np.ndarray, "F 3"]]

    @cached_property
    def _rows(self) -> Int[np.ndarray, " m"]:
        low, high = bounds_of(self.points)
        corner = self.corners[((self.corners - (low + high) / 2) ** 2).sum(1).argmin()]
        return self._within(float(np.linalg.norm(self.points - corner, axis=1).max()))

    def _within(self, reach: float) -> Int[np.ndarray, " m"]:
        """Return the triangles within `reach` of the bounds of the points; rounding must not leave out one at this distance."""
        low, high = bounds_of(self.points)
        return np.flatnonzero(boxes_meet(*self.boxes, low - 1.001 * reach, high + 1.001 * reach))

    @cached_property
    def _tree(self) -> TriangleTree:
        return TriangleTree(self.triangles[self._rows])

    def nearest(self, which: Int[np.ndarray, " k"]) -> tuple[Float[np.ndarray, " k"], Int[np.ndarray, " k"]]:
        """Return the distance of some of the points [units of the input], and the index of the nearest triangle."""
        if not len(which):
            return np.zeros(0), np.zeros(0, np.int64)
        distance, face, _ = self._tree.nearest(self.points[which])
        return distance, self._rows[face]

    def within(self, limit: float) -> Float[np.ndarray, " n"]:
        """Return the distance of each point [units of the input], inf if it is `limit` or more."""
        return distances_within(self.points, self.triangles[self._within(limit)], limit)

    def nearer_half(self, least: float) -> Float[np.ndarray, " n"]:
        """Return the distance of each point [units of the input]; inf for some that are farther than half of all and `least`.

        The limit of the search is estimated from a few points.
        """
        if not len(self.points):
            return np.zeros(0)
        few = np.sort(self.nearest(np.arange(0, len(self.points), GUESSED_STRIDE))[0])
        limit = max(least, float(few[int(GUESSED_SHARE * (len(few) - 1))]))
        distance = self.within(limit)
        enough = np.isfinite(distance).sum() > len(distance) // 2
        return distance if enough else self.nearest(np.arange(len(distance)))[0]


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
