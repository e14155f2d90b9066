"""Mesh topology: welding, edges, connected components, the winding of their faces, closed solids."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import KDTree

from anymesh.geometry.triangle_set import SLANTED, TriangleSet, remembering
from anymesh.types import Brief
from anymesh.types.triangles import bounds_of, by_key, centers_of, corners_of, face_cross, lengths, normals_and_areas, unshared

MIN_VOLUME_SHARE = 0.1  # of the volumes between the faces and their middle: a surface around less has no outside
FLAT = 1e-9  # of the area to the power of 1.5: a smaller volume is rounding
# [rad] faces at an edge with a smaller angle between them count as coplanar, to allow for imprecise exports
MAX_COPLANAR_ANGLE_RAD = 0.05
# of the diagonal: open edges with nearer ends are one edge; coordinates of 14 bits leave such cracks
MAX_CRACK_RATIO = 5e-5
MAX_CRACK_ENDS = 8  # ends of open edges that are joined with one, the nearest first
MIN_MIXED_SHARE = 0.05  # of the edges of two faces: if more of these disagree, no winding is trusted
MAX_AROUND = 1000  # faces around an edge, above which none of them bounds a solid
MAX_COMPARED = 4_000_000  # pairs of faces around edges that are compared at once, which limits memory


@dataclass(frozen=True, eq=False)
class Winding(Brief):
    """How the faces of each component must be wound.

    label: (F,) component of each face; flip: (F,) faces to reverse; two_sided: (c,) components whose faces can agree; sure:
    (F,) faces of components that enclose a volume.
    """

    label: Int[np.ndarray, " F"]
    flip: Bool[np.ndarray, " F"]
    two_sided: Bool[np.ndarray, " c"]
    sure: Bool[np.ndarray, " F"]


def agreeing(
    count: int, pairs: Int[np.ndarray, "m 2"], aligned: Bool[np.ndarray, " m"]
) -> tuple[Int[np.ndarray, " F"], Bool[np.ndarray, " F"], Bool[np.ndarray, " c"]]:
    """Return the component of each face, which faces to reverse so that all of a component agree with its first, and whether
    they can.

    pairs: faces that meet at an edge; aligned: whether they agree. No face of a one-sided component, such as a Moebius strip,
    is reversed.
    """
    label = label_connected(count, pairs)
    components = int(label.max()) + 1
    if aligned.all():
        return label, np.zeros(count, bool), np.ones(components, bool)
    f, g = pairs.T  # each face is two nodes, as it is and reversed
    side = label_connected(2 * count, np.concatenate([np.c_[f, g + count * ~aligned], np.c_[f + count, g + count * aligned]]))
    first = np.unique(label, return_index=True)[1]
    two_sided = side[first] != side[first + count]
    return label, two_sided[label] & (side[:count] != side[first][label]), two_sided


def outward(triangles: Float[np.ndarray, "F 3 3"], pairs: Int[np.ndarray, "m 2"], aligned: Bool[np.ndarray, " m"]) -> Winding:
    """Return how to wind the faces so that each component faces outwards.

    pairs, aligned: as in `agreeing`.

    A component that encloses hardly any volume, such as a flat sheet, is wound as most of its surface is, unless most of the
    other components are inside out.
    """
    label, flip, two_sided = agreeing(len(triangles), pairs, aligned)
    count = len(two_sided)
    faces = np.bincount(label, minlength=count)
    middle = np.stack([np.bincount(label, column, count) for column in centers_of(triangles).T], 1) / faces[:, None]
    t = triangles - middle.take(label, axis=0)[:, None]
    cross = face_cross(t)
    volume = np.where(flip, -1, 1) * np.einsum("ij,ij->i", t[:, 0], cross)
    total, enclosed = np.bincount(label, volume, count), np.bincount(label, np.abs(volume), count)
    areas = lengths(cross)
    area, kept = np.bincount(label, areas, count), np.bincount(label, np.where(flip, -areas, areas), count)
    around = np.abs(total) > np.maximum(MIN_VOLUME_SHARE * enclosed, FLAT * area**1.5)
    inside_out = (np.sign(total) * kept)[around].sum() < 0
    reverse = np.where(around, total < 0, (kept < 0) ^ inside_out) & two_sided
    return Winding(label, flip ^ reverse[label], two_sided, around[label])


def back_to_back(
    triangles: Float[np.ndarray, "F 3 3"], corner: Int[np.ndarray, "F 3"], asked: Bool[np.ndarray, " F"]
) -> tuple[Bool[np.ndarray, " F"], Bool[np.ndarray, " F"]]:
    """Return which of some faces lie in pairs on each other, and which of these to reverse so that each pair is back to back.

    corner: numbers of the corners. In one plane, the first faces of all pairs face the same side, so that a side on which two
    solids lie on each other becomes a side of each.
    """
    rows = np.flatnonzero(asked)
    place, count = np.unique(np.sort(corner[rows], 1), axis=0, return_inverse=True, return_counts=True)[1:]
    place = place.reshape(-1)
    rows, place = rows[count[place] == 2], place[count[place] == 2]
    first, second = rows[np.argsort(place, kind="stable")].reshape(-1, 2).T
    ahead = face_cross(triangles) @ SLANTED > 0
    paired, flip = np.zeros(len(asked), bool), np.zeros(len(asked), bool)
    paired[rows], flip[first], flip[second] = True, ~ahead[first], ahead[second]
    return paired, flip


def label_connected(count: int, pairs: Int[np.ndarray, "m 2"]) -> Int[np.ndarray, " n"]:
    """Label the connected components of `count` nodes, ordered by first node.

    Each node points to an earlier one (Shiloach and Vishkin, 1982): two to nine times as fast as scipy up to 20,000 pairs, and
    about as fast above.
    """
    root, (a, b) = np.arange(count), pairs.T
    while True:
        a, b = root[a], root[b]
        apart = a != b
        if not apart.any():
            return (np.cumsum(root == np.arange(count)) - 1)[root]
        a, b = a[apart], b[apart]
        np.minimum.at(root, np.maximum(a, b), np.minimum(a, b))
        while (above := root[root]).tobytes() != root.tobytes():
            root = above


def strongest(
    row: Int[np.ndarray, " n"], column: Int[np.ndarray, " n"], weight: np.ndarray | None, count: int
) -> tuple[Int[np.ndarray, " r"], Int[np.ndarray, " r"]]:
    """Return the distinct rows, ascending, and for each the column with the greatest total weight, the lowest of equal ones.

    weight: of each pair, None for 1; count: number of columns.
    """
    key, pair = np.unique(row.astype(np.int64) * count + column, return_inverse=True)
    total = np.bincount(pair.reshape(-1), weight)
    order = np.lexsort((key % count, -total, key // count))
    best = key[order[np.r_[True, np.diff(key[order] // count) != 0]]]
    return best // count, best % count


@remembering
def weld(vertices: Float[np.ndarray, "V 3"]) -> Int[np.ndarray, " V"]:
    """Return an index per position: vertices closer than one part in 2**24 of the largest extent share it.

    The cells of a grid of 2**20 parts are joined if each has a vertex within a sixteenth of a cell of their border.
    """
    low, high = bounds_of(vertices)
    extent = float((high - low).max()) or 1.0
    at = [(column - least) / extent * 2**20 for column, least in zip(vertices.T, low, strict=True)]
    cell = [np.rint(a).astype(np.int64) for a in at]
    number = np.unique(_grid_key(cell), return_inverse=True)[1].reshape(-1)
    near = [np.abs(a - c) >= 7 / 16 for a, c in zip(at, cell, strict=True)]
    joined = [np.zeros((0, 2), np.int64)]
    for axes in list(product([False, True], repeat=3))[1:]:  # the axes on which two vertices may lie on two sides of a border
        rows = np.flatnonzero(np.logical_and.reduce([n for n, across in zip(near, axes, strict=True) if across]))
        # half a cell aside on those axes
        key = _grid_key([np.floor(at[k][rows]).astype(np.int64) if axes[k] else cell[k][rows] for k in range(3)])
        order = np.argsort(key)
        met = number[rows[order]]
        same = (np.diff(key[order]) == 0) & (np.diff(met) != 0)
        joined.append(np.stack([met[:-1][same], met[1:][same]], 1))
    pairs = np.concatenate(joined)
    return label_connected(int(number.max()) + 1, pairs)[number] if len(pairs) else number


def _grid_key(cell: Sequence[np.ndarray]) -> np.ndarray:
    x, y, z = cell
    return (x << 42) | (y << 21) | z


@dataclass(frozen=True, eq=False)
class EdgePairs(Brief):
    """Pairs of faces that bound the same material at a shared edge of the welded mesh.

    faces: (m, 2) face indices; vertices: (m, 2) the edge's end points, indices into the mesh's vertices; aligned: (m,) True if
    the two faces traverse the edge in opposite directions; open_faces: faces with an unpaired edge.
    """

    faces: Int[np.ndarray, "m 2"]
    vertices: Int[np.ndarray, "m 2"]
    aligned: Bool[np.ndarray, " m"]
    open_faces: Int[np.ndarray, " k"]


def edge_pairs(vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"]) -> EdgePairs:
    """Return all pairs of faces that meet at an edge.

    Open edges whose ends are closer than MAX_CRACK_RATIO meet too. If more than two faces share an edge (bodies that touch
    along it), each is paired with the face across the material between them, so that touching solids stay separate.
    """
    welded, half = _welded(vertices, faces)
    two = half.start[half.size == 2]
    left, right = [two], [two + 1]
    if (half.size > 2).any():
        owner, forward = half.owner, half.forward
        flip, unsure = _outer_windings(corners_of(vertices, faces), welded[faces], half)
        outer, unsure = forward ^ flip[owner], unsure[owner]
        for count in np.unique(half.size[(half.size > 2) & (half.size <= MAX_AROUND)]):
            rows = half.start[half.size == count][:, None] + np.arange(count)
            for some in np.array_split(rows, len(rows) * count * count // MAX_COMPARED + 1):
                first = some[:, 0]
                edge = np.where(forward[first, None], half.ends[first], half.ends[first, ::-1])
                ways = outer[some] | unsure[some], ~outer[some] | unsure[some]
                i, j = _across_material(vertices[edge], vertices[half.third[some]], ways, owner[some])
                left.append(some[i, j[0]])
                right.append(some[i, j[1]])
    i, j = np.concatenate(left), np.concatenate(right)
    paired = np.zeros(len(half.owner), bool)
    paired[i] = paired[j] = True
    loose = np.bincount(half.owner[~paired], minlength=len(faces)) > 0
    pairs, ends = np.stack([half.owner[i], half.owner[j]], 1), half.ends.take(i, axis=0)
    return EdgePairs(pairs, ends, half.forward[i] != half.forward[j], np.flatnonzero(loose))


def _outer_windings(
    triangles: Float[np.ndarray, "F 3 3"], corner: Int[np.ndarray, "F 3"], half: _HalfEdges
) -> tuple[Bool[np.ndarray, " F"], Bool[np.ndarray, " F"]]:
    """Return the faces to reverse so that all face outwards, and those of which it is unknown, by edges of two faces alone."""
    two = half.start[half.size == 2]
    pairs, aligned = half.owner[np.stack([two, two + 1], 1)], half.forward[two] != half.forward[two + 1]
    wound = outward(triangles, pairs, aligned)
    if (~aligned).sum() <= MIN_MIXED_SHARE * len(aligned):
        return wound.flip, np.zeros(len(triangles), bool)
    paired, settled = back_to_back(triangles, corner, ~wound.sure)
    return np.where(paired, settled, wound.flip), ~wound.sure & ~paired


@dataclass(frozen=True, eq=False)
class _HalfEdges(Brief):
    """The edges of all faces, those at the same place one after another.

    ends: (n, 2) vertices; third: (n,) opposite vertex; owner: (n,) face; forward: (n,) from the lower place to the higher;
    start, size: (k,) first row and number of rows of each place.
    """

    ends: Int[np.ndarray, "n 2"]
    third: Int[np.ndarray, " n"]
    owner: Int[np.ndarray, " n"]
    forward: Bool[np.ndarray, " n"]
    start: Int[np.ndarray, " k"]
    size: Int[np.ndarray, " k"]

    @classmethod
    def of(cls, welded: Int[np.ndarray, " V"], faces: Int[np.ndarray, "F 3"]) -> _HalfEdges:
        """List the edges of all faces except those without a length."""
        corner, count = faces.reshape(-1), int(welded.max(initial=0)) + 1
        a, b = (welded.take(some).reshape(-1) for some in (faces, np.roll(faces, -1, 1)))
        order, key = by_key(np.minimum(a, b) * count + np.maximum(a, b), count**2)
        kept = (a != b)[order]
        if not kept.all():
            order, key = order[kept], key[kept]
        owner, slot = np.divmod(order, 3)
        following = order + 1 - 3 * (slot == 2)
        third = corner[3 * owner + 3 - slot - (following - 3 * owner)]  # slots are 0, 1 and 2
        start = np.flatnonzero(np.r_[True, key[1:] != key[:-1]])
        size = np.diff(np.r_[start, len(key)])
        return cls(np.stack([corner[order], corner[following]], 1), third, owner, a[order] < b[order], start, size)


def without_cracks(
    vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], reach: float | None = None
) -> Float[np.ndarray, "V 3"]:
    """Return the vertices with nearby ends of open edges moved to one place; the same array if there are none.

    reach: distance of near ones [m], MAX_CRACK_RATIO of the diagonal of these faces by default.
    """
    exact, number = weld(vertices), _welded(vertices, faces, reach)[0]
    first = np.unique(number, return_index=True)[1][number]
    moved = exact != exact[first]
    return np.where(moved[:, None], vertices[first], vertices) if moved.any() else vertices


def _welded(
    vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], reach: float | None = None
) -> tuple[Int[np.ndarray, " V"], _HalfEdges]:
    """Number the vertices as `weld`, nearby ends of open edges alike; return also the edges of all faces."""
    welded = weld(vertices)
    half = _HalfEdges.of(welded, faces)
    ends = half.ends[half.start[half.size == 1]].reshape(-1)
    if not len(ends):
        return welded, half
    place, first = np.unique(welded[ends], return_index=True)
    points = vertices[ends[first]]
    if reach is None:
        low, high = bounds_of(corners_of(vertices, faces).reshape(-1, 3))
        reach = MAX_CRACK_RATIO * float(np.linalg.norm(high - low))
    near = KDTree(points).query(points, MAX_CRACK_ENDS, distance_upper_bound=reach, workers=-1)[1].reshape(len(points), -1)
    row, slot = np.nonzero((near < len(points)) & (near != np.arange(len(points))[:, None]))
    if not len(row):
        return welded, half
    met = np.stack([place[row], place[near[row, slot]]], 1)
    welded = label_connected(int(welded.max()) + 1, met)[welded]
    return welded, _HalfEdges.of(welded, faces)


def _across_material(
    edge: np.ndarray, third: np.ndarray, ways: tuple[np.ndarray, np.ndarray], owner: np.ndarray
) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]:
    """Return pairs (row, (slot, slot)) among the n faces around each of m edges.

    edge: (m, 2, 3) its ends; third: (m, n, 3) the opposite corners; ways: (m, n) whether the face, wound outwards, may have the
    edge in this direction, and in the other one.

    A face is paired with the next one behind its surface. Of several in one plane (bodies that overlap), the one with the
    closest index is used.
    """
    along = edge[:, 1:] - edge[:, :1]
    along /= np.maximum(np.linalg.norm(along, axis=2, keepdims=True), 1e-300)
    into = third - edge[:, :1]
    into -= (into * along).sum(2, keepdims=True) * along
    u = into[:, :1] / np.maximum(np.linalg.norm(into[:, :1], axis=2, keepdims=True), 1e-300)
    v = np.cross(along, u)
    angle = np.arctan2((into * v).sum(2), (into * u).sum(2))
    turn = (angle[:, :, None] - angle[:, None, :]) % (2 * np.pi)
    turn = np.where((turn < MAX_COPLANAR_ANGLE_RAD) | (turn > 2 * np.pi - MAX_COPLANAR_ANGLE_RAD), 2 * np.pi, turn)
    turn = np.where(ways[0][:, :, None] & ways[1][:, None, :], turn, np.inf)
    apart = np.abs(owner[:, :, None] - owner[:, None, :])
    mate, back = (
        np.where(turn <= turn.min(k, keepdims=True) + MAX_COPLANAR_ANGLE_RAD, apart, np.inf).argmin(k) for k in (2, 1)
    )
    row, slot = np.nonzero(np.isfinite(turn.min(2)))
    mutual = back[row, mate[row, slot]] == slot
    row, slot = row[mutual], slot[mutual]
    other = mate[row, slot]
    once = _first_uses(row, slot, other, turn[row, slot, other], owner.shape[1])
    return row[once], (slot[once], other[once])


def _first_uses(row: np.ndarray, slot: np.ndarray, other: np.ndarray, turn: np.ndarray, count: int) -> np.ndarray:
    """Return the pairs, those with the smallest turn first, without those of a face that an earlier one has at its edge."""
    order = np.argsort(turn, kind="stable")
    uses = np.stack([row * count + slot, row * count + other], 1)[order]
    first = np.full(int(uses.max(initial=0)) + 1, len(order))
    np.minimum.at(first, uses, np.arange(len(order))[:, None])
    return np.sort(order[(first[uses] == np.arange(len(order))[:, None]).all(1)])


@dataclass(frozen=True, eq=False)
class Components(Brief):
    """Connected components of the welded mesh.

    label: (F,) component of each face; solid: (count,) closed and two-sided; flip: (F,) faces to reverse so that those of a
    component agree, and face outwards unless they enclose nothing; agree: (count,) whether they agree already.
    """

    label: Int[np.ndarray, " F"]
    solid: Bool[np.ndarray, " c"]
    flip: Bool[np.ndarray, " F"]
    agree: Bool[np.ndarray, " c"]
    edges: EdgePairs

    @property
    def count(self) -> int:
        return len(self.solid)


@remembering
def components(vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"]) -> Components:
    """Find the connected components of the welded mesh, and which of them enclose a volume."""
    edges = edge_pairs(vertices, faces)
    wound = outward(corners_of(vertices, faces), edges.faces, edges.aligned)
    solid, agree = wound.two_sided.copy(), np.ones(len(wound.two_sided), bool)
    solid[wound.label[edges.open_faces]] = False
    agree[wound.label[edges.faces[~edges.aligned, 0]]] = False
    return Components(wound.label, solid, wound.flip, agree, edges)


def triangle_set_of(triangles: Float[np.ndarray, "F 3 3"]) -> TriangleSet:
    """Build a triangle set with the normals of closed components outward, whatever their winding."""
    parts = components(*unshared(triangles))
    normals = normals_and_areas(triangles)[0]
    outwards = np.where(parts.flip[:, None], -normals, normals)
    return TriangleSet(triangles, outwards, parts.solid[parts.label], np.arange(len(triangles)))
