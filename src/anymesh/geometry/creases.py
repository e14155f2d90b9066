"""Divide surfaces without sharp edges: at soft concave creases, and at seams that are closed in places."""

from __future__ import annotations

import heapq

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import KDTree

from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.superpoints import superpoints
from anymesh.geometry.topology import edge_pairs, label_connected
from anymesh.types.triangles import centers_of, lengths, normals_and_areas, unshared

MAX_CREASE_FACES = 40_000  # denser components are simplified before they are cut into superpoints
CREASE_STRENGTH = 0.05  # of l0 cut pursuit on normals (the paper's implementation)
MIN_CREASE_DEG = 25.0  # [deg] minimum angle of a concave edge that may bound a part on a fused surface
REACH_RATIO = 0.01  # of the diagonal: distance from a soft crease within which the surface defines its angle
BOX_MARGIN = 1.01  # of this reach: faces outside this margin around a border's box are farther away
AROUND = 32  # points around a point, over which positions and normals are averaged
NEIGHBOURS = 8  # points that a point is connected to
MAX_CREASE_COSINE = 0.97  # cosine to the mean normal around a point (14 degrees) below which it may lie on a crease
MIN_CREASE_POINTS = 10  # connected points of a crease; fewer are noise
MAX_PASSAGE_RATIO = 0.5  # of the distance of a region's middle to the border: widest passage to another region
MIN_CLOSED_SHARE = 0.5  # share of the line between two regions that is border
CLOSE = 2.0  # [spacings] greatest distance of this share from the border
MIN_REGION_SHARE = 0.02  # share of the points below which a region joins the nearest


def convex_regions(triangles: Float[np.ndarray, "F 3 3"], diagonal: float) -> Int[np.ndarray, " F"]:
    """Return a region index per face.

    Regions are superpoints joined across their borders, except for concave creases (locally convex patches, Stein et al. 2014).
    Long creases outweigh short gaps in them (multicut by greedy contraction, Keuper et al. 2015). A crease is judged by the
    surface within REACH_RATIO of it, so that the inside of a bowl is not split.
    """
    few = simplify(triangles, MAX_CREASE_FACES)
    corners, faces = unshared(few)
    edges = edge_pairs(corners, faces)
    normals, areas = normals_and_areas(few)
    areas = np.maximum(areas, 1e-300)
    middle = corners[edges.vertices].mean(1)
    length = lengths(corners[edges.vertices[:, 0]] - corners[edges.vertices[:, 1]])
    label = superpoints(normals, areas, edges.faces, length, CREASE_STRENGTH)
    count = int(label.max()) + 1
    pairs = np.sort(label[edges.faces], 1)
    border = np.flatnonzero(pairs[:, 0] != pairs[:, 1])
    key, where = np.unique(pairs[border] @ np.array([count, 1]), return_inverse=True)
    pull = np.bincount(where.reshape(-1), length[border], len(key))
    pull[_folds_inwards(centers_of(few), normals, areas, label, key, where.reshape(-1), middle[border], diagonal)] *= -1
    region = _contract(count, {divmod(int(k), count): float(p) for k, p in zip(key, pull, strict=True)})[label]
    if len(few) == len(triangles):
        return region
    return region[KDTree(centers_of(few)).query(centers_of(triangles), workers=-1)[1]]


def _folds_inwards(
    centers: np.ndarray, normals: np.ndarray, weight: np.ndarray, label: np.ndarray, key: np.ndarray, where: np.ndarray,
    middle: np.ndarray, diagonal: float,
) -> np.ndarray:  # fmt: skip
    """Return which borders (pairs of superpoints, by key) fold inwards by more than MIN_CREASE_DEG.

    middle: centers of the edges on the borders.
    """
    count, reach = int(label.max()) + 1, REACH_RATIO * diagonal
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
        inwards[k] = (b - a) @ (n - m) > 0 and cosine < np.cos(np.deg2rad(MIN_CREASE_DEG))
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


def divide_at_seams(
    points: Float[np.ndarray, "n 3"], normals: Float[np.ndarray, "n 3"], outside: Float[np.ndarray, "m 3"]
) -> Int[np.ndarray, " n"]:
    """Return the region of each of the points, which sample a surface evenly; regions are numbered from 0.

    outside: points of the surface around them. The border consists of these points and of the concave creases among the points.
    Two regions are kept apart if most of the line between them is border, and its gaps are narrower than the regions.
    """
    one = np.zeros(len(points), np.int64)
    if len(points) <= AROUND:
        return one
    gap, near = KDTree(points).query(points, k=AROUND, workers=-1)
    spacing = float(np.median(gap[:, NEIGHBOURS]))
    border = np.concatenate([outside, points[_concave_creases(points, normals, near, spacing)]])
    if not len(border):
        return one
    distance = KDTree(border).query(points, workers=-1)[0]
    region = _basins(distance, near[:, : NEIGHBOURS + 1])
    large = np.bincount(region)[region] >= MIN_REGION_SHARE * len(points)
    if not large.any():
        return one
    region = np.unique(region[large][KDTree(points[large]).query(points, workers=-1)[1]], return_inverse=True)[1]
    return _closed_off(region, distance < CLOSE * spacing, points, outside, spacing)


def _concave_creases(points: np.ndarray, normals: np.ndarray, near: np.ndarray, spacing: float) -> Bool[np.ndarray, " n"]:
    """Return which points lie on concave creases. near: (n, AROUND) nearest points of each; spacing: of the points [m]."""
    same_side = np.einsum("nkj,nj->nk", normals[near], normals) > 0  # leaves out the other side of a thin plate
    mean = np.einsum("nkj,nk->nj", normals[near], same_side)
    mean /= np.maximum(np.linalg.norm(mean, axis=1, keepdims=True), 1e-300)
    center = np.einsum("nkj,nk->nj", points[near], same_side) / np.maximum(same_side.sum(1), 1)[:, None]
    bent = np.einsum("ij,ij->i", normals, mean) < MAX_CREASE_COSINE
    candidates = np.flatnonzero(bent & (np.einsum("ij,ij->i", center - points, mean) > 0))
    crease = np.zeros(len(points), bool)
    if len(candidates):
        line = label_connected(len(candidates), KDTree(points[candidates]).query_pairs(spacing, output_type="ndarray"))
        crease[candidates[np.bincount(line)[line] >= MIN_CREASE_POINTS]] = True
    return crease


def _basins(distance: Float[np.ndarray, " n"], near: Int[np.ndarray, "n k"]) -> Int[np.ndarray, " n"]:
    """Return regions by the watershed of the distance to the border, joined where the passage is wide.

    near: the nearest points of each point, itself included.
    """
    rank = np.empty(len(distance), np.int64)
    rank[np.argsort(-distance, kind="stable")] = np.arange(len(distance))
    peak = np.take_along_axis(near, rank[near].argmin(1)[:, None], 1)[:, 0]  # the neighbour farthest from the border
    while (peak[peak] != peak).any():
        peak = peak[peak]
    ends, width = _meetings(peak, near), np.minimum(np.repeat(distance, near.shape[1]), distance[near.reshape(-1)])
    meets = np.flatnonzero(ends[:, 0] != ends[:, 1])
    meets = meets[np.argsort(-width[meets], kind="stable")]
    widest = meets[np.sort(np.unique(ends[meets], axis=0, return_index=True)[1])]
    joined = list(range(len(distance)))

    def region(point: int) -> int:
        while joined[point] != point:
            joined[point] = joined[joined[point]]
            point = joined[point]
        return point

    for (a, b), passage in zip(ends[widest].tolist(), width[widest].tolist(), strict=True):
        inner, outer = sorted((region(a), region(b)), key=rank.__getitem__)
        if passage >= MAX_PASSAGE_RATIO * distance[outer]:
            joined[outer] = inner
    return np.unique([region(p) for p in peak.tolist()], return_inverse=True)[1]


def _closed_off(
    region: Int[np.ndarray, " n"], close: Bool[np.ndarray, " n"], points: np.ndarray, outside: np.ndarray, spacing: float
) -> Int[np.ndarray, " n"]:
    """Join regions until the lines between them are mostly border; the most open line goes first.

    close: points close to the border; outside, spacing: as above. A line leads through points outside that are close, too.
    """
    nearest = KDTree(points).query(outside, distance_upper_bound=CLOSE * spacing, workers=-1)[1]
    beside = nearest < len(points)  # the others have no point that is close
    both = np.concatenate([points, outside[beside]])
    near = KDTree(both).query(both, k=NEIGHBOURS + 1, workers=-1)[1]
    region, close = np.r_[region, region[nearest[beside]]], np.r_[close, np.ones(beside.sum(), bool)]
    closed = np.repeat(close, near.shape[1]) | close[near.reshape(-1)]
    while True:
        count = int(region.max()) + 1
        pair = _meetings(region, near) @ [count, 1]
        total = np.bincount(pair, minlength=count * count).reshape(count, count)
        border = np.bincount(pair, closed, count * count).reshape(count, count)
        np.fill_diagonal(total, 0)
        share = np.where(total > 0, border / np.maximum(total, 1), 1.0)
        a, b = np.unravel_index(share.argmin(), share.shape)
        if share[a, b] >= MIN_CLOSED_SHARE:
            return region[: len(points)]
        region = np.unique(np.where(region == b, a, region), return_inverse=True)[1]


def _meetings(region: Int[np.ndarray, " n"], near: Int[np.ndarray, "n k"]) -> Int[np.ndarray, "m 2"]:
    """Return the regions of every two connected points, the smaller number first."""
    return np.sort(np.stack([np.repeat(region, near.shape[1]), region[near.reshape(-1)]], 1), 1)
