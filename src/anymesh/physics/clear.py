"""Collision shapes that let every joint move: false contacts at sampled poses are removed by refinement or trimming.

A contact of shapes is false if the surfaces themselves do not cross. First the components involved are decomposed more finely.
Remaining protrusions are trimmed along the contact. Links whose surfaces overlap at rest are excluded from contact, and listed.
Real collisions (a tray behind a closed door) stay.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from jaxtyping import Float

from anymesh.geometry.raycast_ import RayScene
from anymesh.physics.contacts_ import Contact, ContactBench, Pose
from anymesh.physics.convex import EXACT, as_hull, fitted, trimmed, volume
from anymesh.physics.decompose import Component
from anymesh.physics.split import outline
from anymesh.types import Brief, Hull, Shape
from anymesh.types.triangles import box_corners, normals_and_areas, transformed, unshared

MAX_PLANED_RATIO = 0.15  # maximum share of a shape that is trimmed before its component is refined instead
MAX_PLANED_RATIO_LAST = 0.7  # maximum share that is trimmed at the finest resolution, and of shapes that overlap at rest
REST_ROUNDS = 4  # rounds of trimming at rest
MIN_GAP_RATIO = 0.95  # share of the gap at rest below which shapes are trimmed


class LinkSurface:
    """The triangles of a link in its frame with their edges, for tests of crossing."""

    def __init__(self, triangles: Float[np.ndarray, "n 3 3"]) -> None:
        self.normals, _ = normals_and_areas(triangles)
        self.triangles = triangles
        points, ends = outline(triangles)
        self.bounds = np.stack([points.min(0), points.max(0)])
        self._start, self._end = points[ends[:, 0]], points[ends[:, 1]]
        self._low, self._high = np.minimum(self._start, self._end).T.copy(), np.maximum(self._start, self._end).T.copy()
        self._scene: RayScene | None = None

    def edges_near(self, bounds: Float[np.ndarray, "2 3"]) -> tuple[Float[np.ndarray, "m 3"], Float[np.ndarray, "m 3"]]:
        """Return both ends of the edges that come within some bounds."""
        kept = np.arange(len(self._start))
        for low, high, least, most in zip(self._low, self._high, *bounds, strict=True):
            kept = kept[(high[kept] >= least) & (low[kept] <= most)]
        return self._start[kept], self._end[kept]

    def crossed_by(self, start: Float[np.ndarray, "m 3"], end: Float[np.ndarray, "m 3"], depth: float) -> bool:
        """Return whether an edge, in this frame, crosses a triangle and ends more than `depth` [m] away on both sides."""
        if len(start) == 0:
            return False
        if self._scene is None:
            self._scene = RayScene(*unshared(self.triangles))
        for origin, direction in ((start, end - start), (end, start - end)):  # the first hit from either end
            hits = self._scene.first_hit(origin, direction, 1.0)
            met = np.flatnonzero(hits.face >= 0)
            slope = np.abs(np.einsum("ij,ij->i", direction[met], self.normals[hits.face[met]]))
            before, behind = slope * hits.distance[met], slope * (1 - hits.distance[met])
            if bool((np.minimum(before, behind) > depth).any()):
                return True
        return False


def cross(a: LinkSurface, T_a: Float[np.ndarray, "4 4"], b: LinkSurface, T_b: Float[np.ndarray, "4 4"], depth: float) -> bool:
    """Return whether the surfaces of two links, placed by their transforms, penetrate by more than `depth` [m]."""
    for one, T_one, other, T_other in ((a, T_a, b, T_b), (b, T_b, a, T_a)):
        T = np.linalg.inv(T_other) @ T_one
        back = np.linalg.inv(T)
        start, end = (transformed(p, T) for p in one.edges_near(placed_bounds(other, back)))
        if other.crossed_by(start, end, depth):
            return True
    return False


def placed_bounds(surface: LinkSurface, T: Float[np.ndarray, "4 4"]) -> Float[np.ndarray, "2 3"]:
    """Return the bounds of the transformed bounding box of a surface."""
    corners = transformed(box_corners(surface.bounds), T)
    return np.stack([corners.min(0), corners.max(0)])


# returns shapes of components at levels of resolution
Refine = Callable[[Sequence[Component], Sequence[int]], list[tuple[Shape, ...]]]


@dataclass(frozen=True, eq=False)
class ComponentShapes:
    """A component of a link and its shapes at a level of resolution."""

    link: str
    component: Component
    level: int
    shapes: tuple[Shape, ...]


@dataclass(frozen=True, eq=False)
class Fault(Brief):
    """A false contact at a pose, between shapes of two components.

    first, second: (index of the component, index of its shape).
    """

    first: tuple[int, int]
    second: tuple[int, int]
    depth: float
    normal: np.ndarray  # from the first to the second, in the frame of the pose
    pose: Pose


@dataclass(frozen=True, eq=False)
class Faults:
    """The deepest false contact of each pair of shapes, deepest first. poses: indices of the poses with false contacts."""

    found: list[Fault]
    poses: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class ContactScene:
    """Surfaces per link in link frames, poses (the first one is rest), depth thresholds, and the gap of shapes at rest [m]."""

    surfaces: dict[str, LinkSurface]
    poses: Sequence[Pose]
    contact: float
    crossing: float
    gap: float = 0.0

    @cached_property
    def overlapping(self) -> tuple[tuple[str, str], ...]:
        """Return pairs of links whose surfaces cross at rest."""
        names = sorted(self.surfaces)
        low, high = np.stack([placed_bounds(self.surfaces[name], self.poses[0][name]) for name in names], 1)
        near = np.triu((low[:, None] <= high[None]).all(2) & (low[None] <= high[:, None]).all(2), 1)
        return tuple((names[i], names[k]) for i, k in np.argwhere(near) if self._cross(names[i], names[k], 0))

    @cached_property
    def _crossings(self) -> dict[tuple[str, str, int], bool]:
        return {}

    def _cross(self, a: str, b: str, at: int) -> bool:
        """Return whether the surfaces of two links cross at a pose; cached, since surfaces do not change."""
        if (a, b, at) not in self._crossings:
            pose = self.poses[at]
            self._crossings[a, b, at] = cross(self.surfaces[a], pose[a], self.surfaces[b], pose[b], self.crossing)
        return self._crossings[a, b, at]

    def faults(
        self, pieces: Sequence[ComponentShapes], at: Sequence[int] | None = None, late: Callable[[], bool] = lambda: False
    ) -> Faults:
        """Find the false contacts at some poses, None for all; poses after the deadline are left out."""
        owner = self._owners(pieces)
        bench = ContactBench({link: [pieces[k].shapes[n] for k, n in some] for link, some in owner.items()}, self.overlapping)
        worst: dict[tuple[tuple[int, int], tuple[int, int]], Fault] = {}
        poses = []
        for number in range(len(self.poses)) if at is None else at:
            if late():
                break
            pair_contacts: dict[tuple[str, str], list[Contact]] = {}
            for contact in bench.contacts(self.poses[number], self.contact):
                a, b = sorted((contact.first[0], contact.second[0]))
                pair_contacts.setdefault((a, b), []).append(contact)
            false = [c for (a, b), contacts in pair_contacts.items() if not self._cross(a, b, number) for c in contacts]
            poses += [number] if false else []
            for c in false:
                key = owner[c.first[0]][c.first[1]], owner[c.second[0]][c.second[1]]
                if key not in worst or c.depth > worst[key].depth:
                    worst[key] = Fault(*key, c.depth, c.normal, self.poses[number])
        return Faults(sorted(worst.values(), key=lambda f: (-f.depth, f.first, f.second)), tuple(poses))

    def _owners(self, pieces: Sequence[ComponentShapes]) -> dict[str, list[tuple[int, int]]]:
        """Return (index of the component, index of its shape) of the shapes of each link."""
        return {
            link: [(k, n) for k, p in enumerate(pieces) if p.link == link for n in range(len(p.shapes))]
            for link in self.surfaces
        }

    def near_at_rest(self, pieces: Sequence[ComponentShapes]) -> list[Fault]:
        """Find the shapes of different links that are nearer than the gap at rest, nearest first, whatever the surfaces do."""
        owner = self._owners(pieces)
        bench = ContactBench({link: [pieces[k].shapes[n] for k, n in some] for link, some in owner.items()}, margin=self.gap)
        near = bench.contacts(self.poses[0], self.contact - self.gap)
        faults = [
            Fault(owner[c.first[0]][c.first[1]], owner[c.second[0]][c.second[1]], c.depth, c.normal, self.poses[0])
            for c in near
        ]
        return sorted(faults, key=lambda f: (-f.depth, f.first, f.second))


@dataclass(frozen=True, eq=False)
class Cleared:
    """Components after clearing, the number of false contacts before, and the pairs of links that still have some."""

    pieces: list[ComponentShapes]
    before: int
    left: tuple[tuple[str, str], ...]


def clear(
    scene: ContactScene,
    components: list[ComponentShapes],
    refine: Refine,
    *,
    levels: int,
    rounds: int,
    late: Callable[[], bool] = lambda: False,
) -> Cleared:
    """Remove false contacts by trimming shapes, or by refining components up to the last of `levels`.

    Shapes are trimmed if they lose little. Since shapes only shrink, each round checks the poses that had false contacts. Once
    these are free, all poses are checked again. At last, shapes that are too near at rest are trimmed, also where the surfaces
    overlap, since a URDF excludes no contact.

    late: returns whether the deadline has passed, after which false contacts stay.
    """
    faults = scene.faults(components, None, late)
    before = len(faults.found)
    while faults.found and rounds > 0 and not late():
        rounds -= 1
        planed, costly = _planed(components, faults.found, scene.contact, MAX_PLANED_RATIO)
        coarse = sorted({k for f in costly for k, _ in (f.first, f.second) if components[k].level + 1 < levels})
        if coarse:
            finer = refine([components[k].component for k in coarse], [components[k].level + 1 for k in coarse])
            for k, shapes in zip(coarse, finer, strict=True):
                planed[k] = replace(components[k], level=components[k].level + 1, shapes=shapes)
        elif costly:
            planed, _ = _planed(components, faults.found, scene.contact, MAX_PLANED_RATIO_LAST)
        components = planed
        again = scene.faults(components, faults.poses, late)
        again = again if again.found else scene.faults(components, None, late)
        if late():  # not all poses were checked, so earlier false contacts may remain
            break
        faults = again
    for _ in range(REST_ROUNDS if scene.gap > 0 and not late() else 0):
        apart = _apart(components, scene.near_at_rest(components), scene)
        if apart is None:
            break
        components = apart
    links = [(components[f.first[0]].link, components[f.second[0]].link) for f in faults.found]
    return Cleared(components, before, tuple(sorted({(min(pair), max(pair)) for pair in links})))


def _planed(
    components: list[ComponentShapes], faults: Sequence[Fault], margin: float, max_ratio: float
) -> tuple[list[ComponentShapes], list[Fault]]:
    """Trim the shape of each contact that loses the smaller share.

    Return the shapes, and the contacts for which that share exceeds `max_ratio`.
    """
    shapes = [list(p.shapes) for p in components]
    costly = []
    for fault in faults:
        sides = [(k, n, fault.pose[components[k].link], shapes[k][n]) for k, n in (fault.first, fault.second)]
        reach = [
            float((placed_hull(shape, T) @ (sign * fault.normal)).max())
            for (_, _, T, shape), sign in zip(sides, (1.0, -1.0), strict=True)
        ]
        if reach[0] + reach[1] <= 0:  # separated by an earlier cut
            continue
        depth = reach[0] + reach[1] + margin
        cuts = [_cut(shape, T, sign * fault.normal, depth) for (_, _, T, shape), sign in zip(sides, (1.0, -1.0), strict=True)]
        side = 0 if cuts[0][0] <= cuts[1][0] else 1
        if cuts[side][0] > max_ratio:
            costly.append(fault)
        else:
            shapes[sides[side][0]][sides[side][1]] = fitted(cuts[side][1], EXACT)
    return [replace(p, shapes=tuple(some)) for p, some in zip(components, shapes, strict=True)], costly


def _apart(components: list[ComponentShapes], near: Sequence[Fault], scene: ContactScene) -> list[ComponentShapes] | None:
    """Trim shapes that are too near each other at rest, those that touch by more than the others; None if nothing changes.

    A box or cylinder that touches nothing stays one.
    """
    shapes = [list(p.shapes) for p in components]
    changed = False
    for fault in near:
        sides = [(k, n, fault.pose[components[k].link], shapes[k][n]) for k, n in (fault.first, fault.second)]
        normals = (fault.normal, -fault.normal)
        reach = [float((placed_hull(s, T) @ n).max()) for (_, _, T, s), n in zip(sides, normals, strict=True)]
        if (overlap := sum(reach)) <= -MIN_GAP_RATIO * scene.gap:  # separated by an earlier cut
            continue
        cuts = [_cut(s, T, n, overlap + scene.gap) for (_, _, T, s), n in zip(sides, normals, strict=True)]
        touch = overlap > (1 - MIN_GAP_RATIO) * scene.gap
        for (share, left), (k, n, _, shape) in sorted(zip(cuts, sides, strict=True), key=lambda pair: pair[0][0]):
            if share > (MAX_PLANED_RATIO_LAST if touch else MAX_PLANED_RATIO):
                break
            rest = fitted(left, EXACT)
            if touch or type(rest) is type(shape):
                shapes[k][n], changed = rest, True
                break
    return [replace(p, shapes=tuple(some)) for p, some in zip(components, shapes, strict=True)] if changed else None


def placed_hull(shape: Shape, T: np.ndarray) -> np.ndarray:
    """Return the corners of a shape in a pose."""
    return transformed(as_hull(shape).vertices, T)


def _cut(shape: Shape, T: np.ndarray, normal: np.ndarray, depth: float) -> tuple[float, Hull]:
    """Return the share that a shape loses, 1 if it is all, and its rest, when it is trimmed by `depth` [m] from its end."""
    hull = as_hull(shape)
    n = T[:3, :3].T @ normal
    left = trimmed(hull, n, float((hull.vertices @ n).max()) - depth)
    return (1.0, hull) if left is None else (1 - volume(left) / volume(hull), left)
