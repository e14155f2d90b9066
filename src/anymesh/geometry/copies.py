"""Faces that lie where other faces lie: doubled surfaces, and the backs of surfaces that were modelled with two sides."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int, Shaped

from anymesh.geometry.connected import label_connected
from anymesh.geometry.distance_ import TriangleTree
from anymesh.geometry.topology import Components, components, weld
from anymesh.types.triangles import normals_and_areas

BACK_TO_BACK_COSINE = 0.999  # minimum cosine between the normals of a face and one that lies on it, up to the sign
SAME_AREA = 1e-6  # maximum relative difference of the areas of copies


def without_copies(
    vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"]
) -> tuple[Int[np.ndarray, " F"], Components]:
    """Return for each face the one that it copies, itself for most, and the components of the faces that copy none.

    Copies are all but one of connected surfaces that are there several times, whatever the winding of each face; components
    with the corners and the area of an earlier one, such as backs that are divided along other diagonals; and faces with the
    corners and the winding of an earlier one. Where solids touch, single faces lie on each other, and are no copies.
    """
    corner = weld(vertices)[faces]
    place = _places(corner)
    first = _several_times(corner, place)
    kept = originals(first)
    parts = components(vertices, faces[kept])
    of_components = _same_components(corner[kept], vertices[faces[kept]], parts)
    left = kept[originals(of_components)]
    of_faces = np.arange(len(faces))
    if len(_repeated(place[left])):
        of_faces[left] = left[_same_faces(corner[left])]
    first = of_faces[kept[of_components]][np.searchsorted(kept, first)]
    last = originals(first)
    return first, parts if len(last) == len(kept) else components(vertices, faces[last])


def originals(first: Int[np.ndarray, " F"]) -> Int[np.ndarray, " K"]:
    """Return the faces that copy none, by what each face copies."""
    return np.flatnonzero(first == np.arange(len(first)))


def _repeated(number: Shaped[np.ndarray, " n"]) -> Shaped[np.ndarray, " m"]:
    """Return the numbers that are there more than once, in order."""
    ordered = np.sort(number)
    return ordered[1:][ordered[1:] == ordered[:-1]]


def _several_times(corner: Int[np.ndarray, "F 3"], place: Int[np.ndarray, " F"]) -> Int[np.ndarray, " F"]:
    """Return the copies of surfaces of which all faces are there equally often.

    The number is the greatest common divisor over a surface, since two solids that touch have two faces at some places.
    place: number of the corners of each face.
    """
    first = np.arange(len(corner))
    count = np.bincount(place)
    if count.max(initial=1) == 1:
        return first
    ends = np.sort(np.stack([corner, np.roll(corner, -1, 1)], 2).reshape(-1, 2), 1)
    owner, edge = np.repeat(first, 3), _number_rows(ends)
    surface = label_connected(len(corner) + int(edge.max()) + 1, np.stack([owner, len(corner) + edge], 1))[: len(corner)]
    times = np.zeros(int(surface.max()) + 1, np.int64)
    np.gcd.at(times, surface, count[place])
    wound = _wound(corner)
    order = np.lexsort((first, _rank(wound), place))  # at each place one face of each winding, then the others
    rank = np.empty(len(corner), np.int64)
    rank[order] = _rank(place[order])
    kept = np.flatnonzero(rank < count[place] // times[surface])
    stands_for = np.full((2, int(max(place.max(), wound.max())) + 1), -1)
    stands_for[0][place[kept[::-1]]] = kept[::-1]
    stands_for[1][wound[kept[::-1]]] = kept[::-1]
    first = np.where(stands_for[1][wound] >= 0, stands_for[1][wound], stands_for[0][place])
    first[kept] = kept
    return first


def _same_components(
    corner: Int[np.ndarray, "K 3"], triangles: Float[np.ndarray, "K 3 3"], parts: Components
) -> Int[np.ndarray, " K"]:
    """Return the copies of components with the same corners and the same area.

    Where a surface turns back onto itself, as at the rim of a sheet that has a back, it counts as two components.
    """
    normals, areas = normals_and_areas(triangles)
    f, g = parts.edges.faces.T
    cosine = np.einsum("ij,ij->i", normals[f], normals[g])
    folded = np.where(parts.edges.aligned, -cosine, cosine) > BACK_TO_BACK_COSINE
    label = label_connected(len(corner), parts.edges.faces[~folded]) if folded.any() else parts.label
    first = np.arange(len(corner))
    if label.max() == 0:
        return first
    order = np.argsort(label, kind="stable")
    start = np.flatnonzero(np.r_[True, np.diff(label[order]) != 0])
    bounds = [np.minimum.reduceat(corner.min(1)[order], start), np.maximum.reduceat(corner.max(1)[order], start)]
    pair = _number_rows(np.stack(bounds, 1))
    earlier: dict[bytes, list[int]] = {}
    members = np.split(order, start[1:])
    for c in np.flatnonzero(np.bincount(pair)[pair] > 1).tolist():
        mine, area = members[c], float(areas[members[c]].sum())
        same = earlier.setdefault(np.unique(corner[mine]).tobytes(), [])
        like = next((members[k] for k in same if abs(float(areas[members[k]].sum()) - area) <= SAME_AREA * area), None)
        if like is None:
            same.append(c)
        else:
            first[mine] = like[TriangleTree(triangles[like]).nearest(triangles[mine].mean(1))[1]]
    return first


def _same_faces(corner: Int[np.ndarray, "L 3"]) -> Int[np.ndarray, " L"]:
    """Return the copies of faces with the same corners and winding."""
    wound = _wound(corner)
    return np.unique(wound, return_index=True)[1][wound]


def _places(corner: Int[np.ndarray, "n 3"]) -> Int[np.ndarray, " n"]:
    """Number faces by their corners, whatever the winding, by a sum of random numbers, which is faster than sorting rows."""
    weight = np.random.default_rng(0).integers(0, 2**62, int(corner.max()) + 1, dtype=np.uint64)
    total = weight[corner[:, 0]] + weight[corner[:, 1]] + weight[corner[:, 2]]
    if not len(_repeated(total)):
        return np.arange(len(total))
    return np.unique(total, return_inverse=True)[1].reshape(-1)


def _wound(corner: Int[np.ndarray, "n 3"]) -> Int[np.ndarray, " n"]:
    """Number faces by their corners and winding, whichever corner is first."""
    turn = (corner.argmin(1)[:, None] + np.arange(3)) % 3
    return _number_rows(np.take_along_axis(corner, turn, 1))


def _rank(number: Int[np.ndarray, " n"]) -> Int[np.ndarray, " n"]:
    """Return how many earlier rows have the same number."""
    order = np.argsort(number, kind="stable")
    new = np.r_[True, np.diff(number[order]) != 0]
    rank = np.empty(len(number), np.int64)
    rank[order] = np.arange(len(number)) - np.maximum.accumulate(np.where(new, np.arange(len(number)), 0))
    return rank


def _number_rows(rows: Int[np.ndarray, "n k"]) -> Int[np.ndarray, " n"]:
    """Number the distinct rows of indices."""
    number = rows[:, 0]
    for column in rows.T[1:]:
        number = np.unique(number * (int(column.max(initial=0)) + 1) + column, return_inverse=True)[1].reshape(-1)
    return number
