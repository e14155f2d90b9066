"""Nouns of planning: poses of a gripper on a part, what an arm can do, and its trajectory."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from jaxtyping import Float

from anymesh.errors import OptionError


class PlanError(OptionError):
    """No motion does what was asked: out of reach, in collision, or beyond a limit; the message says which.

    nearest: the nearest value of the joint that can be reached [rad or m], None where none is known.
    """

    def __init__(self, message: str, nearest: float | None = None) -> None:
        super().__init__(message)
        self.nearest = nearest


class GripperContact(StrEnum):
    """How the gripper meets the part."""

    GRASP = "grasp"  # the fingers close on it
    PUSH = "push"  # the closed fingers press on it


class Phase(StrEnum):
    """What the arm does between two stops."""

    APPROACH = "approach"  # through free space, planned
    REACH = "reach"  # straight to the part
    CLOSE = "close"  # the fingers close, the arm stands
    MOVE = "move"  # the part along its joint
    HOLD = "hold"
    OPEN = "open"  # the fingers open, the arm stands
    RETREAT = "retreat"  # straight away from the part


@dataclass(frozen=True, eq=False)
class Target:
    """A pose of the tool on a part at rest.

    T_asset_tool: (4, 4), the tool's z is where it comes from to where it goes, its y the way the fingers close, its origin
    between their pads; width: of what is grasped [m], 0 for a push; score: larger is tried earlier.
    """

    contact: GripperContact
    T_asset_tool: Float[np.ndarray, "4 4"]
    width: float
    score: float


@dataclass(frozen=True)
class BasePose:
    """Where the robot stands in the asset frame: x, y, z [m], yaw [rad]."""

    x: float
    y: float
    z: float
    yaw: float

    def __post_init__(self) -> None:
        if not np.isfinite((self.x, self.y, self.z, self.yaw)).all():
            raise OptionError(f"a base needs four finite numbers X,Y,Z,YAW, found {self}")

    @classmethod
    def parse(cls, text: str) -> BasePose:
        """Parse "X,Y,Z,YAW" [m, m, m, deg]. Raises OptionError."""
        try:
            x, y, z, yaw = (float(word) for word in text.split(","))
        except ValueError:
            raise OptionError(f"--base: found {text!r}; valid are auto or X,Y,Z,YAW in metres and degrees") from None
        return cls(x, y, z, float(np.deg2rad(yaw)))

    @property
    def transform(self) -> Float[np.ndarray, "4 4"]:
        """(4, 4) from the robot's frame to the asset's."""
        c, s = np.cos(self.yaw), np.sin(self.yaw)
        return np.array([[c, -s, 0, self.x], [s, c, 0, self.y], [0, 0, 1, self.z], [0, 0, 0, 1]])

    def __str__(self) -> str:
        return f"{self.x:.3f},{self.y:.3f},{self.z:.3f},{np.rad2deg(self.yaw):.1f}"


@dataclass(frozen=True, eq=False)
class Trajectory:
    """What the arm does, sampled.

    joints: names of the arm's, as the robot's file has them; time: (n,) from 0 [s]; position, velocity, acceleration: (n, J)
    [rad, rad/s, rad/s2]; gap: (n,) between the fingers that is commanded, 0 is closing with full force [m]; phase: of each
    sample; value: (n,) where the part's joint is meant to be [rad or m].
    """

    joints: tuple[str, ...]
    time: Float[np.ndarray, " n"]
    position: Float[np.ndarray, "n J"]
    velocity: Float[np.ndarray, "n J"]
    acceleration: Float[np.ndarray, "n J"]
    gap: Float[np.ndarray, " n"]
    phase: tuple[Phase, ...]
    value: Float[np.ndarray, " n"]

    def __post_init__(self) -> None:
        count = len(self.time)
        if any(
            len(rows) != count for rows in (self.position, self.velocity, self.acceleration, self.gap, self.phase, self.value)
        ):
            raise ValueError(f"a trajectory has one row a time, found {count} times and others")
        if count < 2 or not (np.diff(self.time) > 0).all():
            raise ValueError("the times of a trajectory must rise")

    @property
    def duration(self) -> float:
        """Of the whole [s]."""
        return float(self.time[-1])


@dataclass(frozen=True, eq=False)
class MotionPlan:
    """A trajectory and what it is for.

    asset, robot, joint, part: names; value: from, to [rad or m]; unit: rad or m; target: at rest; seconds: that each step of
    planning took; notes: what was tried and dropped, in words.
    """

    asset: str
    robot: str
    joint: str
    part: str
    unit: str
    value: tuple[float, float]
    base: BasePose
    target: Target
    trajectory: Trajectory
    seconds: Mapping[str, float]
    notes: tuple[str, ...] = ()
