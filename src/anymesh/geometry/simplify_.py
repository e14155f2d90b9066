"""Reduce the number of triangles of a surface, by fast-simplification (quadric error, MIT)."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.geometry.topology import weld
from anymesh.types.triangles import bounds_of, centers_of, corners_of, face_cross, lengths, normals_and_areas

OFF = 0.1  # of its size: a triangle whose center is farther from the surface spans a gap
DENSE = 6  # times the target number of faces, from which vertices are clustered first
FEWEST = 50_000  # number of faces up to which quadrics alone are fast enough
CLUSTERED = 3  # times the target number of faces: target of the clustering
STALLED = 1.25  # times the target number of faces, above which quadrics count as stalled


def simplify(triangles: Float[np.ndarray, "F 3 3"], max_faces: int) -> Float[np.ndarray, "R 3 3"]:
    """Return the surface in about `max_faces` triangles, with the same winding.

    Return the input if it has no more, or would collapse.

    A very dense surface is clustered first, since quadrics on millions of faces with many slivers take minutes. The same
    applies if quadrics stall above `max_faces`: on a fine, regular grid they fold the remaining faces.
    """
    if len(triangles) <= max_faces:
        return triangles
    corners = triangles.reshape(-1, 3)
    number = weld(corners)  # consecutive
    center = corners.mean(0)  # fast-simplification uses float32, which is more precise near the origin
    first = np.empty(int(number.max()) + 1, np.int64)
    first[number[::-1]] = np.arange(len(number))[::-1]
    before, corner = corners[first] - center, number.reshape(-1, 3)
    if len(corner) > max(DENSE * max_faces, FEWEST):
        points, faces = _by_quadrics(*_clustered(before, corner, CLUSTERED * max_faces), max_faces)
    else:
        points, faces = _by_quadrics(before, corner, max_faces)
        if len(faces) > STALLED * max_faces:
            again = _by_quadrics(*_clustered(before, corner, CLUSTERED * max_faces), max_faces)
            area = _area(before, corner)
            points, faces = min((points, faces), again, key=lambda mesh: abs(_area(*mesh) - area))
    simplified = corners_of(points.astype(np.float64), faces)
    if len(faces) and _has_border(corner):
        simplified = simplified[_on_surface(simplified, before, corner)]
    return simplified + center if len(simplified) else triangles


def _by_quadrics(
    points: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], max_faces: int
) -> tuple[Float[np.ndarray, "v 3"], Int[np.ndarray, "f 3"]]:
    """Collapse edges by quadric error, to about `max_faces` faces; return the input if it has no more."""
    if len(faces) <= max_faces:
        return points, faces
    from fast_simplification import simplify as quadric

    return quadric(np.ascontiguousarray(points, np.float32), np.ascontiguousarray(faces, np.int32), target_count=max_faces)


def _area(points: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"]) -> float:
    return float(lengths(face_cross(corners_of(points, faces))).sum()) / 2


def _clustered(
    points: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], max_faces: int
) -> tuple[Float[np.ndarray, "v 3"], Int[np.ndarray, "f 3"]]:
    """Join vertices in each cell of a grid that face the same octant (Rossignac and Borrel 1993), to about `max_faces` faces.

    The sharpest vertex represents its cell, so that creases stay in place. Both sides of a thin board stay separate.
    """
    cross = face_cross(corners_of(points, faces))
    double = lengths(cross)
    normal = np.stack([np.bincount(faces.reshape(-1), np.repeat(column, 3), len(points)) for column in cross.T], 1)
    around = np.bincount(faces.reshape(-1), np.repeat(double, 3), len(points))
    # a grid cell of the surface has two faces
    low, high = bounds_of(points)
    cell = max(np.sqrt(double.sum() / max_faces), 2.0**-20 * float((high - low).max()))
    x, y, z = (np.floor((column - least) / cell).astype(np.int64) for column, least in zip(points.T, low, strict=True))
    key = (((x << 20) | y) << 20 | z) << 3 | (normal > 0) @ np.array([4, 2, 1])
    sharp = lengths(normal) / np.maximum(around, 1e-300)
    order = np.lexsort((sharp, key))
    first = order[np.r_[True, np.diff(key[order]) != 0]]
    number = np.empty(len(points), np.int64)
    number[order] = np.cumsum(np.r_[False, np.diff(key[order]) != 0])
    a, b, c = number.take(faces).T
    corner = np.stack([a, b, c], 1)[(a != b) & (b != c) & (c != a)]
    return points[first], np.unique(smallest_index_first(corner), axis=0)


def smallest_index_first(faces: Int[np.ndarray, "F 3"]) -> Int[np.ndarray, "F 3"]:
    """Rotate the corners of every face so that the smallest index comes first; the winding stays."""
    return np.take_along_axis(faces, (faces.argmin(1)[:, None] + np.arange(3)) % 3, 1)


def _has_border(faces: Int[np.ndarray, "F 3"]) -> bool:
    a, b = faces.reshape(-1), np.roll(faces, -1, 1).reshape(-1)
    edge = np.sort(np.minimum(a, b) * (int(faces.max()) + 1) + np.maximum(a, b))
    other = np.r_[True, edge[1:] != edge[:-1], True]
    return bool((other[1:] & other[:-1]).any())


def _on_surface(triangles: np.ndarray, vertices: np.ndarray, faces: np.ndarray) -> Bool[np.ndarray, " R"]:
    """Return which triangles lie on the surface.

    Quadrics ignore borders: in a plane, a triangle may close a notch or a frame.
    """
    size = np.sqrt(normals_and_areas(triangles)[1])
    return distance_to_mesh(centers_of(triangles), vertices, faces)[0] <= OFF * size
