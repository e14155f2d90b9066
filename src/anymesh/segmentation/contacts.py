"""Contacts between patches: which touch, which are close with a clearance, and which are attached only through another."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Float32, Int
from scipy.spatial.distance import cdist

from anymesh.geometry.boxes import box_pairs, within
from anymesh.geometry.surface import ObjectShape
from anymesh.geometry.topology import label_connected
from anymesh.geometry.triangle_set import TriangleSet, spread_points
from anymesh.runtime import CONTACTS, Deadline
from anymesh.types import Brief
from anymesh.types.triangles import meet_box, normals_and_areas, quartered

TOUCH_RATIO = 0.0004  # of the object's diagonal: patches closer than this touch; clearances of real fits are wider
NEAR_RATIO = 0.02  # of it: components closer than this, but not touching, have a clearance
PROBES = 160  # sample points per patch for the distance to another patch
COARSE = 6  # every how many of these points are measured first
AREA_POINTS = 500  # sample points of a patch near another one, for the area in contact
MAX_DIVIDED = 2000  # triangles of a patch, up to which those near another patch are divided until they are as small as it
ROUNDING = 1e-9  # of the reach: tolerance of bounds of distances
MAX_CLEARANCE_FACTOR = 2.0  # neighbours of a set of touching patches lie within this many times its smallest clearance


def gap_within(a: TriangleSet, b: TriangleSet, reach: float, enough: float = 0.0) -> float:
    """Return the smallest distance from a to b [m], from a's corners and samples within reach of b's box.

    A result below `enough` or from `reach` on is an upper bound of the smallest distance.

    Every sixth point is measured first. The distance of another point differs by at most its distance to that point, and those
    that cannot be the closest are not measured.
    """
    low, high = b.bounds[0] - reach, b.bounds[1] + reach
    points = [p[within(p, low, high)] for p in (a.corners, a.samples.points)]
    points = [p[:: max(1, len(p) // PROBES)] for p in points]
    probe = np.concatenate(points)
    if len(probe) == 0:
        return np.inf
    rough = probe[::COARSE]
    distance = b.tree.distance(rough)
    gap = float(distance.min())
    if gap < enough:
        return gap
    bound = (distance - cdist(probe, rough)).max(1)
    bound[::COARSE] = np.inf
    closer = probe[bound < min(gap, reach) + ROUNDING * reach]
    return min(gap, float(b.tree.distance(closer).min())) if len(closer) else gap


def crosses(a: TriangleSet, b: TriangleSet) -> bool:
    """Return whether edges of one shape pass through faces of the other."""
    for one, other in ((a, b), (b, a)):
        start = one.triangles.reshape(-1, 3)
        span = one.triangles[:, [1, 2, 0]].reshape(-1, 3) - start
        step = max(1, len(start) // 3000)
        start, span = start[::step], span[::step]
        face = other.scene.first_hit(start, span, 1.0).face
        hit = np.flatnonzero(face >= 0)
        if len(hit) == 0:
            continue
        slope = np.abs(np.einsum("ij,ij->i", span[hit], other.normals[face[hit]]))
        # a ray in the plane of a face gives no reliable hit
        if (slope > 0.02 * np.linalg.norm(span[hit], axis=1)).any():
            return True
    return False


def area_in_contact(a: TriangleSet, b: TriangleSet, tolerance: float) -> float:
    """Return the area of a within the tolerance of b [m^2], from samples of a near b."""
    low, high = b.bounds[0] - tolerance, b.bounds[1] + tolerance
    triangles = a.triangles[meet_box(a.triangles, low, high)]
    areas = normals_and_areas(triangles)[1]
    while 0 < len(triangles) <= MAX_DIVIDED and areas.sum() > b.area:
        parts = quartered(triangles)
        triangles = parts[meet_box(parts, low, high)]
        areas = normals_and_areas(triangles)[1]
    points, _ = spread_points(triangles, areas, AREA_POINTS, a.seed)
    gap = b.tree.distance(points[within(points, low, high)])
    return float(areas.sum()) * float((gap < tolerance).sum()) / max(len(points), 1)


@dataclass(frozen=True, eq=False)
class Contacts(Brief):
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


def find_contacts(whole: ObjectShape, deadline: Deadline | None = None) -> Contacts:
    """Measure all pairs of patches whose boxes are near each other; after the deadline further ones have no contact."""
    deadline = deadline or Deadline()
    order = np.argsort(whole.patch, kind="stable")
    start = np.searchsorted(whole.patch[order], np.arange(int(whole.patch.max()) + 2))
    shapes = tuple(whole.of(order[a:b]) for a, b in itertools.pairwise(start))
    shared = {(int(a), int(b)) for a, b in whole.shared}
    tolerance, reach = TOUCH_RATIO * whole.diagonal, NEAR_RATIO * whole.diagonal
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
    neighbours: list[list[int]] = [[] for _ in range(count)]
    for a, b in pairs.tolist():
        neighbours[a].append(b)
    above = _dominators(neighbours, root)
    above |= dict.fromkeys(set(range(count)) - above.keys(), root)  # without neighbours, a component depends on the root
    dominated = {node: [node] for node in range(count)}
    for node, over in reversed(above.items()):  # from the leaves on
        if node != root:
            dominated[over] += dominated[node]
    return dominated


def _dominators(neighbours: Sequence[Sequence[int]], root: int) -> dict[int, int]:
    """Return the immediate dominator of each node that is connected to the root, before what it dominates; the root is its own.

    It is the node nearest to the root of the biconnected component that the node is reached in (Hopcroft and Tarjan, 1973).
    """
    order, low, parent = {root: 0}, {root: 0}, {root: root}
    path = [(root, iter(neighbours[root]))]
    while path:
        node, left = path[-1]
        for other in left:
            if other not in order:
                order[other] = low[other] = len(order)
                parent[other] = node
                path.append((other, iter(neighbours[other])))
                break
            low[node] = min(low[node], order[other])
        else:
            path.pop()
            low[parent[node]] = min(low[parent[node]], low[node])
    above: dict[int, int] = {}
    for node, over in parent.items():
        above[node] = over if low[node] >= order[over] else above[over]
    return above
