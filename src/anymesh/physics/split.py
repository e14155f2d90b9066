"""Convex decomposition of open surfaces: the surface is cut by planes until every piece is close to its hull.

A voxel remesh, as decomposers of solids need, would give an open shell thick walls. Cut directly, the shell stays thin and its
cavity stays open. The planes at concave edges, along which closed solids are cut, are found here, too.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import ConvexHull, QhullError

from anymesh.geometry.boxes import dominant_normals
from anymesh.geometry.distance_ import distance_to_triangles
from anymesh.geometry.topology import edge_pairs, weld
from anymesh.geometry.triangle_set import sample_surface
from anymesh.physics.convex import DIRECTIONS, cut, hull_of
from anymesh.physics.openings import NONE, Openings, Plane
from anymesh.types import Brief, Hull
from anymesh.types.triangles import normals_and_areas, unshared

SAMPLES = 200  # sample points of a hull for its distance from the surface
PLACES = 5  # positions of a cutting plane along each direction
EXACT = 3  # planes whose hulls are computed from all points, after a selection from the furthest points
DIGITS = 9  # of relative lengths and volumes that are compared; planes with equal ones keep their order
MIN_CONCAVE_ANGLE_DEG = 10.0  # [deg] minimum fold at an edge that counts as concave
SAME_PLANE = (0.9999, 1e-5)  # cosine of the normals, and offset as a share of the diagonal


@dataclass(frozen=True, eq=False)
class Patch(Brief):
    """A piece of surface, its hull, and the maximum distance of the hull from it [m]."""

    triangles: Float[np.ndarray, "n 3 3"]
    hull: Hull
    gap: float


def patch_of(triangles: Float[np.ndarray, "n 3 3"], wall: float, openings: Openings = NONE) -> Patch | None:
    """Return the patch of some triangles; a flat one gets a hull of `wall` [m] behind it. None if there is no surface.

    What the balls of openings allow is subtracted from the distance; a hull that reaches into them has an infinite one.
    """
    if len(triangles) == 0:
        return None
    normals, areas = normals_and_areas(triangles)
    facing = (normals * areas[:, None]).sum(0)
    hull = hull_of(triangles.reshape(-1, 3), wall, -facing if float(np.linalg.norm(facing)) > 0 else None)
    if hull is None:
        return None
    sides = hull.vertices[hull.faces]
    points = np.concatenate([sample_surface(sides, SAMPLES, 0).points, sides.mean(1)])
    gap = float((distance_to_triangles(points, triangles) - openings.slack(points)).max())
    return Patch(triangles, hull, np.inf if openings.lost(hull).any() else gap)


def split_surface(
    triangles: Float[np.ndarray, "n 3 3"], *, gap: float, wall: float, max_pieces: int, openings: Openings = NONE
) -> list[Hull]:
    """Return hulls of pieces that are within `gap` [m] of the surface, or of `max_pieces` pieces.

    Thin pieces are `wall` [m] thick; openings: that must stay.
    """
    first = patch_of(triangles, wall, openings)
    done, waiting = [], [] if first is None else [first]
    while waiting:
        worst = max(range(len(waiting)), key=lambda k: waiting[k].gap)
        patch = waiting.pop(worst)
        if patch.gap <= max(gap, 2 * wall) or len(done) + len(waiting) + 1 >= max_pieces:
            done.append(patch)
            continue
        halves = _halves(patch, wall, openings)
        if len(halves) < 2:
            done.append(patch)
        else:
            waiting += halves
    return [patch.hull for patch in done]


def _halves(patch: Patch, wall: float, openings: Openings) -> list[Patch]:
    """Return the two pieces of a cut by the plane that leaves the least volume in both hulls, or that opens most."""
    outlined = outline(patch.triangles)
    best = openings.cuts(patch.hull, outlined)[:1]
    if not best:
        planes = [*cutting_planes(patch.triangles, wall), *openings.halving(openings.near(patch.hull), outlined[0])]
        best = [planes[k] for k in least_volume_first(outlined, planes, wall)[:1]]
    if not best:
        return []
    pieces = (patch_of(piece, wall, openings) for piece in cut(patch.triangles, *best[0]))
    return [piece for piece in pieces if piece is not None]


def least_volume_first(
    outlined: tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "E 2"]], planes: Sequence[Plane], wall: float = 0.0
) -> list[int]:
    """Return the order of planes by the volume that they leave in the hulls of both sides of an outline.

    The furthest points in some directions give the order, and all points that of its first EXACT planes.

    wall: hulls count as at least this thick [m].
    """
    sides = [below_and_above(*outlined, *plane) for plane in planes]
    order = _rounded_order([sum(hull_volume(_furthest(points), wall) for points in pair) for pair in sides])
    first = _rounded_order([sum(hull_volume(points, wall) for points in sides[k]) for k in order[:EXACT]])
    return [order[k] for k in first] + order[EXACT:]


def _rounded_order(values: Sequence[float]) -> list[int]:
    """Return the indices of values from the smallest to the largest; those that differ by rounding only keep their order."""
    rounded = np.round(np.asarray(values) / (max(values, default=0.0) or 1.0), DIGITS)
    return np.argsort(rounded, kind="stable").tolist()


def _furthest(points: np.ndarray) -> np.ndarray:
    """Return the furthest of many points in each of some directions."""
    return points[np.unique((points @ DIRECTIONS.T).argmax(0))] if len(points) > 2 * len(DIRECTIONS) else points


def solid_mesh(triangles: Float[np.ndarray, "n 3 3"]) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "n 3"]]:
    """Return the welded vertices and faces of some triangles."""
    corners = triangles.reshape(-1, 3)
    _, first, faces = np.unique(weld(corners), return_index=True, return_inverse=True)
    return corners[first], faces.reshape(-1, 3)


def outline(triangles: Float[np.ndarray, "n 3 3"]) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "E 2"]]:
    """Return the distinct corners of some triangles, and the distinct edges as pairs of them."""
    points, index = np.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    index = index.reshape(-1, 3)
    ends = np.sort(np.concatenate([index[:, [0, 1]], index[:, [1, 2]], index[:, [2, 0]]]), axis=1)
    key = np.unique(ends[:, 0] * len(points) + ends[:, 1])
    return points, np.stack([key // len(points), key % len(points)], 1)


def cutting_planes(triangles: Float[np.ndarray, "n 3 3"], wall: float) -> Iterator[tuple[np.ndarray, float]]:
    """Yield planes (normal, offset) across the directions that a surface faces and its principal directions.

    They lie beside and between its corners, at least `wall` [m] apart.
    """
    normals, areas = normals_and_areas(triangles)
    corners = triangles.reshape(-1, 3)
    spread = corners - corners.mean(0)
    directions = list(dominant_normals(normals, areas, count=4))
    if len(directions) < 3:
        directions += list(np.linalg.svd(spread.T @ spread)[2])
    kept: list[np.ndarray] = []
    for direction in directions:
        if all(abs(float(direction @ other)) < 0.99 for other in kept):
            kept.append(direction)
    for direction in kept:
        along = np.unique(np.round((corners @ direction) / wall)) * wall
        low, high = float(along[0]), float(along[-1])
        if high - low < 4 * wall:
            continue
        inner = along[(along > low + 1.5 * wall) & (along < high - 1.5 * wall)]
        chosen = inner[np.unique(np.linspace(0, len(inner) - 1, PLACES).astype(int))] if len(inner) else inner
        for offset in (low + wall, *chosen.tolist(), (low + high) / 2, high - wall):
            yield direction, float(offset)


def below_and_above(
    points: Float[np.ndarray, "V 3"], ends: Int[np.ndarray, "E 2"], normal: Float[np.ndarray, " 3"], offset: float
) -> tuple[Float[np.ndarray, "a 3"], Float[np.ndarray, "b 3"]]:
    """Return the corner points on each side of a plane through an outline, without dividing the triangles."""
    height = points @ normal - offset
    a, b = ends[height[ends[:, 0]] * height[ends[:, 1]] < 0].T
    share = (height[a] / (height[a] - height[b]))[:, None]
    met = points[a] + (points[b] - points[a]) * share
    return np.concatenate([points[height <= 0], met]), np.concatenate([points[height >= 0], met])


def hull_volume(points: np.ndarray, wall: float = 0.0) -> float:
    """Return the volume of the hull of some points, at least that of a sheet `wall` [m] thick; 0 if there is none."""
    if len(points) < 4:
        return 0.0
    for options in ("Q5", "QJ") if wall > 0 else ("Q5",):  # with joggled input (QJ), flat points have a hull too
        try:
            hull = ConvexHull(points, qhull_options=options)
        except QhullError:
            continue
        return max(float(hull.volume), wall * float(hull.area) / 2)
    return 0.0


def concave_planes(
    triangles: Float[np.ndarray, "n 3 3"], most: int, min_angle: float = MIN_CONCAVE_ANGLE_DEG
) -> list[tuple[np.ndarray, float]]:
    """Return the distinct planes (normal, offset) of faces that meet at concave edges, at most one more than `most`.

    min_angle: minimum fold at a concave edge [deg].

    They are ordered by the total length of these edges, longest first.
    """
    corners, faces = unshared(triangles)
    pairs = edge_pairs(corners, faces)
    normals, middle = normals_and_areas(triangles)[0], triangles.mean(1)
    f, g = pairs.faces.T
    inward = np.einsum("ij,ij->i", middle[g] - middle[f], normals[f] - normals[g])
    folded = np.einsum("ij,ij->i", normals[f], normals[g]) < np.cos(np.deg2rad(min_angle))
    concave = np.flatnonzero((inward > 0) & folded)
    ends = corners[pairs.vertices[concave]]
    length = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    normal = np.concatenate([normals[f[concave]], normals[g[concave]]])
    offset = np.einsum("ij,ij->i", normal, np.tile(ends[:, 0], (2, 1)))
    return _distinct(normal, offset, np.tile(length, 2), float(np.linalg.norm(np.ptp(corners, axis=0))), most)


def _distinct(
    normal: np.ndarray, offset: np.ndarray, weight: np.ndarray, size: float, most: int
) -> list[tuple[np.ndarray, float]]:
    """Return planes without near-duplicates, at most one more than `most`.

    They are ordered by the sum of the weights of each and its duplicates.
    """
    weight = np.round(weight / max(float(weight.sum()), 1e-300), DIGITS)
    planes = _grouped(normal, offset, weight, weight, size, most)
    if len(planes) > most:  # so that a floor comes before the many planes of the round wall on it
        signed = np.sign(normal[np.arange(len(normal)), np.abs(normal).argmax(1)])
        cells = np.round(np.c_[normal * signed[:, None] / 0.02, offset * signed / (0.002 * size)]).astype(np.int64)
        cell = np.unique(cells, axis=0, return_inverse=True)[1].reshape(-1)
        planes = _grouped(normal, offset, weight, np.bincount(cell, weight)[cell], size, most)
    return [(n, o) for _, n, o in sorted(planes, key=lambda plane: -round(plane[0], DIGITS))]


def _grouped(
    normal: np.ndarray, offset: np.ndarray, weight: np.ndarray, first: np.ndarray, size: float, most: int
) -> list[tuple[float, np.ndarray, float]]:
    """Return the weight, normal and offset of distinct planes, starting with those where `first` is highest."""
    left = np.argsort(-np.round(first, DIGITS), kind="stable")
    planes: list[tuple[float, np.ndarray, float]] = []
    while len(left) and len(planes) <= most:
        n, o = normal[left[0]], float(offset[left[0]])
        along = normal[left] @ n
        same = (np.abs(along) > SAME_PLANE[0]) & (np.abs(offset[left] * np.sign(along) - o) < SAME_PLANE[1] * size)
        same[0] = True
        planes.append((float(weight[left[same]].sum()), n, o))
        left = left[~same]
    return planes
