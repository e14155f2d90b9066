"""One part among the others: its core box, the way out, its handle, its connecting area."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import KDTree

from anymesh.config import ArticulationConfig
from anymesh.geometry.boxes import OrientedBox, box_in_frame
from anymesh.geometry.circles import Outline, roundest
from anymesh.geometry.contact import connecting_area
from anymesh.geometry.pieces import ObjectShape
from anymesh.geometry.shape import FaceSet
from anymesh.geometry.sweep import Obstacles
from anymesh.geometry.topology import label_connected
from anymesh.types import Handle

SIDE_LEVEL_RATIO = 0.12  # share of the surface facing a side that makes up the side's level
MAX_PROTRUSION_RATIO = 0.25  # what sticks out is less than this share of the surface
IGNORE_OVERLAP_SCALE = 10.0  # slack from which the rest is taken as if room for the part were yet to be carved out of it
DOWNWARD_PENALTY = 0.4  # what being open below is worth less: most things stand on something
FACING_COSINE = 0.5  # cosine from which a surface faces a direction
MIN_TAB_GAP_RATIO = 0.01  # of the scale: what is nearer to the parent is no tab, but a hinge's barrel
MAX_BULGE_RATIO = 0.25  # of a grip's height: around a grip the face is lower, around the top of a face that bulges it is not
MIN_HANDLE_GAP_RATIO = 0.002  # of the scale: what is nearer to the parent is no grip, but what holds the part
MIN_HANDLE_ASPECT = 0.3  # a grip stands out by this share of its smaller width at least
MIN_SCALE_RATIO = 1e-9  # of the diagonal: a part that is a point has tolerances too
MIN_HANDLE_HEIGHT_RATIO = 0.012  # a handle stands out by this share of the part's diagonal at least


def body_obb(shape: FaceSet) -> OrientedBox:
    """The box of a part without what sticks out of it: a small share of its surface, less wide than the part."""
    frame = shape.box.axes
    local = shape.samples.points @ frame.T
    facing = np.abs(shape.samples.normals @ frame.T) > 0.9
    corners = shape.corners @ frame.T
    low, high = corners.min(0), corners.max(0)
    slack = 0.01 * shape.box.diagonal
    for axis in range(3):
        for sign, edge in ((1.0, high), (-1.0, low)):
            at = np.sort(sign * local[facing[:, axis], axis])
            if len(at) < 0.02 * len(local) or len(at) < 3:
                continue
            level = at[-1 - min(int(SIDE_LEVEL_RATIO * len(at)), len(at) - 1)]
            out = sign * local[:, axis] > level + slack / 2
            if level < sign * edge[axis] - slack and _protrudes(local, out, axis):
                edge[axis] = sign * level
    if (high - low < 1e-9).any():
        return shape.box
    ends = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    return box_in_frame(ends @ frame, frame)


def _protrudes(local: np.ndarray, beyond: np.ndarray, axis: int) -> bool:
    """Whether samples beyond a level are a grip or the like: few, and narrower than the part in one direction."""
    if not 0 < beyond.mean() < MAX_PROTRUSION_RATIO:
        return False
    others = [k for k in range(3) if k != axis]
    span = np.ptp(local[beyond][:, others], axis=0) / np.maximum(np.ptp(local[:, others], axis=0), 1e-12)
    return bool(span.min() < 0.6)


@dataclass(frozen=True, eq=False)
class PartContext:
    """A part (with all that moves along with it), what it could hit, its parent and the other movable parts.

    diagonal: of the whole object [m]; center: of the whole object's box.
    """

    part: FaceSet
    parent: FaceSet
    rest: FaceSet  # everything that stands still while the part moves
    others: FaceSet | None  # the other movable parts
    everything: FaceSet  # all of the object but the part
    barrel_candidates: tuple[FaceSet, ...]  # small round rods where part and parent meet (see `rods`)
    diagonal: float
    center: Float[np.ndarray, " 3"]
    config: ArticulationConfig
    siblings: tuple[FaceSet, ...] = ()  # the other movable parts, each by itself
    shared_opening_direction: Float[np.ndarray, " 3"] | None = None  # the way out that it shares with its copies

    @cached_property
    def bounds(self) -> Float[np.ndarray, "2 3"]:
        """Of the whole object [m]."""
        both = np.array([self.part.bounds, self.everything.bounds])
        return np.array([both[:, 0].min(0), both[:, 1].max(0)])

    @cached_property
    def body_obb(self) -> OrientedBox:
        """The part's box without what stands out of it."""
        return body_obb(self.part)

    @cached_property
    def scale(self) -> float:
        """The length that tolerances are shares of [m]: the object's diagonal, less for a part that is small in it."""
        return max(min(self.diagonal, 5 * self.part.box.diagonal), MIN_SCALE_RATIO * self.diagonal)

    @cached_property
    def insertion_depth(self) -> float:
        """How deep the part lies in the parent along the way out, over its smallest side across."""
        across = [float(np.ptp(self.part.corners @ a)) for a in self.body_obb.axes if abs(a @ self.opening_direction) < 0.7]
        return self.depth_in_parent(self.opening_direction) / max(min(across, default=1.0), 1e-9)

    def depth_in_parent(self, direction: Float[np.ndarray, " 3"]) -> float:
        """How deep the part reaches into the parent against `direction` [m]: its extent between the parent's bounds."""
        along = self.part.samples.points @ direction
        parent = self.parent.samples.points @ direction
        low, high = np.percentile(along, 0.5), np.percentile(along, 99.5)
        return float(max(0.0, min(high, parent.max()) - max(low, parent.min())))

    def obstacles(self, penetration_scale: float = 1.0) -> Obstacles:
        """What the part could hit. slack: factor on the penetration that counts, for a part that is stuck in the rest; CARVED
        or more: where the part lies, the rest makes room."""
        if penetration_scale not in self._obstacles:
            hole = self.body_obb if penetration_scale >= IGNORE_OVERLAP_SCALE else None
            self._obstacles[penetration_scale] = Obstacles(self.part, self.rest, penetration_scale * self.penetration, hole)
        return self._obstacles[penetration_scale]

    @cached_property
    def _obstacles(self) -> dict[float, Obstacles]:
        return {}

    @cached_property
    def penetration(self) -> float:
        """How far a path may go behind a surface before it is stopped [m]."""
        return self.config.penetration * self.scale

    @cached_property
    def obstacles_at_rest(self) -> Obstacles:
        """The same with the other movable parts at rest: what keeps the part from moving sideways."""
        return Obstacles(self.part, self.everything, self.penetration)

    @cached_property
    def outline(self) -> Outline:
        """The roundest outline of the part, seen along its box's axes."""
        points = np.concatenate([self.part.corners, self.part.samples.points])
        return roundest(points, self.part.box.axes[::-1])

    @cached_property
    def nearest(self) -> tuple[Float[np.ndarray, " n"], Int[np.ndarray, " n"]]:
        """Distance of each sample of the part to the parent [m], and the nearest face of the parent."""
        distance, face, _ = self.parent.tree.nearest(self.part.samples.points)
        return distance, face

    @property
    def gap(self) -> Float[np.ndarray, " n"]:
        """Distance of each sample of the part to the parent [m]."""
        return self.nearest[0]

    @cached_property
    def contact(self) -> Float[np.ndarray, "n 3"]:
        """Points of the connecting area, of both (paper, 3.3) [m].

        Measured to the other's surface rather than to its samples: on a large parent these may all lie apart from a small part.
        """
        theirs = self.parent.samples.points
        off = self.part.tree.distance(theirs)
        near, far, _ = connecting_area(self.gap, off, self.config.connecting * max(self.scale, 1e-3 * self.diagonal))
        return np.concatenate([self.part.samples.points[near], theirs[far]])

    def sees_outside(self, direction: Float[np.ndarray, " 3"]) -> Bool[np.ndarray, " n"]:
        """Which samples of the part see no other surface of the object along `direction`."""
        return self._sees(self.part.samples.points[::6], direction)

    def _sees(self, points: np.ndarray, direction: np.ndarray) -> np.ndarray:
        start = points + 1e-4 * self.diagonal * direction
        rays = np.repeat(direction[None] * 4 * self.diagonal, len(start), 0)
        return self.rest.scene.first_hit(start, rays, 1.0).face < 0

    def _open_face(self, direction: np.ndarray) -> float:
        """Share that sees the outside along `direction` of the surface that faces it, or of all where hardly any does."""
        facing = self.part.samples.normals @ direction
        solid = self.part.solid[self.part.samples.faces]
        faces = np.flatnonzero(np.where(solid, facing, np.abs(facing)) > FACING_COSINE)
        points = self.part.samples.points[faces] if len(faces) > 0.02 * len(facing) else self.part.samples.points
        return float(self._sees(points[:: max(1, len(points) // 500)], direction).mean())

    @cached_property
    def opening_directions(self) -> tuple[Float[np.ndarray, "6 3"], Float[np.ndarray, " 6"]]:
        """The core box's directions both ways, and how much each looks like the way out: open, thin, away from the middle."""
        ways, worth = [], []
        away = self.part.samples.points.mean(0) - self.center
        for k, axis in enumerate(self.body_obb.axes):
            for sign in (1.0, -1.0):
                seen = self._open_face(sign * axis)
                facing = self.body_obb.half[2] / max(self.body_obb.half[k], 1e-12)
                score = seen + 0.5 * facing + 0.3 * sign * float(axis @ away) / self.diagonal
                ways.append(sign * axis)
                worth.append(score - DOWNWARD_PENALTY * max(0.0, -sign * float(axis[2])))
        return np.array(ways), np.array(worth)

    @cached_property
    def opening_direction(self) -> Float[np.ndarray, " 3"]:
        """The way out of the object, unit, among the core box's directions: the thin one unless another is far more open."""
        if self.shared_opening_direction is not None:
            return self.shared_opening_direction
        ways, worth = self.opening_directions
        return ways[int(np.flatnonzero(worth > worth.max() - 1e-9)[0])]

    @cached_property
    def visibility(self) -> float:
        """Share of the part that sees the outside along the way out."""
        return float(self.sees_outside(self.opening_direction).mean())

    @cached_property
    def handle(self) -> Handle | None:
        """What stands out of the part's outer face the furthest, if it is small against the face, no mere raised panel, and
        in one or two places: more are controls. Where nothing does, a tab that stands out of one rim into the air.
        """
        return self._face_handle() or self._tab()

    def _tab(self) -> Handle | None:
        face, core = self.face_axes, self.body_obb
        local = core.local(self.part.samples.points)
        found = []
        for row, k in enumerate(face):
            for sign in (-1.0, 1.0):
                out = sign * local[:, k] > core.half[k] + MIN_HANDLE_HEIGHT_RATIO * core.diagonal
                if (
                    out.sum() < 3
                    or out.mean() > MAX_PROTRUSION_RATIO
                    or float(np.median(self.gap[out])) < MIN_TAB_GAP_RATIO * self.scale
                ):
                    continue
                along, half = local[out][:, face[1 - row]], max(float(core.half[face[1 - row]]), 1e-9)
                if np.ptp(along) < half:  # half of the rim; what is wider is a ledge
                    found.append((row, sign, float(along.mean()) / half, out))
        if len(found) != 1:
            return None
        row, sign, level, out = found[0]
        across = [sign, float(np.clip(level, -1, 1))]
        size = float(np.ptp(local[out][:, face], axis=0).max() / core.diagonal)
        return Handle((across[0], across[1]) if row == 0 else (across[1], across[0]), None, size)

    def _face_handle(self) -> Handle | None:
        k = int(np.abs(self.body_obb.axes @ self.opening_direction).argmax())
        sign = np.sign(self.body_obb.axes[k] @ self.opening_direction)
        local = self.body_obb.local(self.part.samples.points)
        above = sign * local[:, k] - self.body_obb.half[k]
        height = float(above.max())
        out = above > max(MIN_HANDLE_HEIGHT_RATIO * self.body_obb.diagonal, height / 2)
        if out.sum() < 3 or out.mean() > 0.45 or float(np.quantile(self.gap[out], 0.1)) < MIN_HANDLE_GAP_RATIO * self.scale:
            return None
        face = [i for i in range(3) if i != k]
        at = local[out][:, face]
        spacing = np.sqrt(self.part.area / len(local))
        groups = label_connected(
            len(at), KDTree(at).query_pairs(max(0.03 * self.body_obb.diagonal, 6 * spacing), output_type="ndarray")
        )
        if groups.max() > 1:
            return None
        low, high = at.min(0), at.max(0)
        size = high - low
        margin = max(height, 2 * spacing)
        around = ((local[:, face] > low - margin) & (local[:, face] < high + margin)).all(1)
        around &= ~((local[:, face] >= low) & (local[:, face] <= high)).all(1)
        around &= self.part.samples.normals @ self.opening_direction > FACING_COSINE
        if around.any() and (above[around] > MAX_BULGE_RATIO * height).mean() > 0.5:
            return None
        middle = (low + high) / 2 / np.maximum(self.body_obb.half[face], 1e-9)
        along = None if size.max() < 1.6 * size.min() + 1e-9 else int(size.argmax())
        if (size > 1.7 * self.body_obb.half[face]).all() or height < MIN_HANDLE_ASPECT * size.min():
            return None
        return Handle(
            (float(np.clip(middle[0], -1, 1)), float(np.clip(middle[1], -1, 1))),
            along,
            float(size.max() / self.body_obb.diagonal),
        )

    @cached_property
    def face_axes(self) -> list[int]:
        """The two core axes that span the part's outer face, in the order that Handle.across uses."""
        k = int(np.abs(self.body_obb.axes @ self.opening_direction).argmax())
        return [i for i in range(3) if i != k]


def find_barrel_candidates(whole: ObjectShape, part: FaceSet, parent: FaceSet) -> tuple[FaceSet, ...]:
    """Components that are long, thin and small against the part, and near both it and its parent: they may be barrels."""
    diagonal = part.box.diagonal
    reach = 0.015 * min(whole.diagonal, 5 * diagonal)
    label = whole.patch
    found = []
    for own, other in ((part, parent), (parent, part)):
        low, high = other.bounds[0] - reach, other.bounds[1] + reach
        center = own.triangles.mean(1)
        near = ((center > low) & (center < high)).all(1)
        candidates, count = np.unique(label[own.faces[near]], return_counts=True)
        for c in candidates[count >= 6][:60]:
            mine = own.take(label[own.faces] == c)
            half = mine.box.half
            if 2 * half[0] > 1.1 * diagonal or half[1] > 0.05 * diagonal or half[2] < 0.7 * half[1] or half[0] < 1.5 * half[1]:
                continue
            if other.tree.distance(mine.samples.points[::10]).min() < reach:
                found.append(mine)
    return tuple(found)
