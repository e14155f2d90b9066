"""Candidate motions of a part with their evidence from the sweep, and the motion that is chosen among them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Literal

import numpy as np
from jaxtyping import Float

from anymesh.config import ALONG_COSINE
from anymesh.motion.part_context import PartContext
from anymesh.types import JointType, Motion, Sweep

MIN_FREE_ANGLE_RAD = float(np.deg2rad(12))  # [rad] a hinge that opens less is blocked
MIN_FREE_TRAVEL_RATIO = 0.008  # of the tolerance length: a slide with less free travel is blocked
ENDLESS_ANGLE_RAD = 3.0  # [rad] minimum free angle in each direction of an endless rotation; the sweep ends at half a turn

# Relation of a motion to its part: of a hinge's axis ("center" also names the normal of the connecting area, "pin" its width);
# of a slide ("slide", "contact_slide"); or an answered one ("asked").
Role = Literal[
    "edge", "edge_mid", "center", "round", "pin", "circle", "pivot", "hub", "two_pivot", "barrel", "surface", "contact",
    "slide", "contact_slide", "asked",
]  # fmt: skip
BOX_RIM_ROLES: tuple[Role, ...] = ("edge", "edge_mid")  # hinges along the rims of the part's box
ProposedMotion = tuple[Role, Motion]


class SlideDirection(StrEnum):
    """Direction of a slide relative to the opening direction of its part."""

    OUTWARDS = "out of the case"
    INWARDS = "into the case"
    ALONG_SURFACE = "along the surface"


@dataclass(frozen=True, eq=False)
class PartFacts:
    """What is known of a part whatever its motion.

    label: standard term, "part" if unknown; size: its diagonal [m]; roundness: of its roundest outline, 0..1.
    """

    label: str
    size: float
    roundness: float

    @classmethod
    def of(cls, context: PartContext, label: str) -> PartFacts:
        """Return the facts of a part with this label."""
        return cls(label, context.part.box.diagonal, context.outline.roundness)


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
class CandidateMotions:
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
