"""Contacts between patches: which touch, which are close with a clearance, and which are attached only through another."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Float32, Int

from anymesh.config import SegmentationConfig
from anymesh.geometry.boxes import box_pairs
from anymesh.geometry.patches import ObjectShape
from anymesh.geometry.topology import label_connected
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.runtime import CONTACTS, Deadline
from anymesh.segmentation.dominators import NONE, immediate_dominators
from anymesh.segmentation.patch_gaps import area_in_contact, crosses, gap_within

MAX_CLEARANCE_FACTOR = 2.0  # neighbours of a set of touching patches lie within this many times its smallest clearance


@dataclass(frozen=True, eq=False)
class Contacts:
    """Patches and their contacts.

    shapes: one per patch; touch: (m, 2) pairs that touch or cross; near: (k, 2) pairs of different sets with a clearance;
    touching_group: (P,) number of the set of patches, connected by touching pairs, that each patch belongs to.
    """

    shapes: tuple[TriangleSet, ...]
    touch: Int[np.ndarray, "m 2"]
    near: Int[np.ndarray, "k 2"]
    touching_group: Int[np.ndarray, " P"]
    area: dict[tuple[int, int], float]  # contact area of the first patch on the second [m^2]

    @cached_property
    def patch_bounds(self) -> Float[np.ndarray, "P 2 3"]:
        """Return the axis-aligned bounds of each patch [m]."""
        return np.array([s.bounds for s in self.shapes])

    @cached_property
    def area_matrix(self) -> Float32[np.ndarray, "P P"]:
        """Return `area` as a matrix, 0 for patches that do not touch [m^2]."""
        amounts = np.zeros((len(self.shapes), len(self.shapes)), np.float32)
        for pair, amount in self.area.items():
            amounts[pair] = amount
        return amounts

    @cached_property
    def patch_area(self) -> Float[np.ndarray, " P"]:
        """Return the area of each patch [m^2]."""
        return np.array([s.area for s in self.shapes])


def find_contacts(whole: ObjectShape, config: SegmentationConfig, deadline: Deadline | None = None) -> Contacts:
    """Measure all pairs of patches whose boxes are near each other; after the deadline further ones have no contact."""
    deadline = deadline or Deadline()
    order = np.argsort(whole.patch, kind="stable")
    start = np.searchsorted(whole.patch[order], np.arange(int(whole.patch.max()) + 2))
    shapes = tuple(whole.of(order[a:b]) for a, b in itertools.pairwise(start))
    shared = {(int(a), int(b)) for a, b in whole.shared}
    tolerance, reach = config.touch * whole.diagonal, config.near * whole.diagonal
    low, high = np.array([s.bounds for s in shapes]).transpose(1, 0, 2)
    near = [pair for pair in box_pairs(low, high, reach) if pair not in shared]
    i, j = np.array(near, np.int64).reshape(-1, 2).T
    apart = np.maximum(np.maximum(low[i] - high[j], low[j] - high[i]), 0).max(1, initial=0)  # lower bound of the distance
    close = [pair for pair, d in zip(near, apart, strict=True) if d <= tolerance]
    beside = [(d, *pair) for pair, d in zip(near, apart, strict=True) if d > tolerance]
    touch, measured = _measured(shapes, close, tolerance, reach, deadline)
    touch = sorted(shared) + touch
    pairs = np.array(touch, np.int64).reshape(-1, 2)
    group = label_connected(len(shapes), pairs)
    free = _neighbours(measured, beside, group, shapes, (tolerance, reach), deadline)
    area = {}
    for i, j in touch:
        if _late(deadline):
            break
        area[i, j], area[j, i] = (area_in_contact(shapes[a], shapes[b], 2 * tolerance) for a, b in ((i, j), (j, i)))
    return Contacts(shapes, pairs, free, group, area)


def _measured(
    shapes: tuple[TriangleSet, ...], pairs: list[tuple[int, int]], tolerance: float, reach: float, deadline: Deadline
) -> tuple[list[tuple[int, int]], list[tuple[int, int, float]]]:
    """Split pairs whose boxes meet into those that touch or cross, and those within reach, with their distance."""
    touch, near = [], []
    for i, j in pairs:
        if _late(deadline):
            break
        gap = gap_within(shapes[i], shapes[j], reach, tolerance)
        gap = gap if gap < tolerance else min(gap, gap_within(shapes[j], shapes[i], reach, tolerance))
        if gap < tolerance or (gap < reach and crosses(shapes[i], shapes[j])):
            touch.append((i, j))
        elif gap < reach:
            near.append((i, j, gap))
    return touch, near


def _late(deadline: Deadline) -> bool:
    """Return whether no further contact may be measured."""
    if late := deadline.late(CONTACTS):
        deadline.leave_out("segmentation: some contacts were not measured")
    return late


def _neighbours(
    near: list[tuple[int, int, float]],
    beside: list[tuple[float, int, int]],
    group: np.ndarray,
    shapes: tuple[TriangleSet, ...],
    distances: tuple[float, float],
    deadline: Deadline,
) -> np.ndarray:
    """Return the pairs of patches of two groups with a clearance that are among the nearest of the smaller group.

    The clearances around a fitted part differ by up to a factor of two.

    near: pairs with their distance; beside: pairs that are not yet measured, each with the lower bound of its distance first;
    distances: tolerance of a touch, and reach of a clearance [m].
    """
    tolerance, reach = distances
    extent = np.zeros(int(group.max()) + 1)
    np.maximum.at(extent, group, [float(np.linalg.norm(s.bounds[1] - s.bounds[0])) for s in shapes])

    def ordered(i: int, j: int) -> tuple[int, int]:
        first, second = sorted((i, j), key=lambda p: (extent[group[p]], group[p]))
        return first, second

    pairs = [(gap, *ordered(i, j)) for i, j, gap in near if group[i] != group[j]]
    nearest = np.full(len(extent), np.inf)
    np.minimum.at(nearest, group[[small for _, small, _ in pairs]], [gap for gap, *_ in pairs])
    for least, i, j in sorted(beside):
        small, large = ordered(i, j)
        if group[i] == group[j] or least > MAX_CLEARANCE_FACTOR * nearest[group[small]] + tolerance:
            continue
        if _late(deadline):
            break
        gap = min(gap_within(shapes[i], shapes[j], reach), gap_within(shapes[j], shapes[i], reach))
        if gap < reach:
            pairs.append((gap, small, large))
            nearest[group[small]] = min(nearest[group[small]], gap)
    kept = [sorted((i, j)) for gap, i, j in pairs if gap <= MAX_CLEARANCE_FACTOR * nearest[group[i]] + tolerance]
    return np.array(sorted(kept), np.int64).reshape(-1, 2)


def dominated_by(contacts: Contacts, group: Int[np.ndarray, " P"], root: int) -> dict[int, list[int]]:
    """Return for every group its dominated set: the groups that reach the root only through it, itself first.

    Groups join patches that are known to move together. Components without neighbours depend on the root.
    """
    count = int(group.max()) + 1
    pairs = group[np.concatenate([contacts.touch, contacts.near]).astype(np.int64).reshape(-1, 2)]
    pairs = np.unique(np.concatenate([pairs, pairs[:, ::-1]])[np.tile(pairs[:, 0] != pairs[:, 1], 2)], axis=0)
    island = label_connected(count, pairs)
    alone = np.flatnonzero(island != island[root])  # without neighbours, a component depends on the root
    successors = [part.tolist() for part in np.split(pairs[:, 1], np.searchsorted(pairs[:, 0], np.arange(1, count)))]
    successors[root] += alone.tolist()
    children: list[list[int]] = [[] for _ in range(count)]
    for node, dominator in enumerate(immediate_dominators(successors, root)):
        if dominator != NONE:
            children[dominator].append(node)
    dominated: dict[int, list[int]] = {}
    for node in range(count):
        stack, below = [node], []
        while stack:
            at = stack.pop()
            below.append(at)
            stack.extend(children[at])
        dominated[node] = below
    return dominated
