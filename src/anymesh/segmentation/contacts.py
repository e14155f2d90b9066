"""Which pieces touch, which are apart by a clearance, and what hangs on what."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import networkx as nx
import numpy as np
from jaxtyping import Int

from anymesh.config import SegmentationConfig
from anymesh.geometry.boxes import alike
from anymesh.geometry.distance_ import distance_to_triangles
from anymesh.geometry.pieces import ObjectShape
from anymesh.geometry.shape import Shape
from anymesh.geometry.topology import label_connected

FLAT = 0.6  # length of the mean normal of a sheet, with its handle; 1 where it is plane
LEAF = 0.3  # width of a plate over its length; planks are narrower
SAME_WAY = 0.95  # cosine
PROBES = 160  # points of a piece that are measured against another


@dataclass(frozen=True, eq=False)
class Contacts:
    """Pieces and what they touch.

    shapes: one a piece; touch: (m, 2) pairs that touch or cross; near: (k, 2) pairs of different bodies with a clearance;
    body: (P,) bodies are pieces that touch, directly or through others.
    """

    shapes: tuple[Shape, ...]
    touch: Int[np.ndarray, "m 2"]
    near: Int[np.ndarray, "k 2"]
    body: Int[np.ndarray, " P"]
    area: dict[tuple[int, int], float]  # of the first piece that touches the second [m^2]; none for one flat surface


def find_contacts(whole: ObjectShape, config: SegmentationConfig) -> Contacts:
    """Measures all pairs of pieces whose boxes are near each other."""
    order = np.argsort(whole.piece, kind="stable")
    bounds = np.searchsorted(whole.piece[order], np.arange(int(whole.piece.max()) + 2))
    shapes = tuple(whole.of(order[a:b]) for a, b in itertools.pairwise(bounds))
    shared = {(int(a), int(b)) for a, b in whole.shared}
    touch, near = sorted(shared), []
    tolerance, reach = config.touch * whole.diagonal, config.near * whole.diagonal
    for i, j in _box_pairs(shapes, reach):
        if (i, j) in shared:
            continue
        gap = min(_gap(shapes[i], shapes[j], reach), _gap(shapes[j], shapes[i], reach))
        if gap < tolerance or (gap < reach and _crosses(shapes[i], shapes[j])):
            touch.append((i, j))
        elif gap < reach:
            near.append((i, j, gap))
    pairs = np.array(touch, np.int64).reshape(-1, 2)
    body = label_connected(len(shapes), pairs)
    apart = _neighbours(near, body, shapes, tolerance)
    area = {}
    for i, j in touch:
        if (i, j) in shared and _goes_on(shapes[i], shapes[j]):
            continue  # fronts side by side hold nothing of each other
        area[i, j], area[j, i] = (_touching(shapes[a], shapes[b], 2 * tolerance) for a, b in ((i, j), (j, i)))
    return Contacts(shapes, pairs, apart, body, area)


def _neighbours(near: list[tuple[int, int, float]], body: np.ndarray, shapes: tuple[Shape, ...], slack: float) -> np.ndarray:
    """Of the pairs of bodies with a clearance, those that are among the nearest of the smaller body.

    A fit has clearances that differ by a factor of two; what is small against its nearest piece hangs on that alone.
    """
    size = [float(np.linalg.norm(s.bounds[1] - s.bounds[0])) for s in shapes]
    extent = np.zeros(int(body.max()) + 1)
    np.maximum.at(extent, body, size)
    pairs = []
    for i, j, gap in near:
        if body[i] != body[j]:
            small, large = sorted((i, j), key=lambda p: (extent[body[p]], body[p]))
            pairs.append((gap, small, large))
    most: dict[int, float] = {}
    kept = []
    for gap, small, large in sorted(pairs):
        factor = 1.3 if extent[body[small]] < 0.5 * size[large] else 2.0
        if gap <= most.setdefault(int(body[small]), factor * gap) + slack:
            kept.append((min(small, large), max(small, large)))
    return np.array(sorted(kept), np.int64).reshape(-1, 2)


def _goes_on(a: Shape, b: Shape) -> bool:
    """Whether both are sheets that face the same way."""
    mean = [s.areas @ s.normals / max(s.area, 1e-300) for s in (a, b)]
    length = [float(np.linalg.norm(m)) for m in mean]
    return min(length) > FLAT and bool(mean[0] @ mean[1] > SAME_WAY * length[0] * length[1])


def _touching(a: Shape, b: Shape, tolerance: float) -> float:
    """Area of a within the tolerance of b [m^2]."""
    samples = a.samples.points[::3]
    near = ((samples >= b.bounds[0] - tolerance) & (samples <= b.bounds[1] + tolerance)).all(1)
    gap = distance_to_triangles(samples[near], b.triangles)
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
        if min(s.half[1] / max(s.half[0], 1e-12) for s in (a, b)) > LEAF and alike(a, b):
            continue  # two leaves of a window
        if abs(float(a.axes[2] @ b.axes[2])) > 0.9995 and level < tolerance and abs(a.half[2] - b.half[2]) < tolerance:
            found.append((int(i), int(j)))
    return found


def _box_pairs(shapes: tuple[Shape, ...], reach: float) -> list[tuple[int, int]]:
    low = np.array([s.bounds[0] for s in shapes]) - reach / 2
    high = np.array([s.bounds[1] for s in shapes]) + reach / 2
    found = []
    for i in range(len(shapes) - 1):
        meets = ((low[i + 1 :] <= high[i]) & (high[i + 1 :] >= low[i])).all(1)
        found += [(i, int(j) + i + 1) for j in np.flatnonzero(meets)]
    return found


def _gap(a: Shape, b: Shape, reach: float) -> float:
    """Smallest distance of a's corners and samples, as far as they lie in b's box, to b [m]."""
    low, high = b.bounds[0] - reach, b.bounds[1] + reach
    points = [p[((p >= low) & (p <= high)).all(1)] for p in (a.corners, a.samples.points)]
    points = [p[:: max(1, len(p) // PROBES)] for p in points]
    probe = np.concatenate(points)
    return float(distance_to_triangles(probe, b.triangles).min()) if len(probe) else np.inf


def _crosses(a: Shape, b: Shape) -> bool:
    """Whether edges of one shape pass through faces of the other."""
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


def hanging_on(contacts: Contacts, unit: Int[np.ndarray, " P"], root: int) -> dict[int, list[int]]:
    """For every unit, the units that reach the root only through it (itself first): its dominated set.

    Units join pieces that are known to move as one. Bodies that are near nothing hang on the root.
    """
    graph = nx.DiGraph()
    count = int(unit.max()) + 1
    graph.add_nodes_from(range(count))
    for i, j in np.concatenate([contacts.touch, contacts.near]):
        a, b = int(unit[i]), int(unit[j])
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
