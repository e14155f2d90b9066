"""Types of grasps, and their file."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.applications.policy.robots_ import REACH, Gripper
from anymesh.errors import InputError, OutputError
from anymesh.runtime import write_whole
from anymesh.types import Brief

VERSION, DIGITS = 1, 6
NAME, FINGER = "grasps.json", ("length", "width", "thickness")


class GraspKind(StrEnum):
    """What the gripper meets."""

    HANDLE = "handle"
    PIECE = "piece"  # a small piece of the part, such as a knob
    EDGE = "edge"  # a wall of the part at its edge, rim or lip
    WHOLE = "whole"  # the whole part is between the fingers
    PUSH = "push"  # nothing is held: the tips of the closed fingers press on the part
    HOOK = "hook"  # nothing is held: the side of the closed fingers presses on the part from behind an edge or in a recess
    RUB = "rub"  # nothing is held: the tips press on a surface and take it along by friction


@dataclass(frozen=True, eq=False)
class Grasp(Brief):
    """Pose of the gripper on a part at rest, and what it did in the simulation.

    T_link_tool: (4, 4) in the frame of the joint's link, z along the approach, y along the closing direction, origin between
    the pads of the fingers; width: of what is grasped [m], 0 where nothing is held; score: 0..1, mean share of the motion in
    all trials; reached: value of the joint in the first trial [rad or m]; slip: of the gripper along the part in it [m].
    """

    kind: GraspKind
    T_link_tool: Float[np.ndarray, "4 4"]
    width: float
    score: float
    reached: float
    slip: float

    @property
    def prehensile(self) -> bool:
        """Whether the fingers hold the part."""
        return self.kind not in (GraspKind.PUSH, GraspKind.HOOK, GraspKind.RUB)


@dataclass(frozen=True, eq=False)
class JointGrasps(Brief):
    """Grasps of the part of a joint, best first.

    goal: of the motion from rest [rad or m]; after: other joints that are opened first, since they are in the way, with their
    values; reason: why there is no grasp, else "".
    """

    joint: str
    link: str
    goal: float
    grasps: tuple[Grasp, ...]
    after: tuple[tuple[str, float], ...] = ()
    reason: str = ""


def write_grasps(path: Path, found: Sequence[JointGrasps], gripper: Gripper, seed: int) -> None:
    """Write the file, completely or not at all. Raise OutputError if it cannot be written."""
    try:
        write_whole(path, (json.dumps(grasps_record(found, gripper, seed), indent=1) + "\n").encode())
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror or error}") from error


def grasps_record(found: Sequence[JointGrasps], gripper: Gripper, seed: int) -> dict[str, Any]:
    """Return the content of the file."""
    finger = dict(zip(FINGER, gripper.finger, strict=True))
    hand = {"stroke": gripper.stroke, "finger": finger | {"tip": REACH}, "force": gripper.force}
    return {"version": VERSION, "gripper": hand, "seed": seed, "joints": [_joint(j) for j in found]}


def _joint(j: JointGrasps) -> dict[str, Any]:
    grasps = [
        {
            "kind": g.kind.value,
            "prehensile": g.prehensile,
            "pose": (np.round(g.T_link_tool, DIGITS) + 0.0).tolist(),
            **{k: round(float(getattr(g, k)), DIGITS) + 0.0 for k in ("width", "score", "reached", "slip")},
        }
        for g in j.grasps
    ]
    more: dict[str, Any] = {"reason": j.reason} if j.reason else {}
    if j.after:
        more["after"] = {name: round(value, DIGITS) for name, value in j.after}
    return {"joint": j.joint, "link": j.link, "goal": round(j.goal, DIGITS), **more, "grasps": grasps}


def read_grasps(path: str | Path) -> tuple[Gripper, tuple[JointGrasps, ...]]:
    """Read the file: the gripper that was assumed, and the grasps of each joint. Raise InputError if it holds none."""
    path = Path(path)
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        if record["version"] != VERSION:
            raise ValueError(f"version {record['version']}, valid is {VERSION}")
        hand = record["gripper"]
        finger = [float(hand["finger"][k]) for k in FINGER]
        return Gripper(hand["stroke"], (finger[0], finger[1], finger[2]), hand["force"]), tuple(
            _read(j) for j in record["joints"]
        )
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
        raise InputError(f"{path.name} holds no grasps of anymesh ({type(error).__name__}: {error})") from None


def _read(j: dict[str, Any]) -> JointGrasps:
    grasps = []
    for g in j["grasps"]:
        T = np.array(g["pose"], float)
        if T.shape != (4, 4) or not np.allclose(T[:3, :3] @ T[:3, :3].T, np.eye(3), atol=1e-3):
            raise ValueError(f"the pose {g['pose']} of {j['joint']} is no rigid transform")
        grasps.append(Grasp(GraspKind(g["kind"]), T, *(float(g[k]) for k in ("width", "score", "reached", "slip"))))
    after = tuple((name, float(value)) for name, value in j.get("after", {}).items())
    return JointGrasps(j["joint"], j["link"], float(j["goal"]), tuple(grasps), after, j.get("reason", ""))
