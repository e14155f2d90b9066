"""Superpoints: regions of nearly constant signal, by l0 cut pursuit (Landrieu and Obozinski 2017; paper, 3.2 and 3.3)."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, maximum_flow

from anymesh.geometry.topology import label_connected

ROUNDS = 8  # rounds of the cut; each splits every superpoint in two at most
ALTERNATIONS = 3  # alternations between values and borders within a split
CAPACITY = 1 << 12  # flow units per unit of energy, as flows are integers


def superpoints(
    signal: Float[np.ndarray, "n d"],
    weight: Float[np.ndarray, " n"],
    edges: Int[np.ndarray, "m 2"],
    length: Float[np.ndarray, " m"],
    strength: float,
) -> Int[np.ndarray, " n"]:
    """Return one superpoint index per node: the partition x that minimizes sum w |signal - x|^2 + strength * cut length.

    weight (area of a face) and length (of an edge) are relative to their means. The result is deterministic. A superpoint that
    a round leaves unchanged is not split again, since the result would be the same.
    """
    weight = weight / max(float(weight.mean()), 1e-300)
    cost = strength * length / max(float(length.mean()), 1e-300) if len(length) else length
    label = label_connected(len(signal), edges)
    active = np.arange(len(signal))
    for _ in range(ROUNDS):
        upper = np.zeros(len(signal), bool)
        upper[active] = _split_some(signal, weight, label, edges, cost, active)
        kept = (label[edges[:, 0]] == label[edges[:, 1]]) & (upper[edges[:, 0]] == upper[edges[:, 1]])
        finer = label_connected(len(signal), edges[kept])
        finer = _merge(signal, weight, finer, edges, cost)
        if finer.max() == label.max() and (finer == label).all():
            break
        active = _still_active(label, finer, upper, active)
        label = finer
    return label


def _still_active(before: np.ndarray, after: np.ndarray, upper: np.ndarray, active: np.ndarray) -> Int[np.ndarray, " k"]:
    """Return the nodes of the superpoints that changed, or that the last split divided before they were merged again."""
    count = int(before.max()) + 1
    high, size = np.bincount(before, upper, count), np.bincount(before, minlength=count)
    divided = (high > 0) & (high < size)
    first = np.unique(after, return_index=True)[1]
    origin = before[first]  # for each superpoint, the previous one of its first node
    same = (np.bincount(after) == size[origin]) & (np.bincount(after, before != origin[after]) == 0)
    done = same & ~divided[origin]
    return np.flatnonzero(~done[after])


def _split_some(
    signal: np.ndarray, weight: np.ndarray, label: np.ndarray, edges: np.ndarray, cost: np.ndarray, nodes: np.ndarray
) -> np.ndarray:
    """Return which of the given nodes take the upper value when their superpoints are split.

    nodes: all nodes of some superpoints.
    """
    number = np.full(len(label), -1)
    number[nodes] = np.arange(len(nodes))
    ends = number[edges]
    inner = (label[edges[:, 0]] == label[edges[:, 1]]) & (ends[:, 0] >= 0)
    own = np.unique(label[nodes], return_inverse=True)[1].reshape(-1)
    return _split(signal[nodes], weight[nodes], own, ends[inner], cost[inner])


def _means(signal: np.ndarray, weight: np.ndarray, label: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the weighted mean of the signal in every label (count, d), and the labels' weights."""
    total = np.bincount(label, weight, count)
    sums = np.stack([np.bincount(label, weight * column, count) for column in signal.T], 1)
    return sums / np.maximum(total, 1e-300)[:, None], total


def _split(signal: np.ndarray, weight: np.ndarray, label: np.ndarray, edges: np.ndarray, cost: np.ndarray) -> np.ndarray:
    """Return which nodes take the upper value in the best two-valued approximation of every superpoint.

    One maximum flow solves all superpoints.
    """
    count = int(label.max()) + 1
    mean, _ = _means(signal, weight, label, count)
    off = signal - mean[label]
    axis = _main_direction(off, weight, label, count)
    upper = np.einsum("ij,ij->i", off, axis[label]) > 0
    open_labels = np.ones(count, bool)
    for _ in range(ALTERNATIONS):
        both, _ = _means(signal, weight, 2 * label + upper, 2 * count)
        far_low = weight * ((signal - both[2 * label]) ** 2).sum(1)
        far_high = weight * ((signal - both[2 * label + 1]) ** 2).sum(1)
        todo = open_labels[label]
        cut = upper.copy()
        cut[todo] = _minimum_cut_of(far_low - far_high, edges, cost, todo)
        open_labels = np.bincount(label, cut != upper, count) > 0  # the others have converged
        upper = cut
        if not open_labels.any():
            break
    return upper


def _minimum_cut_of(gain: np.ndarray, edges: np.ndarray, cost: np.ndarray, some: np.ndarray) -> np.ndarray:
    """Return the minimum cut of the nodes in the mask `some`, which no edge joins to the others."""
    number = np.cumsum(some) - 1
    inside = some[edges[:, 0]]
    return _minimum_cut(gain[some], number[edges[inside]], cost[inside])


def _main_direction(off: np.ndarray, weight: np.ndarray, label: np.ndarray, count: int) -> np.ndarray:
    """Return the direction of largest variance of the signal in every label, by its covariance (count, d)."""
    d = off.shape[1]
    covariance = np.zeros((count, d, d))
    for i in range(d):
        for j in range(i, d):
            covariance[:, i, j] = covariance[:, j, i] = np.bincount(label, weight * off[:, i] * off[:, j], count)
    return np.linalg.eigh(covariance)[1][:, :, -1]


def _minimum_cut(gain: np.ndarray, edges: np.ndarray, cost: np.ndarray) -> np.ndarray:
    """Return the side of every node.

    True if taking the upper value, which gains `gain`, outweighs the cost of the cut edges.
    """
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
    """Join neighbours while that lowers the energy, the best pairs first."""
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
        for k in order:  # choose a matching, so that every pair's gain holds
            if not taken[a[k]] and not taken[b[k]]:
                taken[a[k]] = taken[b[k]] = True
                chosen.append(k)
        label = label_connected(count, np.c_[a[chosen], b[chosen]])[label]
