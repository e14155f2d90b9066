"""Triangulation of polygons, with manifold3d (Apache-2.0).

Convex polygons become fans. Concave ones are cut by manifold3d, so that no triangle covers a window's hole. It keeps every
corner, also those on a line between others, and with them the seams to neighbours, and it ends soon for outlines that cross
themselves.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.errors import InputError, MissingExtraError
from anymesh.loading.files import Folder

COMMA = re.compile(r"(?<!\S)([+-]?\d*),(\d+(?:[eE][+-]?\d+)?)(?!\S)")  # a number with a decimal comma
BETWEEN = re.compile(r"(?<=\d),(?!\S)")  # a comma between numbers that are separated by spaces too
NO_NUMBER = re.compile(r"(?i)(?<!\S)[+-]?(?:s?nan\S*|1[.,]#\S*)(?!\S)")  # as C libraries write it, such as -nan(ind)

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


def usable_polygons(
    folder: Folder,
    vertices: Float[np.ndarray, "V 3"],
    corners: Int[np.ndarray, " c"],
    counts: Int[np.ndarray, " n"],
    *,
    first: int,
) -> Bool[np.ndarray, " n"]:
    """Return which polygons are left after those with a corner without a vertex, or with one that is not finite.

    They give a warning. If they are more than half of all, nothing is left out, so that the file will be refused.
    """
    exists = (corners >= 0) & (corners < len(vertices))
    good = exists.copy()
    good[exists] = np.isfinite(vertices[corners[exists]]).all(1)
    usable = np.bincount(np.repeat(np.arange(len(counts)), counts)[~good], minlength=len(counts)) == 0
    bad = int((~usable).sum())
    if 2 * bad > len(counts):
        return np.ones(len(counts), bool)
    if not exists.all():
        such = f"vertex {corners[~exists][0] + first}; valid are {first} to {len(vertices) - 1 + first}"
        folder.warn(f"{bad} of {len(counts)} faces are left out, which refer to vertices that do not exist (such as {such})")
    elif bad:
        folder.warn(f"{bad} of {len(counts)} faces are left out, which have vertices that are not finite (NaN or infinite)")
    return usable


def with_points(text: str, folder: Folder) -> str:
    """Return numbers with points for decimal commas, which give a warning, and with `nan` for all that is no number."""
    text = NO_NUMBER.sub("nan", BETWEEN.sub("", text))
    pointed = COMMA.sub(r"\1.\2", text)
    if pointed != text:
        folder.warn("found decimal commas, which are taken for points")
    return pointed


def check_count(name: str, what: str, stated: int, room: int) -> None:
    """Raise InputError if a header states more elements than the file has room for."""
    if stated < 0 or stated > room:
        raise InputError(f"{name} is truncated or broken: it states {stated} {what}, and has room for at most {max(room, 0)}")
