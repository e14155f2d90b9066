"""Gymnasium environment of a task on one or several assets.

Observations are the full state, the object as a box, or a point cloud cast by the engine from a camera.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float, Float32

from anymesh.applications.policy.objects_ import TaskObject, find_assets, task_object
from anymesh.applications.policy.robots_ import NAMES
from anymesh.applications.policy.scene_ import TIMESTEP
from anymesh.applications.policy.simulation_ import HORIZON, SUBSTEPS, TaskSimulation
from anymesh.applications.policy.tasks import PolicyTask, Randomization, reward, success
from anymesh.errors import MissingExtraError, OptionError, pip_install

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


try:
    import gymnasium
    from gymnasium.spaces import Box, Dict
except ImportError:
    raise MissingExtraError(f"gymnasium is not installed; {pip_install('policy')} brings it") from None

LARGE = 100.0  # bound of observations

VECTORS = {ObservationKind.STATE: state, ObservationKind.BOX: boxed}


class ArticulatedEnv(gymnasium.Env):
    """Environment of a task on articulated assets, one of which is drawn at each reset.

    The reset option "asset" chooses one by its number. An episode ends with success, or is truncated at the horizon. `info`
    holds asset, success, progress, rise [m] and value of the joint [rad or m].
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": round(1 / (SUBSTEPS * TIMESTEP))}  # noqa: RUF012

    def __init__(
        self,
        objects: Sequence[TaskObject],
        task: PolicyTask,
        *,
        robot: str = "gripper",
        observation: ObservationKind = ObservationKind.STATE,
        randomization: Randomization = Randomization(),  # noqa: B008
        horizon: int = HORIZON,
        render_mode: str | None = None,
    ) -> None:
        if render_mode not in (None, "rgb_array"):
            raise OptionError(f"render_mode: found {render_mode!r}; valid are rgb_array and None")
        self.simulations = [TaskSimulation(object_, task, robot, horizon) for object_ in objects]
        self.task, self.observation, self.randomization, self.render_mode = task, observation, randomization, render_mode
        self.simulation = self.simulations[0]
        self._camera: DepthCamera | None = None
        self._picture: Any = None
        self.action_space = Box(-1.0, 1.0, (len(self.simulation.robot.servos),), np.float32)
        if observation in VECTORS:
            self.observation_space = Box(-LARGE, LARGE, VECTORS[observation](self.simulation).shape, np.float32)
        else:
            own = Box(-LARGE, LARGE, (len(robot_state(self.simulation)),), np.float32)
            self.observation_space = Dict({"robot": own, "points": Box(-LARGE, LARGE, (POINTS, 4), np.float32)})

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Draw an asset and a sample of the randomization. options: "asset", its number."""
        super().reset(seed=seed)
        number = (options or {}).get("asset")
        if number is None:
            number = int(self.np_random.integers(len(self.simulations)))
        elif not 0 <= int(number) < len(self.simulations):
            raise OptionError(f"asset: found {number}; valid are 0 to {len(self.simulations) - 1}")
        self.simulation = self.simulations[int(number)]
        self.simulation.reset(self.randomization.draw(self.np_random))
        self._camera = DepthCamera(self.simulation) if self.observation is ObservationKind.POINTS else None
        measured = self.simulation.measure()
        return self._observe(), self._info(measured.progress, measured.rise, False)

    def step(self, action: Float[np.ndarray, " a"]) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Run one action of 50 ms."""
        measured = self.simulation.act(np.asarray(action, float))
        done = success(self.task, measured)
        info = self._info(measured.progress, measured.rise, done)
        return self._observe(), reward(self.task, measured), done, measured.step >= measured.horizon, info

    def _observe(self) -> Any:
        if self._camera is None:
            return np.clip(VECTORS[self.observation](self.simulation), -LARGE, LARGE)
        return {
            "robot": np.clip(robot_state(self.simulation), -LARGE, LARGE),
            "points": self._camera.points(self.simulation, self.np_random),
        }

    def _info(self, progress: float, rise: float, done: bool) -> dict[str, Any]:
        s = self.simulation
        return {"asset": s.object.name, "success": done, "progress": progress, "rise": rise, "value": s.value}

    def render(self) -> Any:
        """Draw the scene by the project's ray caster."""
        if self.render_mode is None:
            return None
        from anymesh.applications.policy.simulation_ import ScenePicture

        if self._picture is None or self._picture.simulation is not self.simulation:
            self._picture = ScenePicture(self.simulation)
        return self._picture.frame()


def make_env(
    asset: str | Path | Sequence[str | Path],
    task: str,
    *,
    robot: str = "gripper",
    observation: str = "state",
    joint: str | None = None,
    opening: float | None = None,
    randomization: Randomization = Randomization(),  # noqa: B008
    horizon: int = HORIZON,
    render_mode: str | None = None,
) -> ArticulatedEnv:
    """Make a Gymnasium environment from an asset, a URDF or MJCF, a folder of assets, or several of these.

    task: open, close or lift; robot: gripper, shadow, panda or ur5e; observation: state, box or points; joint: which one the
    task moves (default: that of the largest part); opening: from closed [rad or m] (default: 90 degrees or the whole range).
    Raise InputError or OptionError if an asset does not fit the task, MissingExtraError if a package is not installed.
    """
    if task not in list(PolicyTask):
        raise OptionError(f"--task: found {task!r}; valid are {', '.join(PolicyTask)}")
    if observation not in list(ObservationKind):
        raise OptionError(f"--observation: found {observation!r}; valid are {', '.join(ObservationKind)}")
    if robot not in NAMES:
        raise OptionError(f"--robot: found {robot!r}; valid are {', '.join(NAMES)}")
    if horizon < 1:
        raise OptionError(f"--horizon must be 1 or more, found {horizon}")
    objects = [task_object(path, PolicyTask(task), joint, opening) for path in find_assets(asset)]
    return ArticulatedEnv(
        objects,
        PolicyTask(task),
        robot=robot,
        observation=ObservationKind(observation),
        randomization=randomization,
        horizon=horizon,
        render_mode=render_mode,
    )
