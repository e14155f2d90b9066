"""Geometry of one part relative to the rest of the object: body OBB, opening direction, handle, connecting area.

Also the named features of its shape, place and handle that part candidates and the motions of parts share. Their lengths are
relative to the object's diagonal, and ratios of lengths are limited.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.config import ALONG_COSINE, FACING_COSINE
from anymesh.geometry.boxes import OrientedBox
from anymesh.geometry.circles import Outline, outline_about, roundest
from anymesh.geometry.surface import ObjectShape
from anymesh.geometry.sweep import Obstacles
from anymesh.geometry.triangle_set import SurfacePoints, TriangleSet, body_obb, quantile
from anymesh.motion.handle import face_axes, find_handle
from anymesh.types import Brief, Handle, JointType, Motion

# of the tolerance length: threshold of the connecting area; 0.01 for a diagonal of 2 (the paper's implementation)
CONNECTING_RATIO = 0.005
PENETRATION_RATIO = 0.003  # of the tolerance length: depth behind a surface at which a path is stopped
MIN_LEAD = 0.03  # of the score of a direction over that of the opposite one; less is chance
CENTRAL_RATIO = 1e-3  # of the diagonal: a part that is nearer to the object's middle along a direction is in the middle
DOWNWARD_PENALTY = 0.4  # subtracted from the score of a downward direction, since most objects stand on something
CONTACT_REACHES = (0.08, 0.2)  # of the link's diagonal: its contact with the parent is within this distance
MAX_SURFACE_POINTS = 400  # sample points of the surfaces in contact
MIN_ROUNDNESS = 0.5  # minimum roundness of the outline of a round part
MAX_PART_DIAGONALS = 5  # lengths are compared with the object's diagonal, but with at most this many diagonals of the part
MIN_OF_NODE = 0.6  # of the area of a part and its node together: least share in both for the pivot to be the part's
MIN_SCALE_RATIO = 1e-9  # of the diagonal: keeps tolerances positive for a part that is a point
MAX_LENGTH_RATIO = 4.0  # upper limit of ratios of lengths
MAX_HEIGHT_OVER_RADIUS = 8.0


def connecting_area(
    gap_a: Float[np.ndarray, " n"], gap_b: Float[np.ndarray, " m"], threshold: float
) -> tuple[Bool[np.ndarray, " n"], Bool[np.ndarray, " m"], float]:
    """Return the points of each part closer than `threshold` [m] to the other (paper, 3.3).

    The threshold is doubled until there is at least one point.

    gap_a, gap_b: distance of the points of each part to the other [m].

    Return both masks and the threshold used.
    """
    if threshold <= 0:
        raise ValueError(f"the threshold of a connecting area must be positive, found {threshold}")
    if not (np.isfinite(gap_a).any() or np.isfinite(gap_b).any()):
        raise ValueError("a connecting area needs points of both parts, found none")
    while not ((gap_a < threshold).any() or (gap_b < threshold).any()):
        threshold *= 2
    return gap_a < threshold, gap_b < threshold, threshold


def pivot_of(whole: ObjectShape, faces: Bool[np.ndarray, " R"]) -> Float[np.ndarray, " 3"] | None:
    """Return the pivot of the node that these faces of the object are, by most of the area of both; None without."""
    of_face, areas = whole.pivot, whole.shape.areas
    if of_face is None:
        return None
    pivots = np.unique(of_face[faces & np.isfinite(of_face[:, 0])], axis=0)
    nodes = [(of_face == pivot).all(1) for pivot in pivots]
    shares = (areas[node & faces].sum() / areas[node | faces].sum() for node in nodes)
    return next((pivot for pivot, share in zip(pivots, shares, strict=True) if share > MIN_OF_NODE), None)


def best_direction(scores: Float[np.ndarray, " 6"], outwards: Float[np.ndarray, " 6"]) -> int:
    """Return the opening direction of highest score; of two opposite ones that score about the same the outer one.

    scores: as from `PartContext.opening_directions`, in pairs of opposite directions; outwards: how far the part is off the
    object's middle along each, over the diagonal. Of a part in the middle the positive direction along the box axis.
    """
    best = int(scores.argmax())
    if scores[best ^ 1] <= scores[best] - MIN_LEAD:
        return best
    return best - best % 2 if abs(outwards[best]) < CENTRAL_RATIO else best ^ int(outwards[best] < 0)


@dataclass(frozen=True, eq=False)
class PartContext(Brief):
    """A part with everything it carries, the geometry that it could hit, its parent and the other movable parts.

    diagonal: of the object [m]; center: of the object's axis-aligned box [m].
    """

    part: TriangleSet
    parent: TriangleSet
    rest: TriangleSet  # static while the part moves
    other_surface: TriangleSet | None  # the other movable parts together
    without_part: TriangleSet  # the object without what moves
    barrel_candidates: tuple[TriangleSet, ...]  # long thin patches that may be hinge barrels
    diagonal: float
    center: Float[np.ndarray, " 3"]
    other_parts: tuple[TriangleSet, ...] = ()  # the other movable parts, one each
    shared_opening_direction: Float[np.ndarray, " 3"] | None = None  # common to a row of repeated parts
    link: TriangleSet | None = None  # the part without what hangs on it; None if nothing does
    pivot: Float[np.ndarray, " 3"] | None = None  # of the part's node in the file, None if it has none that tells [m]

    @cached_property
    def bounds(self) -> Float[np.ndarray, "2 3"]:
        """Return the axis-aligned bounds of the object [m]."""
        both = np.array([self.part.bounds, self.without_part.bounds])
        return np.array([both[:, 0].min(0), both[:, 1].max(0)])

    @cached_property
    def place(self) -> Float[np.ndarray, " 12"]:
        """Return where the part is in the object and where it faces.

        Center and half extents of its bounds, in half diagonals of the object from its center; opening direction; thin axis of
        the body OBB, whose largest component is positive.
        """
        bounds = (self.part.bounds - self.bounds.mean(0)) / (self.diagonal / 2)
        thin = self.body_obb.axes[2]
        thin = thin * np.sign(thin[np.abs(thin).argmax()])
        return np.concatenate([bounds.mean(0), np.ptp(bounds, axis=0) / 2, self.opening_direction, thin])

    @cached_property
    def body_obb(self) -> OrientedBox:
        """Return the oriented box of the part without protrusions."""
        return body_obb(self.part)

    @cached_property
    def tolerance_length(self) -> float:
        """Return the reference length of tolerances [m]: the object's diagonal, limited to MAX_PART_DIAGONALS of the part."""
        return max(min(self.diagonal, MAX_PART_DIAGONALS * self.part.box.diagonal), MIN_SCALE_RATIO * self.diagonal)

    @cached_property
    def insertion_depth(self) -> float:
        """Return the depth of the part inside its parent along the opening direction, over its smallest side across."""
        across = [np.ptp(self.part.corners @ a) for a in self.body_obb.axes if abs(a @ self.opening_direction) < ALONG_COSINE]
        return self.depth_in_parent(self.opening_direction) / max(min(across, default=1.0), 1e-9)

    def depth_in_parent(self, direction: Float[np.ndarray, " 3"]) -> float:
        """Return the depth of the part inside its parent along `direction` [m], measured between the parent's bounds."""
        along = self.part.samples.points @ direction
        parent = self.parent.samples.points @ direction
        low, high = quantile(along, 0.005), quantile(along, 0.995)
        return float(max(0.0, min(high, parent.max()) - max(low, parent.min())))

    @cached_property
    def obstacles(self) -> Obstacles:
        """Return the obstacles of the part: what does not move with it, without the other movable parts."""
        return Obstacles(self.part, self.rest, self.penetration)

    @cached_property
    def overlap_depth(self) -> float:
        """Return how deep the part and the static geometry lie in solids of each other at rest, up to half its thickness [m].

        Artists sink doors into their frames.
        """
        return min(max(self.rest.depth(self.part.corners), self.part.depth(self.rest.corners)), float(self.body_obb.half[2]))

    @cached_property
    def obstacles_of_hinges(self) -> Obstacles:
        """Return the obstacles with the overlap at rest tolerated: what counts is the penetration that a turn adds."""
        if self.overlap_depth == 0:
            return self.obstacles
        return replace(self.obstacles, tolerance=self.penetration + self.overlap_depth)

    def obstacles_of(self, motion: Motion) -> Obstacles:
        """Return the obstacles of a motion: for a slide along the surface, also the other movable parts at rest."""
        if motion.kind is not JointType.PRISMATIC:
            return self.obstacles_of_hinges
        along_surface = abs(float(motion.axis @ self.opening_direction)) <= ALONG_COSINE
        return self.obstacles_with_others if along_surface else self.obstacles

    @cached_property
    def penetration(self) -> float:
        """Return the penetration at which a path is stopped [m]."""
        return PENETRATION_RATIO * self.tolerance_length

    @cached_property
    def obstacles_with_others(self) -> Obstacles:
        """Return the obstacles with the other movable parts at rest, which guide a part sideways."""
        return Obstacles(self.part, self.without_part, self.penetration)

    @cached_property
    def outline(self) -> Outline:
        """Return the roundest outline of the part among those along its box axes."""
        points = np.concatenate([self.part.corners, self.part.samples.points])
        return roundest(points, self.part.box.axes[::-1])

    @property
    def is_round(self) -> bool:
        """Return whether the outline of the part is about a circle."""
        return self.outline.roundness > MIN_ROUNDNESS

    def outline_about(self, axis: Float[np.ndarray, " 3"]) -> Outline:
        """Return the outline of the part's samples about an axis, computed once for parallel lines."""
        key = axis.tobytes()
        if key not in self._outlines:
            self._outlines[key] = outline_about(self.part.samples.points, axis)
        return self._outlines[key]

    @cached_property
    def _outlines(self) -> dict[bytes, Outline]:
        return {}

    @cached_property
    def nearest(self) -> tuple[Float[np.ndarray, " n"], Int[np.ndarray, " n"]]:
        """Return the distance of each sample of the part to the parent [m], and the nearest face of the parent."""
        return self.parent.nearest(self.part.samples.points)

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
        near, far, _ = connecting_area(self.gap, off, CONNECTING_RATIO * max(self.tolerance_length, 1e-3 * self.diagonal))
        return np.concatenate([self.part.samples.points[near], theirs[far]])

    @cached_property
    def contact_surfaces(self) -> tuple[SurfacePoints, ...]:
        """Return points of the link and its parent within each of CONTACT_REACHES of the other, the nearest first."""
        link = self.part if self.link is None else self.link
        reach = np.array(CONTACT_REACHES) * max(link.box.diagonal, MIN_SCALE_RATIO * self.diagonal)
        low, high = link.bounds + reach[-1] * np.array([[-1.0], [1.0]])
        beside = (self.parent.highest > low) & (self.parent.lowest < high)
        theirs = self.parent.take(np.flatnonzero(beside.all(1))).samples
        theirs = theirs.take(np.flatnonzero(((theirs.points > low) & (theirs.points < high)).all(1)))
        off = self.parent.tree.distance(link.samples.points), link.tree.distance(theirs.points)
        surfaces = [link.samples.take(off[0] < r).joined(theirs.take(off[1] < r)) for r in reach]
        return tuple(s.take(np.arange(0, len(s), -(-len(s) // MAX_SURFACE_POINTS) or 1)) for s in surfaces)

    def facing(self, direction: Float[np.ndarray, " 3"]) -> Float[np.ndarray, " n"]:
        """Return how far each sample of the part faces along a unit direction, -1..1; open sheets face both ways."""
        along = self.part.samples.normals @ direction
        return np.where(self.part.solid[self.part.samples.faces], along, np.abs(along))

    def sees(self, points: Float[np.ndarray, "n 3"], directions: Float[np.ndarray, "h 3"]) -> Bool[np.ndarray, "h n"]:
        """Return which points [m] have a free line of sight past the static geometry along each unit direction."""
        along = np.repeat(directions, len(points), 0)
        return self._free_sight(np.tile(points, (len(directions), 1)), along).reshape(len(directions), len(points))

    def _free_sight(self, points: Float[np.ndarray, "n 3"], directions: Float[np.ndarray, "n 3"]) -> Bool[np.ndarray, " n"]:
        """Return which points [m] have a free line of sight past the static geometry, each along its own unit direction."""
        start, rays = points + 1e-4 * self.diagonal * directions, 4 * self.diagonal * directions
        return self.rest.scene.first_hit(start, rays, 1.0).face < 0

    def _visible_shares(self, directions: Float[np.ndarray, "h 3"]) -> Float[np.ndarray, " h"]:
        """Return the visible share of the surface facing each direction, or of the whole surface if hardly any faces it."""
        points = self.part.samples.points
        facing = [np.flatnonzero(self.facing(direction) > FACING_COSINE) for direction in directions]
        probed = [points[faces] if len(faces) > 0.02 * len(points) else points for faces in facing]
        some = [probes[:: max(1, len(probes) // 500)] for probes in probed]
        ends = np.cumsum([len(probes) for probes in some])
        seen = self._free_sight(np.concatenate(some), np.repeat(directions, np.diff(ends, prepend=0), 0))
        return np.array([probes.mean() for probes in np.split(seen, ends[:-1])])

    @cached_property
    def opening_directions(self) -> tuple[Float[np.ndarray, "6 3"], Float[np.ndarray, " 6"]]:
        """Return both directions of each box axis, and their scores as opening direction.

        Visible, thin and off-center directions score higher.
        """
        directions = np.stack([self.body_obb.axes, -self.body_obb.axes], 1).reshape(-1, 3)
        thin = (self.body_obb.half[2] / np.maximum(self.body_obb.half, 1e-12)).repeat(2)
        away = directions @ (self.part.centroid - self.center) / self.diagonal
        scores = self._visible_shares(directions) + 0.5 * thin + 0.3 * away
        return directions, scores - DOWNWARD_PENALTY * np.maximum(0.0, -directions[:, 2])

    @property
    def off_the_middle(self) -> Float[np.ndarray, " 3"]:
        """Return the middle of the part's bounds from that of the object's, over the object's diagonal."""
        return (self.part.bounds.mean(0) - self.center) / self.diagonal

    @cached_property
    def opening_direction(self) -> Float[np.ndarray, " 3"]:
        """Return the opening direction, unit: the box direction with the highest score, or the shared one of its row."""
        if self.shared_opening_direction is not None:
            return self.shared_opening_direction
        directions, scores = self.opening_directions
        return directions[best_direction(scores, directions @ self.off_the_middle)]

    @cached_property
    def visibility(self) -> float:
        """Return the share of the part that is visible along the opening direction."""
        return float(self.sees(self.part.samples.points[::6], self.opening_direction[None]).mean())

    @cached_property
    def handle(self) -> Handle | None:
        """Return the handle of the part, None if it has none."""
        return find_handle(self.part, self.body_obb, self.parent, self.tolerance_length, self.opening_direction)

    @cached_property
    def face_axes(self) -> list[int]:
        """Return the two box axes that span the outer face, in the order of Handle.across."""
        return face_axes(self.body_obb, self.opening_direction)


def shape_features(context: PartContext) -> dict[str, float]:
    """Return the features of a part that need only its own shape and the object's bounds."""
    core, outline = context.body_obb, context.outline
    length, width, thickness = core.half
    low, high = context.bounds
    extent, middle = np.maximum(high - low, 1e-12), context.part.bounds.mean(0)
    box_area = 8 * float(length * width + width * thickness + length * thickness)
    return {
        "size": context.part.box.diagonal / context.diagonal,
        "thinness": float(thickness / max(width, 1e-12)),
        "width over length": float(width / max(length, 1e-12)),
        "thickness": float(2 * thickness / context.diagonal),
        "roundness": outline.roundness,
        "height over radius": min(outline.height / max(outline.radius, 1e-12), MAX_HEIGHT_OVER_RADIUS),
        "opening direction up": float(context.opening_direction[2]),
        "visibility": context.visibility,
        "height": float((middle[2] - low[2]) / extent[2]),
        "horizontal offset": float(np.linalg.norm(((middle - low) / extent * 2 - 1)[:2])),
        "object height": float(np.clip(extent[2] / extent[:2].max(), 0, MAX_LENGTH_RATIO)),
        "solid": float(context.part.solid @ context.part.areas / max(context.part.area, 1e-300)),
        "area over box": float(np.clip(context.part.area / max(box_area, 1e-300), 0, MAX_LENGTH_RATIO)),
        "insertion depth": min(context.insertion_depth, MAX_LENGTH_RATIO),
        **_handle(context),
    }


def _handle(context: PartContext) -> dict[str, float]:
    handle = context.handle
    if handle is None:
        return {"handle": 0.0, "handle size": 0.0, "handle off the middle": 0.0, "bar handle": 0.0}
    return {
        "handle": 1.0,
        "handle size": handle.size,
        "handle off the middle": max(abs(a) for a in handle.across),
        "bar handle": float(handle.along is not None),
    }
