"""Motors that drive an asset's joints, with a strength that fits their loads."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from anymesh.checking.engines.robot import Robot, RobotJoint
from anymesh.errors import InputError

REACHED_RATIO = 0.02  # share of a joint's range: tolerance for a limit being reached, and for a joint being stuck
MOTOR_FREQUENCY = 20.0  # [rad/s] natural frequency of the motors
MIN_SETTLING_RATIO = 10.0  # minimum ratio of the duration of a motion to the time constant of the joint's damping
MAX_ENGINE_SECONDS = 10.0  # [s] maximum duration of a motion in the engines other than MuJoCo
DEFAULT_EFFORT = 1000.0  # [N or N m] default effort of a motor


@dataclass(frozen=True)
class Motor:
    """A position motor. stiffness [N m/rad or N/m], damping [N m s/rad or N s/m], effort [N m or N]."""

    joint: str
    stiffness: float
    damping: float
    effort: float
    seconds: float  # duration of a motion from limit to limit


def motors_of(robot: Robot) -> tuple[Motor, ...]:
    """Return a critically damped motor for each moving joint, from its inertia at rest and its friction."""
    motors = []
    at = robot.placements({})
    for joint in robot.moving:
        inertia = max(_inertia(robot, joint, at), 1e-6)
        span = float(np.ptp(joint.range))
        effort = joint.effort or DEFAULT_EFFORT
        seconds = min(max(1.0, np.pi * np.sqrt(inertia * span / effort)), MAX_ENGINE_SECONDS)
        against = max(4 * joint.friction / max(REACHED_RATIO * span, 1e-9), MIN_SETTLING_RATIO * joint.damping / seconds)
        stiffness = max(inertia * MOTOR_FREQUENCY**2, against)
        motors.append(Motor(joint.name, stiffness, 2 * float(np.sqrt(stiffness * inertia)), effort, float(seconds)))
    return tuple(motors)


def _inertia(robot: Robot, joint: RobotJoint, at: dict[str, np.ndarray]) -> float:
    """Compute the inertia that a motor of the joint moves, at rest [kg or kg m2]."""
    carried = robot.carried(joint.child)
    T = at[joint.child]
    axis = T[:3, :3] @ joint.axis / np.linalg.norm(joint.axis)
    total = 0.0
    for link in robot.links:
        if link.name not in carried or link.inertial is None:
            continue
        if joint.type == "prismatic":
            total += link.inertial.mass
            continue
        turn, place = at[link.name][:3, :3], at[link.name][:3, 3]
        arm = np.cross(axis, turn @ link.inertial.center + place - T[:3, 3])
        own = axis @ turn @ link.inertial.tensor @ turn.T @ axis
        total += float(own + link.inertial.mass * arm @ arm)
    return total


def readable(robot: Robot) -> Robot:
    """Return the robot if engines can load it. Raise InputError if its joints do not form a tree, or an axis is zero."""
    names = {link.name for link in robot.links}
    lost = [j.name for j in robot.joints if not {j.parent, j.child} <= names]
    if lost or len(robot.roots) != 1 or any(not np.linalg.norm(j.axis) > 0 for j in robot.moving):
        raise InputError(f"{robot.path.name} is not a tree of joints with one root and nonzero axes")
    try:
        robot.placements({})
    except ValueError as error:
        raise InputError(f"{robot.path.name}: {error}") from None
    return robot
