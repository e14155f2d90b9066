"""Superpoints: regions of near constant signal, by l0 cut pursuit (Landrieu and Obozinski 2017; paper, 3.2 and 3.3)."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, maximum_flow

from anymesh.geometry.topology import label_connected

ROUNDS = 8  # each splits every superpoint in two at most
ALTERNATIONS = 3  # of values and borders within a split
CAPACITY = 1 << 12  # flows are whole numbers: this many to the unit of energy


def superpoints(
    signal: Float[np.ndarray, "n d"],
    weight: Float[np.ndarray, " n"],
    edges: Int[np.ndarray, "m 2"],
    length: Float[np.ndarray, " m"],
    strength: float,
) -> Int[np.ndarray, " n"]:
    """A superpoint number a node: the partition x that lowers sum w |signal - x|^2 + strength * cut length.

    weight (area of a face) and length (of an edge) count in units of their means. Deterministic.
    """
    weight = weight / max(float(weight.mean()), 1e-300)
    cost = strength * length / max(float(length.mean()), 1e-300) if len(length) else length
    label = label_connected(len(signal), edges)
    for _ in range(ROUNDS):
        inner = label[edges[:, 0]] == label[edges[:, 1]]
        upper = _split(signal, weight, label, edges[inner], cost[inner])
        kept = inner.copy()
        kept[inner] = upper[edges[inner, 0]] == upper[edges[inner, 1]]
        finer = label_connected(len(signal), edges[kept])
        finer = _merge(signal, weight, finer, edges, cost)
        if finer.max() == label.max() and (finer == label).all():
            break
        label = finer
    return label


def _means(signal: np.ndarray, weight: np.ndarray, label: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Weighted mean of the signal in every label (count, d), and the labels' weights."""
    total = np.bincount(label, weight, count)
    sums = np.stack([np.bincount(label, weight * column, count) for column in signal.T], 1)
    return sums / np.maximum(total, 1e-300)[:, None], total


def _split(signal: np.ndarray, weight: np.ndarray, label: np.ndarray, edges: np.ndarray, cost: np.ndarray) -> np.ndarray:
    """The best two-valued approximation of every superpoint: which nodes take the upper value. One flow for all of them."""
    count = int(label.max()) + 1
    mean, _ = _means(signal, weight, label, count)
    off = signal - mean[label]
    axis = _main_direction(off, weight, label, count)
    upper = np.einsum("ij,ij->i", off, axis[label]) > 0
    for _ in range(ALTERNATIONS):
        both, _ = _means(signal, weight, 2 * label + upper, 2 * count)
        far_low = weight * ((signal - both[2 * label]) ** 2).sum(1)
        far_high = weight * ((signal - both[2 * label + 1]) ** 2).sum(1)
        cut = _minimum_cut(far_low - far_high, edges, cost)
        if (cut == upper).all():
            break
        upper = cut
    return upper


def _main_direction(off: np.ndarray, weight: np.ndarray, label: np.ndarray, count: int) -> np.ndarray:
    """Direction of largest variance of the signal in every label, by its covariance (count, d)."""
    d = off.shape[1]
    covariance = np.zeros((count, d, d))
    for i in range(d):
        for j in range(i, d):
            covariance[:, i, j] = covariance[:, j, i] = np.bincount(label, weight * off[:, i] * off[:, j], count)
    return np.linalg.eigh(covariance)[1][:, :, -1]


def _minimum_cut(gain: np.ndarray, edges: np.ndarray, cost: np.ndarray) -> np.ndarray:
    """The side of every node: True where taking the upper value (it gains `gain`) is worth the edges that are cut."""
    n = len(gain)
    whole = np.round(gain * CAPACITY).astype(np.int64).clip(-(2**30), 2**30)
    wall = np.maximum(np.round(cost * CAPACITY), 1).astype(np.int64).clip(0, 2**30)
    source, sink = n, n + 1
    high, low = np.flatnonzero(whole > 0), np.flatnonzero(whole < 0)
    row = np.concatenate([np.full(len(high), source), low, edges[:, 0], edges[:, 1]])
    column = np.concatenate([high, np.full(len(low), sink), edges[:, 1], edges[:, 0]])
    capacity = np.concatenate([whole[high], -whole[low], wall, wall])
    graph = coo_array((capacity.astype(np.int32), (row, column)), shape=(n + 2, n + 2)).tocsr()
    residual = graph - maximum_flow(graph, source, sink).flow
    residual.data = np.maximum(residual.data, 0)
    residual.eliminate_zeros()
    reached = np.zeros(n + 2, bool)
    reached[breadth_first_order(residual, source, return_predecessors=False)] = True
    return reached[:n]


def _merge(signal: np.ndarray, weight: np.ndarray, label: np.ndarray, edges: np.ndarray, cost: np.ndarray) -> np.ndarray:
    """Joins neighbours while that lowers the energy, the best pairs first, until none is left."""
    while True:
        count = int(label.max()) + 1
        mean, total = _means(signal, weight, label, count)
        pair = np.sort(label[edges], 1)
        between = pair[:, 0] != pair[:, 1]
        key, where = np.unique(pair[between] @ np.array([count, 1]), return_inverse=True)
        if len(key) == 0:
            return label
        a, b = key // count, key % count
        saved = np.bincount(where.reshape(-1), cost[between])
        lost = total[a] * total[b] / np.maximum(total[a] + total[b], 1e-300) * ((mean[a] - mean[b]) ** 2).sum(1)
        better = np.flatnonzero(saved > lost)
        if len(better) == 0:
            return label
        order = better[np.argsort(-(saved - lost)[better], kind="stable")]
        taken = np.zeros(count, bool)
        chosen = []
        for k in order:  # a matching, so that every pair's gain holds
            if not taken[a[k]] and not taken[b[k]]:
                taken[a[k]] = taken[b[k]] = True
                chosen.append(k)
        label = label_connected(count, np.c_[a[chosen], b[chosen]])[label]
