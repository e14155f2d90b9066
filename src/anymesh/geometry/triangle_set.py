"""Sets of triangles with oriented normals, surface samples, a distance tree and a ray caster, each computed on demand."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.geometry.boxes import OrientedBox, fit_box
from anymesh.geometry.distance_ import TriangleTree
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.sampling import SurfacePoints, spread_points
from anymesh.types.triangles import bounds_of, boxes_meet, corner_bounds, normals_and_areas

SAMPLES = 3000  # surface points per triangle set; a share of 1 % is 30 points
SLANTED = np.array([0.3127, 0.5241, 0.7922])  # direction of the rays that tell inside from outside; along no usual face


@dataclass(frozen=True, eq=False)
class KnownFaces:
    """Data shared by a triangle set and all its subsets.

    positions: (V, 3) distinct corner positions in lexical order, including those of faces that were not taken [m]; corner: (F,
    3) position index of each corner; areas: (F,) [m^2].
    """

    positions: Float[np.ndarray, "V 3"]
    corner: Int[np.ndarray, "F 3"]
    areas: Float[np.ndarray, " F"]

    @classmethod
    def of(cls, triangles: Float[np.ndarray, "F 3 3"]) -> KnownFaces:
        """Build the data of the faces of an object."""
        positions, corner = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
        return cls(positions, corner.reshape(-1, 3), normals_and_areas(triangles)[1])

    def take(self, index: np.ndarray) -> KnownFaces:
        """Return the data of some of the faces."""
        return KnownFaces(self.positions, self.corner[index], self.areas[index])

    @cached_property
    def compact(self) -> tuple[Float[np.ndarray, "n 3"], Int[np.ndarray, "F 3"]]:
        """Return the corner positions of these faces in lexical order, and the faces as indices of them."""
        used = np.zeros(len(self.positions), bool)
        used[self.corner.reshape(-1)] = True
        return self.positions[used], (np.cumsum(used) - 1)[self.corner]


@dataclass(frozen=True, eq=False)
class TriangleSet:
    """Triangles, with outward normals where the surface is closed.

    triangles: (F, 3, 3) [m]; normals: (F, 3) unit, outward for solid faces, else as wound; solid: (F,) whether the face belongs
    to a closed component; faces: (F,) indices in the mesh.
    """

    triangles: Float[np.ndarray, "F 3 3"]
    normals: Float[np.ndarray, "F 3"]
    solid: Bool[np.ndarray, " F"]
    faces: Int[np.ndarray, " F"]
    seed: int = 0
    known: KnownFaces | None = None

    @cached_property
    def areas(self) -> Float[np.ndarray, " F"]:
        """Return the area of each face [m^2]."""
        return normals_and_areas(self.triangles)[1] if self.known is None else self.known.areas

    @property
    def lowest(self) -> Float[np.ndarray, "F 3"]:
        """Return the lower corner of the axis-aligned box of each face [m]."""
        return self._corner_bounds[0]

    @property
    def highest(self) -> Float[np.ndarray, "F 3"]:
        """Return the upper corner of the axis-aligned box of each face [m]."""
        return self._corner_bounds[1]

    @cached_property
    def _corner_bounds(self) -> tuple[Float[np.ndarray, "F 3"], Float[np.ndarray, "F 3"]]:
        return corner_bounds(self.triangles)

    @cached_property
    def tree(self) -> TriangleTree:
        """Return the tree for exact distances to these triangles."""
        return TriangleTree(self.triangles)

    def nearest(self, points: Float[np.ndarray, "n 3"]) -> tuple[Float[np.ndarray, " n"], Int[np.ndarray, " n"]]:
        """Return the distance of each point to these triangles [m], and the index of the nearest triangle.

        Triangles that are further from the bounds of the points than any of them is from one corner are left out before a tree
        is built, which takes longer than the search.
        """
        if not len(points):
            return np.zeros(0), np.zeros(0, np.int64)
        low, high = points.min(0), points.max(0)
        corner = self.corners[((self.corners - (low + high) / 2) ** 2).sum(1).argmin()]
        reach = 1.001 * float(np.linalg.norm(points - corner, axis=1).max())  # rounding must not leave out the corner itself
        near = np.flatnonzero(boxes_meet(self.lowest, self.highest, low - reach, high + reach))
        distance, face, _ = TriangleTree(self.triangles[near]).nearest(points)
        return distance, near[face]

    @cached_property
    def scene(self) -> RayScene:
        """Return the ray caster of these triangles."""
        if self.known is not None:
            return RayScene(*self.known.compact)
        corners = self.triangles.reshape(-1, 3)
        return RayScene(corners, np.arange(len(corners)).reshape(-1, 3))

    @cached_property
    def corners(self) -> Float[np.ndarray, "n 3"]:
        """Return the distinct corner positions [m]."""
        return np.unique(self.triangles.reshape(-1, 3), axis=0) if self.known is None else self.known.compact[0]

    @cached_property
    def samples(self) -> SurfacePoints:
        """Return points sampled evenly by area, with outward normals."""
        points, faces = spread_points(self.triangles, self.areas, SAMPLES, self.seed)
        return SurfacePoints(points, self.normals[faces], faces)

    @cached_property
    def box(self) -> OrientedBox:
        """Return the oriented bounding box."""
        return fit_box(self.corners, self.normals, self.areas)

    @cached_property
    def bounds(self) -> Float[np.ndarray, "2 3"]:
        """Return the axis-aligned bounds [m]."""
        return bounds_of(self.triangles.reshape(-1, 3))

    @cached_property
    def centroid(self) -> Float[np.ndarray, " 3"]:
        """Return the centroid of the surface [m]; of the corners of the faces if they have no area."""
        weights = self.areas if self.area > 0 else np.ones(len(self.areas))
        return weights @ self.triangles.mean(1) / weights.sum()

    def depth(self, points: Float[np.ndarray, "n 3"]) -> float:
        """Return how deep the deepest of some points lies inside a closed solid of these triangles [m], 0 for none."""
        if not len(points) or not len(self.triangles):
            return 0.0
        face = self.scene.first_hit(points, np.repeat(SLANTED[None], len(points), 0)).face
        inside = (face >= 0) & self.solid[face] & (self.normals[face] @ SLANTED > 0)
        return float(self.tree.distance(points[inside]).max()) if inside.any() else 0.0

    @property
    def area(self) -> float:
        """Return the surface area [m^2]."""
        return float(self.areas.sum())

    @property
    def slender(self) -> bool:
        """Return whether the area is far smaller than that of its box, as for a bar, a hoop or a frame."""
        a, b, c = self.box.half
        return bool(self.area < 0.6 * 8 * (a * b + b * c + a * c))

    def take(self, index: np.ndarray) -> TriangleSet:
        """Return a subset of the faces (indices or a mask)."""
        known = None if self.known is None else self.known.take(index)
        return TriangleSet(self.triangles[index], self.normals[index], self.solid[index], self.faces[index], self.seed, known)

    def prepared(self) -> TriangleSet:
        """Return the same faces with the data that subsets share."""
        return replace(self, known=KnownFaces.of(self.triangles))
