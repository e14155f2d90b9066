"""Types of planning: poses of a gripper on a part, and plans with their trajectories."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from jaxtyping import Float

from anymesh.errors import OptionError

UNITS = {"": 1.0, "rad": 1.0, "m": 1.0, "deg": math.pi / 180, "mm": 1e-3, "cm": 1e-2}
VALUE = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([a-z]*)\s*")


class PlanError(OptionError):
    """Error if no motion reaches the requested value; the message states whether reach, a collision or a limit prevents it.

    nearest: the nearest value of the joint that can be reached [rad or m], None if unknown.
    """

    def __init__(self, message: str, nearest: float | None = None) -> None:
        super().__init__(message)
        self.nearest = nearest


class GripperContact(StrEnum):
    """How the gripper meets the part."""

    GRASP = "grasp"  # the fingers close on it
    PUSH = "push"  # the closed fingers press on it


class Phase(StrEnum):
    """Phase of a trajectory."""

    APPROACH = "approach"  # through free space, planned
    REACH = "reach"  # straight to the part
    CLOSE = "close"  # the fingers close, the arm is at rest
    MOVE = "move"  # the part moves along its joint
    HOLD = "hold"
    OPEN = "open"  # the fingers open, the arm is at rest
    RETREAT = "retreat"  # straight away from the part


@dataclass(frozen=True, eq=False)
class Target:
    """Pose of the tool on a part at rest.

    T_asset_tool: (4, 4), z along the approach, y along the closing direction of the fingers, origin between their pads;
    width: of what is grasped [m], 0 for a push; score: targets with higher scores are tried first.
    """

    contact: GripperContact
    T_asset_tool: Float[np.ndarray, "4 4"]
    width: float
    score: float


@dataclass(frozen=True)
class BasePose:
    """Pose of the robot's base in the asset frame: x, y, z [m], yaw [rad]."""

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
        """Transform (4, 4) from the robot's frame to the asset's."""
        c, s = np.cos(self.yaw), np.sin(self.yaw)
        return np.array([[c, -s, 0, self.x], [s, c, 0, self.y], [0, 0, 1, self.z], [0, 0, 0, 1]])

    def __str__(self) -> str:
        return f"{self.x:.3f},{self.y:.3f},{self.z:.3f},{np.rad2deg(self.yaw):.1f}"


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Sampled trajectory of the arm and the gripper.

    joints: names of the arm's joints in the robot's file; time: (n,) from 0 [s]; position, velocity, acceleration: (n, J)
    [rad, rad/s, rad/s2]; gap: (n,) commanded between the fingers [m], 0 to close with full force; phase: of each sample;
    value: (n,) planned value of the part's joint [rad or m].
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
            raise ValueError(f"a trajectory has one row per time, found {count} times and others")
        if count < 2 or not (np.diff(self.time) > 0).all():
            raise ValueError("the times of a trajectory must increase")

    @property
    def duration(self) -> float:
        """Duration of the trajectory [s]."""
        return float(self.time[-1])


@dataclass(frozen=True, eq=False)
class MotionPlan:
    """Trajectory with its task and statistics.

    asset, robot, joint, part: names; value: from, to [rad or m]; unit: rad or m; target: at rest; seconds: of each step of
    planning; notes: what was tried and dropped, in words.
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


def parse_value(text: str) -> float:
    """Return a joint's value [rad or m] from a number with an optional unit. Raise OptionError if the text is not valid."""
    match = VALUE.fullmatch(text)
    if match is None or match[2] not in UNITS:
        units = ", ".join(name for name in UNITS if name)
        raise OptionError(f"--to: found {text!r}; valid is a number, in radians or metres or followed by one of {units}")
    return float(match[1]) * UNITS[match[2]]
