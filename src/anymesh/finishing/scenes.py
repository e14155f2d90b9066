"""An asset at rest and with open joints, for ray casting, and its parts as they grow during completion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.geometry.kinematics import joint_motion, link_transforms
from anymesh.geometry.raycast_ import RayScene
from anymesh.geometry.sweep import Obstacles, free_amount
from anymesh.geometry.topology import triangle_set_of
from anymesh.geometry.triangle_set import SurfacePoints, sample_surface, spread_directions
from anymesh.motion.part_context import PENETRATION_RATIO
from anymesh.types import Asset, Brief, Joint, JointType, Mesh
from anymesh.types.triangles import unshared

PROBES = 20_000  # points on the surface, besides the centroid of every face
DIRECTIONS = 96  # directions from which each point is viewed
GRAZE = 0.02  # minimum share of directions in which a point must be visible from a side; less is through a gap
RAYS = 50_000  # rays per batch
OFF = 1e-5  # share of the diagonal: distance of ray origins from the surface
HALF_REVOLUTION_RAD = np.pi
SKIP = 1e-4  # share of the diagonal: nearer surfaces are in contact
FLOOR = 1e-3  # share of the diagonal: points within this distance of the ground stand on it
STEPS = 24  # steps of a sweep from rest to a limit
LOSS = 0.02  # share of its range that a joint may lose
NONE = np.zeros((0, 3, 3))


def seen_from_outside(
    scene: RayScene, points: Float[np.ndarray, "n 3"], normals: Float[np.ndarray, "n 3"], diagonal: float
) -> Bool[np.ndarray, " n"]:
    """Return which points are visible from far away, from either side. diagonal: of the whole scene."""
    return (escapes(scene, points, normals, diagonal) != 0).any(1)


def escapes(
    scene: RayScene, points: Float[np.ndarray, "n 3"], normals: Float[np.ndarray, "n 3"], diagonal: float
) -> Float[np.ndarray, "n 2"]:
    """Compute the share of all directions in which a point is unobstructed, on the side of its normal and on the other."""
    counts = np.zeros((len(points), 2))
    directions = spread_directions(DIRECTIONS)
    for ways in np.array_split(directions, min(len(directions), 1 + len(points) * len(directions) // RAYS)):
        front = ways @ normals.T > 0
        start = points + OFF * diagonal * np.where(front, 1.0, -1.0)[:, :, None] * normals
        rays = np.repeat(ways * 2 * diagonal, len(points), 0)
        free = scene.first_hit(start.reshape(-1, 3), rays, 1.0).face.reshape(front.shape) < 0
        counts[:, 0] += (free & front).sum(0)
        counts[:, 1] += (free & ~front).sum(0)
    return counts / len(directions)


def visible_faces(mesh: Mesh) -> Bool[np.ndarray, " F"]:
    """Return which faces are at least partly visible from outside, for any winding."""
    scene = RayScene(mesh.vertices, mesh.faces)
    middles = SurfacePoints(mesh.triangles.mean(1), mesh.face_normals, np.arange(len(mesh.faces)))
    seen = np.zeros(len(mesh.faces), bool)
    for probe in (middles, sample_surface(mesh.triangles, PROBES, 0)):
        seen[probe.faces[seen_from_outside(scene, probe.points, probe.normals, mesh.diagonal)]] = True
    return seen


@dataclass(frozen=True, eq=False)
class Scenes:
    """The original surface. Part numbers are those of the asset's segmentation."""

    asset: Asset
    _opened: dict[int, RayScene] = field(default_factory=dict, init=False)

    @cached_property
    def diagonal(self) -> float:
        return self.asset.mesh.diagonal

    @cached_property
    def rest(self) -> RayScene:
        return RayScene(self.asset.mesh.vertices, self.asset.mesh.faces)

    @cached_property
    def number(self) -> dict[str, int]:
        """Part name -> number."""
        return {part.name: k for k, part in enumerate(self.asset.segmentation.parts)}

    @cached_property
    def joint(self) -> dict[int, Joint]:
        """Part number -> the joint that carries it."""
        return {self.number[j.child]: j for j in self.asset.joints}

    @cached_property
    def order(self) -> tuple[int, ...]:
        """Part numbers, each after its parent."""
        return tuple(sorted(range(len(self.number)), key=lambda k: (len(self.carriers(k)), k)))

    def carriers(self, part: int) -> tuple[int, ...]:
        """Return the ancestors of a part, nearest first."""
        ancestors: list[int] = []
        while (joint := self.joint.get(ancestors[-1] if ancestors else part)) is not None:
            ancestors.append(self.number[joint.parent])
        return tuple(ancestors)

    def opened(self, part: int) -> Float[np.ndarray, "p 4 4"]:
        """Return the transform of each part, relative to `part`, with all descendants of `part` at their widest positions."""
        wide = {j.name: widest(j) for k, j in self.joint.items() if part in self.carriers(k)}
        moved = link_transforms(self.asset, wide)
        return np.stack([moved[p.name] for p in self.asset.segmentation.parts])

    def scene_opened(self, part: int) -> RayScene:
        """Return the surface with all descendants of `part` at their widest positions."""
        if part not in self._opened:
            T = self.opened(part)[self.asset.segmentation.face_part]
            t = np.einsum("fij,fkj->fki", T[:, :3, :3], self.asset.mesh.triangles) + T[:, None, :3, 3]
            self._opened[part] = RayScene(*unshared(t))
        return self._opened[part]

    def seen(self, points: Float[np.ndarray, "n 3"], normals: Float[np.ndarray, "n 3"]) -> Bool[np.ndarray, "n 2"]:
        """Return which points are visible at rest from the side of their normals, and which from the other side."""
        return escapes(self.rest, points, normals, self.diagonal) >= GRAZE

    def on_the_ground(self, points: Float[np.ndarray, "n 3"]) -> bool:
        """Return whether points lie in the ground plane of the object."""
        return bool((points[:, 2] < self.asset.mesh.bounds[0, 2] + FLOOR * self.diagonal).all())


def widest(joint: Joint) -> float:
    """Return the position furthest from rest [rad or m]; half a turn for continuous joints."""
    if joint.type is JointType.FIXED:
        return 0.0
    return HALF_REVOLUTION_RAD if joint.limits is None else max(joint.limits[::-1], key=abs)


@dataclass(eq=False)
class Growing(Brief):
    """The parts during completion: original surface, added triangles, and notes on what was done.

    late: returns whether the time for completion is over.
    """

    scenes: Scenes
    late: Callable[[], bool] = lambda: False
    added: dict[int, list[Float[np.ndarray, "_ 3 3"]]] = field(default_factory=dict)
    notes: dict[int, list[str]] = field(default_factory=dict)

    def undo(self, part: int) -> None:
        """Remove all that was added to a part."""
        self.added.pop(part, None)
        self.notes.pop(part, None)

    def add(self, part: int, triangles: Float[np.ndarray, "n 3 3"], notes: Sequence[str]) -> None:
        if len(triangles):
            self.added.setdefault(part, []).append(triangles)
        if notes:
            self.notes.setdefault(part, []).extend(notes)

    def faces(self, part: int) -> Int[np.ndarray, " n"]:
        return self.scenes.asset.segmentation.faces(part)

    def triangles(self, *parts: int) -> Float[np.ndarray, "n 3 3"]:
        """Return the current triangles of these parts."""
        old = [self.scenes.asset.mesh.triangles[self.faces(k)] for k in parts]
        return np.concatenate([*old, *(t for k in parts for t in self.added.get(k, []))])

    def others(self, part: int) -> Float[np.ndarray, "n 3 3"]:
        """Return the current triangles of the other parts."""
        rest = [k for k in self.scenes.order if k != part]
        return self.triangles(*rest) if rest else np.zeros((0, 3, 3))


def scene_of(triangles: Float[np.ndarray, "n 3 3"]) -> RayScene | None:
    """Return a ray scene of triangles; None without any."""
    return RayScene(*unshared(triangles)) if len(triangles) else None


def room(
    scene: RayScene | None,
    points: Float[np.ndarray, "n 3"],
    ways: Float[np.ndarray, "n 3"],
    max_distance: float,
    skip: float,
    *,
    without: Int[np.ndarray, " m"] | None = None,
) -> Float[np.ndarray, " n"]:
    """Return the distance from points along directions to the first surface [m].

    It is `max_distance` if there is none, or if it is one of the faces `without`. Surfaces nearer than `skip` are in contact,
    and are ignored.
    """
    if scene is None or len(points) == 0:
        return np.full(len(points), max_distance)
    hits = scene.first_hit(points + skip * ways, ways, max_distance)
    far = np.minimum(hits.distance + skip, max_distance)
    return far if without is None else np.where(np.isin(hits.face, without), max_distance, far)


def moves_freely(
    part: int,
    growing: Growing,
    before: Growing,
    *,
    added: Float[np.ndarray, "n 3 3"] = NONE,
    beside: Float[np.ndarray, "m 3 3"] = NONE,
) -> bool:
    """Return whether a part still moves as far towards both limits as it did `before`.

    The part moves with its descendants and the triangles `added`, among the other parts and the triangles `beside`.
    """
    joint = growing.scenes.joint[part]
    if joint.type is JointType.FIXED:
        return True
    scenes = growing.scenes
    carried = [k for k in scenes.order if k == part or part in scenes.carriers(k)]
    others = [k for k in scenes.order if k not in carried]
    tolerance = PENETRATION_RATIO * scenes.diagonal
    own, rest = (np.concatenate([growing.triangles(*k), new]) for k, new in ((carried, added), (others, beside)))
    after = Obstacles(triangle_set_of(own), triangle_set_of(rest), tolerance)
    motion = joint_motion(joint)
    low, high = (-np.pi, np.pi) if joint.limits is None else joint.limits
    for sign, most in ((1, float(high)), (-1, -float(low))):
        if most <= 0:  # this limit is at rest
            continue
        now = free_amount(after, motion, sign, most, STEPS)[0]
        if now < (1 - LOSS) * most:
            old, about = (triangle_set_of(before.triangles(*k)) for k in (carried, others))
            if now < free_amount(Obstacles(old, about, tolerance), motion, sign, most, STEPS)[0] - LOSS * most:
                return False
    return True
