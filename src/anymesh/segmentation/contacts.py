"""Contacts between patches: which touch, which have a clearance, and which support which."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from functools import cached_property

import networkx as nx
import numpy as np
from jaxtyping import Float, Int

from anymesh.config import SegmentationConfig
from anymesh.geometry.boxes import box_pairs, same_box, within
from anymesh.geometry.patches import ObjectShape
from anymesh.geometry.topology import label_connected
from anymesh.geometry.triangle_set import TriangleSet

MIN_FLATNESS = 0.6  # length of the mean normal of a sheet, with its handle; 1 where it is plane
MIN_PLATE_ASPECT = 0.3  # width of a plate over its length; planks are narrower
MIN_ALIGNED_COSINE = 0.95  # cosine
MAX_CLEARANCE_FACTOR = 2.0  # times the nearest clearance of a body: what is further away is no neighbour
MAX_SMALL_CLEARANCE_FACTOR = 1.3  # the same of what is small against its nearest patch
PROBES = 160  # points of a patch that are measured against another


@dataclass(frozen=True, eq=False)
class Contacts:
    """Patches and their contacts.

    shapes: one a patch; touch: (m, 2) pairs that touch or cross; near: (k, 2) pairs of different components with a clearance;
    component: (P,) patches that touch, directly or through others, are one component.
    """

    shapes: tuple[TriangleSet, ...]
    touch: Int[np.ndarray, "m 2"]
    near: Int[np.ndarray, "k 2"]
    component: Int[np.ndarray, " P"]
    area: dict[tuple[int, int], float]  # of the first patch that touches the second [m^2]; none for one flat surface

    @cached_property
    def patch_bounds(self) -> Float[np.ndarray, "P 2 3"]:
        """Return the axis-aligned bounds of each patch [m]."""
        return np.array([s.bounds for s in self.shapes])

    @cached_property
    def patch_area(self) -> Float[np.ndarray, " P"]:
        """Return the area of each patch [m^2]."""
        return np.array([s.area for s in self.shapes])


def find_contacts(whole: ObjectShape, config: SegmentationConfig) -> Contacts:
    """Measures all pairs of patches whose boxes are near each other."""
    order = np.argsort(whole.patch, kind="stable")
    start = np.searchsorted(whole.patch[order], np.arange(int(whole.patch.max()) + 2))
    shapes = tuple(whole.of(order[a:b]) for a, b in itertools.pairwise(start))
    shared = {(int(a), int(b)) for a, b in whole.shared}
    tolerance, reach = config.touch * whole.diagonal, config.near * whole.diagonal
    low, high = np.array([s.bounds for s in shapes]).transpose(1, 0, 2)
    near = [pair for pair in box_pairs(low, high, reach) if pair not in shared]
    i, j = np.array(near, np.int64).reshape(-1, 2).T
    apart = np.maximum(np.maximum(low[i] - high[j], low[j] - high[i]), 0).max(1, initial=0)  # at least so far
    close = [pair for pair, d in zip(near, apart, strict=True) if d <= tolerance]
    beside = [(d, *pair) for pair, d in zip(near, apart, strict=True) if d > tolerance]
    touch, measured = _measured(shapes, close, tolerance, reach)
    touch = sorted(shared) + touch
    pairs = np.array(touch, np.int64).reshape(-1, 2)
    body = label_connected(len(shapes), pairs)
    free = _neighbours(measured, beside, body, shapes, tolerance, reach)
    area = {}
    for i, j in touch:
        if (i, j) in shared and _goes_on(shapes[i], shapes[j]):
            continue  # fronts side by side hold nothing of each other
        area[i, j], area[j, i] = (_touching(shapes[a], shapes[b], 2 * tolerance) for a, b in ((i, j), (j, i)))
    return Contacts(shapes, pairs, free, body, area)


def _measured(
    shapes: tuple[TriangleSet, ...], pairs: list[tuple[int, int]], tolerance: float, reach: float
) -> tuple[list[tuple[int, int]], list[tuple[int, int, float]]]:
    """Of pairs whose boxes meet, those that touch or cross, and the others within reach with the distance between them."""
    touch, near = [], []
    for i, j in pairs:
        gap = _gap(shapes[i], shapes[j], reach)
        gap = gap if gap < tolerance else min(gap, _gap(shapes[j], shapes[i], reach))
        if gap < tolerance or (gap < reach and _crosses(shapes[i], shapes[j])):
            touch.append((i, j))
        elif gap < reach:
            near.append((i, j, gap))
    return touch, near


def _neighbours(
    near: list[tuple[int, int, float]],
    beside: list[tuple[float, int, int]],
    component: np.ndarray,
    shapes: tuple[TriangleSet, ...],
    tolerance: float,
    reach: float,
) -> np.ndarray:
    """Of the pairs of bodies with a clearance, those that are among the nearest of the smaller body.

    A fit has clearances that differ by a factor of two; what is small against its nearest patch hangs on that alone.
    near: with their distance; beside: pairs that are yet to be measured, each behind the least distance that it can have.
    """
    size = [float(np.linalg.norm(s.bounds[1] - s.bounds[0])) for s in shapes]
    extent = np.zeros(int(component.max()) + 1)
    np.maximum.at(extent, component, size)

    def ordered(i: int, j: int) -> tuple[int, int]:
        first, second = sorted((i, j), key=lambda p: (extent[component[p]], component[p]))
        return first, second

    pairs = [(gap, *ordered(i, j)) for i, j, gap in near if component[i] != component[j]]
    nearest = np.full(len(extent), np.inf)
    np.minimum.at(nearest, component[[small for _, small, _ in pairs]], [gap for gap, *_ in pairs])
    for least, i, j in sorted(beside):
        small, large = ordered(i, j)
        if component[i] == component[j] or least > MAX_CLEARANCE_FACTOR * nearest[component[small]] + tolerance:
            continue
        gap = min(_gap(shapes[i], shapes[j], reach), _gap(shapes[j], shapes[i], reach))
        if gap < reach:
            pairs.append((gap, small, large))
            nearest[component[small]] = min(nearest[component[small]], gap)
    most: dict[int, float] = {}
    kept = []
    for gap, small, large in sorted(pairs):
        factor = MAX_SMALL_CLEARANCE_FACTOR if extent[component[small]] < 0.5 * size[large] else MAX_CLEARANCE_FACTOR
        if gap <= most.setdefault(int(component[small]), factor * gap) + tolerance:
            kept.append((min(small, large), max(small, large)))
    return np.array(sorted(kept), np.int64).reshape(-1, 2)


def _goes_on(a: TriangleSet, b: TriangleSet) -> bool:
    """Return whether both are sheets that face the same way."""
    mean = [s.areas @ s.normals / max(s.area, 1e-300) for s in (a, b)]
    length = [float(np.linalg.norm(m)) for m in mean]
    return min(length) > MIN_FLATNESS and bool(mean[0] @ mean[1] > MIN_ALIGNED_COSINE * length[0] * length[1])


def _touching(a: TriangleSet, b: TriangleSet, tolerance: float) -> float:
    """Return the area of a within the tolerance of b [m^2]."""
    samples = a.samples.points[::3]
    gap = b.tree.distance(samples[within(samples, b.bounds[0] - tolerance, b.bounds[1] + tolerance)])
    return a.area * float((gap < tolerance).sum()) / max(len(samples), 1)


def coplanar(contacts: Contacts, whole: ObjectShape, tolerance: float) -> list[tuple[int, int]]:
    """Touching plates of one thickness that lie in one plane: the boards of a framed door. Not those that a crease in one
    surface parts (drawers of a fused cabinet), nor two leaves alike."""
    parted = {(int(a), int(b)) for a, b in whole.shared}
    found = []
    for i, j in contacts.touch:
        if (int(i), int(j)) in parted:
            continue
        a, b = contacts.shapes[i].box, contacts.shapes[j].box
        if max(a.half[2] / max(a.half[1], 1e-12), b.half[2] / max(b.half[1], 1e-12)) > 0.5:
            continue
        level = abs(float((a.center - b.center) @ a.axes[2]))
        if min(s.half[1] / max(s.half[0], 1e-12) for s in (a, b)) > MIN_PLATE_ASPECT and same_box(a, b):
            continue  # two leaves of a window
        if abs(float(a.axes[2] @ b.axes[2])) > 0.9995 and level < tolerance and abs(a.half[2] - b.half[2]) < tolerance:
            found.append((int(i), int(j)))
    return found


def _gap(a: TriangleSet, b: TriangleSet, reach: float) -> float:
    """Smallest distance of a's corners and samples, as far as they lie in b's box, to b [m]."""
    low, high = b.bounds[0] - reach, b.bounds[1] + reach
    points = [p[within(p, low, high)] for p in (a.corners, a.samples.points)]
    points = [p[:: max(1, len(p) // PROBES)] for p in points]
    probe = np.concatenate(points)
    return float(b.tree.distance(probe).min()) if len(probe) else np.inf


def _crosses(a: TriangleSet, b: TriangleSet) -> bool:
    """Return whether edges of one shape pass through faces of the other."""
    for one, other in ((a, b), (b, a)):
        start = one.triangles.reshape(-1, 3)
        span = one.triangles[:, [1, 2, 0]].reshape(-1, 3) - start
        step = max(1, len(start) // 3000)
        start, span = start[::step], span[::step]
        face = other.scene.first_hit(start, span, 1.0).face
        slope = np.abs(np.einsum("ij,ij->i", span, other.normals[np.maximum(face, 0)]))
        if ((face >= 0) & (slope > 0.02 * np.linalg.norm(span, axis=1))).any():  # in the plane itself a ray cannot tell
            return True
    return False


def hanging_on(contacts: Contacts, group: Int[np.ndarray, " P"], root: int) -> dict[int, list[int]]:
    """For every group, the groups that reach the root only through it (itself first): its dominated set.

    Groups join patches that are known to move together. Components that are near nothing hang on the root.
    """
    graph = nx.DiGraph()
    count = int(group.max()) + 1
    graph.add_nodes_from(range(count))
    for i, j in np.concatenate([contacts.touch, contacts.near]):
        a, b = int(group[i]), int(group[j])
        if a != b:
            graph.add_edge(a, b)
            graph.add_edge(b, a)
    for island in list(nx.weakly_connected_components(graph)):
        if root not in island:  # near nothing: it hangs on the root
            graph.add_edges_from((root, node) for node in island)
    parent = nx.immediate_dominators(graph, root)
    children: dict[int, list[int]] = {u: [] for u in range(count)}
    for node in sorted(parent):
        if node != root and parent[node] is not None and parent[node] != node:
            children[parent[node]].append(node)
    found: dict[int, list[int]] = {}
    for node in range(count):
        stack, below = [node], []
        while stack:
            at = stack.pop()
            below.append(at)
            stack.extend(children[at])
        found[node] = below
    return found
