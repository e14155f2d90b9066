"""A mesh as something that may stand: samples of its surface, its convex hull, the directions it faces, its symmetries."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from jaxtyping import Float
from scipy.spatial import ConvexHull, KDTree, QhullError

from anymesh.geometry.surface import mesh_surface
from anymesh.geometry.triangle_set import sample_surface, spread_directions
from anymesh.types import Mesh

POINTS = 1500  # samples of the surface
MAX_VERTICES, MAX_SEEDS = 6000, 500  # of dense meshes: vertices, and triangles of the convex hull around which facets are found
OUTER_DIRECTIONS = 1000  # in which the outermost vertices of dense meshes are kept
SAME_COSINE = float(np.cos(np.deg2rad(2)))  # directions closer than this are one
FLAT_COSINE = float(np.cos(np.deg2rad(5)))  # normals closer than this to a direction face it
MAX_FLATS = 4  # directions that most of the surface faces
MIN_FLAT_SHARE = 0.02  # minimum share of the surface that faces such a direction
MIN_ANGLE_SINE = 0.5  # between two directions whose cross product is one more


@dataclass(frozen=True, eq=False)
class Stander:
    """A mesh as something that stands, with the center of its surface at 0 and its farthest corner at 0.5. Build it by `of`.

    points, normals: samples of the surface; corners: of its convex hull; facets: unit normals of the hull's flat facets, the
    largest first; facet_areas: as shares of the hull's area.
    """

    points: Float[np.ndarray, "n 3"]
    normals: Float[np.ndarray, "n 3"]
    corners: Float[np.ndarray, "c 3"]
    facets: Float[np.ndarray, "f 3"]
    facet_areas: Float[np.ndarray, " f"]

    @classmethod
    def of(cls, mesh: Mesh) -> Stander | None:
        """Sample a mesh; return None if it is flat or has no extent."""
        used = np.zeros(len(mesh.vertices), bool)
        used[mesh.faces] = True
        low, high = mesh.bounds
        with np.errstate(over="ignore", under="ignore", divide="ignore", invalid="ignore"):
            scaled = (mesh.vertices - (low + high) / 2) / float(np.linalg.norm(high - low))
        if not np.isfinite(scaled[used]).all():
            return None
        outer = mesh_surface(replace(mesh, vertices=np.where(used[:, None], scaled, 0.0))).shape
        samples = sample_surface(outer.triangles, POINTS, 0)
        try:
            hull = ConvexHull(_outermost(scaled[used]))
        except QhullError:
            return None
        facets, areas = _facets(hull)
        corners, center = hull.points[hull.vertices], samples.points.mean(0)
        size = 2 * float(np.linalg.norm(corners - center, axis=1).max())  # the diagonal of bounds depends on the rotation
        points = (samples.points - center) / size
        return cls(points, samples.normals, (corners - center) / size, facets, areas / areas.sum())

    @cached_property
    def flats(self) -> Float[np.ndarray, "k 3"]:
        """Return the directions that most of the surface faces, either way, and the cross products of these."""
        normals = self.normals[::3]
        left, directions, facing = np.ones(len(normals)), [], np.abs(normals @ normals.T) > FLAT_COSINE
        for _ in range(MAX_FLATS):
            best = int((facing @ left * left).argmax())
            if (facing[best] @ left) < MIN_FLAT_SHARE * len(left):
                break
            sign = np.sign(normals @ normals[best])
            direction = (normals * (sign * left * facing[best])[:, None]).sum(0)
            directions.append(direction / np.linalg.norm(direction))
            left = left * (np.abs(normals @ directions[-1]) <= FLAT_COSINE)
        across = [np.cross(a, b) for k, a in enumerate(directions) for b in directions[:k]]
        across = [c / np.linalg.norm(c) for c in across if np.linalg.norm(c) > MIN_ANGLE_SINE]
        return np.array([*directions, *across]).reshape(-1, 3)

    @cached_property
    def main_axes(self) -> Float[np.ndarray, "3 3"]:
        """Return the principal axes of the surface."""
        return np.linalg.svd(self.points, full_matrices=False)[2]

    @cached_property
    def mirrors(self) -> tuple[Float[np.ndarray, "m 3"], Float[np.ndarray, " m"]]:
        """Return the normals of possible mirror planes, and the mean distance of the mirrored surface from the surface."""
        normals = distinct([*self.flats, *self.main_axes], either_way=True)
        return normals, np.array([self.asymmetry(n) for n in normals])

    def asymmetry(self, normal: Float[np.ndarray, " 3"]) -> float:
        """Return the mean distance from the surface of its mirror image, in the middle of the extent along `normal`."""
        along = self.corners @ normal
        height = self.points[::3] @ normal - (along.min() + along.max()) / 2
        return float(self._tree.query(self.points[::3] - 2 * height[:, None] * normal)[0].mean())

    @cached_property
    def _tree(self) -> KDTree:
        return KDTree(self.points)


def _outermost(points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "m 3"]:
    """Return all points, or of more than MAX_VERTICES the outermost ones in OUTER_DIRECTIONS directions.

    The time of a convex hull grows with the square of the number of corners of a ring.
    """
    if len(points) <= MAX_VERTICES:
        return points
    directions = spread_directions(OUTER_DIRECTIONS)
    blocks = np.array_split(np.arange(len(points)), -(-len(points) // MAX_VERTICES))
    outer = np.unique(np.concatenate([block[(directions @ points[block].T).argmax(1)] for block in blocks]))
    return points[np.unique(outer[(directions @ points[outer].T).argmax(1)])]


def _facets(hull: ConvexHull) -> tuple[Float[np.ndarray, "f 3"], Float[np.ndarray, " f"]]:
    """Return the unit normals and areas of the flat facets of a hull, the largest first.

    Facets without any of the hull's MAX_SEEDS largest triangles are left out.
    """
    normals, corners = hull.equations[:, :3], hull.points[hull.simplices]
    areas = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    left, facets, sizes = areas > 0, [], []
    for k in np.argsort(-areas, kind="stable")[:MAX_SEEDS]:
        if left[k]:
            same = left & (normals @ normals[k] > SAME_COSINE)
            left &= ~same
            normal = (normals[same] * areas[same, None]).sum(0)
            facets.append(normal / np.linalg.norm(normal))
            sizes.append(areas[same].sum())
    order = np.argsort(-np.array(sizes), kind="stable")
    return np.array(facets)[order], np.array(sizes)[order]


def distinct(directions: Iterable[Float[np.ndarray, " 3"]], *, either_way: bool = False) -> Float[np.ndarray, "k 3"]:
    """Return the directions without those that are close to an earlier one, or to its opposite if `either_way`."""
    chosen: list[np.ndarray] = []
    for d in directions:
        cosines = [float(d @ c) for c in chosen]
        if max((abs(c) if either_way else c for c in cosines), default=-1.0) < SAME_COSINE:
            chosen.append(d)
    return np.array(chosen).reshape(-1, 3)
