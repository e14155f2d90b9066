"""Find soft concave creases on rounded, scanned or generated surfaces without sharp edges."""

from __future__ import annotations

import heapq

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import KDTree

from anymesh.config import PatchConfig
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.superpoints import superpoints
from anymesh.geometry.topology import edge_pairs
from anymesh.types.triangles import normals_and_areas

BOX_MARGIN = 1.01  # of `reach`: faces outside this margin around a border's box are farther away than `reach`


def convex_regions(triangles: Float[np.ndarray, "F 3 3"], diagonal: float, config: PatchConfig) -> Int[np.ndarray, " F"]:
    """Return a region index per face.

    Regions are superpoints joined across their borders, except for concave creases (locally convex patches, Stein et al. 2014).
    Long creases outweigh short gaps in them (multicut by greedy contraction, Keuper et al. 2015). A crease is judged by the
    surface within `reach` of it, so that the inside of a bowl is not split.
    """
    few = simplify(triangles, config.superpoint_faces)
    corners = few.reshape(-1, 3)
    edges = edge_pairs(corners, np.arange(len(corners)).reshape(-1, 3))
    normals, areas = normals_and_areas(few)
    areas = np.maximum(areas, 1e-300)
    middle = corners[edges.vertices].mean(1)
    length = np.linalg.norm(corners[edges.vertices[:, 0]] - corners[edges.vertices[:, 1]], axis=1)
    label = superpoints(normals, areas, edges.faces, length, config.superpoint_strength)
    count = int(label.max()) + 1
    pairs = np.sort(label[edges.faces], 1)
    border = np.flatnonzero(pairs[:, 0] != pairs[:, 1])
    key, where = np.unique(pairs[border] @ np.array([count, 1]), return_inverse=True)
    pull = np.bincount(where.reshape(-1), length[border], len(key))
    pull[_folds_inwards(few.mean(1), normals, areas, label, key, where.reshape(-1), middle[border], diagonal, config)] *= -1
    region = _contract(count, {divmod(int(k), count): float(p) for k, p in zip(key, pull, strict=True)})[label]
    if len(few) == len(triangles):
        return region
    return region[KDTree(few.mean(1)).query(triangles.mean(1), workers=-1)[1]]


def _folds_inwards(
    centers: np.ndarray, normals: np.ndarray, weight: np.ndarray, label: np.ndarray, key: np.ndarray, where: np.ndarray,
    middle: np.ndarray, diagonal: float, config: PatchConfig,
) -> np.ndarray:  # fmt: skip
    """Return which borders (pairs of superpoints, by key) fold inwards by more than `config.crease`.

    middle: centers of the edges on the borders.
    """
    count, reach = int(label.max()) + 1, config.reach * diagonal
    order = np.argsort(label, kind="stable")
    start = np.searchsorted(label[order], np.arange(count + 1))
    ordered = centers[order]
    rows = np.argsort(where, kind="stable")
    first = np.searchsorted(where[rows], np.arange(len(key) + 1))
    inwards = np.zeros(len(key), bool)
    for k, pair in enumerate(key):
        border = middle[rows[first[k] : first[k + 1]]]
        tree, low, high = KDTree(border), border.min(0) - BOX_MARGIN * reach, border.max(0) + BOX_MARGIN * reach
        ends = []
        for side in divmod(int(pair), count):
            mine, points = (a[start[side] : start[side + 1]] for a in (order, ordered))
            boxed = mine[((points >= low) & (points <= high)).all(1)]  # most faces of a large superpoint are far away
            near = boxed[tree.query(centers[boxed], distance_upper_bound=BOX_MARGIN * reach)[0] <= reach]
            if len(near) == 0:
                gap = tree.query(points)[0]
                near = mine[gap <= gap.min()]
            share = weight[near][:, None]  # np.average without its overhead
            total = share.sum(0)
            ends.append(((centers[near] * share).sum(0) / total, (normals[near] * share).sum(0) / total))
        (a, n), (b, m) = ends
        cosine = float(n @ m) / max(float(np.linalg.norm(n) * np.linalg.norm(m)), 1e-300)
        inwards[k] = (b - a) @ (n - m) > 0 and cosine < np.cos(np.deg2rad(config.crease))
    return inwards


def _contract(count: int, pull: dict[tuple[int, int], float]) -> Int[np.ndarray, " n"]:
    """Join the pair with the highest attraction and add up its attractions to others, until none is positive."""
    near: list[dict[int, float]] = [{} for _ in range(count)]
    for (a, b), p in pull.items():
        near[a][b] = near[b][a] = p
    heap = [(-p, a, b) for (a, b), p in pull.items() if p > 0]
    heapq.heapify(heap)
    target = np.arange(count)
    while heap:
        p, a, b = heapq.heappop(heap)
        if near[a].get(b) != -p:
            continue
        if len(near[a]) < len(near[b]):
            a, b = b, a
        for other, q in near[b].items():
            del near[other][b]
            if other != a:
                total = near[a].get(other, 0.0) + q
                near[a][other] = near[other][a] = total
                if total > 0:
                    heapq.heappush(heap, (-total, min(a, other), max(a, other)))
        near[b] = {}
        target[b] = a
    while (target[target] != target).any():
        target = target[target]
    return np.unique(target, return_inverse=True)[1].reshape(-1)
