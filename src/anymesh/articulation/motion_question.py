"""Motion questions with their facts and candidates, and their answers.

Answers are validated when constructed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Literal

import numpy as np
from jaxtyping import Float

from anymesh.config import ALONG_COSINE
from anymesh.types import Handle, JointType, Motion, Sweep

MIN_FREE_ANGLE_RAD = float(np.deg2rad(12))  # [rad] a hinge that opens less is blocked
MIN_FREE_TRAVEL_RATIO = 0.008  # of the tolerance length: a slide with less free travel is blocked
ENDLESS_ANGLE = 3.0  # [rad] minimum free angle in each direction of an endless rotation; the sweep ends at half a turn

# Relation of a motion to its part: that of a hinge's axis; of a slide ("slide", "contact_slide"); or an answered one ("asked").
Role = Literal[
    "edge", "edge_mid", "center", "round", "pin", "circle", "pivot", "hub", "two_pivot", "barrel", "surface", "contact",
    "slide", "contact_slide", "asked",
]  # fmt: skip
Proposal = tuple[Role, Motion]


class SlideDirection(StrEnum):
    """Direction of a slide relative to the opening direction of its part."""

    OUTWARDS = "outwards"
    INWARDS = "inwards"
    ALONG_SURFACE = "along the surface"


@dataclass(frozen=True, eq=False)
class PartFacts:
    """Geometric facts of one part. Lengths are relative to the object's diagonal unless stated otherwise."""

    name: str
    label: str  # standard term, "part" if unknown
    extents: tuple[float, float, float]  # of its body OBB, longest first
    thinness: float  # shortest side / middle side of the body OBB
    roundness: float  # 0..1, of its roundest outline
    flatness: float  # height along that outline's axis over its radius
    opening_direction: Float[np.ndarray, " 3"]  # unit
    visibility: float  # 0..1, share of the part's surface that is visible along the opening direction
    insertion_depth: float  # depth within the parent along the opening direction, over the smallest side across
    size: float  # its diagonal over the object's
    diagonal: float  # the object's [m]
    handle: Handle | None
    two_pivot: bool  # supported by two contacts far apart with free space between (a bucket handle)
    tall: float  # log2 of its face's height over its width; 0 for a horizontal face
    height: float  # 0..1, of its center within the object's height
    back_contact: float  # 0..1, share of its back in contact with the parent
    free_rim: float  # 0..1, for a round part: share of its rim with a free view outside, across its axis
    # 0..1, for a round part: share of its rim near the parent, times the share of its back with an opening behind it
    covers_opening: float
    rotational_asymmetry: float = 1.0  # for a round part: distance from a body of revolution, over its radius


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
    hinge_support: float  # 0..1, share of the hinge line near the parent
    sibling: float  # 0..1, share of the hinge line near another movable part
    handle_side: float  # -1..1: 1 if the handle is opposite the hinge, 0 if there is no handle or it is level with the hinge
    guided: float  # 0..1, for a slide: share of the sideways directions in which the part is guided
    depth: float  # extent of the part along the slide that lies within the parent, over its smallest side across
    vertical: float  # |axis . up|
    above: float  # -1..1: position of the axis between the lowest (-1) and the highest (1) point of the part
    captured: bool  # whether a slide is stopped in both directions, with free travel between
    outward: float  # cosine between the initial motion of the center and the opening direction of the part
    pair: float = 0.0  # -1..1: 1 if a similar panel meets the part opposite the hinge, -1 if at the hinge
    outer: float = 0.0  # -1..1: 1 if the hinge is at the object's outer side, -1 if towards its middle
    handle_off: float = 0.0  # 0..1, offset of the handle from the center of the hinge's length
    support_opposite: float = 0.0  # 0..1, as hinge_support, of the line at the part's other side, which is 0 for a free side
    reach: float = 0.0  # log2 of the part's reach across the line over its length along it
    contact_proximity: float = 0.0  # 0..1, proximity of the contact to the line
    thick: float = 0.0  # 0..1, thickness at the line over the part's largest
    contact_retention: float = 0.0  # 0..1, share of the contact that remains when the part opens slightly
    overlap_gain: float = 0.0  # 0..1, for a slide: gain in overlap with other surfaces

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
        return self.motion.kind is JointType.REVOLUTE and min(self.opening, self.closing) > ENDLESS_ANGLE


@dataclass(frozen=True, eq=False)
class MotionQuestion:
    """Question how a part moves: by one of the candidates, or not at all.

    scores: (k,) log-odds that each candidate is right; reason: the features that decided for a candidate, in words.
    """

    part: PartFacts
    candidates: tuple[Candidate, ...]
    scores: Float[np.ndarray, " k"]
    reason: Callable[[int], str]


@dataclass(frozen=True)
class MotionAnswer:
    """Answer to a motion question.

    ranking: candidate indices, best first; type: the joint's; confidence: 0..1; reason: in words.
    """

    ranking: tuple[int, ...]
    type: JointType
    confidence: float
    reason: str

    def __post_init__(self) -> None:
        if not 0 <= self.confidence <= 1 or not self.reason:
            raise ValueError(f"an answer needs a confidence in 0..1 and a reason, found {self.confidence}, {self.reason!r}")
