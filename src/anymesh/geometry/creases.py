"""Concave creases that are soft: rounded, scanned or generated surfaces, where no single edge is sharp."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import KDTree

from anymesh.config import PiecesConfig
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.superpoints import superpoints
from anymesh.geometry.topology import EdgePairs, edge_pairs, label_connected


def convex_regions(triangles: Float[np.ndarray, "F 3 3"], diagonal: float, config: PiecesConfig) -> Int[np.ndarray, " F"]:
    """A region a face: superpoints, joined across every border that is not a concave crease (locally convex patches,
    Stein et al. 2014). A crease is judged by the surface within `reach` of it, so a bowl's inside stays whole."""
    few = simplify(triangles, config.superpoint_faces)
    corners = few.reshape(-1, 3)
    edges = edge_pairs(corners, np.arange(len(corners)).reshape(-1, 3))
    cross = np.cross(few[:, 1] - few[:, 0], few[:, 2] - few[:, 0])
    double = np.maximum(np.linalg.norm(cross, axis=1), 1e-300)
    normals = cross / double[:, None]
    length = np.linalg.norm(corners[edges.vertices[:, 0]] - corners[edges.vertices[:, 1]], axis=1)
    label = superpoints(normals, double / 2, edges.faces, length, config.superpoint_strength)
    pairs = label[edges.faces]
    cut = _concave_borders(few.mean(1), normals, double, label, edges, corners, config, diagonal)
    region = label_connected(int(label.max()) + 1, pairs[~cut & (pairs[:, 0] != pairs[:, 1])])[label]
    if len(few) == len(triangles):
        return region
    return region[KDTree(few.mean(1)).query(triangles.mean(1), workers=-1)[1]]


def _concave_borders(
    centers: np.ndarray, normals: np.ndarray, weight: np.ndarray, label: np.ndarray, edges: EdgePairs, corners: np.ndarray,
    config: PiecesConfig, diagonal: float,
) -> Bool[np.ndarray, " m"]:  # fmt: skip
    """Which edges lie on a border of two superpoints that folds inwards by more than `config.crease`."""
    pairs = np.sort(label[edges.faces], 1)
    border = np.flatnonzero(pairs[:, 0] != pairs[:, 1])
    count = int(label.max()) + 1
    key, where = np.unique(pairs[border] @ np.array([count, 1]), return_inverse=True)
    order = np.argsort(label, kind="stable")
    start = np.searchsorted(label[order], np.arange(count + 1))
    middle = corners[edges.vertices[border]].mean(1)
    rows = np.argsort(where.reshape(-1), kind="stable")
    first = np.searchsorted(where.reshape(-1)[rows], np.arange(len(key) + 1))
    concave = np.zeros(len(key), bool)
    for k, pair in enumerate(key):
        tree = KDTree(middle[rows[first[k] : first[k + 1]]])
        ends = []
        for side in divmod(int(pair), count):
            mine = order[start[side] : start[side + 1]]
            gap = tree.query(centers[mine])[0]
            near = mine[gap <= max(config.reach * diagonal, float(gap.min()))]
            ends.append((np.average(centers[near], 0, weight[near]), np.average(normals[near], 0, weight[near])))
        (a, n), (b, m) = ends
        cosine = float(n @ m) / max(float(np.linalg.norm(n) * np.linalg.norm(m)), 1e-300)
        concave[k] = (b - a) @ (n - m) > 0 and cosine < np.cos(np.deg2rad(config.crease))
    cut = np.zeros(len(pairs), bool)
    cut[border] = concave[where.reshape(-1)]
    return cut
