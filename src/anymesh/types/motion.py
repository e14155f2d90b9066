"""Motions of parts: recognized kinds, candidate motions with the results of their sweeps, and joints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass, field, replace
from enum import StrEnum
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from anymesh.types.brief import Brief, brief


class JointType(StrEnum):
    """Kind of motion of a part relative to its parent."""

    REVOLUTE = "revolute"
    CONTINUOUS = "continuous"
    PRISMATIC = "prismatic"
    SCREW = "screw"  # turns, and moves along its axis in proportion
    BALL = "ball"  # turns about a point
    FREE = "free"  # only lies there, and can be lifted off
    FIXED = "fixed"


BASE = "base"  # label of the static base
MOVING = (JointType.REVOLUTE, JointType.CONTINUOUS, JointType.PRISMATIC)
SLIDING = (JointType.PRISMATIC, JointType.FREE)  # whose amounts are lengths
STILL = (0.0, 0.0)
HALF_TURN = (-float(np.pi), float(np.pi))


@dataclass(frozen=True, eq=False)
class Motion(Brief):
    """A candidate motion.

    kind: REVOLUTE or PRISMATIC; axis: unit, asset frame; origin: a point on the axis [m, asset frame] (any point for a slide);
    pitch: of a screw, whose kind is REVOLUTE: along the axis for a positive turn [m per turn].
    """

    kind: JointType
    axis: Float[np.ndarray, " 3"]
    origin: Float[np.ndarray, " 3"]
    source: str  # the generator that proposed it, in words
    pitch: float = 0.0

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
        if self.pitch:
            T[:, :3, 3] += self.pitch / (2 * np.pi) * amounts[:, None] * self.axis
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
    If it is unknown, `range_known` is False, and the sign of the axis has no meaning. pitch: of a screw [length per turn].
    """

    type: JointType
    origin: Float[np.ndarray, " 3"]
    axis: Float[np.ndarray, " 3"]
    limits: tuple[float, float] | None
    range_known: bool = True
    pitch: float = 0.0

    @property
    def opening_motion(self) -> Motion:
        """Return the motion, signed so that positive covers the larger part of the range."""
        sign = -1.0 if self.limits is not None and sum(self.limits) < 0 else 1.0
        kind = JointType.PRISMATIC if self.type is JointType.PRISMATIC else JointType.REVOLUTE
        return Motion(kind, sign * self.axis / np.linalg.norm(self.axis), self.origin, "known", self.pitch)

    @property
    def opening_range(self) -> tuple[float, float] | None:
        """Return the limits of `opening_motion`."""
        return (-self.limits[1], -self.limits[0]) if self.limits is not None and sum(self.limits) < 0 else self.limits


@dataclass(frozen=True, eq=False)
class StatedJoint(KnownJoint):
    """A joint that the file states for the nodes that refer to it, in the frame of their mesh at rest; limits contain 0.

    name: of the part that it moves; reason: where the file states it; parent: index of the joint that moves its parent, None if
    that is the base. If `axis_known` is False, only the origin is known, as of a bone: type, axis and limits mean nothing.
    follows: index of the joint that leads it, None without one; ratio: of their amounts [rad or length per rad or length].
    """

    name: str = ""
    reason: str = ""
    parent: int | None = None
    axis_known: bool = True
    follows: int | None = None
    ratio: float = 1.0

    def transformed(self, T: Float[np.ndarray, "4 4"]) -> StatedJoint:
        """Return the joint of a mesh under a 4x4 transform that keeps angles; a mirroring one turns the other way round."""
        slides, linear = self.type is JointType.PRISMATIC, T[:3, :3]
        axis = linear @ self.axis
        length = float(np.linalg.norm(axis) / np.linalg.norm(self.axis))
        limits = (self.limits[0] * length, self.limits[1] * length) if slides and self.limits is not None else self.limits
        sign = -1.0 if not slides and np.linalg.det(linear) < 0 else 1.0
        pitch, origin = sign * length * self.pitch, linear @ self.origin + T[:3, 3]
        return replace(self, origin=origin, axis=sign / length * axis, limits=limits, pitch=pitch)


@dataclass(frozen=True)
class Mimic:
    """How a joint follows another one: its amount is ratio * that of `joint` + offset [rad or m], as in URDF."""

    joint: str
    ratio: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, eq=False)
class Joint:
    """A joint at rest in the asset frame. Positive motion opens.

    origin: a point on the axis [m], the centre of a ball; axis: unit, of a ball the direction of its arm at rest; limits:
    (lower, upper) [rad or m] containing 0, of a ball (0, half the angle of its cone), None if the joint is continuous, free or
    fixed, or a screw or ball without an end; others: other joints that the part may have, likeliest first, whose confidence is
    their weight; mimic: of a follower; pitch: of a screw, along the axis for a positive turn [m per turn].
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
    mimic: Mimic | None = None
    pitch: float = 0.0

    def __post_init__(self) -> None:
        if not abs(float(np.linalg.norm(self.axis)) - 1) <= 1e-6:  # also rejects NaN
            raise ValueError(f"joint {self.name!r}: axis must be a unit vector, found {self.axis}")
        if not np.isfinite(self.origin).all():
            raise ValueError(f"joint {self.name!r}: origin must be finite, found {self.origin}")
        if not 0 <= self.confidence <= 1:
            raise ValueError(f"joint {self.name!r}: confidence must lie in 0..1, found {self.confidence}")
        if not self.reason:
            raise ValueError(f"joint {self.name!r}: a reason in words is needed")
        if not np.isfinite(self.pitch) or (self.pitch != 0) != (self.type is JointType.SCREW):
            raise ValueError(f"joint {self.name!r}: a screw has a pitch [m per turn], other types have 0, found {self.pitch}")
        if self.mimic is not None:
            if self.type not in (*MOVING, JointType.SCREW) or self.name == self.mimic.joint:
                raise ValueError(f"joint {self.name!r}: of type {self.type}, it cannot follow {self.mimic.joint!r}")
            if not np.isfinite((self.mimic.ratio, self.mimic.offset)).all() or not self.mimic.ratio:
                raise ValueError(
                    f"joint {self.name!r}: ratio and offset are finite, the ratio is not 0, found {astuple(self.mimic)[1:]}"
                )
        limited = self.type in (JointType.REVOLUTE, JointType.PRISMATIC)
        if limited != (self.limits is not None) and self.type not in (JointType.SCREW, JointType.BALL):
            raise ValueError(f"joint {self.name!r}: limits {self.limits} do not match type {self.type}")
        if self.limits is None:
            return
        if self.type is JointType.BALL and not (self.limits[0] == 0 and self.limits[1] <= HALF_TURN[1]):
            raise ValueError(f"joint {self.name!r}: limits of a ball are (0, half the angle of its cone), found {self.limits}")
        lower, upper = self.limits
        if not (-np.inf < lower <= 0 <= upper < np.inf and lower < upper):
            raise ValueError(
                f"joint {self.name!r}: limits must be finite and contain the rest pose 0 and a range, found {self.limits}"
            )

    def __repr__(self) -> str:
        axis = f"axis {brief(self.axis)} through {brief(self.origin)}"
        motion = " ".join(f"{self.type} {extent(self)}".split()) + (f", follows {self.mimic.joint}" if self.mimic else "")
        return f"Joint {self.name!r}: {self.child} on {self.parent}, {motion}, {axis}, confidence {self.confidence:.2f}"

    @property
    def span(self) -> tuple[float, float]:
        """Return the range over which the joint is moved [rad or m]: half a turn each way if it is endless, else its limits.

        A ball swings both ways; what is free has no range of its own, and what is fixed none.
        """
        if self.type in (JointType.FIXED, JointType.FREE):
            return STILL
        if self.limits is None:
            return HALF_TURN
        return (-self.limits[1], self.limits[1]) if self.type is JointType.BALL else self.limits


@dataclass(frozen=True, eq=False)
class Loop(Brief):
    """Two links that stay joined as at rest, which the tree of joints does not join: they close a loop.

    origin: [m, asset frame at rest]; axis: unit; kind: REVOLUTE (they turn about the axis), BALL (about the origin), PRISMATIC
    (slide along the axis) or FIXED.
    """

    name: str
    first: str
    second: str
    origin: Float[np.ndarray, " 3"]
    axis: Float[np.ndarray, " 3"]
    kind: JointType = JointType.REVOLUTE

    def __post_init__(self) -> None:
        if self.kind not in LOOP_KINDS:
            raise ValueError(f"loop {self.name!r}: found kind {self.kind}; valid are {', '.join(LOOP_KINDS)}")
        if not abs(float(np.linalg.norm(self.axis)) - 1) <= 1e-6 or not np.isfinite(self.origin).all():
            raise ValueError(f"loop {self.name!r}: the axis is unit and the origin finite, found {self.axis}, {self.origin}")
        if self.first == self.second:
            raise ValueError(f"loop {self.name!r}: it must join two links, found {self.first!r} twice")


LOOP_KINDS = (JointType.REVOLUTE, JointType.BALL, JointType.PRISMATIC, JointType.FIXED)


def leaders(joints: Sequence[Joint]) -> dict[str, Mimic]:
    """Return for each follower, by name, the joint that leads it in the end, which follows none: chains are multiplied out.

    Raise ValueError if a leader is not there, is led in a circle, or is not of the types in MOVING.
    """
    by_name, ways = {j.name: j for j in joints}, dict[str, Mimic]()
    for joint in (j for j in joints if j.mimic is not None):
        at, way, seen = joint, Mimic(joint.name), {joint.name}
        while at.mimic is not None:
            name, ratio, offset = at.mimic.joint, at.mimic.ratio, at.mimic.offset
            if name in seen or name not in by_name or by_name[name].type not in MOVING:
                what = "is led by it" if name in seen else f"is no joint of the types {', '.join(MOVING)}"
                raise ValueError(f"joint {joint.name!r} cannot follow {name!r}, which {what}")
            way, at = Mimic(name, way.ratio * ratio, way.offset + way.ratio * offset), by_name[name]
            seen.add(name)
        ways[joint.name] = way
    return ways


def led(joints: Sequence[Joint], positions: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return positions of joints by name with those of all followers, as their leaders (0 by default) have them."""
    ways = leaders(joints)
    return (
        {**positions, **{n: m.ratio * positions.get(m.joint, 0.0) + m.offset for n, m in ways.items()}} if ways else positions
    )


def with_implied_limits(joints: Sequence[Joint]) -> tuple[Joint, ...]:
    """Return the joints, the followers with the limits that their leaders imply; a turn is continuous if its leader's is."""
    by_name, follows = {j.name: j for j in joints}, leaders(joints)

    def implied(joint: Joint) -> Joint:
        way = follows.get(joint.name)
        if way is None:
            return joint
        ends = None if (of := by_name[way.joint].limits) is None else sorted(way.ratio * end + way.offset for end in of)
        turns = {JointType.REVOLUTE: JointType.CONTINUOUS} if ends is None else {JointType.CONTINUOUS: JointType.REVOLUTE}
        return replace(joint, type=turns.get(joint.type, joint.type), limits=ends and (ends[0], ends[1]))

    return tuple(map(implied, joints))


def extent(joint: Joint) -> str:
    """Format the range of a joint in degrees or centimetres, with the pitch of a screw."""
    pitch = f", {1000 * joint.pitch:.1f} mm a turn" if joint.pitch else ""
    if joint.limits is None:
        return "" if joint.type in (JointType.FIXED, JointType.FREE) else f"endless{pitch}"
    if joint.type is JointType.PRISMATIC:
        return f"{100 * joint.limits[0]:.1f}..{100 * joint.limits[1]:.1f} cm"
    return f"{np.degrees(joint.limits[0]):.0f}..{np.degrees(joint.limits[1]):.0f} deg{pitch}"


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
