"""A set of faces made ready for questions: oriented normals, what is solid, samples, rays."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.geometry.boxes import OrientedBox, fit_box
from anymesh.geometry.distance_ import TriangleTree, winding_number
from anymesh.geometry.sampling import SurfacePoints, spread_points
from anymesh.geometry.topology import Components, components
from anymesh.rendering.raycast_ import RayScene
from anymesh.types import Mesh
from anymesh.types.triangles import bounds_of, normals_and_areas

SAMPLES = 3000  # surface points a shape; enough for a share of 1 % to be 30 points


@dataclass(frozen=True, eq=False)
class KnownFaces:
    """What is computed once for a shape and all that are taken from it.

    positions: (V, 3) distinct corner positions in lexical order, also of faces that were not taken [m]; corner: (F, 3) the
    position of each corner; areas: (F,) [m^2].
    """

    positions: Float[np.ndarray, "V 3"]
    corner: Int[np.ndarray, "F 3"]
    areas: Float[np.ndarray, " F"]

    @classmethod
    def of(cls, triangles: Float[np.ndarray, "F 3 3"]) -> KnownFaces:
        """Of the faces of a whole object."""
        positions, corner = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
        return cls(positions, corner.reshape(-1, 3), normals_and_areas(triangles)[1])

    def take(self, index: np.ndarray) -> KnownFaces:
        """Of some of the faces."""
        return KnownFaces(self.positions, self.corner[index], self.areas[index])

    @cached_property
    def compact(self) -> tuple[Float[np.ndarray, "n 3"], Int[np.ndarray, "F 3"]]:
        """The positions that these faces have, in lexical order, and the faces as indices of them."""
        used = np.zeros(len(self.positions), bool)
        used[self.corner.reshape(-1)] = True
        return self.positions[used], (np.cumsum(used) - 1)[self.corner]


@dataclass(frozen=True, eq=False)
class FaceSet:
    """Triangles with outward normals where the surface is closed.

    triangles: (F, 3, 3) [m]; normals: (F, 3) unit, outward for solid faces, else as wound; solid: (F,) the face belongs to
    a closed component; faces: (F,) the faces' numbers in the mesh.
    """

    triangles: Float[np.ndarray, "F 3 3"]
    normals: Float[np.ndarray, "F 3"]
    solid: Bool[np.ndarray, " F"]
    faces: Int[np.ndarray, " F"]
    seed: int = 0
    known: KnownFaces | None = None

    @cached_property
    def areas(self) -> Float[np.ndarray, " F"]:
        """Area of every face [m^2]."""
        return normals_and_areas(self.triangles)[1] if self.known is None else self.known.areas

    @cached_property
    def lowest(self) -> Float[np.ndarray, "F 3"]:
        """Lower corner of the axis-aligned box of every face [m]."""
        a, b, c = self.triangles.transpose(1, 0, 2)
        return np.minimum(np.minimum(a, b), c)

    @cached_property
    def highest(self) -> Float[np.ndarray, "F 3"]:
        """Upper corner of the axis-aligned box of every face [m]."""
        a, b, c = self.triangles.transpose(1, 0, 2)
        return np.maximum(np.maximum(a, b), c)

    @cached_property
    def tree(self) -> TriangleTree:
        """For exact distances to these triangles."""
        return TriangleTree(self.triangles)

    @cached_property
    def scene(self) -> RayScene:
        """For casting rays at these triangles."""
        if self.known is not None:
            return RayScene(*self.known.compact)
        corners = self.triangles.reshape(-1, 3)
        return RayScene(corners, np.arange(len(corners)).reshape(-1, 3))

    @cached_property
    def corners(self) -> Float[np.ndarray, "n 3"]:
        """The distinct corner positions."""
        return np.unique(self.triangles.reshape(-1, 3), axis=0) if self.known is None else self.known.compact[0]

    @cached_property
    def samples(self) -> SurfacePoints:
        """Points spread evenly by area, with outward normals."""
        points, faces = spread_points(self.triangles, self.areas, SAMPLES, self.seed)
        return SurfacePoints(points, self.normals[faces], faces)

    @cached_property
    def box(self) -> OrientedBox:
        """The smallest box along the shape's own directions."""
        return fit_box(self.corners, self.normals, self.areas)

    @cached_property
    def bounds(self) -> Float[np.ndarray, "2 3"]:
        """Axis-aligned bounds [m]."""
        return bounds_of(self.triangles.reshape(-1, 3))

    @property
    def area(self) -> float:
        """Surface area [m^2]."""
        return float(self.areas.sum())

    @property
    def slender(self) -> bool:
        """Whether it has far less surface than its box: a bar, a hoop, a frame."""
        a, b, c = self.box.half
        return bool(self.area < 0.6 * 8 * (a * b + b * c + a * c))

    def take(self, index: np.ndarray) -> FaceSet:
        """The shape of some of the faces (index into this shape, or a mask)."""
        known = None if self.known is None else self.known.take(index)
        return FaceSet(self.triangles[index], self.normals[index], self.solid[index], self.faces[index], self.seed, known)

    def prepared(self) -> FaceSet:
        """The same shape, for taking many others from it."""
        return replace(self, known=KnownFaces.of(self.triangles))


@dataclass(frozen=True, eq=False)
class MeshSurface:
    """The whole object's shape, and the connected components of its welded surface."""

    shape: FaceSet
    components: Components
    void: Bool[np.ndarray, " c"]  # components that are the walls of a closed cavity in another
    vertices: Float[np.ndarray, "V 3"]
    diagonal: float


def mesh_surface(mesh: Mesh, seed: int = 0) -> MeshSurface:
    """Orients and prepares a mesh; the mesh itself is not changed."""
    parts = components(mesh.vertices, mesh.faces)
    void = _voids(mesh, parts)
    flip = (parts.flip & ~void)[parts.label]
    normals = np.where(flip[:, None], -mesh.face_normals, mesh.face_normals)
    shape = FaceSet(mesh.triangles, normals, parts.solid[parts.label], np.arange(len(mesh.faces)), seed)
    return MeshSurface(shape, parts, void, mesh.vertices, mesh.diagonal)


def _voids(mesh: Mesh, parts: Components) -> Bool[np.ndarray, " c"]:
    """Inside-out components within a solid one: walls of its cavities, not things of their own."""
    void = np.zeros(parts.count, bool)
    solid, inverted = np.flatnonzero(parts.solid & ~parts.flip), np.flatnonzero(parts.flip)
    if not (len(solid) and len(inverted)):
        return void
    order = np.argsort(parts.label, kind="stable")
    start = np.searchsorted(parts.label[order], np.arange(parts.count + 1))
    triangles = mesh.triangles[order]
    low = np.minimum.reduceat(triangles.min(1), start[:-1])[solid]
    high = np.maximum.reduceat(triangles.max(1), start[:-1])[solid]
    points = triangles[start[inverted]].mean(1)  # one on each inverted component
    for c, point in zip(inverted, points, strict=True):
        for s in solid[((point > low) & (point < high)).all(1)]:
            faces = mesh.faces[order[start[s] : start[s + 1]]]
            if winding_number(point[None], mesh.vertices, faces)[0] > 0.5:
                void[c] = True
                break
    return void
