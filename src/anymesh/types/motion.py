"""Motions of parts: recognized kinds, candidate motions with the results of their sweeps, and joints."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np
from jaxtyping import Float, Int

from anymesh.types.brief import Brief, brief


class JointType(StrEnum):
    """Kind of motion of a part relative to its parent: the joint types that are written to every format."""

    REVOLUTE = "revolute"
    CONTINUOUS = "continuous"
    PRISMATIC = "prismatic"
    FIXED = "fixed"


BASE = "base"  # label of the static base
MOVING = (JointType.REVOLUTE, JointType.CONTINUOUS, JointType.PRISMATIC)


@dataclass(frozen=True, eq=False)
class Motion(Brief):
    """A candidate motion.

    kind: REVOLUTE or PRISMATIC; axis: unit, asset frame; origin: a point on the axis [m, asset frame] (any point for a slide).
    """

    kind: JointType
    axis: Float[np.ndarray, " 3"]
    origin: Float[np.ndarray, " 3"]
    source: str  # the generator that proposed it, in words

    def __post_init__(self) -> None:
        length = float(np.linalg.norm(self.axis))
        if abs(length - 1) > 1e-6:
            raise ValueError(f"a motion's axis must be a unit vector, found length {length:.6f}")

    def transform(self, amount: float) -> Float[np.ndarray, "4 4"]:
        """Return the rigid transform (asset frame) at `amount` [rad for revolute, m for prismatic]."""
        return self.transforms(np.array([amount]))[0]

    def transforms(self, amounts: Float[np.ndarray, " k"]) -> Float[np.ndarray, "k 4 4"]:
        """Return the rigid transforms at several amounts."""
        T = np.tile(np.eye(4), (len(amounts), 1, 1))
        if self.kind is JointType.PRISMATIC:
            T[:, :3, 3] = amounts[:, None] * self.axis
            return T
        x, y, z = self.axis
        K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        T[:, :3, :3] += np.sin(amounts)[:, None, None] * K + (1 - np.cos(amounts))[:, None, None] * (K @ K)
        T[:, :3, 3] = self.origin - T[:, :3, :3] @ self.origin
        return T

    def distance(self, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, " n"]:
        """Return the distance of points from the axis [m]."""
        arms = points - self.origin
        across = arms - (arms @ self.axis)[:, None] * self.axis
        return np.sqrt(np.einsum("ij,ij->i", across, across))


@dataclass(frozen=True)
class Sweep:
    """Free range of a motion in both directions from rest [rad or m, both >= 0]."""

    forward: float  # free amount along +axis
    backward: float  # free amount along -axis
    clear_forward: bool  # True if the whole tested range is free
    clear_backward: bool

    def reversed(self) -> Sweep:
        """Return the same ranges of the motion along the opposite axis."""
        return Sweep(self.backward, self.forward, self.clear_backward, self.clear_forward)


@dataclass(frozen=True)
class Handle(Brief):
    """A handle that protrudes from a part's outer face.

    across: (2,) position on the face, -1..1 along the face's long and short side; along: side that it is parallel to (0 long, 1
    short, None for a knob); size: its length relative to the part's diagonal; faces: of the part; way: in which it protrudes.
    """

    across: tuple[float, float]
    along: int | None
    size: float
    faces: Int[np.ndarray, " k"] = field(compare=False, repr=False)
    way: Float[np.ndarray, " 3"] = field(compare=False, repr=False)


@dataclass(frozen=True, eq=False)
class KnownJoint(Brief):
    """A joint that a data set, an annotation or an answer gives, in its own frame and unit; positive opens.

    axis: of any length but zero; limits: (lower, upper) [rad or length], None if the joint is continuous or its range unknown.
    If it is unknown, `range_known` is False, and the sign of the axis has no meaning.
    """

    type: JointType
    origin: Float[np.ndarray, " 3"]
    axis: Float[np.ndarray, " 3"]
    limits: tuple[float, float] | None
    range_known: bool = True

    @property
    def opening_motion(self) -> Motion:
        """Return the motion, signed so that positive covers the larger part of the range."""
        sign = -1.0 if self.limits is not None and sum(self.limits) < 0 else 1.0
        kind = JointType.PRISMATIC if self.type is JointType.PRISMATIC else JointType.REVOLUTE
        return Motion(kind, sign * self.axis / np.linalg.norm(self.axis), self.origin, "known")

    @property
    def opening_range(self) -> tuple[float, float] | None:
        """Return the limits of `opening_motion`."""
        return (-self.limits[1], -self.limits[0]) if self.limits is not None and sum(self.limits) < 0 else self.limits


@dataclass(frozen=True, eq=False)
class StatedJoint(KnownJoint):
    """A joint that the file states for the nodes that refer to it, in the frame of their mesh at rest; limits contain 0.

    name: of the part that it moves; reason: where the file states it; parent: index of the joint that moves its parent, None if
    that is the base. If `axis_known` is False, only the origin is known, as of a bone: type, axis and limits mean nothing.
    """

    name: str = ""
    reason: str = ""
    parent: int | None = None
    axis_known: bool = True

    def transformed(self, T: Float[np.ndarray, "4 4"]) -> StatedJoint:
        """Return the joint of a mesh under a 4x4 transform that keeps angles; a mirroring one turns the other way round."""
        slides, linear = self.type is JointType.PRISMATIC, T[:3, :3]
        axis = linear @ self.axis
        length = float(np.linalg.norm(axis) / np.linalg.norm(self.axis))
        limits = (self.limits[0] * length, self.limits[1] * length) if slides and self.limits is not None else self.limits
        sign = -1.0 if not slides and np.linalg.det(linear) < 0 else 1.0
        return replace(self, origin=linear @ self.origin + T[:3, 3], axis=sign / length * axis, limits=limits)


@dataclass(frozen=True, eq=False)
class Joint:
    """A joint at rest in the asset frame. Positive motion opens.

    origin: a point on the axis [m]; axis: unit; limits: (lower, upper) [rad or m] containing 0, None if and only if the joint
    is continuous or fixed; others: other joints that the part may have, likeliest first, whose confidence is their weight.
    """

    name: str
    type: JointType
    parent: str
    child: str
    origin: Float[np.ndarray, " 3"]
    axis: Float[np.ndarray, " 3"]
    limits: tuple[float, float] | None
    confidence: float
    reason: str
    others: tuple[Joint, ...] = ()

    def __post_init__(self) -> None:
        if not abs(float(np.linalg.norm(self.axis)) - 1) <= 1e-6:  # also rejects NaN
            raise ValueError(f"joint {self.name!r}: axis must be a unit vector, found {self.axis}")
        if not np.isfinite(self.origin).all():
            raise ValueError(f"joint {self.name!r}: origin must be finite, found {self.origin}")
        if not 0 <= self.confidence <= 1:
            raise ValueError(f"joint {self.name!r}: confidence must lie in 0..1, found {self.confidence}")
        if not self.reason:
            raise ValueError(f"joint {self.name!r}: a reason in words is needed")
        limited = self.type in (JointType.REVOLUTE, JointType.PRISMATIC)
        if limited != (self.limits is not None):
            raise ValueError(f"joint {self.name!r}: limits {self.limits} do not match type {self.type}")
        if self.limits is None:
            return
        lower, upper = self.limits
        if not (-np.inf < lower <= 0 <= upper < np.inf and lower < upper):
            raise ValueError(
                f"joint {self.name!r}: limits must be finite and contain the rest pose 0 and a range, found {self.limits}"
            )

    def __repr__(self) -> str:
        axis = f"axis {brief(self.axis)} through {brief(self.origin)}"
        motion = " ".join(f"{self.type} {extent(self)}".split())
        return f"Joint {self.name!r}: {self.child} on {self.parent}, {motion}, {axis}, confidence {self.confidence:.2f}"


def extent(joint: Joint) -> str:
    """Format the range of a joint in degrees or centimetres."""
    if joint.limits is None:
        return "" if joint.type is JointType.FIXED else "endless"
    if joint.type is JointType.PRISMATIC:
        return f"{100 * joint.limits[0]:.1f}..{100 * joint.limits[1]:.1f} cm"
    return f"{np.degrees(joint.limits[0]):.0f}..{np.degrees(joint.limits[1]):.0f} deg"


@dataclass(frozen=True)
class RecognizedLabel:
    """A kind of movable part.

    moves: as answered before any picture of its joint, never FIXED; limits: (lower, upper) from the pose shown [rad, or m];
    count: how many there are; None if unknown.
    """

    label: str
    moves: JointType | None  # None if unknown
    parent: str | None  # another label, or "base"; None if unknown
    limits: tuple[float, float] | None
    count: int | None = None


@dataclass(frozen=True)
class Recognition:
    """The recognized object.

    size: longest side of the real object [m]; front: azimuth of the view that shows the front [deg]; None if unknown.
    """

    category: str
    size: float | None
    labels: tuple[RecognizedLabel, ...]
    front: float | None = None
    machine: bool = False
