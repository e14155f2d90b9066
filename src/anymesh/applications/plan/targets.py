"""Candidate grasps and pushes: sampled on the part's surface, checked for free space by rays, ranked by score."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float

from anymesh.applications.plan.plans import GripperContact, Target
from anymesh.geometry.raycast_ import RayScene
from anymesh.types import Brief, JointType, Motion
from anymesh.types.triangles import face_cross, unshared

POINTS = 3000  # samples of the part's surface
OPPOSED = np.cos(np.deg2rad(15))  # cosine; two faces within this angle of opposite can be grasped
THIN = 0.002  # [m] thinner objects are not grasped
ROOM = 0.006  # [m] of the stroke reserved for clearance when the open fingers pass the grasped place
APPROACH_ANGLES = 12  # approach directions per pair of faces
ROLLS = 4  # rotations of the closed hand about the pressing direction
TILTS = np.deg2rad([0, 20, -20, 40, -40])  # of the pressing direction against the part's motion
FACING = np.cos(np.deg2rad(25))  # cosine; a face within this angle of the motion can be pressed
EPS = 1e-5  # [m] offset of rays from their surface
KEPT, POOL = 250, 2500  # targets returned by default, and number of the best from which they are chosen
APART, TURNED = 0.015, np.cos(np.deg2rad(25))  # [m], cosine; targets closer than both are duplicates


@dataclass(frozen=True)
class HandRoom:
    """Room that a hand needs, by default that of the robots' [m].

    finger, tip: half thickness and half width of a finger; palm: half sizes of the palm across; back: from the palm to the
    grasped place; corridor: free length behind the palm.
    """

    finger: float = 0.013
    tip: float = 0.008
    palm: tuple[float, float] = (0.03, 0.08)
    back: float = 0.034
    corridor: float = 0.35


@dataclass(frozen=True, eq=False)
class PartSurfaces(Brief):
    """Surfaces of the part and of the rest of the object at rest: (n, 3, 3) and (m, 3, 3) [m]; and the room of the hand."""

    part: Float[np.ndarray, "n 3 3"]
    others: Float[np.ndarray, "m 3 3"]
    hand: HandRoom = HandRoom()

    @cached_property
    def scene(self) -> RayScene:
        """Ray casting scene of both surfaces; the part's faces come first."""
        return RayScene(*unshared(np.concatenate([self.part, self.others])))

    @cached_property
    def part_normals(self) -> Float[np.ndarray, "n 3"]:
        """Unit normals of the part's faces; zero for faces without area."""
        cross = face_cross(self.part)
        return cross / np.maximum(np.linalg.norm(cross, axis=1, keepdims=True), 1e-12)


def sample_targets(
    surfaces: PartSurfaces,
    motion: Motion,
    value: float,
    stroke: float,
    seed: int,
    contacts: tuple[GripperContact, ...],
    count: int = KEPT,
) -> list[Target]:
    """Return targets of the requested kinds, the most promising first.

    value: of the joint to reach from rest [rad or m], whose sign gives the direction; stroke: of the gripper [m]; count: the
    largest number of targets.
    """
    rng = np.random.default_rng(seed)
    points, normals = sample_surface(surfaces.part, rng)
    targets: list[Target] = []
    if GripperContact.GRASP in contacts:
        targets += _grasps(surfaces, points, normals, motion, value, stroke)
    if GripperContact.PUSH in contacts:
        targets += _pushes(surfaces, points, normals, motion, value)
    first = {kind: k for k, kind in enumerate(contacts)}
    return sorted(unlike(targets, count), key=lambda t: (first[t.contact], -t.score))


def sample_surface(
    triangles: np.ndarray, rng: np.random.Generator
) -> tuple[Float[np.ndarray, "n 3"], Float[np.ndarray, "n 3"]]:
    """Sample points on a surface; return them with its normals."""
    cross = face_cross(triangles)
    area = np.linalg.norm(cross, axis=1)
    chosen = rng.choice(len(triangles), POINTS, p=area / area.sum())
    u, v = rng.random((2, POINTS, 1))
    over = (u + v) > 1
    u, v = np.where(over, 1 - u, u), np.where(over, 1 - v, v)
    a, b, c = (triangles[chosen, k] for k in range(3))
    return a + u * (b - a) + v * (c - a), cross[chosen] / area[chosen, None]


def velocity(motion: Motion, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Return the velocity of points of the part per unit of the joint's value, [m] per radian or metre."""
    if motion.kind is JointType.PRISMATIC:
        return np.broadcast_to(motion.axis, points.shape).copy()
    return np.cross(motion.axis, points - motion.origin)


def frames(y: np.ndarray, z: np.ndarray, origin: np.ndarray) -> Float[np.ndarray, "n 4 4"]:
    T = np.tile(np.eye(4), (len(y), 1, 1))
    T[:, :3, :3] = np.stack([np.cross(y, z), y, z], -1)
    T[:, :3, 3] = origin
    return T


def across(v: np.ndarray) -> np.ndarray:
    """Return a unit vector perpendicular to each input vector."""
    helper = np.where(np.abs(v[:, 2:3]) < 0.9, [[0.0, 0, 1]], [[1.0, 0, 0]])
    cross = np.cross(v, helper)
    return cross / np.linalg.norm(cross, axis=1, keepdims=True)


def _grasps(
    surfaces: PartSurfaces, points: np.ndarray, normals: np.ndarray, motion: Motion, value: float, stroke: float
) -> list[Target]:
    """Return grasps of two opposite faces of the part, approached from directions with free space."""
    hits = surfaces.scene.first_hit(points - EPS * normals, -normals)
    width = hits.distance + EPS
    mine = (hits.face >= 0) & (hits.face < len(surfaces.part))
    ok = np.flatnonzero(mine & (width > THIN) & (width < stroke - ROOM))
    far = surfaces.part_normals[hits.face[ok]]
    ok = ok[np.einsum("ij,ij->i", far, normals[ok]) < -OPPOSED]
    if len(ok) == 0:
        return []
    y, w, middle = normals[ok], width[ok], points[ok] - normals[ok] * width[ok, None] / 2
    side = across(y)
    other = np.cross(y, side)
    angle = np.arange(APPROACH_ANGLES) * 2 * np.pi / APPROACH_ANGLES
    z = np.cos(angle)[:, None, None] * side + np.sin(angle)[:, None, None] * other  # (APPROACH_ANGLES, k, 3)
    z, y, middle, w = (
        z.reshape(-1, 3),
        np.tile(y, (APPROACH_ANGLES, 1)),
        np.tile(middle, (APPROACH_ANGLES, 1)),
        np.tile(w, APPROACH_ANGLES),
    )
    T = frames(y, z, middle)
    free = room(surfaces, T, w)
    T, w, y, z, middle = T[free], w[free], y[free], z[free], middle[free]
    if len(T) == 0:
        return []
    speed = velocity(motion, middle) * np.sign(value)
    length = np.linalg.norm(speed, axis=1)
    along = np.abs(np.einsum("ij,ij->i", y, speed)) / np.maximum(length, 1e-9)
    lever = length / max(float(length.max()), 1e-9)
    score = lever + 0.3 * along - 0.3 * np.maximum(z[:, 2], 0) - 2.0 * w
    return [Target(GripperContact.GRASP, t, float(a), float(s)) for t, a, s in zip(T, w, score, strict=True)]


def _pushes(surfaces: PartSurfaces, points: np.ndarray, normals: np.ndarray, motion: Motion, value: float) -> list[Target]:
    """Return places where the closed fingers can press in the direction of the motion."""
    speed = velocity(motion, points) * np.sign(value)
    length = np.linalg.norm(speed, axis=1)
    way = speed / np.maximum(length, 1e-9)[:, None]
    ok = np.flatnonzero((np.einsum("ij,ij->i", normals, way) < -FACING) & (length > 1e-9))
    if len(ok) == 0:
        return []
    ok = ok[:: max(1, len(ok) // 150)]
    center = points[ok].mean(0)
    spread = max(float(np.linalg.norm(points[ok] - center, axis=1).max()), 1e-6)
    near = 1 - np.linalg.norm(points[ok] - center, axis=1) / spread
    lever = length[ok] / max(float(length[ok].max()), 1e-9)
    targets = []
    for tilt in TILTS:
        for roll in np.arange(ROLLS) * np.pi / ROLLS:
            side = across(way[ok])
            up = np.cross(side, way[ok])  # `side` is horizontal, so a tilt moves the hand up or down
            z = np.cos(tilt) * way[ok] + np.sin(tilt) * up
            flat = np.cross(z, side)
            y = np.cos(roll) * side + np.sin(roll) * flat
            T = frames(y, z, points[ok])
            T, seen = _first_touch(surfaces, T)
            free = seen & room(surfaces, T, np.zeros(len(T)))
            score = lever + near - 0.5 * abs(tilt) - 0.3 * np.maximum(z[:, 2], 0)
            targets += [Target(GripperContact.PUSH, T[k], 0.0, float(score[k])) for k in np.flatnonzero(free)]
    return targets


def _first_touch(
    surfaces: PartSurfaces, T: Float[np.ndarray, "n 4 4"]
) -> tuple[Float[np.ndarray, "n 4 4"], Bool[np.ndarray, " n"]]:
    """Move targets along their z until the first ray of the fingertips meets the part; False if it meets another surface."""
    tip = surfaces.hand.tip
    grid = np.array([(x, y) for x in (-tip, 0.0, tip) for y in (-tip, 0.0, tip)])
    back = 0.05
    own = np.concatenate([grid, np.full((len(grid), 1), -back)], 1)
    starts = np.einsum("nij,kj->nki", T[:, :3, :3], own) + T[:, None, :3, 3]
    ways = np.repeat(T[:, None, :3, 2], len(grid), 1)
    hits = surfaces.scene.first_hit(starts.reshape(-1, 3), ways.reshape(-1, 3))
    distance = hits.distance.reshape(len(T), -1)
    first = distance.argmin(1)
    at = distance[np.arange(len(T)), first]
    face = hits.face.reshape(len(T), -1)[np.arange(len(T)), first]
    moved = T.copy()
    ok = np.isfinite(at) & (face >= 0) & (face < len(surfaces.part)) & (at > 0.02)
    moved[ok, :3, 3] += (at[ok] - back)[:, None] * T[ok, :3, 2]
    return moved, ok


def room(surfaces: PartSurfaces, T: Float[np.ndarray, "n 4 4"], width: Float[np.ndarray, " n"]) -> Bool[np.ndarray, " n"]:
    """Return whether the fingers and the palm fit along the approach."""
    if len(T) == 0:
        return np.zeros(0, bool)
    rows, hand = [], surfaces.hand
    for side in (-1, 1):
        for x in (-hand.tip, hand.tip):
            own = np.zeros((len(T), 3))
            own[:, 0], own[:, 1] = x, side * (width / 2 + np.where(width > 0, hand.finger, hand.tip))
            own[:, 2] = np.where(width > 0, 0.006, -0.002)
            rows.append(own)
    for x in (-hand.palm[0], 0.0, hand.palm[0]):
        rows += [np.tile([x, y, -hand.back], (len(T), 1)) for y in np.linspace(-hand.palm[1], hand.palm[1], 5)]
    own = np.stack(rows, 1)
    starts = np.einsum("nij,nkj->nki", T[:, :3, :3], own) + T[:, None, :3, 3]
    ways = np.repeat(-T[:, None, :3, 2], len(rows), 1)
    hits = surfaces.scene.first_hit(starts.reshape(-1, 3), ways.reshape(-1, 3))
    return np.asarray(hits.distance.reshape(len(T), -1).min(1) > hand.corridor)


def unlike(targets: list[Target], count: int) -> list[Target]:
    """Return targets without near duplicates, keeping the best of each group."""
    pool = sorted(targets, key=lambda t: -t.score)[:POOL]
    T = np.stack([t.T_asset_tool for t in pool]) if pool else np.zeros((0, 4, 4))
    pushes = np.array([t.contact is GripperContact.PUSH for t in pool])
    kept: list[int] = []
    for k in range(len(pool)):
        if len(kept) >= count:
            break
        alike = pushes[kept] == pushes[k]
        alike &= np.linalg.norm(T[kept, :3, 3] - T[k, :3, 3], axis=1) < APART
        alike &= T[kept, :3, 2] @ T[k, :3, 2] > TURNED
        alike &= np.abs(T[kept, :3, 1] @ T[k, :3, 1]) > TURNED
        if not alike.any():
            kept.append(k)
    return [pool[k] for k in kept]
