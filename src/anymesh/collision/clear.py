"""Collision shapes that let every joint move: false contacts are found at sampled poses and refined or planed away.

A contact of shapes is false where the surfaces themselves do not go through each other. First the components at fault are
decomposed finer; what still stands out is planed off along the contact. Links whose surfaces overlap at rest are excluded from
contact, and listed; a collision that is there in truth (a tray behind a closed door) stays.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from anymesh.collision.contacts_ import Contact, ContactBench, Pose
from anymesh.collision.convex import trimmed, volume
from anymesh.collision.crossing import LinkSurface, cross, placed_bounds
from anymesh.collision.decompose import Component
from anymesh.collision.primitives import EXACT, as_hull, fitted
from anymesh.types import Shape

MAX_PLANED_RATIO = 0.15  # share of a shape that is planed off rather than its piece refined
MAX_PLANED_RATIO_LAST = 0.7  # share that is planed off where nothing finer is left
Refine = Callable[[Sequence[Component], Sequence[int]], list[tuple[Shape, ...]]]  # shapes of components at levels of resolution


@dataclass(frozen=True, eq=False)
class ComponentShapes:
    """A component of a link and its shapes at a level of resolution."""

    link: str
    component: Component
    level: int
    shapes: tuple[Shape, ...]


@dataclass(frozen=True, eq=False)
class Fault:
    """A false contact at a pose, between shapes of two pieces: (number of the piece, number of its shape)."""

    first: tuple[int, int]
    second: tuple[int, int]
    depth: float
    normal: np.ndarray  # from the first to the second, where the pose places them
    pose: Pose


@dataclass(frozen=True, eq=False)
class Faults:
    """The deepest false contact of each pair of shapes, deepest first. poses: numbers of the poses that have any."""

    found: list[Fault]
    poses: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class ContactScene:
    """Surfaces per link in link frames, poses (the first one is rest), and depths that count [m]."""

    surfaces: dict[str, LinkSurface]
    poses: Sequence[Pose]
    contact: float
    crossing: float

    @cached_property
    def overlapping(self) -> tuple[tuple[str, str], ...]:
        """Pairs of links whose surfaces go through each other at rest."""
        names = sorted(self.surfaces)
        low, high = np.stack([placed_bounds(self.surfaces[name], self.poses[0][name]) for name in names], 1)
        near = np.triu((low[:, None] <= high[None]).all(2) & (low[None] <= high[:, None]).all(2), 1)
        return tuple((names[i], names[k]) for i, k in np.argwhere(near) if self._cross(names[i], names[k], 0))

    @cached_property
    def _crossings(self) -> dict[tuple[str, str, int], bool]:
        return {}

    def _cross(self, a: str, b: str, at: int) -> bool:
        """Whether the surfaces of two links go through each other at a pose. Kept: surfaces do not change."""
        if (a, b, at) not in self._crossings:
            pose = self.poses[at]
            self._crossings[a, b, at] = cross(self.surfaces[a], pose[a], self.surfaces[b], pose[b], self.crossing)
        return self._crossings[a, b, at]

    def faults(
        self, pieces: Sequence[ComponentShapes], at: Sequence[int] | None = None, late: Callable[[], bool] = lambda: False
    ) -> Faults:
        """Find the false contacts at some poses, None for all; poses that come when it is late are left out."""
        owner = {
            link: [(k, n) for k, p in enumerate(pieces) if p.link == link for n in range(len(p.shapes))]
            for link in self.surfaces
        }
        bench = ContactBench({link: [pieces[k].shapes[n] for k, n in some] for link, some in owner.items()}, self.overlapping)
        worst: dict[tuple[tuple[int, int], tuple[int, int]], Fault] = {}
        poses = []
        for number in range(len(self.poses)) if at is None else at:
            if late():
                break
            found: dict[tuple[str, str], list[Contact]] = {}
            for contact in bench.contacts(self.poses[number], self.contact):
                a, b = sorted((contact.first[0], contact.second[0]))
                found.setdefault((a, b), []).append(contact)
            false = [c for (a, b), contacts in found.items() if not self._cross(a, b, number) for c in contacts]
            poses += [number] if false else []
            for c in false:
                key = owner[c.first[0]][c.first[1]], owner[c.second[0]][c.second[1]]
                if key not in worst or c.depth > worst[key].depth:
                    worst[key] = Fault(*key, c.depth, c.normal, self.poses[number])
        return Faults(sorted(worst.values(), key=lambda f: (-f.depth, f.first, f.second)), tuple(poses))


@dataclass(frozen=True, eq=False)
class Cleared:
    """Pieces after clearing, how many false contacts there were first, and the pairs of links that still have some."""

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
    """Plane the shapes of false contacts where that costs them little; refine pieces up to the last of `levels` where not.

    Shapes only shrink, so a round looks at the poses that had false contacts; when these are free, all are looked at again.
    late: tells that the time is over, after which false contacts stay.
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
        if late():  # not all poses were looked at: what had false contacts before may still have them
            break
        faults = again
    links = [(components[f.first[0]].link, components[f.second[0]].link) for f in faults.found]
    return Cleared(components, before, tuple(sorted({(min(pair), max(pair)) for pair in links})))


def _planed(
    components: list[ComponentShapes], faults: Sequence[Fault], margin: float, max_ratio: float
) -> tuple[list[ComponentShapes], list[Fault]]:
    """Of each fault, the shape that loses the smaller share of itself is cut back, and the faults that would cost more than
    the share `max_ratio`."""
    shapes: list[list[Shape | None]] = [list(p.shapes) for p in components]
    costly = []
    for fault in faults:
        sides = [(k, n, fault.pose[components[k].link], shapes[k][n]) for k, n in (fault.first, fault.second)]
        reach = [
            None if shape is None else float((placed_hull(shape, T) @ (sign * fault.normal)).max())
            for (_, _, T, shape), sign in zip(sides, (1.0, -1.0), strict=True)
        ]
        if reach[0] is None or reach[1] is None or reach[0] + reach[1] <= 0:  # parted by an earlier cut
            continue
        depth = reach[0] + reach[1] + margin
        cuts = [
            _cut(shape, T, sign * fault.normal, depth)
            for (_, _, T, shape), sign in zip(sides, (1.0, -1.0), strict=True)
            if shape is not None
        ]
        side = 0 if cuts[0][0] <= cuts[1][0] else 1
        if cuts[side][0] > max_ratio:
            costly.append(fault)
        else:
            shapes[sides[side][0]][sides[side][1]] = cuts[side][1]
    kept = [replace(p, shapes=tuple(s for s in some if s is not None)) for p, some in zip(components, shapes, strict=True)]
    return kept, costly


def placed_hull(shape: Shape, T: np.ndarray) -> np.ndarray:
    """The corners of a shape where a pose has it."""
    return as_hull(shape).vertices @ T[:3, :3].T + T[:3, 3]


def _cut(shape: Shape, T: np.ndarray, normal: np.ndarray, depth: float) -> tuple[float, Shape | None]:
    """The share that a shape loses, and what is left, when it is cut back by `depth` [m] from where it reaches furthest."""
    hull = as_hull(shape)
    n = T[:3, :3].T @ normal
    left = trimmed(hull, n, float((hull.vertices @ n).max()) - depth)
    return (1.0, None) if left is None else (1 - volume(left) / volume(hull), fitted(left, EXACT))
