"""Mesh topology: welding, edges, connected components, closed solids."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

# [rad] faces at an edge with a smaller angle between them count as coplanar, to allow for imprecise exports
MAX_COPLANAR_ANGLE_RAD = 0.05


def weld(vertices: Float[np.ndarray, "V 3"]) -> Int[np.ndarray, " V"]:
    """Return an index per position: vertices closer than one part in 2**24 of the largest extent share it.

    The cells of a grid of 2**20 parts are joined if each has a vertex within a sixteenth of a cell of their border.
    """
    low = vertices.min(0)
    extent = float((vertices.max(0) - low).max()) or 1.0
    at = (vertices - low) / extent * 2**20
    cell = np.rint(at).astype(np.int64)
    number = np.unique(_grid_key(cell), return_inverse=True)[1].reshape(-1)
    near = np.abs(at - cell) >= 7 / 16
    joined = [np.zeros((0, 2), np.int64)]
    for axes in list(product([False, True], repeat=3))[1:]:  # the axes on which two vertices may lie on two sides of a border
        rows = np.flatnonzero(near[:, axes].all(1))
        key = _grid_key(np.where(axes, np.floor(at[rows]).astype(np.int64), cell[rows]))  # half a cell aside on those axes
        order = np.argsort(key)
        met = number[rows[order]]
        same = (np.diff(key[order]) == 0) & (np.diff(met) != 0)
        joined.append(np.stack([met[:-1][same], met[1:][same]], 1))
    pairs = np.concatenate(joined)
    return label_connected(int(number.max()) + 1, pairs)[number] if len(pairs) else number


def _grid_key(cell: np.ndarray) -> np.ndarray:
    return (cell[:, 0] << 42) | (cell[:, 1] << 21) | cell[:, 2]


@dataclass(frozen=True, eq=False)
class EdgePairs:
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

    If more than two faces share an edge (bodies that touch along it), each is paired with the face across the material between
    them, so that touching solids stay separate.
    """
    welded = weld(vertices)
    f = welded[faces]
    a, b = f.reshape(-1), f[:, [1, 2, 0]].reshape(-1)
    ends = np.stack([faces.reshape(-1), faces[:, [1, 2, 0]].reshape(-1)], 1)
    third = faces[:, [2, 0, 1]].reshape(-1)
    owner = np.repeat(np.arange(len(faces)), 3)
    keep = a != b
    a, b, owner, ends, third = a[keep], b[keep], owner[keep], ends[keep], third[keep]
    key = np.minimum(a, b).astype(np.int64) * (int(welded.max()) + 1) + np.maximum(a, b)
    order = np.argsort(key, kind="stable")
    key, owner, ends, third, forward = key[order], owner[order], ends[order], third[order], (a < b)[order]
    start = np.flatnonzero(np.r_[True, key[1:] != key[:-1]])
    size = np.diff(np.r_[start, len(key)])
    two = start[size == 2]
    left, right = [two], [two + 1]
    for count in np.unique(size[size > 2]):
        rows = start[size == count][:, None] + np.arange(count)
        i, j = _across_material(vertices, ends[rows], third[rows], forward[rows], owner[rows])
        left.append(rows[i, j[0]])
        right.append(rows[i, j[1]])
    i, j = np.concatenate(left), np.concatenate(right)
    paired = np.zeros(len(key), bool)
    paired[i] = paired[j] = True
    loose = np.unique(owner[~paired])
    return EdgePairs(np.stack([owner[i], owner[j]], 1), ends[i], forward[i] != forward[j], loose)


def _across_material(
    vertices: np.ndarray, ends: np.ndarray, third: np.ndarray, forward: np.ndarray, owner: np.ndarray
) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]:
    """Return pairs (row, (slot, slot)) among the n faces around each of m edges.

    A face is paired with the next one behind its surface. Of several in one plane (bodies that overlap), the one with the
    closest index is used.
    """
    low = np.where(forward[:, :1, None], vertices[ends[:, :1, 0]], vertices[ends[:, :1, 1]])
    high = np.where(forward[:, :1, None], vertices[ends[:, :1, 1]], vertices[ends[:, :1, 0]])
    edge = high - low
    edge /= np.maximum(np.linalg.norm(edge, axis=2, keepdims=True), 1e-300)
    into = vertices[third] - low
    into -= (into * edge).sum(2, keepdims=True) * edge
    u = into[:, :1] / np.maximum(np.linalg.norm(into[:, :1], axis=2, keepdims=True), 1e-300)
    v = np.cross(edge, u)
    angle = np.arctan2((into * v).sum(2), (into * u).sum(2))
    turn = (angle[:, :, None] - angle[:, None, :]) % (2 * np.pi)
    turn = np.where((turn < MAX_COPLANAR_ANGLE_RAD) | (turn > 2 * np.pi - MAX_COPLANAR_ANGLE_RAD), 2 * np.pi, turn)
    turn = np.where(forward[:, :, None] & ~forward[:, None, :], turn, np.inf)
    apart = np.abs(owner[:, :, None] - owner[:, None, :])
    mate, back = (
        np.where(turn <= turn.min(k, keepdims=True) + MAX_COPLANAR_ANGLE_RAD, apart, np.inf).argmin(k) for k in (2, 1)
    )
    row, slot = np.nonzero(np.isfinite(turn.min(2)))
    mutual = back[row, mate[row, slot]] == slot
    row, slot = row[mutual], slot[mutual]
    return row, (slot, mate[row, slot])


def label_connected(count: int, pairs: Int[np.ndarray, "m 2"]) -> Int[np.ndarray, " n"]:
    """Label the connected components of `count` nodes, ordered by first node."""
    graph = coo_array((np.ones(len(pairs), np.int8), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    _, raw = connected_components(graph, directed=False)
    first = np.unique(raw, return_index=True)[1]
    rank = np.empty(len(first), np.int64)
    rank[np.argsort(first)] = np.arange(len(first))
    return rank[raw]


@dataclass(frozen=True, eq=False)
class Components:
    """Connected components of the welded mesh.

    label: (F,) component of each face; solid: (count,) closed and consistently wound; flip: (count,) solid but inside out.
    """

    label: Int[np.ndarray, " F"]
    solid: Bool[np.ndarray, " c"]
    flip: Bool[np.ndarray, " c"]
    edges: EdgePairs

    @property
    def count(self) -> int:
        return len(self.solid)


def components(vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"]) -> Components:
    """Find the connected components of the welded mesh, and which of them enclose a volume."""
    edges = edge_pairs(vertices, faces)
    label = label_connected(len(faces), edges.faces)
    count = int(label.max()) + 1
    solid = np.ones(count, bool)
    solid[label[edges.open_faces]] = False
    solid[label[edges.faces[~edges.aligned, 0]]] = False
    t = vertices[faces] - vertices[faces].mean((0, 1))
    six_volumes = np.bincount(label, np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])), count)
    return Components(label, solid, solid & (six_volumes < 0), edges)
