"""Triangulation of polygons.

Convex polygons become fans. Concave ones are cut by ear clipping, so that no triangle covers a window's hole. Common ear
clippers drop corners that lie on a line between others, and with them the seams to neighbours. This one keeps every corner.
"""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int

REFLEX = 1e-6  # sine-like ratio of a corner's cross product to its sides' lengths; a corner that turns in by less is straight


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
    """Cut the fans of concave polygons again, by ears; the number of triangles and their positions stay the same.

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
    np.logical_or.at(reflex, owner, turn < -limit)
    recut_triangles = triangles.copy()
    place = np.searchsorted(polygon, np.arange(len(counts)))
    for k in np.flatnonzero(reflex & (counts > 3)):
        corners = points[start[k] : start[k] + counts[k]]
        recut_triangles[place[k] : place[k] + counts[k] - 2] = start[k] + _ears(_flat(corners, normal[k]))
    return recut_triangles


def _flat(points: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Return (n, 2) points as seen against the normal, so that the outline runs counterclockwise."""
    k = int(np.abs(normal).argmax())
    axes = [(k + 1) % 3, (k + 2) % 3]
    return points[:, axes if normal[k] > 0 else axes[::-1]]


def _ears(p: np.ndarray) -> np.ndarray:
    """Return the (n - 2, 3) corner indices of the triangles of a simple counterclockwise polygon (n, 2)."""
    left, ears = list(range(len(p))), []
    while len(left) > 3:
        ear = next((i for i in range(len(left)) if _is_ear(p, left, i)), None)
        if ear is None:  # the polygon crosses itself: the flattest corner does the least harm
            ear = int(np.argmin([abs(_cross(p, *_around(left, i))) for i in range(len(left))]))
        ears.append(_around(left, ear))
        del left[ear]
    return np.array([*ears, tuple(left)])


def _around(left: list[int], i: int) -> tuple[int, int, int]:
    return left[i - 1], left[i], left[(i + 1) % len(left)]


def _cross(p: np.ndarray, a: int, b: int, c: int) -> float:
    u, v = p[b] - p[a], p[c] - p[b]
    return float(u[0] * v[1] - u[1] * v[0])


def _is_ear(p: np.ndarray, left: list[int], i: int) -> bool:
    """Return whether the corner is convex, and no other corner lies in its triangle (one at the same place does not count)."""
    a, b, c = _around(left, i)
    if _cross(p, a, b, c) <= 0:
        return False
    others = p[[k for k in left if k not in (a, b, c)]]
    inside = np.ones(len(others), bool)
    for start, end in ((a, b), (b, c), (c, a)):
        side, arm = p[end] - p[start], others - p[start]
        inside &= side[0] * arm[:, 1] - side[1] * arm[:, 0] >= 0
    at_corner = (others[:, None] == p[[a, b, c]]).all(2).any(1)
    return not (inside & ~at_corner).any()
