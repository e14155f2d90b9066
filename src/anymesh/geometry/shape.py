"""A set of faces made ready for questions: oriented normals, what is solid, samples, rays."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.geometry.boxes import Box, fit_box
from anymesh.geometry.distance_ import TriangleTree, winding_number
from anymesh.geometry.sampling import SurfacePoints, sample_surface
from anymesh.geometry.topology import Components, components
from anymesh.rendering.raycast_ import RayScene
from anymesh.types import Mesh
from anymesh.types.triangles import normals_and_areas

SAMPLES = 3000  # surface points a shape; enough for a share of 1 % to be 30 points


@dataclass(frozen=True, eq=False)
class Shape:
    """Triangles with outward normals where the surface is closed.

    triangles: (F, 3, 3) [m]; normals: (F, 3) unit, outward for solid faces, else as wound; solid: (F,) the face belongs to
    a closed component; faces: (F,) the faces' numbers in the mesh.
    """

    triangles: Float[np.ndarray, "F 3 3"]
    normals: Float[np.ndarray, "F 3"]
    solid: Bool[np.ndarray, " F"]
    faces: Int[np.ndarray, " F"]
    seed: int = 0

    @cached_property
    def areas(self) -> Float[np.ndarray, " F"]:
        """Area of every face [m^2]."""
        return normals_and_areas(self.triangles)[1]

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
        corners = self.triangles.reshape(-1, 3)
        return RayScene(corners, np.arange(len(corners)).reshape(-1, 3))

    @cached_property
    def corners(self) -> Float[np.ndarray, "n 3"]:
        """The distinct corner positions."""
        return np.unique(self.triangles.reshape(-1, 3), axis=0)

    @cached_property
    def samples(self) -> SurfacePoints:
        """Points spread evenly by area, with outward normals."""
        s = sample_surface(self.triangles, SAMPLES, self.seed)
        return SurfacePoints(s.points, self.normals[s.faces], s.faces)

    @cached_property
    def box(self) -> Box:
        """The smallest box along the shape's own directions."""
        return fit_box(self.corners, self.normals, self.areas)

    @cached_property
    def bounds(self) -> Float[np.ndarray, "2 3"]:
        """Axis-aligned bounds [m]."""
        corners = self.triangles.reshape(-1, 3)
        return np.array([corners.min(0), corners.max(0)])

    @property
    def area(self) -> float:
        """Surface area [m^2]."""
        return float(self.areas.sum())

    @property
    def slender(self) -> bool:
        """Whether it has far less surface than its box: a bar, a hoop, a frame."""
        a, b, c = self.box.half
        return bool(self.area < 0.6 * 8 * (a * b + b * c + a * c))

    def take(self, index: np.ndarray) -> Shape:
        """The shape of some of the faces (index into this shape, or a mask)."""
        return Shape(self.triangles[index], self.normals[index], self.solid[index], self.faces[index], self.seed)


@dataclass(frozen=True, eq=False)
class Surface:
    """The whole object's shape, and the connected components of its welded surface."""

    shape: Shape
    parts: Components
    void: Bool[np.ndarray, " c"]  # components that are the walls of a closed cavity in another
    vertices: Float[np.ndarray, "V 3"]
    diagonal: float


def surface_of(mesh: Mesh, seed: int = 0) -> Surface:
    """Orients and prepares a mesh; the mesh itself is not changed."""
    parts = components(mesh.vertices, mesh.faces)
    void = _voids(mesh, parts)
    flip = (parts.flip & ~void)[parts.label]
    normals = np.where(flip[:, None], -mesh.face_normals, mesh.face_normals)
    shape = Shape(mesh.triangles, normals, parts.solid[parts.label], np.arange(len(mesh.faces)), seed)
    return Surface(shape, parts, void, mesh.vertices, mesh.diagonal)


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
