"""Observations: the full state, the object as a box, and a point cloud cast by the engine from a camera."""

from __future__ import annotations

from enum import StrEnum

import numpy as np
from jaxtyping import Float32

from anymesh.applications.policy.simulation_ import TaskSimulation

POINTS = 512  # of the cloud, as DexArt's
GRID = 32  # rays per side of the camera
FOV = np.deg2rad(40)
REACH = 10.0  # [m] of the rays
EYE = np.array([-0.35, -0.75, 0.65])  # [m] of the camera, from the handle point at the start


class ObservationKind(StrEnum):
    """What a policy observes."""

    STATE = "state"
    BOX = "box"
    POINTS = "points"


def robot_state(s: TaskSimulation) -> Float32[np.ndarray, " n"]:
    """Return the robot's state: its joints, tool, contacts, commands, and the time (as DexArt's robot state)."""
    velocity = np.zeros(6)
    s.mujoco.mj_objectVelocity(s.model, s.data, s.mujoco.mjtObj.mjOBJ_SITE, s.tool_site, velocity, 0)
    tool = s.tool_rotation
    moves = s.robot.rate > 0
    command = (s.command - s.data.qpos[s.command_at])[moves] / s.robot.rate[moves]  # steps that the commands are ahead
    parts = (s.data.qpos[s.robot_at], s.tool_position, velocity, tool[:, 2], tool[:, 1], command, s.fingers)
    return np.concatenate([*parts, [s.step / s.horizon]]).astype(np.float32)


def state(s: TaskSimulation) -> Float32[np.ndarray, " n"]:
    """Return the robot's state and the object's: handle point and axis from the tool, progress and rise."""
    tool, data = s.tool_position, s.data
    joint = s.model.dof_jntid[s.dof]
    anchor, axis = data.xanchor[joint], data.xaxis[joint]
    lever = s.handle_position - anchor
    progress = s.object.goal.progress(s.value)
    rise = data.xpos[s.stand, 2] - s.start_height
    own = (10 * (s.handle_position - tool), 5 * (anchor - tool), axis, 5 * lever, [progress, 5 * rise])
    return np.concatenate([robot_state(s), *own]).astype(np.float32)


def boxed(s: TaskSimulation) -> Float32[np.ndarray, " n"]:
    """Return the robot's state and what a detector measures of the object: its box at the start, where it is, and the progress.

    The handle and the axis are not observed; their places in the box differ between objects.
    """
    R, T = s.data.xmat[s.stand].reshape(3, 3), s.object.T_world_asset
    low, high = s.object.box
    center = R @ (T[:3, :3].T @ ((low + high) / 2 - T[:3, 3])) + s.data.xpos[s.stand]
    turn = R @ T[:3, :3].T
    progress = s.object.goal.progress(s.value)
    own = (5 * (center - s.tool_position), 5 * (high - low), turn[:2, 0], [progress, 5 * (center[2] - (low + high)[2] / 2)])
    return np.concatenate([robot_state(s), *own]).astype(np.float32)


class DepthCamera:
    """Depth camera that sees the object at its start; its rays are cast by the engine against collision shapes."""

    def __init__(self, s: TaskSimulation) -> None:
        target = s.handle_at_start
        self.eye = target + EYE
        ahead = -EYE / np.linalg.norm(EYE)
        right = np.cross(ahead, [0, 0, 1])
        right /= np.linalg.norm(right)
        up = np.cross(right, ahead)
        u, v = np.meshgrid(*[np.tan(FOV / 2) * np.linspace(-1, 1, GRID)] * 2)
        ways = ahead + u.reshape(-1, 1) * right + v.reshape(-1, 1) * up
        self._ways = np.ascontiguousarray(ways / np.linalg.norm(ways, axis=1, keepdims=True))
        self._groups = np.ones(6, np.uint8)

    def points(self, s: TaskSimulation, rng: np.random.Generator) -> Float32[np.ndarray, "n 4"]:
        """Return `POINTS` points of object and robot from the tool [m], with 1 for those of the robot; zeros where too few.

        Points of the floor are removed.
        """
        count = len(self._ways)
        geom, distance = np.zeros(count, np.int32), np.zeros(count)
        s.mujoco.mj_multiRay(
            s.model, s.data, self.eye, self._ways.reshape(-1), self._groups, 1, -1, geom, distance, None, count, 10.0
        )
        seen = np.flatnonzero(geom >= 0)
        seen = seen[s.is_object[geom[seen]] | s.is_robot[geom[seen]]]
        if len(seen) > POINTS:
            seen = np.sort(rng.choice(seen, POINTS, replace=False))
        cloud = np.zeros((POINTS, 4), np.float32)
        cloud[: len(seen), :3] = self.eye + distance[seen, None] * self._ways[seen] - s.tool_position
        cloud[: len(seen), 3] = s.is_robot[geom[seen]]
        return cloud
