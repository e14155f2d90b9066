"""Sets of triangles with oriented normals, surface samples, a distance tree and a ray caster, each computed on demand.

Also what is measured on their surfaces: samples, moments, shares above a level, and the box without protrusions.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache, wraps
from hashlib import blake2b
from threading import Lock
from typing import ParamSpec, TypeVar

import numpy as np
from jaxtyping import Bool, Float, Int, Shaped

from anymesh.geometry.boxes import OrientedBox, box_in_frame, fit_box
from anymesh.geometry.distance_ import NearestSearch, TriangleTree
from anymesh.geometry.raycast_ import RayScene, index_rows
from anymesh.types import Brief
from anymesh.types.triangles import bounds_of, box_corners, corner_bounds, crosses, normals_and_areas, unshared

P = ParamSpec("P")
R = TypeVar("R")
REMEMBERED = 4  # results of one function that are kept, which limits memory
SAMPLES = 3000  # surface points per triangle set; a share of 1 % is 30 points
SLANTED = np.array([0.3127, 0.5241, 0.7922])  # direction of the rays that tell inside from outside; along no usual face
SIDE_LEVEL_RATIO = 0.12  # of the surface that faces along an axis, either way: the outermost share is not the level of a side
MAX_PROTRUSION_RATIO = 0.25  # upper bound on the share of the surface that protrudes


def remembering(function: Callable[P, R]) -> Callable[P, R]:
    """Return a function of arrays with its last results, by the contents of these: stages ask the same of the same surface.

    Reading the contents takes a tenth of the work that it saves. Results must not be changed.
    """
    results, lock = dict[bytes, R](), Lock()

    @wraps(function)
    def call(*arrays: P.args, **named: P.kwargs) -> R:
        contents = blake2b(digest_size=16)
        for array in map(np.ascontiguousarray, (*arrays, *named.values())):
            contents.update(f"{array.dtype}{array.shape}".encode())
            contents.update(array)
        key = contents.digest()
        known = results.get(key)
        result = function(*arrays, **named) if known is None else known
        with lock:
            results.pop(key, None)
            results[key] = result
            while len(results) > REMEMBERED:
                del results[next(iter(results))]
        return result

    return call


@dataclass(frozen=True, eq=False)
class SurfacePoints(Brief):
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
        return crosses(self.points, self.normals)


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
    if not len(areas):
        return np.zeros((0, 3)), np.zeros(0, np.int64)
    ticks, a, b, c = _draws(count, seed)
    weights = areas if (areas > 0).any() else np.ones(len(areas))
    index = np.minimum(np.searchsorted(np.cumsum(weights), ticks * weights.sum()), len(areas) - 1)
    t = triangles[index]
    return a * t[:, 0] + b * t[:, 1] + c * t[:, 2], index


@lru_cache(8)  # an object has thousands of sets of points, of a few sizes
def _draws(count: int, seed: int) -> tuple[np.ndarray, ...]:
    """Return where points lie along the area, 0..1, and the weights of the corners of their triangles."""
    rng = np.random.default_rng(seed)
    ticks = (np.arange(count) + rng.random()) / count
    r1, r2 = np.sqrt(rng.random(count))[:, None], rng.random(count)[:, None]
    return ticks, 1 - r1, r1 * (1 - r2), r1 * r2


@dataclass(frozen=True, eq=False)
class KnownFaces(Brief):
    """Data shared by a triangle set and all its subsets.

    positions: (V, 3) distinct corner positions in lexical order, including those of faces that were not taken [m]; corner: (F,
    3) position index of each corner; areas: (F,) [m^2]; rows: (F,) the position indices, as from `index_rows`.
    """

    positions: Float[np.ndarray, "V 3"]
    corner: Int[np.ndarray, "F 3"]
    areas: Float[np.ndarray, " F"]
    rows: Shaped[np.ndarray, " F"]

    @classmethod
    def of(cls, triangles: Float[np.ndarray, "F 3 3"]) -> KnownFaces:
        """Build the data of the faces of an object."""
        positions, corner = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
        corner = corner.reshape(-1, 3)
        return cls(positions, corner, normals_and_areas(triangles)[1], index_rows(corner))

    def take(self, index: np.ndarray) -> KnownFaces:
        """Return the data of some of the faces."""
        return KnownFaces(self.positions, self.corner[index], self.areas[index], self.rows[index])

    @cached_property
    def _used(self) -> Bool[np.ndarray, " V"]:
        used = np.zeros(len(self.positions), bool)
        used[self.corner.reshape(-1)] = True
        return used

    @cached_property
    def corners(self) -> Float[np.ndarray, "n 3"]:
        """Return the corner positions of these faces in lexical order."""
        return self.positions[self._used]

    def scene(self, bounds: Float[np.ndarray, "2 3"]) -> RayScene:
        """Return the ray caster of these faces with these bounds: with all positions, unless most of them are of others."""
        if 2 * len(self.corners) > len(self.positions):
            return RayScene(self.positions, self.rows, bounds)
        return RayScene(self.corners, (np.cumsum(self._used) - 1)[self.corner])


@dataclass(frozen=True, eq=False)
class TriangleSet(Brief):
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
        """Return the distance of each point to these triangles [m], and the index of the nearest triangle."""
        return self.search(points).nearest(np.arange(len(points)))

    def search(self, points: Float[np.ndarray, "n 3"]) -> NearestSearch:
        """Return the search for the triangles nearest to some points."""
        return NearestSearch(points, self.triangles, self.corners, (self.lowest, self.highest))

    @cached_property
    def scene(self) -> RayScene:
        """Return the ray caster of these triangles."""
        return RayScene(*unshared(self.triangles)) if self.known is None else self.known.scene(self.bounds)

    @cached_property
    def corners(self) -> Float[np.ndarray, "n 3"]:
        """Return the distinct corner positions [m]."""
        return np.unique(self.triangles.reshape(-1, 3), axis=0) if self.known is None else self.known.corners

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


def quantile(values: Float[np.ndarray, " n"], share: float) -> float:
    """Return a quantile of some values, as `np.quantile`, which takes ten times as long for a thousand of them."""
    at = share * (len(values) - 1)
    low = int(at)
    a, b = np.partition(values, (low, min(low + 1, len(values) - 1)))[[low, min(low + 1, len(values) - 1)]]
    return float(b - (b - a) * (1 - at + low) if at - low >= 0.5 else a + (b - a) * (at - low))


def median(values: Float[np.ndarray, " n"]) -> float:
    """Return the median of some values, as `np.median`, which takes ten times as long for few of them."""
    ordered = np.sort(values)
    return float(ordered[(len(ordered) - 1) // 2] + ordered[len(ordered) // 2]) / 2


def shares_above(heights: Float[np.ndarray, "F 3"], level: float) -> Float[np.ndarray, " F"]:
    """Return the share of each face that is above a level."""
    a, b, c = heights.T  # sorting rows of three takes five times as long
    low, high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
    middle = np.maximum(np.minimum(a, b), np.minimum(np.maximum(a, b), c))
    with np.errstate(divide="ignore", invalid="ignore"):
        below = (level - low) ** 2 / ((middle - low) * (high - low))  # a corner is below
        above = (high - level) ** 2 / ((high - low) * (high - middle))  # a corner is above
    return np.where(level < low, 1.0, np.where(level >= high, 0.0, np.where(level < middle, 1 - below, above)))


def points_above(
    triangles: Float[np.ndarray, "F 3 3"], heights: Float[np.ndarray, "F 3"], level: float
) -> Float[np.ndarray, "n 3"]:
    """Return the corners of the faces' parts above a level [m]."""
    start, end = heights, heights[:, [1, 2, 0]]
    face, edge = np.nonzero((start > level) != (end > level))
    share = (level - start[face, edge]) / (end[face, edge] - start[face, edge])
    a, b = triangles[face, edge], triangles[face, (edge + 1) % 3]
    return np.concatenate([triangles[heights > level], a + share[:, None] * (b - a)])


def surface_moments(triangles: Float[np.ndarray, "F 3 3"]) -> Float[np.ndarray, "4 4"]:
    """Return the integral of p p^T over the surface for homogeneous points p = (x, y, z, 1); its last entry is the area."""
    corners = np.concatenate([triangles, np.ones((*triangles.shape[:2], 1))], axis=2)
    total = corners.sum(1)
    weight = normals_and_areas(triangles)[1] / 12
    return np.einsum("f,fki,fkj->ij", weight, corners, corners) + np.einsum("f,fi,fj->ij", weight, total, total)


def principal_spread(moments: Float[np.ndarray, "n 4 4"]) -> Float[np.ndarray, "n 3"]:
    """Return the standard deviations of surfaces along their principal axes, the largest last, in any rotation."""
    mean = moments / np.maximum(moments[:, 3:, 3:], 1e-300)
    return np.sqrt(np.maximum(np.linalg.eigvalsh(mean[:, :3, :3] - mean[:, :3, 3:] * mean[:, 3:, :3]), 0))


def body_obb(shape: TriangleSet) -> OrientedBox:
    """Return the oriented box of a part without protrusions: a small share of its surface, narrower than the part."""
    frame = shape.box.axes
    local, area = shape.triangles @ frame.T, max(shape.area, 1e-300)
    facing = np.abs(shape.normals @ frame.T) > 0.9
    corners = shape.corners @ frame.T
    low, high = bounds_of(corners)
    tolerance = 0.01 * shape.box.diagonal
    for axis in (2, 1, 0):  # thickness first: beyond another side, what is as thick as the rest is not narrow
        for sign, edge in ((1.0, high), (-1.0, low)):
            heights = sign * local[:, :, axis]
            level = _side_level(heights[facing[:, axis]], shape.areas[facing[:, axis]], 0.02 * area)
            if level >= sign * edge[axis] - tolerance:
                continue
            share = float(shape.areas @ shares_above(heights, level + tolerance / 2)) / area
            if not 0 < share < MAX_PROTRUSION_RATIO:
                continue
            beyond = np.clip(points_above(local, heights, level + tolerance / 2), low, high)
            if np.delete(np.ptp(beyond, axis=0) / np.maximum(high - low, 1e-12), axis).min() < 0.6:  # it is narrow
                edge[axis] = sign * level
    return box_in_frame(box_corners(np.stack([low, high])) @ frame, frame)


def _side_level(heights: Float[np.ndarray, "F 3"], areas: Float[np.ndarray, " F"], least: float) -> float:
    """Return the level of the faces that face along an axis, without the outermost; inf if they are smaller than `least`."""
    if areas.sum() <= least:
        return np.inf
    middle = (heights[:, 0] + heights[:, 1] + heights[:, 2]) / 3
    order = np.argsort(-middle, kind="stable")
    outer = np.cumsum(areas[order])
    return float(middle[order[np.searchsorted(outer, SIDE_LEVEL_RATIO * outer[-1], side="right")]])
