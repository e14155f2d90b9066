"""Geometry of one part relative to the rest of the object: body OBB, opening direction, handle, connecting area."""

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
from anymesh.geometry.patches import ObjectShape
from anymesh.geometry.sweep import Obstacles
from anymesh.geometry.topology import label_connected
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.types import Handle

SIDE_LEVEL_RATIO = 0.12  # share of the surface facing a side that defines the level of that side
MAX_PROTRUSION_RATIO = 0.25  # upper bound on the share of the surface that protrudes
IGNORE_OVERLAP_SCALE = 10.0  # penetration scale from which static geometry inside the part's box is ignored
DOWNWARD_PENALTY = 0.4  # subtracted from the score of a downward direction, since most objects stand on something
FACING_COSINE = 0.5  # minimum cosine between a normal and the direction it faces
MIN_TAB_GAP_RATIO = 0.01  # of the scale: a tab that is closer to the parent is a hinge barrel
# of the handle's height: maximum height of the face around a handle; around the top of a bulge it is higher
MAX_BULGE_RATIO = 0.25
MIN_HANDLE_GAP_RATIO = 0.002  # of the scale: a protrusion closer to the parent supports the part and is no handle
MIN_HANDLE_ASPECT = 0.3  # minimum height of a handle over its smaller width
MIN_SCALE_RATIO = 1e-9  # of the diagonal: keeps tolerances positive for a part that is a point
MIN_HANDLE_HEIGHT_RATIO = 0.012  # minimum height of a handle over the part's diagonal


def body_obb(shape: TriangleSet) -> OrientedBox:
    """Return the oriented box of a part without protrusions: a small share of its surface, narrower than the part."""
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
    """Return whether the samples beyond a level are a protrusion: few, and narrower than the part in one direction."""
    if not 0 < beyond.mean() < MAX_PROTRUSION_RATIO:
        return False
    others = [k for k in range(3) if k != axis]
    span = np.ptp(local[beyond][:, others], axis=0) / np.maximum(np.ptp(local[:, others], axis=0), 1e-12)
    return bool(span.min() < 0.6)


@dataclass(frozen=True, eq=False)
class PartContext:
    """A part with everything it carries, the geometry that it could hit, its parent and the other movable parts.

    diagonal: of the object [m]; center: of the object's axis-aligned box [m].
    """

    part: TriangleSet
    parent: TriangleSet
    rest: TriangleSet  # static while the part moves
    others: TriangleSet | None  # the other movable parts
    everything: TriangleSet  # the object without the part
    barrel_candidates: tuple[TriangleSet, ...]  # see `find_barrel_candidates`
    diagonal: float
    center: Float[np.ndarray, " 3"]
    config: ArticulationConfig
    siblings: tuple[TriangleSet, ...] = ()  # the other movable parts, one each
    shared_opening_direction: Float[np.ndarray, " 3"] | None = None  # common to a row of repeated parts

    @cached_property
    def bounds(self) -> Float[np.ndarray, "2 3"]:
        """Return the axis-aligned bounds of the object [m]."""
        both = np.array([self.part.bounds, self.everything.bounds])
        return np.array([both[:, 0].min(0), both[:, 1].max(0)])

    @cached_property
    def body_obb(self) -> OrientedBox:
        """Return the oriented box of the part without protrusions."""
        return body_obb(self.part)

    @cached_property
    def scale(self) -> float:
        """Return the reference length of tolerances [m]: the object's diagonal, limited to five diagonals of the part."""
        return max(min(self.diagonal, 5 * self.part.box.diagonal), MIN_SCALE_RATIO * self.diagonal)

    @cached_property
    def insertion_depth(self) -> float:
        """Return the depth of the part inside its parent along the opening direction, over its smallest side across."""
        across = [float(np.ptp(self.part.corners @ a)) for a in self.body_obb.axes if abs(a @ self.opening_direction) < 0.7]
        return self.depth_in_parent(self.opening_direction) / max(min(across, default=1.0), 1e-9)

    def depth_in_parent(self, direction: Float[np.ndarray, " 3"]) -> float:
        """Return the depth of the part inside its parent along `direction` [m], measured between the parent's bounds."""
        along = self.part.samples.points @ direction
        parent = self.parent.samples.points @ direction
        low, high = np.percentile(along, 0.5), np.percentile(along, 99.5)
        return float(max(0.0, min(high, parent.max()) - max(low, parent.min())))

    def obstacles(self, penetration_scale: float = 1.0) -> Obstacles:
        """Return the obstacles of the part, cached per penetration scale.

        penetration_scale: factor on the tolerated penetration, for a part that overlaps static geometry. From
        IGNORE_OVERLAP_SCALE on, static geometry inside the part's box is ignored.
        """
        if penetration_scale not in self._obstacles:
            hole = self.body_obb if penetration_scale >= IGNORE_OVERLAP_SCALE else None
            self._obstacles[penetration_scale] = Obstacles(self.part, self.rest, penetration_scale * self.penetration, hole)
        return self._obstacles[penetration_scale]

    @cached_property
    def _obstacles(self) -> dict[float, Obstacles]:
        return {}

    @cached_property
    def penetration(self) -> float:
        """Return the penetration at which a path is stopped [m]."""
        return self.config.penetration * self.scale

    @cached_property
    def obstacles_at_rest(self) -> Obstacles:
        """Return the obstacles with the other movable parts at rest, which guide a part sideways."""
        return Obstacles(self.part, self.everything, self.penetration)

    @cached_property
    def outline(self) -> Outline:
        """Return the roundest outline of the part among those along its box axes."""
        points = np.concatenate([self.part.corners, self.part.samples.points])
        return roundest(points, self.part.box.axes[::-1])

    @cached_property
    def nearest(self) -> tuple[Float[np.ndarray, " n"], Int[np.ndarray, " n"]]:
        """Return the distance of each sample of the part to the parent [m], and the nearest face of the parent."""
        distance, face, _ = self.parent.tree.nearest(self.part.samples.points)
        return distance, face

    @property
    def gap(self) -> Float[np.ndarray, " n"]:
        """Return the distance of each sample of the part to the parent [m]."""
        return self.nearest[0]

    @cached_property
    def contact(self) -> Float[np.ndarray, "n 3"]:
        """Return the points of the connecting area on both surfaces (paper, 3.3) [m].

        Distances are measured to the surface and not to its samples, since those of a large parent may all be far from a small
        part.
        """
        theirs = self.parent.samples.points
        off = self.part.tree.distance(theirs)
        near, far, _ = connecting_area(self.gap, off, self.config.connecting * max(self.scale, 1e-3 * self.diagonal))
        return np.concatenate([self.part.samples.points[near], theirs[far]])

    def sees_outside(self, direction: Float[np.ndarray, " 3"]) -> Bool[np.ndarray, " n"]:
        """Return which samples of the part have a free line of sight along `direction`."""
        return self._sees(self.part.samples.points[::6], direction)

    def _sees(self, points: np.ndarray, direction: np.ndarray) -> np.ndarray:
        start = points + 1e-4 * self.diagonal * direction
        rays = np.repeat(direction[None] * 4 * self.diagonal, len(start), 0)
        return self.rest.scene.first_hit(start, rays, 1.0).face < 0

    def _open_face(self, direction: np.ndarray) -> float:
        """Return the visible share of the surface facing `direction`, or of the whole surface if hardly any faces it."""
        facing = self.part.samples.normals @ direction
        solid = self.part.solid[self.part.samples.faces]
        faces = np.flatnonzero(np.where(solid, facing, np.abs(facing)) > FACING_COSINE)
        points = self.part.samples.points[faces] if len(faces) > 0.02 * len(facing) else self.part.samples.points
        return float(self._sees(points[:: max(1, len(points) // 500)], direction).mean())

    @cached_property
    def opening_directions(self) -> tuple[Float[np.ndarray, "6 3"], Float[np.ndarray, " 6"]]:
        """Return both directions of each box axis, and their scores as opening direction.

        Visible, thin and off-center directions score higher.
        """
        directions, scores = [], []
        away = self.part.samples.points.mean(0) - self.center
        for k, axis in enumerate(self.body_obb.axes):
            for sign in (1.0, -1.0):
                seen = self._open_face(sign * axis)
                facing = self.body_obb.half[2] / max(self.body_obb.half[k], 1e-12)
                score = seen + 0.5 * facing + 0.3 * sign * float(axis @ away) / self.diagonal
                directions.append(sign * axis)
                scores.append(score - DOWNWARD_PENALTY * max(0.0, -sign * float(axis[2])))
        return np.array(directions), np.array(scores)

    @cached_property
    def opening_direction(self) -> Float[np.ndarray, " 3"]:
        """Return the opening direction, unit: the box direction with the highest score, or the shared one of its row."""
        if self.shared_opening_direction is not None:
            return self.shared_opening_direction
        directions, scores = self.opening_directions
        return directions[int(np.flatnonzero(scores > scores.max() - 1e-9)[0])]

    @cached_property
    def visibility(self) -> float:
        """Return the share of the part that is visible along the opening direction."""
        return float(self.sees_outside(self.opening_direction).mean())

    @cached_property
    def handle(self) -> Handle | None:
        """Find the handle: the highest protrusion of the outer face, or otherwise a tab at one rim.

        It must be small compared to the face, higher than a raised panel, and in one place. Several protrusions are controls.
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
                if np.ptp(along) < half:  # at most half of the rim; a wider one is a ledge
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
        """Return the two box axes that span the outer face, in the order of Handle.across."""
        k = int(np.abs(self.body_obb.axes @ self.opening_direction).argmax())
        return [i for i in range(3) if i != k]


def find_barrel_candidates(whole: ObjectShape, part: TriangleSet, parent: TriangleSet) -> tuple[TriangleSet, ...]:
    """Find connected components near both part and parent that are long, thin and small: possible hinge barrels."""
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
