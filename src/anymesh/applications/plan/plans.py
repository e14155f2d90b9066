"""Types of planning: poses of a gripper on a part, and plans with their trajectories; their files.

A trajectory is written as the project's JSON with all data, as CSV, or in the layout of ROS' trajectory_msgs/JointTrajectory.
"""

from __future__ import annotations

import csv
import io
import json
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any, assert_never

import numpy as np
from jaxtyping import Float

from anymesh.errors import InputError, OptionError, OutputError
from anymesh.types import Brief

UNITS = {"": 1.0, "rad": 1.0, "m": 1.0, "deg": math.pi / 180, "mm": 1e-3, "cm": 1e-2}
VALUE = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([a-z]*)\s*")
VERSION = 1
DIGITS = 9  # decimals of positions and their derivatives: 1e-9 rad
SECOND = 1_000_000_000  # [ns]


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
class Target(Brief):
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
class Trajectory(Brief):
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


class PlanFormat(StrEnum):
    """File format of a trajectory."""

    JSON = "json"
    CSV = "csv"
    ROS = "ros"  # trajectory_msgs/JointTrajectory as JSON, which is also valid YAML


def write_plan(plan: MotionPlan, path: Path, kind: str = PlanFormat.JSON, *, force: bool = False) -> None:
    """Write a plan, completely or not at all. Raise OptionError for an unknown format, OutputError if writing fails."""
    if kind not in list(PlanFormat):
        raise OptionError(f"--format: found {kind!r}; valid are {', '.join(PlanFormat)}")
    if path.exists() and not force:
        raise OutputError(f"{path} exists; --force replaces it")
    fresh = path.with_name(f".{path.name}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        fresh.write_text(plan_text(plan, PlanFormat(kind)), encoding="utf-8", newline="\n")
        fresh.replace(path)
    except OSError as error:
        fresh.unlink(missing_ok=True)
        raise OutputError(f"cannot write {path}: {error.strerror or error}") from error


def plan_text(plan: MotionPlan, kind: PlanFormat) -> str:
    """Return the content of the file in the given format."""
    match kind:
        case PlanFormat.JSON:
            return json.dumps(plan_record(plan), indent=1) + "\n"
        case PlanFormat.CSV:
            return _csv(plan.trajectory)
        case PlanFormat.ROS:
            return json.dumps(ros_record(plan.trajectory), indent=1) + "\n"
        case _:
            assert_never(kind)


def plan_record(plan: MotionPlan) -> dict[str, Any]:
    """Return the whole plan as plain values, without planning times, so that the same plan gives the same text."""
    t = plan.trajectory
    return {
        "version": VERSION,
        "asset": plan.asset,
        "robot": plan.robot,
        "joint": plan.joint,
        "part": plan.part,
        "unit": plan.unit,
        "value": list(plan.value),
        "base": {"x": plan.base.x, "y": plan.base.y, "z": plan.base.z, "yaw": plan.base.yaw},
        "target": {
            "contact": plan.target.contact.value,
            "width": round(plan.target.width, DIGITS),
            "score": round(plan.target.score, DIGITS),
            "T_asset_tool": np.round(plan.target.T_asset_tool, DIGITS).tolist(),
        },
        "joints": list(t.joints),
        "duration": round(t.duration, DIGITS),
        "notes": list(plan.notes),
        "waypoints": [
            {
                "time": round(float(t.time[k]), DIGITS),
                "phase": t.phase[k].value,
                "position": _numbers(t.position[k]),
                "velocity": _numbers(t.velocity[k]),
                "acceleration": _numbers(t.acceleration[k]),
                "gap": round(float(t.gap[k]), DIGITS),
                "value": round(float(t.value[k]), DIGITS),
            }
            for k in range(len(t.time))
        ],
    }


def _numbers(row: np.ndarray) -> list[float]:
    return [round(float(v), DIGITS) + 0.0 for v in row]


def read_plan(path: str | Path) -> MotionPlan:
    """Read a plan from the project's JSON. Raise InputError if the file holds none."""
    path = Path(path)
    try:
        return _plan(json.loads(path.read_text(encoding="utf-8")))
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(f"{path.name} is not a plan of anymesh ({type(error).__name__}: {error})") from None


def _plan(record: Mapping[str, Any]) -> MotionPlan:
    if record["version"] != VERSION:
        raise ValueError(f"version {record['version']}, valid is {VERSION}")
    rows, target = record["waypoints"], record["target"]

    def column(name: str) -> np.ndarray:
        return np.array([row[name] for row in rows], float)

    trajectory = Trajectory(
        tuple(record["joints"]),
        column("time"),
        column("position"),
        column("velocity"),
        column("acceleration"),
        column("gap"),
        tuple(Phase(row["phase"]) for row in rows),
        column("value"),
    )
    pose = Target(GripperContact(target["contact"]), np.array(target["T_asset_tool"], float), target["width"], target["score"])
    first, last = record["value"]
    base = BasePose(**record["base"])
    names = (record[name] for name in ("asset", "robot", "joint", "part", "unit"))
    return MotionPlan(*names, (first, last), base, pose, trajectory, {}, tuple(record["notes"]))


def _csv(t: Trajectory) -> str:
    """Return one row per sample: time [s], phase, position, velocity and acceleration per joint, gap, value of the part."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    heads = [f"{word}_{joint}" for word in ("position", "velocity", "acceleration") for joint in t.joints]
    writer.writerow(["time", "phase", *heads, "gap", "value"])
    for k in range(len(t.time)):
        numbers = [*_numbers(t.position[k]), *_numbers(t.velocity[k]), *_numbers(t.acceleration[k])]
        writer.writerow(
            [round(float(t.time[k]), 6), t.phase[k].value, *numbers, round(float(t.gap[k]), 6), round(float(t.value[k]), 6)]
        )
    return text.getvalue()


def ros_record(t: Trajectory) -> dict[str, Any]:
    """Return exactly the fields of trajectory_msgs/JointTrajectory (ROS 2), so that the record can be published unchanged."""
    points = [
        {
            "positions": _numbers(t.position[k]),
            "velocities": _numbers(t.velocity[k]),
            "accelerations": _numbers(t.acceleration[k]),
            "effort": [],
            "time_from_start": _stamp(float(t.time[k])),
        }
        for k in range(len(t.time))
    ]
    header = {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": ""}
    return {"header": header, "joint_names": list(t.joints), "points": points}


def _stamp(seconds: float) -> dict[str, int]:
    whole = round(seconds * SECOND)
    return {"sec": whole // SECOND, "nanosec": whole % SECOND}


def gripper_commands(t: Trajectory) -> list[dict[str, Any]]:
    """Return the commanded gaps of the fingers [m] with their times from start [s], for control_msgs/GripperCommand."""
    changes = np.r_[0, np.flatnonzero(np.diff(t.gap)) + 1]
    return [{"time": round(float(t.time[k]), 6), "gap": round(float(t.gap[k]), 6)} for k in changes]
