"""Forward and inverse kinematics of the arm with mink, on MuJoCo."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.applications.plan.hand_ import Hand
from anymesh.applications.plan.robot_ import RobotArm, quaternion, without_visuals
from anymesh.errors import MissingExtraError, pip_install
from anymesh.mujoco_ import load_mujoco

TOOL = "anymesh_tool"  # name of the site added to the wrist
POSITION_TOLERANCE_M, ANGLE_TOLERANCE_RAD = 1e-6, 1e-6  # [m], [rad] largest error of a solution
STEPS = 40  # Gauss-Newton steps per seed
GIVE_UP = 12  # steps after which a seed is dropped unless its error is below `HOPE`
HOPE = 0.15  # [m] or [rad]
MARGIN = 0.02  # [rad] distance of solutions from the joint limits, reserved for tracking


class Kinematics:
    """Kinematic model of the arm alone, its base at the origin."""

    def __init__(self, robot: RobotArm, hand: Hand) -> None:
        try:
            import mink
        except ImportError:
            raise MissingExtraError(f"mink is missing; install it with {pip_install('plan')}") from None
        self.mujoco = load_mujoco()
        self._mink: Any = mink
        self.robot = robot
        self.model = _arm_alone(self.mujoco, robot, hand)
        self._configuration = mink.Configuration(self.model)
        self._task = mink.FrameTask(TOOL, "site", position_cost=1.0, orientation_cost=0.3, gain=1.0, lm_damping=1e-6)
        self._limits = [mink.ConfigurationLimit(self.model)]
        self.low, self.high = robot.limits[:, 0] + MARGIN, robot.limits[:, 1] - MARGIN
        self.shoulder, self.reach = self._reach()

    def _reach(self) -> tuple[Float[np.ndarray, " 3"], float]:
        """Return the position of the second joint at home, and the reach from there [m], estimated from 300 random postures."""
        self._configuration.update(self.robot.home)
        shoulder = np.array(self._configuration.data.xanchor[self.model.joint(self.robot.joints[1]).id])
        postures = np.random.default_rng(0).uniform(self.low, self.high, (300, len(self.low)))
        return shoulder, max(float(np.linalg.norm(self.forward(q)[:3, 3] - shoulder)) for q in postures)

    def forward(self, posture: Float[np.ndarray, " J"]) -> Float[np.ndarray, "4 4"]:
        """Return the transform from the tool's frame to the base's."""
        self._configuration.update(np.asarray(posture, float))
        return np.array(self._configuration.get_transform_frame_to_world(TOOL, "site").as_matrix())

    def solve(self, T_base_tool: Float[np.ndarray, "4 4"], seed: Float[np.ndarray, " J"]) -> Float[np.ndarray, " J"] | None:
        """Return a posture near the seed that brings the tool to a pose; None if none is found within the limits."""
        self._configuration.update(np.clip(seed, self.low, self.high))
        self._task.set_target(self._mink.SE3.from_matrix(T_base_tool))
        for step in range(STEPS):
            error = self._task.compute_error(self._configuration)
            off, turned = float(np.linalg.norm(error[:3])), float(np.linalg.norm(error[3:]))
            if off < POSITION_TOLERANCE_M and turned < ANGLE_TOLERANCE_RAD:
                posture = self._configuration.q.copy()
                return posture if ((posture >= self.low - 1e-9) & (posture <= self.high + 1e-9)).all() else None
            if step == GIVE_UP and max(off, turned) > HOPE:
                return None
            try:
                velocity = self._mink.solve_ik(self._configuration, [self._task], 1.0, "daqp", limits=self._limits)
            except self._mink.NoSolutionFound:
                return None
            longest = float(np.abs(velocity).max())
            self._configuration.integrate_inplace(velocity * min(1.0, 0.6 / max(longest, 1e-9)), 1.0)
        return None

    def search(
        self, T_base_tool: Float[np.ndarray, "4 4"], rng: np.random.Generator, tries: int, near: Iterable[np.ndarray] = ()
    ) -> Iterable[Float[np.ndarray, " J"]]:
        """Yield distinct postures that bring the tool to a pose, seeded by `near`, the home posture and random postures."""
        postures: list[np.ndarray] = []
        spread = np.minimum(self.high - self.low, 2 * np.pi)
        middle = (self.low + self.high) / 2
        seeds = [*near, self.robot.home, *(middle + spread * (rng.random((tries, len(spread))) - 0.5))]
        for seed in seeds:
            posture = self.solve(T_base_tool, seed)
            if posture is not None and all(np.abs(posture - other).max() > 0.1 for other in postures):
                postures.append(posture)
                yield posture


def _arm_alone(mujoco: Any, robot: RobotArm, hand: Hand) -> Any:
    """Return a model of the arm's links without shapes, with the gripper's joints fixed and a site at the tool."""
    spec = without_visuals(robot.spec)
    for things in (spec.actuators, spec.equalities, spec.tendons, spec.sensors, spec.excludes, spec.geoms, spec.meshes):
        for thing in list(things):
            spec.delete(thing)
    for joint in [j for j in spec.joints if j.name not in robot.joints]:
        spec.delete(joint)
    for body in spec.bodies[1:]:
        body.explicitinertial, body.mass, body.inertia = True, 1.0, [1.0, 1.0, 1.0]  # the shapes that gave inertia are deleted
        body.fullinertia = [np.nan] * 6
    T = hand.T_wrist_tool
    spec.body(robot.wrist).add_site(name=TOOL, pos=T[:3, 3], quat=quaternion(T[:3, :3]))
    return spec.compile()
