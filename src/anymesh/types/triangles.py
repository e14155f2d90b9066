"""Areas and normals of triangles given by their corners; points, their bounds, and the corners of boxes."""

from __future__ import annotations

from itertools import product

import numpy as np
from jaxtyping import Bool, Float, Int, UInt64

MAX_PIECES = 20_000  # pieces up to which triangles are divided
CUBE_CORNERS = np.array(list(product((0, 1), repeat=3)))  # of a box: index of its lower or upper bound along x, y, z
BLOCK = 4096
MAX_HALVINGS = 40  # of a side, which a box of the size of a rounding error would need without end


def corners_of(vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "*n 3"]) -> Float[np.ndarray, "*n 3 3"]:
    """Return the corner positions of faces: `vertices[faces]`, which takes three times as long."""
    return vertices.take(faces, axis=0)


def centers_of(triangles: Float[np.ndarray, "F 3 3"]) -> Float[np.ndarray, "F 3"]:
    """Return the middle of each triangle: `triangles.mean(1)`, which takes three times as long."""
    a, b, c = triangles.transpose(1, 0, 2)
    return (a + b + c) / 3


def lengths(vectors: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, " n"]:
    """Return the length of each vector, to the last bit as `np.linalg.norm`, which takes three times as long."""
    x, y, z = vectors.T
    return np.sqrt(x * x + y * y + z * z)


def face_cross(triangles: Float[np.ndarray, "F 3 3"]) -> Float[np.ndarray, "F 3"]:
    """Return twice the area times the unit normal of every triangle, block by block, each of which fits into the cache."""
    made = np.empty(triangles.shape[::2], triangles.dtype)
    for start in range(0, len(triangles), BLOCK):
        a, b, c = triangles[start : start + BLOCK].transpose(1, 0, 2)
        made[start : start + BLOCK] = crosses(b - a, c - a)
    return made


def crosses(a: Float[np.ndarray, "n 3"], b: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Return the cross products of rows, without the overhead of np.cross."""
    product = np.empty(a.shape, np.result_type(a, b))
    for k, i, j in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        product[:, k] = a[:, i] * b[:, j] - a[:, j] * b[:, i]
    return product


def unshared(triangles: Float[np.ndarray, "F 3 3"]) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "F 3"]]:
    """Return the vertices and faces of triangles, of which no two share a vertex."""
    return triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3)


def normals_and_areas(triangles: Float[np.ndarray, "F 3 3"]) -> tuple[Float[np.ndarray, "F 3"], Float[np.ndarray, " F"]]:
    """Return the unit normals, zero for triangles without area, and the areas."""
    normals = face_cross(triangles)
    double = lengths(normals)
    return np.divide(normals, double[:, None], out=np.zeros_like(normals), where=double[:, None] > 0), double / 2


def bounds_of(points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "2 3"]:
    """Return the lowest and highest coordinates of points.

    Computed column by column, which is ten times faster than `points.min(0)`.
    """
    return np.array([[points[:, k].min() for k in range(3)], [points[:, k].max() for k in range(3)]])


def box_corners(bounds: Float[np.ndarray, "2 3"]) -> Float[np.ndarray, "8 3"]:
    """Return the corners of the box between two bounds."""
    return np.take_along_axis(bounds, CUBE_CORNERS, axis=0)


def transformed(points: Float[np.ndarray, "*n 3"], T: Float[np.ndarray, "4 4"]) -> Float[np.ndarray, "*n 3"]:
    """Return the points moved by a transform."""
    return points @ T[:3, :3].T + T[:3, 3]


def about_z(angle: float) -> Float[np.ndarray, "4 4"]:
    """Return the rotation by `angle` [rad] about z."""
    T = np.eye(4)
    T[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    return T


def quartered(triangles: Float[np.ndarray, "F 3 3"]) -> Float[np.ndarray, "G 3 3"]:
    """Return each triangle as four of half its size."""
    a, b, c = triangles.transpose(1, 0, 2)
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    return np.concatenate([np.stack(part, 1) for part in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])


def meet_box(
    triangles: Float[np.ndarray, "F 3 3"], low: Float[np.ndarray, " 3"], high: Float[np.ndarray, " 3"]
) -> Bool[np.ndarray, " F"]:
    """Return which triangles have a box that meets an axis-aligned box."""
    return boxes_meet(*corner_bounds(triangles), low, high)


def corner_bounds(triangles: Float[np.ndarray, "F 3 3"]) -> tuple[Float[np.ndarray, "F 3"], Float[np.ndarray, "F 3"]]:
    """Return the lower and the upper corner of the axis-aligned box of each triangle."""
    a, b, c = triangles.transpose(1, 0, 2)
    return np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)


def label_bounds(
    label: Int[np.ndarray, " F"], lowest: Float[np.ndarray, "F 3"], highest: Float[np.ndarray, "F 3"]
) -> tuple[Float[np.ndarray, "n 3"], Float[np.ndarray, "n 3"]]:
    """Return the lower and the upper corner of the box of each label, whose members have these boxes."""
    low, high = (np.full((int(label.max()) + 1, 3), end) for end in (np.inf, -np.inf))
    for k in range(3):  # one axis at a time: numpy is ten times as fast on flat arrays
        np.minimum.at(low[:, k], label, lowest[:, k])
        np.maximum.at(high[:, k], label, highest[:, k])
    return low, high


def boxes_meet(
    lowest: Float[np.ndarray, "F 3"],
    highest: Float[np.ndarray, "F 3"],
    low: Float[np.ndarray, " 3"],
    high: Float[np.ndarray, " 3"],
) -> Bool[np.ndarray, " F"]:
    """Return which axis-aligned boxes meet another one. Computed column by column, which is faster than `all(1)`."""
    meet = np.ones(len(lowest), bool)
    for k in range(3):
        meet &= (highest[:, k] >= low[k]) & (lowest[:, k] <= high[k])
    return meet


def cross(a: Float[np.ndarray, " 3"], b: Float[np.ndarray, " 3"]) -> Float[np.ndarray, " 3"]:
    """Return the cross product of two vectors, without the overhead of np.cross."""
    (ax, ay, az), (bx, by, bz) = a, b
    return np.array([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])


def pieces_within(
    triangles: Float[np.ndarray, "F 3 3"], low: Float[np.ndarray, " 3"], high: Float[np.ndarray, " 3"]
) -> tuple[Float[np.ndarray, "P 3 3"], Int[np.ndarray, " P"]]:
    """Return the pieces of triangles near an axis-aligned box, none longer than half of it, and the triangle of each."""
    size = float((high - low).max()) / 2
    face = np.flatnonzero(meet_box(triangles, low, high))
    pieces = triangles[face]
    for _ in range(MAX_HALVINGS):
        large = np.ptp(pieces, axis=1).max(1, initial=0.0) > size
        if not large.any() or len(pieces) > MAX_PIECES:
            break
        parts, of = quartered(pieces[large]), np.tile(face[large], 4)
        met = meet_box(parts, low, high)
        pieces, face = np.concatenate([pieces[~large], parts[met]]), np.concatenate([face[~large], of[met]])
    return pieces, face


def unique_rows(columns: list[UInt64[np.ndarray, " n"]]) -> tuple[Int[np.ndarray, " k"], Int[np.ndarray, " n"]]:
    """Return the first row of each distinct value, in order of appearance, and the index of the value of every row.

    Rows are hashed and the hash is sorted, which is 5 times faster than sorting rows. The result is checked against the rows.
    """
    key = np.zeros(len(columns[0]), np.uint64)
    for column in columns:
        key = (key ^ column) * np.uint64(0x9E3779B97F4A7C15)
        key ^= key >> np.uint64(29)
    first, inverse = _kinds(key)
    if all((c == c[first][inverse]).all() for c in columns):
        return first, inverse
    kinds = np.unique(np.stack(columns, 1), axis=0, return_inverse=True)[1]
    return _kinds(kinds.reshape(-1).astype(np.uint64))


def _kinds(key: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    order = np.argsort(key)
    ordered = key[order]
    starts = np.flatnonzero(np.r_[True, ordered[1:] != ordered[:-1]])
    first = np.minimum.reduceat(order, starts)  # independent of the order of equal keys in the sort
    rank = np.empty(len(first), np.int64)
    rank[np.argsort(first)] = np.arange(len(first))
    inverse = np.empty(len(key), np.int64)
    inverse[order] = np.repeat(rank, np.diff(np.r_[starts, len(key)]))
    return np.sort(first), inverse


def by_key(key: Int[np.ndarray, " n"], end: int) -> tuple[Int[np.ndarray, " n"], Int[np.ndarray, " n"]]:
    """Return the rows in the stable order of their keys, all below `end`, and the keys; both are sorted as one number."""
    shift = len(key).bit_length()
    if end.bit_length() + shift > 63:
        order = np.argsort(key, kind="stable")
        return order, key[order]
    both = key << shift
    both |= np.arange(len(key))
    both.sort()
    return both & ((1 << shift) - 1), both >> shift
