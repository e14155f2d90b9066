"""Trajectory files: the project's JSON with all data, CSV, and the layout of ROS' trajectory_msgs/JointTrajectory."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping
from enum import StrEnum
from pathlib import Path
from typing import Any, assert_never

import numpy as np

from anymesh.applications.plan.plans import BasePose, GripperContact, MotionPlan, Phase, Target, Trajectory
from anymesh.errors import InputError, OptionError, OutputError

VERSION = 1
DIGITS = 9  # decimals of positions and their derivatives: 1e-9 rad
SECOND = 1_000_000_000  # [ns]


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
