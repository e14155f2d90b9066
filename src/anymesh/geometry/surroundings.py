"""One part among the others: its core box, the way out, its handle, its connecting area."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import KDTree

from anymesh.config import ArticulationConfig
from anymesh.geometry.boxes import Box, box_in_frame
from anymesh.geometry.circles import Outline, roundest
from anymesh.geometry.contact import connecting_area
from anymesh.geometry.pieces import ObjectShape
from anymesh.geometry.shape import Shape
from anymesh.geometry.sweep import Obstacles
from anymesh.geometry.topology import label_connected
from anymesh.types import Handle

LEVEL = 0.12  # share of the surface facing a side that makes up the side's level
MOST_OUT = 0.25  # what sticks out is less than this share of the surface
CARVED = 10.0  # slack from which the rest is taken as if room for the part were yet to be carved out of it
DOWN = 0.4  # what being open below is worth less: most things stand on something
FACES = 0.5  # cosine from which a surface faces a direction
FREE = 0.01  # of the scale: what is nearer to the parent is no tab, but a hinge's barrel
BULGE = 0.25  # of a grip's height: around a grip the face is lower, around the top of a face that bulges it is not
TOUCHES = 0.002  # of the scale: what is nearer to the parent is no grip, but what holds the part
GRIP = 0.3  # a grip stands out by this share of its smaller width at least
LEAST_SCALE = 1e-9  # of the diagonal: a part that is a point has tolerances too
STAND_OUT = 0.012  # a handle stands out by this share of the part's diagonal at least


def core_box(shape: Shape) -> Box:
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
            level = at[-1 - min(int(LEVEL * len(at)), len(at) - 1)]
            out = sign * local[:, axis] > level + slack / 2
            if level < sign * edge[axis] - slack and _sticks_out(local, out, axis):
                edge[axis] = sign * level
    if (high - low < 1e-9).any():
        return shape.box
    ends = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    return box_in_frame(ends @ frame, frame)


def _sticks_out(local: np.ndarray, out: np.ndarray, axis: int) -> bool:
    """Whether samples beyond a level are a grip or the like: few, and narrower than the part in one direction."""
    if not 0 < out.mean() < MOST_OUT:
        return False
    others = [k for k in range(3) if k != axis]
    span = np.ptp(local[out][:, others], axis=0) / np.maximum(np.ptp(local[:, others], axis=0), 1e-12)
    return bool(span.min() < 0.6)


@dataclass(frozen=True, eq=False)
class Surroundings:
    """A part (with all that moves along with it), what it could hit, its parent and the other movable parts.

    diagonal: of the whole object [m]; center: of the whole object's box.
    """

    part: Shape
    parent: Shape
    rest: Shape  # everything that stands still while the part moves
    others: Shape | None  # the other movable parts
    everything: Shape  # all of the object but the part
    slim: tuple[Shape, ...]  # small round rods where part and parent meet (see `rods`)
    diagonal: float
    center: Float[np.ndarray, " 3"]
    config: ArticulationConfig
    siblings: tuple[Shape, ...] = ()  # the other movable parts, each by itself
    agreed: Float[np.ndarray, " 3"] | None = None  # the way out that it shares with its copies

    @cached_property
    def bounds(self) -> Float[np.ndarray, "2 3"]:
        """Of the whole object [m]."""
        both = np.array([self.part.bounds, self.everything.bounds])
        return np.array([both[:, 0].min(0), both[:, 1].max(0)])

    @cached_property
    def core(self) -> Box:
        """The part's box without what stands out of it."""
        return core_box(self.part)

    @cached_property
    def scale(self) -> float:
        """The length that tolerances are shares of [m]: the object's diagonal, less for a part that is small in it."""
        return max(min(self.diagonal, 5 * self.part.box.diagonal), LEAST_SCALE * self.diagonal)

    @cached_property
    def buried(self) -> float:
        """How deep the part lies in the parent along the way out, over its smallest side across."""
        across = [float(np.ptp(self.part.corners @ a)) for a in self.core.axes if abs(a @ self.outward) < 0.7]
        return self.inside_depth(self.outward) / max(min(across, default=1.0), 1e-9)

    def inside_depth(self, direction: Float[np.ndarray, " 3"]) -> float:
        """How deep the part reaches into the parent against `direction` [m]: its extent between the parent's bounds."""
        along = self.part.samples.points @ direction
        parent = self.parent.samples.points @ direction
        low, high = np.percentile(along, 0.5), np.percentile(along, 99.5)
        return float(max(0.0, min(high, parent.max()) - max(low, parent.min())))

    def obstacles(self, slack: float = 1.0) -> Obstacles:
        """What the part could hit. slack: factor on the penetration that counts, for a part that is stuck in the rest; CARVED
        or more: where the part lies, the rest makes room."""
        if slack not in self._obstacles:
            hole = self.core if slack >= CARVED else None
            self._obstacles[slack] = Obstacles(self.part, self.rest, slack * self.penetration, hole)
        return self._obstacles[slack]

    @cached_property
    def _obstacles(self) -> dict[float, Obstacles]:
        return {}

    @cached_property
    def penetration(self) -> float:
        """How far a path may go behind a surface before it is stopped [m]."""
        return self.config.penetration * self.scale

    @cached_property
    def held_by(self) -> Obstacles:
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
        faces = np.flatnonzero(np.where(solid, facing, np.abs(facing)) > FACES)
        points = self.part.samples.points[faces] if len(faces) > 0.02 * len(facing) else self.part.samples.points
        return float(self._sees(points[:: max(1, len(points) // 500)], direction).mean())

    @cached_property
    def ways_out(self) -> tuple[Float[np.ndarray, "6 3"], Float[np.ndarray, " 6"]]:
        """The core box's directions both ways, and how much each looks like the way out: open, thin, away from the middle."""
        ways, worth = [], []
        away = self.part.samples.points.mean(0) - self.center
        for k, axis in enumerate(self.core.axes):
            for sign in (1.0, -1.0):
                seen = self._open_face(sign * axis)
                facing = self.core.half[2] / max(self.core.half[k], 1e-12)
                score = seen + 0.5 * facing + 0.3 * sign * float(axis @ away) / self.diagonal
                ways.append(sign * axis)
                worth.append(score - DOWN * max(0.0, -sign * float(axis[2])))
        return np.array(ways), np.array(worth)

    @cached_property
    def outward(self) -> Float[np.ndarray, " 3"]:
        """The way out of the object, unit, among the core box's directions: the thin one unless another is far more open."""
        if self.agreed is not None:
            return self.agreed
        ways, worth = self.ways_out
        return ways[int(np.flatnonzero(worth > worth.max() - 1e-9)[0])]

    @cached_property
    def openness(self) -> float:
        """Share of the part that sees the outside along the way out."""
        return float(self.sees_outside(self.outward).mean())

    @cached_property
    def handle(self) -> Handle | None:
        """What stands out of the part's outer face the furthest, if it is small against the face, no mere raised panel, and
        in one or two places: more are controls. Where nothing does, a tab that stands out of one rim into the air.
        """
        return self._face_handle() or self._tab()

    def _tab(self) -> Handle | None:
        face, core = self.face_axes, self.core
        local = core.local(self.part.samples.points)
        found = []
        for row, k in enumerate(face):
            for sign in (-1.0, 1.0):
                out = sign * local[:, k] > core.half[k] + STAND_OUT * core.diagonal
                if out.sum() < 3 or out.mean() > MOST_OUT or float(np.median(self.gap[out])) < FREE * self.scale:
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
        k = int(np.abs(self.core.axes @ self.outward).argmax())
        sign = np.sign(self.core.axes[k] @ self.outward)
        local = self.core.local(self.part.samples.points)
        above = sign * local[:, k] - self.core.half[k]
        height = float(above.max())
        out = above > max(STAND_OUT * self.core.diagonal, height / 2)
        if out.sum() < 3 or out.mean() > 0.45 or float(np.quantile(self.gap[out], 0.1)) < TOUCHES * self.scale:
            return None
        face = [i for i in range(3) if i != k]
        at = local[out][:, face]
        spacing = np.sqrt(self.part.area / len(local))
        groups = label_connected(
            len(at), KDTree(at).query_pairs(max(0.03 * self.core.diagonal, 6 * spacing), output_type="ndarray")
        )
        if groups.max() > 1:
            return None
        low, high = at.min(0), at.max(0)
        size = high - low
        margin = max(height, 2 * spacing)
        around = ((local[:, face] > low - margin) & (local[:, face] < high + margin)).all(1)
        around &= ~((local[:, face] >= low) & (local[:, face] <= high)).all(1)
        around &= self.part.samples.normals @ self.outward > FACES
        if around.any() and (above[around] > BULGE * height).mean() > 0.5:
            return None
        middle = (low + high) / 2 / np.maximum(self.core.half[face], 1e-9)
        along = None if size.max() < 1.6 * size.min() + 1e-9 else int(size.argmax())
        if (size > 1.7 * self.core.half[face]).all() or height < GRIP * size.min():
            return None
        return Handle(
            (float(np.clip(middle[0], -1, 1)), float(np.clip(middle[1], -1, 1))),
            along,
            float(size.max() / self.core.diagonal),
        )

    @cached_property
    def face_axes(self) -> list[int]:
        """The two core axes that span the part's outer face, in the order that Handle.across uses."""
        k = int(np.abs(self.core.axes @ self.outward).argmax())
        return [i for i in range(3) if i != k]


def rods(whole: ObjectShape, part: Shape, parent: Shape) -> tuple[Shape, ...]:
    """Components that are long, thin and small against the part, and near both it and its parent: they may be barrels."""
    diagonal = part.box.diagonal
    reach = 0.015 * min(whole.diagonal, 5 * diagonal)
    label = whole.piece
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
