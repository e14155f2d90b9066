"""Triangles that are missing from closed surfaces, as exports and repairs lose some: a solid with one hole has no inside.

A hole is closed if its cover continues the surface around it. What is open on purpose, such as the top of a bin of sheets,
stays open, and so does a component that would not be closed.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from jaxtyping import Float, Int

from anymesh.geometry.topology import components, weld
from anymesh.types.triangles import normals_and_areas, unshared

MAX_EDGES = 12  # of a hole
MAX_LOST_SHARE = 0.05  # of the faces of a component, above FEW_HOLES holes
FEW_HOLES = 3
FLUSH = np.cos(np.deg2rad(30))  # minimum cosine between the cover and the face beside it
MIN_FLUSH_SHARE = {3: 0.3, 4: 0.3, 5: 0.3}  # of the length of a hole's border, at which its cover continues the surface
MIN_FLUSH_SHARE_LARGE = 0.5  # the same for holes with more edges
MAX_AREA_SHARE = 0.03  # of its component: area of a hole with more than three edges


def missing_triangles(triangles: Float[np.ndarray, "n 3 3"]) -> tuple[Float[np.ndarray, "k 3 3"], Int[np.ndarray, " k"]]:
    """Return the triangles that close components that lack a few, and for each a face at the border of its hole.

    triangles: without copies and cracks, wound outwards.
    """
    nothing = np.zeros((0, 3, 3)), np.zeros(0, np.int64)
    if not len(triangles):
        return nothing
    vertices, faces = unshared(triangles)
    parts = components(vertices, faces)
    if parts.solid.all():
        return nothing
    corner = weld(vertices)[faces]
    start, end, owner = corner.reshape(-1), np.roll(corner, -1, 1).reshape(-1), np.repeat(np.arange(len(faces)), 3)
    count = int(corner.max()) + 1
    key, back = start * count + end, end * count + start
    loose = np.flatnonzero((start != end) & ~np.isin(back, key))
    place = np.empty((count, 3))
    place[corner.reshape(-1)] = triangles.reshape(-1, 3)
    normals, areas = normals_and_areas(triangles)
    covers: list[np.ndarray] = []
    beside: list[int] = []
    for label in np.flatnonzero(~parts.solid):
        own = parts.label == label
        border = loose[parts.label[owner[loose]] == label]
        face_of = {(int(end[k]), int(start[k])): int(owner[k]) for k in border}
        if len(face_of) != len(border) or len(border) > 3 * max(FEW_HOLES, MAX_LOST_SHARE * own.sum()):
            continue
        holes = [(loop, _cover(place[loop])) for loop in _loops(list(face_of))]
        limit = MAX_AREA_SHARE * float(areas[own].sum())
        if sum(len(loop) for loop, _ in holes) == len(border) and all(
            _continues(loop, cover, place, [normals[face_of[e]] for e in _edges(loop)], limit) for loop, cover in holes
        ):
            for loop, cover in holes:
                covers.append(place[np.array(loop)[cover]])
                beside += [face_of[loop[0], loop[1]]] * len(cover)
    return (np.concatenate(covers), np.array(beside)) if covers else nothing


def _edges(loop: Sequence[int]) -> Iterator[tuple[int, int]]:
    return ((loop[k], loop[(k + 1) % len(loop)]) for k in range(len(loop)))


def _loops(edges: Sequence[tuple[int, int]]) -> Iterator[list[int]]:
    """Yield simple loops of directed edges; those that never close are left out."""
    ahead: dict[int, list[int]] = {}
    for a, b in edges:
        ahead.setdefault(a, []).append(b)
    for first in list(ahead):
        while ahead.get(first):
            path, at = [first], {first: 0}
            while ahead.get(path[-1]):
                new = ahead[path[-1]].pop()
                if new in at:
                    yield path[at[new] :]
                    for gone in path[at[new] + 1 :]:
                        del at[gone]
                    path = path[: at[new] + 1]
                else:
                    at[new] = len(path)
                    path.append(new)
            if len(path) > 1:
                break


def _cover(points: Float[np.ndarray, "n 3"]) -> Int[np.ndarray, "m 3"]:
    """Return the triangulation of a loop with the least area, as indices (Klincsek 1980); none for a long loop."""
    n = len(points)
    if not 3 <= n <= MAX_EDGES:
        return np.zeros((0, 3), np.int64)
    best: dict[tuple[int, int], tuple[float, int]] = {(k, k + 1): (0.0, -1) for k in range(n - 1)}
    for span in range(2, n):
        for a in range(n - span):
            b = a + span
            areas = np.linalg.norm(np.cross(points[a + 1 : b] - points[a], points[b] - points[a]), axis=1)
            costs = [best[a, m][0] + best[m, b][0] + float(area) for m, area in zip(range(a + 1, b), areas, strict=True)]
            best[a, b] = min(costs), a + 1 + int(np.argmin(costs))
    rows, waiting = [], [(0, n - 1)]
    while waiting:
        a, b = waiting.pop()
        m = best[a, b][1]
        if m >= 0:
            rows.append((a, m, b))
            waiting += [(a, m), (m, b)]
    return np.array(rows)


def _continues(loop: list[int], cover: np.ndarray, place: np.ndarray, beside: Sequence[np.ndarray], limit: float) -> bool:
    """Return whether the cover of a hole continues the surface around it. beside: normals of the faces at its edges."""
    if not len(cover):
        return False
    normals, areas = normals_and_areas(place[np.array(loop)[cover]])
    if len(loop) > 3 and float(areas.sum()) > limit:
        return False
    at = {(row[k], row[(k + 1) % 3]): n for n, row in enumerate(cover.tolist()) for k in range(3)}
    flush = length = 0.0
    for k, (a, b) in enumerate(_edges(loop)):
        size = float(np.linalg.norm(place[b] - place[a]))
        length += size
        flush += size * bool(normals[at[k, (k + 1) % len(loop)]] @ beside[k] > FLUSH)
    return flush >= MIN_FLUSH_SHARE.get(len(loop), MIN_FLUSH_SHARE_LARGE) * length
