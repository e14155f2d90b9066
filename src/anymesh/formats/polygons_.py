"""Triangulation of polygons, with manifold3d (Apache-2.0).

Convex polygons become fans. Concave ones are cut by manifold3d, so that no triangle covers a window's hole. It keeps every
corner, also those on a line between others, and with them the seams to neighbours, and it ends soon for outlines that cross
themselves.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float, Int

from anymesh.errors import MissingExtraError

REFLEX = 1e-6  # sine-like ratio of a corner's cross product to its sides' lengths; a corner that turns in by less is straight


def triangulate(outlines: Sequence[Float[np.ndarray, "_ 2"]]) -> Int[np.ndarray, "m 3"]:
    """Return counterclockwise triangles over the concatenated points of outlines; no points are added or omitted.

    outlines: counterclockwise, holes clockwise. Each of their edges bounds one triangle, and each inner edge two, for any
    shape. Raise MissingExtraError without manifold3d.
    """
    try:
        from manifold3d import triangulate as cut
    except ImportError:
        raise MissingExtraError("manifold3d is missing; it is a dependency of articulate-anymesh; reinstall that") from None
    return np.asarray(cut([np.ascontiguousarray(o, np.float64) for o in outlines]), np.int64).reshape(-1, 3)


def fans(counts: Int[np.ndarray, " n"]) -> tuple[Int[np.ndarray, "F 3"], Int[np.ndarray, " F"]]:
    """Return triangles of polygons that lie one after another, as three indices into all their corners, and their polygons."""
    each = np.maximum(counts - 2, 0)
    polygon = np.repeat(np.arange(len(counts)), each)
    start = (np.cumsum(counts) - counts)[polygon]
    step = np.arange(len(polygon)) - (np.cumsum(each) - each)[polygon]
    return np.stack([start, start + step + 1, start + step + 2], 1), polygon


def recut(
    triangles: Int[np.ndarray, "F 3"],
    polygon: Int[np.ndarray, " F"],
    counts: Int[np.ndarray, " n"],
    vertices: Float[np.ndarray, "V 3"],
    corners: Int[np.ndarray, " c"],
) -> Int[np.ndarray, "F 3"]:
    """Cut the fans of concave polygons again; the number of triangles and their positions stay the same.

    corners: the vertex of each corner, polygon after polygon; those of polygons without triangles may not be valid vertices.
    """
    big = np.flatnonzero(counts > 3)
    if not len(big):
        return triangles
    points = vertices[np.clip(corners, 0, len(vertices) - 1)]
    start = np.cumsum(counts) - counts
    owner = np.repeat(np.arange(len(counts)), counts)
    within = np.arange(len(points)) - start[owner]
    before = points - points[start[owner] + (within - 1) % counts[owner]]
    after = points[start[owner] + (within + 1) % counts[owner]] - points
    first = points[start[owner]]
    normal = np.zeros((len(counts), 3))
    np.add.at(normal, owner, np.cross(points - first, points + after - first))
    turn = np.einsum("ij,ij->i", np.cross(before, after), normal[owner])
    limit = REFLEX * np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1) * np.linalg.norm(normal, axis=1)[owner]
    reflex = np.zeros(len(counts), bool)
    np.logical_or.at(reflex, owner, (turn < -limit) | (limit == 0))  # also at corners that are repeated
    recut_triangles = triangles.copy()
    place = np.searchsorted(polygon, np.arange(len(counts)))
    for k in np.flatnonzero(reflex & (counts > 3)):
        corners = points[start[k] : start[k] + counts[k]]
        recut_triangles[place[k] : place[k] + counts[k] - 2] = start[k] + triangulate([_flat(corners, normal[k])])
    return recut_triangles


def _flat(points: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Return (n, 2) points as seen against the normal, so that the outline runs counterclockwise."""
    k = int(np.abs(normal).argmax())
    axes = [(k + 1) % 3, (k + 2) % 3]
    return points[:, axes if normal[k] > 0 else axes[::-1]]
