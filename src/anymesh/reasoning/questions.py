"""The typed questions that the pipeline asks, and the protocol of those who answer.

A question carries the facts (and, for a model that sees, what pictures can be drawn of), an answer is checked when made.
The pipeline does not know which answerer it has.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from jaxtyping import Float

from anymesh.types import JointType, Motion, Sweep


@dataclass(frozen=True)
class Handle:
    """A grip that stands out of a part's outer face.

    across: (2,) where it sits on the face, -1..1 along the face's long and short side; along: which side it runs
    along (0 long, 1 short, None when it is a knob); size: its length as a share of the part's diagonal.
    """

    across: tuple[float, float]
    along: int | None
    size: float


@dataclass(frozen=True, eq=False)
class PartFacts:
    """What geometry shows of one part against the rest. Lengths are shares of the object's diagonal unless said."""

    name: str
    label: str  # the field's word for it, "part" when unknown
    extents: tuple[float, float, float]  # of its core box, longest first
    thinness: float  # shortest side / middle side of the core box
    roundness: float  # 0..1 of its roundest outline
    flatness: float  # height along that outline's axis over its radius
    outward: Float[np.ndarray, " 3"]  # the way out of the object, unit
    openness: float  # 0..1, share of the part's surface that sees the outside along `outward`
    buried: float  # depth within the parent along `outward`, over the smallest side across
    size: float  # its diagonal over the object's
    horizontal: bool  # its face looks up or down
    handle: Handle | None
    touches_ends: bool  # held by two contacts far apart with free space between (a bail)


@dataclass(frozen=True, eq=False)
class Candidate:
    """A motion hypothesis and the evidence for it.

    role: what the axis is to the part ("edge", "edge_mid", "center", "round", "contact", "bail", "barrel", "slide");
    opens: +1 when +axis opens, else -1; opening, closing: free amount each way [rad, or share of the diagonal for a slide].
    """

    motion: Motion
    sweep: Sweep
    role: str
    opens: int
    opening: float
    closing: float
    support: float  # 0..1, share of the hinge line that has the parent near
    sibling: float  # 0..1, share of the hinge line that has another movable part near
    handle_side: float  # -1..1: 1 the handle is opposite the hinge, 0 no handle or level with it
    guided: float  # 0..1, a slide: share of the sideways directions in which the part is held
    depth: float  # extent of the part along the slide that lies within the parent, over its smallest side across
    vertical: float  # |axis . up|
    outward: float  # opening direction . outward, -1..1


@dataclass(frozen=True)
class MotionQuestion:
    """How does this part move? One of the candidates, or not at all."""

    part: PartFacts
    candidates: tuple[Candidate, ...]


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


class Answerer(Protocol):
    """Whoever answers: geometry alone, a vision-language model, or ground truth."""

    name: str

    def which_motion(self, question: MotionQuestion) -> MotionAnswer: ...
