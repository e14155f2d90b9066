"""Exact convex decomposition of faceted solids by cuts along the planes of faces that meet at concave edges.

A drawer, a frame or a bracket has few such planes, and cuts along them leave convex blocks. Smooth solids have too many, and
are left to CoACD.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.spatial import ConvexHull, QhullError

from anymesh.geometry.distance_ import distance_to_mesh, winding_number
from anymesh.geometry.sampling import sample_surface
from anymesh.geometry.topology import edge_pairs
from anymesh.physics.collision.convex import cut, hull_of
from anymesh.physics.collision.split import SAMPLES, below_and_above, cutting_planes, outline, solid_mesh
from anymesh.types import Hull
from anymesh.types.triangles import normals_and_areas

MIN_CONCAVE_ANGLE_DEG = 10.0  # [deg] minimum fold at an edge that counts as concave
MAX_PLANES = 32  # distinct planes at concave edges; a solid with more is not faceted
PLANES_PER_CUT = 16  # planes tried per cut, those with the longest concave edges first
FLAT = 1e-9  # share of the volume of both sides below which a plane does not divide
SAME_PLANE = (0.9999, 1e-4)  # cosine of the normals, and offset as a share of the diagonal


@dataclass(frozen=True, eq=False)
class _Block:
    """A piece of the solid's surface, its hull, and the maximum distance of the hull from the solid [m]."""

    triangles: np.ndarray
    hull: Hull
    gap: float


def cut_solid(triangles: Float[np.ndarray, "n 3 3"], *, gap: float, wall: float, max_pieces: int) -> list[Hull] | None:
    """Return convex pieces that are within `gap` [m] of a closed solid.

    Return None if that takes more than `max_pieces` pieces, or if the solid is not faceted.

    wall: minimum spacing of other cutting planes [m].
    """
    planes = _concave_planes(triangles)
    if not 0 < len(planes) <= MAX_PLANES:
        return None
    solid = solid_mesh(triangles)
    whole = _block(triangles, solid)
    done, waiting = [], [] if whole is None else [whole]
    cuts = 0
    while waiting:
        cuts += 1
        if len(done) + len(waiting) > max_pieces or cuts > 2 * max_pieces:
            return None
        block = waiting.pop()
        if block.gap <= gap:
            done.append(block.hull)
            continue
        halves = _halves(block.triangles, planes, wall)
        if not halves:
            return None
        waiting += [half for side in halves if (half := _block(side, solid)) is not None]  # a sliver has no hull
    return done or None


def _block(triangles: np.ndarray, solid: tuple[np.ndarray, np.ndarray]) -> _Block | None:
    hull = hull_of(triangles.reshape(-1, 3)) if len(triangles) else None
    if hull is None:
        return None
    sides = hull.vertices[hull.faces]
    points = np.concatenate([sample_surface(sides, SAMPLES, 0).points, sides.mean(1)])
    off = distance_to_mesh(points, *solid)[0]
    away = np.flatnonzero(off > 0)
    off[away] *= winding_number(points[away], *solid) < 0.5  # hull points inside the solid have no distance
    return _Block(triangles, hull, float(off.max()))


def _halves(triangles: np.ndarray, planes: Sequence[tuple[np.ndarray, float]], wall: float) -> list[np.ndarray]:
    """Return the two sides of the plane that leaves the least volume in both hulls; none if no plane divides.

    If no concave edge is left, the block is curved and is cut across the directions that it faces.
    """
    outlined = outline(triangles)
    best = _best(outlined, planes, PLANES_PER_CUT) or _best(outlined, list(cutting_planes(triangles, wall)))
    return [] if best is None else list(cut(triangles, *best))


def _best(
    outlined: tuple[np.ndarray, np.ndarray], planes: Sequence[tuple[np.ndarray, float]], max_planes: int | None = None
) -> tuple[np.ndarray, float] | None:
    """Return, of the first `max_planes` planes that divide an outline, the one that leaves the least volume in both hulls."""
    sides = ([_volume(side) for side in below_and_above(*outlined, *plane)] for plane in planes)
    dividing = ((sum(pair), plane) for pair, plane in zip(sides, planes, strict=True) if min(pair) > FLAT * sum(pair))
    found = min(enumerate(itertools.islice(dividing, max_planes)), key=lambda item: (item[1][0], item[0]), default=None)
    return None if found is None else found[1][1]


def _concave_planes(triangles: np.ndarray) -> list[tuple[np.ndarray, float]]:
    """Return the distinct planes of faces that meet at concave edges, those with the longest edges first."""
    corners = triangles.reshape(-1, 3)
    pairs = edge_pairs(corners, np.arange(len(corners)).reshape(-1, 3))
    normals, middle = normals_and_areas(triangles)[0], triangles.mean(1)
    f, g = pairs.faces.T
    inward = np.einsum("ij,ij->i", middle[g] - middle[f], normals[f] - normals[g])
    folded = np.einsum("ij,ij->i", normals[f], normals[g]) < np.cos(np.deg2rad(MIN_CONCAVE_ANGLE_DEG))
    concave = np.flatnonzero((inward > 0) & folded)
    ends = corners[pairs.vertices[concave]]
    length = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    normal = np.concatenate([normals[f[concave]], normals[g[concave]]])
    offset = np.einsum("ij,ij->i", normal, np.tile(ends[:, 0], (2, 1)))
    return _distinct(normal, offset, np.tile(length, 2), float(np.linalg.norm(np.ptp(corners, axis=0))))


def _distinct(normal: np.ndarray, offset: np.ndarray, weight: np.ndarray, size: float) -> list[tuple[np.ndarray, float]]:
    """Return planes without near-duplicates, at most one more than MAX_PLANES.

    They are ordered by the sum of the weights of each and its duplicates.
    """
    left = np.argsort(-weight, kind="stable")
    found: list[tuple[float, np.ndarray, float]] = []
    while len(left) and len(found) <= MAX_PLANES:
        n, o = normal[left[0]], float(offset[left[0]])
        along = normal[left] @ n
        same = (np.abs(along) > SAME_PLANE[0]) & (np.abs(offset[left] * np.sign(along) - o) < SAME_PLANE[1] * size)
        same[0] = True
        found.append((float(weight[left[same]].sum()), n, o))
        left = left[~same]
    return [(n, o) for _, n, o in sorted(found, key=lambda plane: -plane[0])]


def _volume(points: np.ndarray) -> float:
    try:
        return float(ConvexHull(points).volume) if len(points) > 3 else 0.0
    except QhullError:
        return 0.0
