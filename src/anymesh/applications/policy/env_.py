"""Gymnasium environment of a task on one or several assets."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.applications.policy.objects_ import TaskObject, find_assets, task_object
from anymesh.applications.policy.observations_ import POINTS, DepthCamera, ObservationKind, boxed, robot_state, state
from anymesh.applications.policy.randomization import Randomization
from anymesh.applications.policy.robots import NAMES
from anymesh.applications.policy.scene_ import TIMESTEP
from anymesh.applications.policy.simulation_ import HORIZON, SUBSTEPS, TaskSimulation
from anymesh.applications.policy.tasks import PolicyTask, reward, success
from anymesh.errors import MissingExtraError, OptionError

try:
    import gymnasium
    from gymnasium.spaces import Box, Dict
except ImportError:
    raise MissingExtraError("gymnasium is not installed; `pip install 'articulate-anymesh[policy]'` brings it") from None

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
        from anymesh.applications.policy.pictures_ import ScenePicture

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
