"""Part instances from the masks of all views, by the expectation maximisation of PartSlip++ (Zhou et al. 2023).

Every superpoint has one logit per instance. Each view compares the instance probabilities with its masks point by point, so
point counts per (superpoint, mask) are the only input.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import KDTree

from anymesh.geometry.topology import label_connected
from anymesh.prompted.grounding.cloud import Cloud
from anymesh.prompted.grounding.fuse import Counts, Instances

EXTRA_INSTANCES = 5  # instances in addition to the initial ones
MAX_INSTANCES = 28  # instances up to which these are added; initial ones are never dropped
EPOCHS = 10
RATE = 1.0  # learning rate of Adam
CONNECT_RATIO = 0.025  # of the diagonal: an instance is split at larger distances between its points
CERTAIN = 3.0  # initial logit of the instance that a superpoint starts in; the others start at 0
MIN_PROBABILITY = 1e-7  # distance of probabilities from 0 and 1
ADAM = (0.9, 0.999, 1e-8)  # Kingma and Ba 2015: decay of the gradient's mean, decay of its square's mean, and epsilon
JOIN_POINTS = 40_000  # points of the cloud used to find neighbouring superpoints


def refine_instances(cloud: Cloud, counts: Sequence[Counts], start: Instances, rng: np.random.Generator) -> Instances:
    """Refine the initial instances to explain the masks, split unconnected ones, and label each by majority."""
    if not any(c.labels for c in counts):
        return start
    chosen = maximise(counts, start.number, len(start.labels), rng)
    seen = np.asarray(sum(c.seen for c in counts)) > 0
    split = _split(chosen, near_superpoints(cloud, CONNECT_RATIO * cloud.diagonal))
    return _labelled(counts, np.where(seen, split, -1))


def maximise(
    counts: Sequence[Counts], start: Int[np.ndarray, " S"], initial: int, rng: np.random.Generator
) -> Int[np.ndarray, " S"]:
    """Return the likeliest instance (0..K - 1) of every superpoint after EPOCHS passes over the views in random order.

    start: as `Instances.number`. Its first `initial` parts become the first instances, the other superpoints start in the one
    after them.
    """
    number = max(min(initial + EXTRA_INSTANCES, MAX_INSTANCES), initial + 1)  # at least one instance is for points of no part
    logits = np.zeros((len(start), number))
    logits[np.arange(len(start)), np.where(start > 0, start - 1, initial)] = CERTAIN
    mean, square = np.zeros_like(logits), np.zeros_like(logits)
    step = 0
    for _ in range(EPOCHS):
        for v in rng.permutation(len(counts)):
            target = counts[v].top
            pairs = match(logits, target)
            _, gradient = loss_and_gradient(logits, target, pairs)
            step += 1
            mean = ADAM[0] * mean + (1 - ADAM[0]) * gradient
            square = ADAM[1] * square + (1 - ADAM[1]) * gradient**2
            unbiased, spread = mean / (1 - ADAM[0] ** step), square / (1 - ADAM[1] ** step)
            logits = logits - RATE * unbiased / (np.sqrt(spread) + ADAM[2])
    return logits.argmax(1)


def probabilities(logits: Float[np.ndarray, "S K"]) -> Float[np.ndarray, "S K"]:
    """Return the softmax over the instances, clipped away from 0 and 1."""
    p = np.exp(logits - logits.max(1, keepdims=True))
    return np.clip(p / p.sum(1, keepdims=True), MIN_PROBABILITY, 1 - MIN_PROBABILITY)


def match(logits: Float[np.ndarray, "S K"], target: Int[np.ndarray, "S N"]) -> tuple[np.ndarray, np.ndarray]:
    """Match instances to masks so that the total binary cross-entropy of the pairs is minimal (E-step)."""
    p = probabilities(logits)
    seen = target.sum(1)
    cost = -(np.log(p).T @ target) - np.log1p(-p).T @ (seen[:, None] - target)
    from scipy.optimize import linear_sum_assignment  # import on use: it takes 0.1 s, and only runs with a mask model need it

    return linear_sum_assignment(cost / max(int(seen.sum()), 1))


def loss_and_gradient(
    logits: Float[np.ndarray, "S K"], target: Int[np.ndarray, "S N"], pairs: tuple[np.ndarray, np.ndarray]
) -> tuple[float, Float[np.ndarray, "S K"]]:
    """Return the loss and its gradient with respect to the logits.

    The loss is the sum over the pairs (instance, mask) of the mean binary cross-entropy per visible point. With c of a
    superpoint's n visible points in the mask and p the instance's probability, a pair costs -(c log p + (n - c) log(1 - p)).
    Its derivative with respect to p, times p, is u = (n - c) p / (1 - p) - c. Through the softmax, the derivative with respect
    to logit j is u_j - p_j sum_k u_k.
    """
    k, m = pairs
    seen = target.sum(1)
    points = max(int(seen.sum()), 1)
    p = probabilities(logits)
    q, c = p[:, k], target[:, m]
    others = seen[:, None] - c
    loss = -float((c * np.log(q) + others * np.log1p(-q)).sum()) / points
    u = np.zeros_like(p)
    u[:, k] = (others * q / (1 - q) - c) / points
    return loss, u - p * u.sum(1, keepdims=True)


def near_superpoints(cloud: Cloud, reach: float) -> Int[np.ndarray, "m 2"]:
    """Return the pairs of superpoints with points within `reach` [m] of each other, and those that are adjacent."""
    chosen = np.arange(0, len(cloud), max(1, len(cloud) // JOIN_POINTS))
    chosen = np.union1d(chosen, np.unique(cloud.superpoint, return_index=True)[1])
    point_pairs = KDTree(cloud.points[chosen]).query_pairs(reach, output_type="ndarray")
    pairs = np.sort(cloud.superpoint[chosen][point_pairs], 1)
    pairs = np.concatenate([pairs[pairs[:, 0] != pairs[:, 1]], cloud.borders])
    key = np.unique(pairs[:, 0] * cloud.count + pairs[:, 1])
    return np.stack([key // cloud.count, key % cloud.count], 1)


def _split(chosen: np.ndarray, near: np.ndarray) -> Int[np.ndarray, " S"]:
    """Split instances into connected ones, numbered from 1."""
    same = chosen[near[:, 0]] == chosen[near[:, 1]]
    return label_connected(len(chosen), near[same]) + 1


def _labelled(counts: Sequence[Counts], number: Int[np.ndarray, " S"]) -> Instances:
    """Label every instance by most of its visible points; an instance with most points outside all masks is no part."""
    names = sorted({name for c in counts for name in c.labels})
    votes = np.zeros((int(number.max(initial=0)) + 1, len(names) + 1), np.int64)
    kept = number > 0
    for c in counts:
        for k, column in enumerate([*(names.index(name) for name in c.labels), len(names)]):
            np.add.at(votes[:, column], number[kept], c.top[kept, k])
    winner = votes.argmax(1)
    parts = np.flatnonzero((winner < len(names)) & votes.any(1))
    renumber = np.zeros(len(votes) + 1, np.int64)
    renumber[parts] = np.arange(1, len(parts) + 1)
    renumber[-1] = -1
    return Instances(renumber[number], tuple(names[winner[p]] for p in parts))
