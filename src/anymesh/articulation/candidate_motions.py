"""Candidate motions of a part: how they are proposed, their evidence from the sweep, and the motion that is chosen among them.

Joints are chosen among these and never regressed. From the paper (3.3): the line along the connecting area, the normal of its
fitted plane, directions in that plane. Added here: edges, center lines and directions of the part's body OBB, the axis of a
round outline, the line through two far contacts, the axes of hinge barrels and of round surfaces in contact.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Literal

import numpy as np
from jaxtyping import Float

from anymesh.config import ALONG_COSINE
from anymesh.geometry.boxes import OrientedBox
from anymesh.geometry.circles import MIN_CIRCLE_ROUNDNESS, fit_revolution, outline_about
from anymesh.motion.part_context import PartContext
from anymesh.types import Brief, JointType, Motion, Sweep

MIN_GAP_FACTOR = 1.5  # a part that touches nothing is in contact within this multiple of its smallest gap
CONTACT_RATIO = 0.008  # of the tolerance length: points closer to the parent are in contact
MIN_FREE_ANGLE_RAD = float(np.deg2rad(12))  # [rad] a hinge that opens less is blocked
MIN_FREE_TRAVEL_RATIO = 0.008  # of the tolerance length: a slide with less free travel is blocked
# of the part's diagonal: lines nearer to the pivot of its node are beside it, where a user sees them as one, and on it
NEAR_PIVOT_RATIO, ON_PIVOT_RATIO = 0.1, 0.02
MIN_LARGE_RATIO = 0.15  # of the object's diagonal: a smaller part that slides in is a button, one that spins is a knob
ENDLESS_ANGLE_RAD = 3.0  # [rad] minimum free angle in each direction of an endless rotation; the sweep ends at half a turn

# Relation of a motion to its part: of a hinge's axis ("center" also names the normal of the connecting area, "pin" its width);
# of a slide ("slide", "contact_slide"); or an answered one ("asked").
Role = Literal[
    "edge", "edge_mid", "center", "round", "pin", "circle", "pivot", "hub", "two_pivot", "barrel", "surface", "contact",
    "slide", "contact_slide", "asked",
]  # fmt: skip
BOX_RIM_ROLES: tuple[Role, ...] = ("edge", "edge_mid")  # hinges along the rims of the part's box
HINGE_ROLES: tuple[Role, ...] = (*BOX_RIM_ROLES, "barrel", "two_pivot", "asked")  # rotations that doors, lids and handles make
ProposedMotion = tuple[Role, Motion]


def contact_tolerance(context: PartContext) -> float:
    """Return the distance to the parent within which a point is in contact [m]; it grows with the gap of a part with none."""
    return max(CONTACT_RATIO * context.tolerance_length, MIN_GAP_FACTOR * float(context.gap.min()))


def contact_points(context: PartContext) -> Float[np.ndarray, "n 3"]:
    """Return the part's samples in contact with the parent [m]."""
    return context.part.samples.points[context.gap <= contact_tolerance(context)]


class SlideDirection(StrEnum):
    """Direction of a slide relative to the opening direction of its part."""

    OUTWARDS = "out of the case"
    INWARDS = "into the case"
    ALONG_SURFACE = "along the surface"


@dataclass(frozen=True, eq=False)
class PartFacts:
    """What is known of a part whatever its motion.

    label: standard term, "part" if unknown; size: its diagonal [m]; roundness: of its roundest outline, 0..1; pressed: whether
    it may be pressed into a body that fills the hole, as buttons are modelled; named: whether the label is a given name and
    not made from the motion: then it decides over the score.
    """

    label: str
    size: float
    roundness: float
    pressed: bool = True
    named: bool = False

    @classmethod
    def of(cls, context: PartContext, label: str) -> PartFacts:
        """Return the facts of a part with this label."""
        size = context.part.box.diagonal
        sunk = context.overlap_depth > context.penetration
        outline = context.outline
        knob = outline.roundness > MIN_CIRCLE_ROUNDNESS and outline.height > outline.radius  # a button is flat
        button = size <= MIN_LARGE_RATIO * context.diagonal and not knob
        return cls(label, size, outline.roundness, button or not sunk)


@dataclass(frozen=True, eq=False)
class Candidate:
    """A candidate motion and its evidence.

    opening_sign: +1 if +axis opens, else -1; opening, closing: free amounts [rad; for a slide, over the tolerance length].
    """

    motion: Motion
    sweep: Sweep
    role: Role
    opening_sign: int
    opening: float
    closing: float
    outward: float  # cosine between the initial motion of the center and the opening direction of the part
    hinge_support: float = 0.0  # 0..1, share of the hinge line near the parent
    sibling: float = 0.0  # 0..1, share of the hinge line near another movable part
    # 0..1, as hinge_support, of the line at the part's other side, which is 0 for a free side
    support_opposite: float = 0.0
    handle_side: float = 0.0  # -1..1: 1 if the handle is opposite the hinge, 0 if there is none or it is level with the hinge
    guided: float = 0.0  # 0..1, for a slide: share of the sideways directions in which the part is guided
    captured: bool = False  # whether a slide is stopped in both directions, with free travel between
    contact_retention: float = 0.0  # 0..1, share of the contact that remains when the part opens slightly
    spins: bool = False  # whether a rotation is free all round, of a rotor or a crank and not of a door or a lever
    off_pivot: float = np.inf  # distance of a rotation's axis to the pivot of the part's node, over the part's diagonal

    @property
    def at_pivot(self) -> bool:
        """Return whether the axis is on the pivot of the part's node in the file, or beside it."""
        return self.off_pivot < NEAR_PIVOT_RATIO

    @property
    def vertical(self) -> float:
        """Return the cosine between the axis and the vertical, 0..1."""
        return abs(float(self.motion.axis[2]))

    @property
    def opening_motion(self) -> Motion:
        """Return the motion with its axis signed so that positive opens."""
        return Motion(self.motion.kind, self.motion.axis * self.opening_sign, self.motion.origin, self.motion.source)

    @property
    def opening_sweep(self) -> Sweep:
        """Return the sweep of `opening_motion`: forward opens, backward closes."""
        return self.sweep if self.opening_sign > 0 else self.sweep.reversed()

    def reversed(self) -> Candidate:
        """Return the candidate that opens the other way."""
        return replace(self, opening_sign=-self.opening_sign, opening=self.closing, closing=self.opening, outward=-self.outward)

    @property
    def is_free(self) -> bool:
        """Return whether the sweep lets the motion open.

        A slide or a wheel may also move in the closing direction, since a button may fill the hole that it is pressed into.
        """
        if self.motion.kind is JointType.PRISMATIC:
            return max(self.opening, self.closing) >= MIN_FREE_TRAVEL_RATIO
        return max(self.opening, self.closing if self.role == "round" else 0.0) >= MIN_FREE_ANGLE_RAD

    @property
    def slide_direction(self) -> SlideDirection | None:
        """Return the direction in which a slide opens, None for a rotation."""
        if self.motion.kind is not JointType.PRISMATIC:
            return None
        if abs(self.outward) <= ALONG_COSINE:
            return SlideDirection.ALONG_SURFACE
        return SlideDirection.OUTWARDS if self.outward > 0 else SlideDirection.INWARDS

    @property
    def is_endless(self) -> bool:
        """Return whether a rotation is free in both directions."""
        return self.motion.kind is JointType.REVOLUTE and min(self.opening, self.closing) > ENDLESS_ANGLE_RAD


@dataclass(frozen=True, eq=False)
class CandidateMotions(Brief):
    """The motions among which the joint of a part is chosen.

    scores: (k,) log-odds that each candidate is right.
    """

    part: PartFacts
    candidates: tuple[Candidate, ...]
    scores: Float[np.ndarray, " k"]


@dataclass(frozen=True)
class MotionChoice:
    """How a part moves.

    ranking: candidate indices, best first; type: the joint's; confidence: 0..1; reason: in words.
    """

    ranking: tuple[int, ...]
    type: JointType
    confidence: float
    reason: str

    def __post_init__(self) -> None:
        if not 0 <= self.confidence <= 1 or not self.reason:
            raise ValueError(f"a choice needs a confidence in 0..1 and a reason, found {self.confidence}, {self.reason!r}")


# near-duplicates of a motion: maximum angle between the axes, maximum distance of the lines over the tolerance length
DUPLICATE_ANGLE_RAD, DUPLICATE_LINE_RATIO = np.deg2rad(1.0), 0.004
MIN_PIVOTS_APART_RATIO = 0.36  # of the part's diagonal: minimum distance of two pivots
MAX_PIVOT_WIDTH_RATIO = 0.35  # of their distance: maximum width of the contact at a pivot
MIN_REVOLUTION = 0.25  # of the surfaces in contact: least share that turns in place about their axis


def _edges(box: OrientedBox) -> list[ProposedMotion]:
    edges = []
    for k in range(3):
        i, j = (a for a in range(3) if a != k)
        for si in (-1, 1):
            for sj in (-1, 1):
                local = np.zeros(3)
                local[i], local[j] = si * box.half[i], sj * box.half[j]
                origin = box.world(local[None])[0]
                edges.append(("edge", Motion(JointType.REVOLUTE, box.axes[k], origin, "edge of the part")))
    return edges


def _edge_middles(box: OrientedBox) -> list[ProposedMotion]:
    """Return the lines at half the thickness of a plate, along its four rims."""
    lines = []
    for k in range(2):
        other = 1 - k
        for s in (-1, 1):
            local = np.zeros(3)
            local[other] = s * box.half[other]
            origin = box.world(local[None])[0]
            lines.append(("edge_mid", Motion(JointType.REVOLUTE, box.axes[k], origin, "rim of the part")))
    return lines


def _through(box: OrientedBox) -> list[ProposedMotion]:
    return [("center", Motion(JointType.REVOLUTE, a, box.center, "middle line of the part")) for a in box.axes]


def _from_contact(context: PartContext) -> list[ProposedMotion]:
    """Return the paper's candidates: the line along the connecting area, its plane's normal, directions in the plane."""
    contact = context.contact
    if len(contact) < 4:
        return []
    middle = contact.mean(0)
    directions = np.linalg.svd(contact - middle, full_matrices=False)[2]
    return [
        ("contact", hinge_about(directions[0], middle, "line along the connecting area")),
        ("center", hinge_about(directions[2], middle, "normal of the connecting area")),
        ("pin", hinge_about(directions[1], middle, "width of the connecting area")),
        *(
            ("contact_slide", Motion(JointType.PRISMATIC, _unit(d), middle, f"{what} of the connecting area"))
            for d, what in zip(directions, ("length", "width", "plane normal"), strict=True)
        ),
    ]


def hinge_about(axis: Float[np.ndarray, " 3"], origin: Float[np.ndarray, " 3"], source: str) -> Motion:
    """Return a rotation about a line, whose axis is unit and has a positive largest component."""
    return Motion(JointType.REVOLUTE, _unit(axis), origin, source)


def _unit(v: np.ndarray) -> np.ndarray:
    v = v / np.linalg.norm(v)
    return -v if v[np.abs(v).argmax()] < 0 else v


def two_pivot_line(context: PartContext) -> Motion | None:
    """Return the line through two contacts far apart with free space between them (a bucket handle, a trunnion)."""
    near = contact_points(context)
    if len(near) < 6:
        return None
    spread = near - near.mean(0)
    first = np.linalg.svd(spread, full_matrices=False)[2][0]
    t = spread @ first
    side = _two_groups(near, near[[t.argmin(), t.argmax()]])
    if min((side == 0).sum(), (side == 1).sum()) < 2:
        return None
    a, b = ((near[side == s].min(0) + near[side == s].max(0)) / 2 for s in (0, 1))
    apart = float(np.linalg.norm(b - a))
    width = max(float(np.linalg.norm(np.ptp(near[side == s], axis=0))) for s in (0, 1))
    if apart < MIN_PIVOTS_APART_RATIO * context.part.box.diagonal or width > MAX_PIVOT_WIDTH_RATIO * apart:
        return None
    return hinge_about(b - a, (a + b) / 2, "line through the two far contacts")


def _two_groups(points: np.ndarray, centers: np.ndarray) -> np.ndarray:
    """Return 0 or 1 per point: the nearer of two centers, fitted by k-means in 20 rounds."""
    side = np.zeros(len(points), np.int64)
    for _ in range(20):
        side = ((points[:, None] - centers) ** 2).sum(2).argmin(1)
        centers = np.array([points[side == s].mean(0) if (side == s).any() else centers[s] for s in (0, 1)])
    return side


def barrels(context: PartContext) -> list[ProposedMotion]:
    """Return the axes of small cylinders near part and parent: hinge barrels and pins."""
    axes = []
    for component in context.barrel_candidates:
        seen = outline_about(np.concatenate([component.corners, component.samples.points]), component.box.axes[0])
        if seen.roundness > 0.85:
            axes.append(("barrel", hinge_about(seen.axis, seen.center, "axis of a hinge barrel")))
    return axes


def contact_axes(context: PartContext) -> list[ProposedMotion]:
    """Return the axes about which the surfaces in contact turn in place: of pins, bushings and ball joints."""
    fitted = [fit_revolution(surface, MIN_REVOLUTION) for surface in context.contact_surfaces]
    what = "axis of the round surfaces in contact"
    return [("surface", hinge_about(f.axis, f.origin, what)) for f in fitted if f is not None]


def propose(context: PartContext) -> list[ProposedMotion]:
    """Propose all candidate motions of a part with their roles, without near-duplicates, in a fixed order."""
    core = context.body_obb
    proposals: list[ProposedMotion] = []
    if (line := two_pivot_line(context)) is not None:
        proposals.append(("two_pivot", line))
    outline = context.outline
    if context.is_round:
        axis = hinge_about(outline.axis, outline.center, "axis of its round outline")
        proposals.append(("round", axis))
    proposals += barrels(context) + _edges(core) + _edge_middles(core) + _through(core)
    proposals += [("slide", Motion(JointType.PRISMATIC, a, core.center, "direction of the part")) for a in core.axes]
    proposals += _from_contact(context) + contact_axes(context)
    if context.pivot is not None:
        proposals += [("edge", hinge_about(a, context.pivot, "line along its box")) for a in core.axes]
    return distinct(proposals, context.tolerance_length)


def distinct(candidates: Iterable[ProposedMotion], tolerance_length: float) -> list[ProposedMotion]:
    """Return the motions without near-duplicates of earlier ones.

    tolerance_length: reference length of the tolerances [m], as in `PartContext`.
    """
    kept: list[ProposedMotion] = []
    for role, motion in candidates:
        factor = 2 if role == "surface" else 1  # a fit is less exact
        cosine, distance = np.cos(factor * DUPLICATE_ANGLE_RAD), factor * DUPLICATE_LINE_RATIO * tolerance_length
        if not any(_same(motion, other, cosine, distance) for _, other in kept):
            kept.append((role, motion))
    return kept


def _same(a: Motion, b: Motion, cosine: float, distance: float) -> bool:
    if a.kind is not b.kind or abs(float(a.axis @ b.axis)) < cosine:
        return False
    if a.kind is JointType.PRISMATIC:
        return True
    return bool(a.distance(b.origin[None])[0] < distance)
