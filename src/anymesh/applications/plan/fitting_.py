"""Test whether the gripper alone fits at a target; the result is independent of the robot's base."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float

from anymesh.applications.plan.asset_ import ArticulatedObject
from anymesh.applications.plan.hand_ import PAD, Hand
from anymesh.applications.plan.plans import GripperContact, Target
from anymesh.applications.plan.robot_ import RobotArm
from anymesh.applications.plan.scene_ import OBJECT, ROBOT, compose
from anymesh.mujoco_ import load_mujoco

BACK, BACK_STEP = 0.08, 0.01  # [m] length of the straight motion to the part; step of the test
WIDER = (0.002, 0.005, 0.009, 0.014)  # [m] by which collision shapes may be thicker than the visible surface
OPENING = 0.024  # [m] by which the open fingers are wider than what they grasp
TOUCH = 1e-3  # [m] that a finger may penetrate the part


class HandWorld:
    """Collision model of the gripper as a free body and the object at rest."""

    def __init__(self, thing: ArticulatedObject, robot: RobotArm, hand: Hand) -> None:
        self.mujoco = load_mujoco()
        self.hand = hand
        spec = compose(thing, _without_arm(robot))
        spec.body(ROBOT + robot.root).mocap = True
        self.model = model = spec.compile()
        self.data = data = self.mujoco.MjData(model)
        self.mujoco.mj_kinematics(model, data)
        wrist = int(model.body(ROBOT + robot.wrist).id)
        self._T_wrist_root = np.linalg.inv(self._frame(wrist)) @ self._frame(int(model.body(ROBOT + robot.root).id))
        self.fingers = np.array([int(model.joint(ROBOT + n).qposadr[0]) for n in robot.fingers], int)
        below = {wrist}
        for b in range(model.nbody):
            if int(model.body_parentid[b]) in below:
                below.add(b)
        moving = {int(model.joint(ROBOT + n).bodyid[0]) for n in robot.fingers}
        for b in range(model.nbody):
            if int(model.body_parentid[b]) in moving:
                moving.add(b)
        self._finger = np.isin(np.arange(model.nbody), sorted(moving))
        names = [model.body(b).name for b in range(model.nbody)]
        self._part = np.array([n.startswith(OBJECT) and n.removeprefix(OBJECT) in thing.carried for n in names])
        robot_geoms = np.array([names[b].startswith(ROBOT) for b in model.geom_bodyid])
        outside = robot_geoms & ~np.isin(model.geom_bodyid, sorted(below))
        model.geom_contype[outside] = model.geom_conaffinity[outside] = 0
        model.geom_conaffinity[robot_geoms] = 0  # no collisions within the robot

    def _frame(self, body: int) -> Float[np.ndarray, "4 4"]:
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = self.data.xmat[body].reshape(3, 3), self.data.xpos[body]
        return T

    def _clear(self, T_asset_tool: Float[np.ndarray, "4 4"], gap: float) -> bool:
        """Return whether fingers penetrate the part by at most `TOUCH` and nothing else of the hand touches anything."""
        T = T_asset_tool @ np.linalg.inv(self.hand.T_wrist_tool) @ self._T_wrist_root
        quat = np.zeros(4)
        self.mujoco.mju_mat2Quat(quat, np.ascontiguousarray(T[:3, :3]).reshape(-1))
        self.data.mocap_pos[0], self.data.mocap_quat[0] = T[:3, 3], quat
        self.data.qpos[self.fingers] = self.hand.posture_at(gap)
        self.mujoco.mj_kinematics(self.model, self.data)
        self.mujoco.mj_collision(self.model, self.data)
        if self.data.ncon == 0:
            return True
        body = self.model.geom_bodyid[self.data.contact.geom]
        touching = self._finger[body].any(1) & self._part[body].any(1)
        return bool((self.data.contact.dist >= np.where(touching, -TOUCH, 0.0)).all())

    def fitted(self, targets: Sequence[Target]) -> list[Target]:
        """Return the targets where the hand fits, with the width of the collision shapes there."""
        return [fitted_target for target in targets if (fitted_target := self._fit(target)) is not None]

    def _fit(self, target: Target) -> Target | None:
        push = target.contact is GripperContact.PUSH
        for wider in (0.0,) if push else WIDER:
            width = target.width + wider
            if width > self.hand.stroke:
                return None
            if self._clear(tool_pose(target, self.hand, -TOUCH if push else 0.0), width):
                opened = 0.0 if push else min(self.hand.stroke, width + OPENING)
                fitted = replace(target, width=width)
                ways = -np.arange(TOUCH if push else 0.0, BACK + 1e-9, BACK_STEP)
                return fitted if all(self._clear(tool_pose(fitted, self.hand, float(w)), opened) for w in ways) else None
        return None


def tool_pose(target: Target, hand: Hand, along: float) -> Float[np.ndarray, "4 4"]:
    """Return the tool's pose at a target, in the asset frame at rest; along: offset along its z [m].

    The fingertips are `PAD` beyond the grasped place, or at the pushed one.
    """
    ahead = np.eye(4)
    reach = hand.reach_at(target.width)
    ahead[2, 3] = along + (PAD - reach if target.contact is GripperContact.GRASP else -reach)
    return target.T_asset_tool @ ahead


def _without_arm(robot: RobotArm) -> RobotArm:
    """Return the robot with the arm's joints fixed."""
    spec = robot.spec.copy()
    for motor in list(spec.actuators):
        spec.delete(motor)
    for name in robot.joints:
        spec.delete(spec.joint(name))
    return replace(robot, spec=spec)
