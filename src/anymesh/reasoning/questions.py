"""Motion questions with their facts and candidates, and the protocol of answerers.

Answers are validated when constructed. The pipeline does not depend on the kind of answerer.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float

from anymesh.types import Handle, JointType, Motion, MotionKind, Sweep

MIN_ANGLE = float(np.deg2rad(12))  # [rad] a hinge that opens less is blocked
MIN_TRAVEL_RATIO = 0.008  # a slide that is free for less, as a share of the diagonal, is blocked
ENDLESS_ANGLE = 3.0  # [rad] free each way from which a turn is endless; the sweep ends at half a turn


@dataclass(frozen=True, eq=False)
class PartFacts:
    """Geometric facts of one part. Lengths are shares of the object's diagonal unless stated otherwise."""

    name: str
    label: str  # the field's word for it, "part" when unknown
    extents: tuple[float, float, float]  # of its body OBB, longest first
    thinness: float  # shortest side / middle side of the body OBB
    roundness: float  # 0..1 of its roundest outline
    flatness: float  # height along that outline's axis over its radius
    opening_direction: Float[np.ndarray, " 3"]  # unit
    visibility: float  # 0..1, share of the part's surface that is visible along the opening direction
    insertion_depth: float  # depth within the parent along the opening direction, over the smallest side across
    size: float  # its diagonal over the object's
    diagonal: float  # the object's [m]
    horizontal: bool  # its face looks up or down
    handle: Handle | None
    two_pivot: bool  # held by two contacts far apart with free space between (a bucket handle)
    tall: float  # log2 of its face's height over its width; 0 for a level face
    height: float  # 0..1, of its middle in the object's height
    back_contact: float  # 0..1, share of its back that lies on the parent
    free_rim: float  # 0..1, a round part: share of its rim that sees the outside across its axis
    covers_opening: float  # 0..1, a round part: how much of its rim lies on the parent around an opening behind it
    rotational_asymmetry: float = 1.0  # a round part: how far it is from a body of revolution, over its radius


@dataclass(frozen=True, eq=False)
class Candidate:
    """A candidate motion and the evidence for it.

    role: what the axis is to the part ("edge", "edge_mid", "center", "round", "contact", "two_pivot", "barrel", "slide");
    opening_sign: +1 when +axis opens, else -1; opening, closing: free amounts [rad, or share of the diagonal for a slide].
    """

    motion: Motion
    sweep: Sweep
    role: str
    opening_sign: int
    opening: float
    closing: float
    hinge_support: float  # 0..1, share of the hinge line that has the parent near
    sibling: float  # 0..1, share of the hinge line that has another movable part near
    handle_side: float  # -1..1: 1 the handle is opposite the hinge, 0 no handle or level with it
    guided: float  # 0..1, a slide: share of the sideways directions in which the part is held
    depth: float  # extent of the part along the slide that lies within the parent, over its smallest side across
    vertical: float  # |axis . up|
    above: float  # -1..1: where the axis lies between the lowest (-1) and highest (1) of the part
    captured: bool  # a slide that is stopped both ways, with room to move between
    outward: float  # opening direction . outward, -1..1
    pair: float = 0.0  # -1..1: 1 a leaf like it meets the part opposite the hinge, -1 at the hinge
    outer: float = 0.0  # -1..1: 1 the hinge lies at the object's outer side, -1 towards its middle
    handle_off: float = 0.0  # 0..1, how far from the middle of the hinge's length the handle sits
    support_opposite: float = 0.0  # 0..1, as support, of the line at the part's other side: a free side has nothing near
    reach: float = 0.0  # log2 of the part's reach across the line over its length along it
    contact_proximity: float = 0.0  # 0..1, how near the line the contact lies
    thick: float = 0.0  # 0..1, thickness at the line over the part's largest
    contact_retention: float = 0.0  # 0..1, share of the contact that stays when the part opens a little
    penetration_scale: float = 1.0  # factor on the penetration that counts, more than 1 for a part that is stuck in the rest
    overlap_gain: float = 0.0  # 0..1, a slide: the part comes to lie over what it did not lie over

    @property
    def is_free(self) -> bool:
        """Whether the sweep lets the motion open at all; a slide or a wheel may go back as well, a button may fill its hole."""
        if self.motion.kind is MotionKind.PRISMATIC:
            return max(self.opening, self.closing) >= MIN_TRAVEL_RATIO
        return max(self.opening, self.closing if self.role == "round" else 0.0) >= MIN_ANGLE

    @property
    def is_endless(self) -> bool:
        """Whether nothing stops a turn, either way."""
        return self.motion.kind is MotionKind.REVOLUTE and min(self.opening, self.closing) > ENDLESS_ANGLE


@dataclass(frozen=True, eq=False)
class MotionQuestion:
    """Question how a part moves: by one of the candidates, or not at all.

    scores: (k,) log-odds that each candidate is right; reasons: the features that decided, in words.
    """

    part: PartFacts
    candidates: tuple[Candidate, ...]
    scores: Float[np.ndarray, " k"]
    reasons: tuple[str, ...]


@dataclass(frozen=True)
class MotionAnswer:
    """ranking: candidate indices, best first; type: the joint's; confidence 0..1; reason in words."""

    ranking: tuple[int, ...]
    type: JointType
    confidence: float
    reason: str

    def __post_init__(self) -> None:
        if not 0 <= self.confidence <= 1 or not self.reason:
            raise ValueError(f"an answer needs a confidence in 0..1 and a reason, found {self.confidence}, {self.reason!r}")


@runtime_checkable
class MotionAnswerer(Protocol):
    """Answerer of motion questions: geometry, a vision-language model, or ground truth."""

    name: str

    def which_motion(self, question: MotionQuestion) -> MotionAnswer: ...
