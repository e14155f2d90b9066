"""Animation of an asset: all joints at once through their whole range and back, in a loop."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Float32

from anymesh.export.settings import ExportConfig
from anymesh.types import Joint, JointType


@dataclass(frozen=True, eq=False)
class Track:
    """Keys of one joint.

    times: ascending [s]; amounts: at these times [rad or m].
    """

    joint: Joint
    times: Float32[np.ndarray, " n"]
    amounts: Float[np.ndarray, " n"]

    def values(self, rest: Float[np.ndarray, " 3"]) -> tuple[str, Float32[np.ndarray, "n k"]]:
        """Return the glTF path and its keys: quaternions xyzw without sign changes, or translations from `rest` [m]."""
        if self.joint.type is JointType.PRISMATIC:
            return "translation", (rest + self.amounts[:, None] * self.joint.axis).astype(np.float32)
        half = self.amounts[:, None] / 2
        quaternion = np.hstack([np.sin(half) * self.joint.axis, np.cos(half)])
        return "rotation", (quaternion / np.linalg.norm(quaternion, axis=1, keepdims=True)).astype(np.float32)


def tracks(joints: Sequence[Joint], config: ExportConfig) -> tuple[Track, ...]:
    """Return keys of all moving joints: first up to the upper limits and back, then down to the lower ones and back.

    A direction that no joint has is left out. A joint without it rests in the meantime. Continuous joints rotate once, at
    constant speed.
    """
    moving = [j for j in joints if j.type is not JointType.FIXED]
    up = any(j.limits is None or j.limits[1] > 0 for j in moving)
    down = any(j.limits is not None and j.limits[0] < 0 for j in moving)
    length = config.seconds_a_way * (up + down)
    return tuple(_track(j, up, length, config) for j in moving)


def _track(joint: Joint, up: bool, length: float, config: ExportConfig) -> Track:
    turns = joint.type is not JointType.PRISMATIC
    step = np.deg2rad(config.degrees_a_key)
    if joint.limits is None:
        count = int(np.ceil(2 * np.pi / step))
        whole = np.linspace(0, 1, count + 1)
        return Track(joint, (length * whole).astype(np.float32), 2 * np.pi * whole)
    times, amounts = [0.0], [0.0]
    for limit, begin in ((joint.limits[1], 0.0), (joint.limits[0], config.seconds_a_way * up)):
        if limit == 0:
            continue
        half = int(np.ceil(abs(limit) * np.pi / 2 / step)) if turns else 0  # the steepest step of the cosine
        count = 2 * max(12, half)
        share = np.linspace(0, 1, count + 1)
        if begin > times[-1]:
            times.append(begin)
            amounts.append(0.0)
        times += (begin + config.seconds_a_way * share[1:]).tolist()
        amounts += (limit * (1 - np.cos(2 * np.pi * share[1:])) / 2).tolist()
    amounts[-1] = 0.0
    if times[-1] < length:
        times.append(length)
        amounts.append(0.0)
    return Track(joint, np.array(times, np.float32), np.array(amounts))
