"""Arms of `anymesh plan` as robots of an environment: joint servos moved by steps, and a gripper from closed to open."""

from __future__ import annotations

from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.applications.plan.hand_ import Hand, measure_hand
from anymesh.applications.plan.robot_ import RobotArm, load_robot
from anymesh.applications.plan.robot_packages_ import find_robot
from anymesh.applications.policy.robot import TaskRobot
from anymesh.mujoco_ import load_mujoco

TOOL_X, TOOL_Y = 0.0, -0.3  # [m] of the tool at home, from the middle of the object; the base of the arm is behind it
JOINT_STEP = 0.06  # [rad] of the largest change of a command in one step


def arm_robot(name: str) -> TaskRobot:
    """Return an arm with its gripper by the name that `anymesh plan` gives it: an action per joint and one for the gripper.

    Raise MissingExtraError or InputError if its files are not there.
    """
    mujoco = load_mujoco()
    arm = load_robot(find_robot(name))
    hand = measure_hand(arm)
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.impratio, spec.option.cone = arm.spec.option.impratio, arm.spec.option.cone
    at = _tool_at_home(mujoco, arm, hand)
    yaw = np.pi / 2 - np.arctan2(at[1], at[0])
    base = [TOOL_X, TOOL_Y - float(np.hypot(at[0], at[1])), 0.0]
    turn = [np.cos(yaw / 2), 0.0, 0.0, np.sin(yaw / 2)]
    spec.attach(arm.spec.copy(), frame=spec.worldbody.add_frame(pos=base, quat=turn), prefix="")
    quat = np.zeros(4)
    mujoco.mju_mat2Quat(quat, np.ascontiguousarray(hand.T_wrist_tool[:3, :3]).reshape(-1))
    spec.body(arm.wrist).add_site(name="tool", pos=hand.T_wrist_tool[:3, 3], quat=quat)
    for body in spec.bodies:
        body.gravcomp = 1.0
    motors = [a for a in spec.actuators if a.target in arm.joints]
    own = [a for a in spec.actuators if a.target not in arm.joints]
    for number, motor in enumerate((*motors, *own)):
        motor.name = motor.name or f"servo_{number}"
    order = {a.target: a.name for a in motors}
    servos = (*((order[j],) for j in arm.joints), tuple(a.name for a in own))
    low = np.array([*arm.limits[:, 0], hand.control[0, 0]])
    high = np.array([*arm.limits[:, 1], hand.control[-1, 0]])
    rate = np.array([JOINT_STEP] * len(arm.joints) + [0.0])
    start = dict(zip(arm.joints, arm.home, strict=True)) | dict(zip(arm.fingers, hand.posture[-1], strict=True))
    positions = tuple((n, float(v)) for n, v in start.items())
    fingers = _fingers(mujoco, arm, hand)
    return TaskRobot(name, spec, "tool", fingers, False, servos, rate, low, high, positions)


def _tool_at_home(mujoco: Any, arm: RobotArm, hand: Hand) -> Float[np.ndarray, " 3"]:
    """Return the position of the tool in the frame of the arm's file, at home [m]."""
    model = arm.spec.compile()
    data = mujoco.MjData(model)
    for name, value in zip(arm.joints, arm.home, strict=True):
        data.qpos[int(model.joint(name).qposadr[0])] = value
    mujoco.mj_kinematics(model, data)
    wrist = int(model.body(arm.wrist).id)
    return data.xpos[wrist] + data.xmat[wrist].reshape(3, 3) @ hand.T_wrist_tool[:3, 3]


def _fingers(mujoco: Any, arm: RobotArm, hand: Hand) -> tuple[tuple[str, ...], ...]:
    """Return the bodies of each finger: those that the gripper's joints move, by their side in the tool's frame."""
    model = arm.spec.compile()
    data = mujoco.MjData(model)
    for name, value in zip(arm.fingers, hand.posture[-1], strict=True):
        data.qpos[int(model.joint(name).qposadr[0])] = value
    mujoco.mj_kinematics(model, data)
    moving = {int(model.joint(n).bodyid[0]) for n in arm.fingers}
    for body in range(model.nbody):
        if int(model.body_parentid[body]) in moving:
            moving.add(body)
    wrist = int(model.body(arm.wrist).id)
    closing = data.xmat[wrist].reshape(3, 3) @ hand.T_wrist_tool[:3, 1]
    center = data.xpos[wrist] + data.xmat[wrist].reshape(3, 3) @ hand.T_wrist_tool[:3, 3]
    sides: tuple[list[str], list[str]] = ([], [])
    for body in sorted(moving):
        geoms = np.flatnonzero(model.geom_bodyid == body)
        middle = data.geom_xpos[geoms].mean(0) if len(geoms) else data.xpos[body]
        sides[int((middle - center) @ closing < 0)].append(model.body(body).name)
    return tuple(tuple(side) for side in sides)
