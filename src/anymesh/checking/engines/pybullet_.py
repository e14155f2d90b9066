"""PyBullet: a URDF loaded unchanged; links collide with all links except their parents."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.driving import STEP, ReadBack, drive
from anymesh.checking.engines.motors import Motor, motors_of, readable
from anymesh.checking.engines.outside import engine_version, load_engine
from anymesh.checking.engines.report import SweepReport
from anymesh.checking.engines.urdf import read_urdf
from anymesh.errors import InputError


def sweep_joints(path: Path) -> SweepReport:
    """Drive every joint of a URDF over its range. Raise InputError if PyBullet cannot load it.

    Raise MissingExtraError without PyBullet.
    """
    bullet = load_engine("pybullet", shown="PyBullet", extra="pybullet")
    robot = readable(read_urdf(path))
    world = _World(bullet, Path(path), motors_of(robot))
    try:
        return drive(world, robot)
    finally:
        bullet.disconnect(world.client)


class _World:
    def __init__(self, bullet: Any, path: Path, motors: tuple[Motor, ...]) -> None:
        self.bullet = bullet
        self.engine = engine_version("pybullet", "pybullet")
        self.client = bullet.connect(bullet.DIRECT)
        bullet.setTimeStep(STEP, physicsClientId=self.client)
        flags = bullet.URDF_USE_INERTIA_FROM_FILE | bullet.URDF_USE_SELF_COLLISION
        flags |= bullet.URDF_USE_SELF_COLLISION_EXCLUDE_PARENT
        try:
            self.body = bullet.loadURDF(str(path), useFixedBase=True, flags=flags, physicsClientId=self.client)
        except bullet.error as error:
            raise InputError(f"PyBullet cannot load {path}: {error}") from error
        self.index, self.links, self.joints = [], {}, []
        for k in range(bullet.getNumJoints(self.body, physicsClientId=self.client)):
            info = bullet.getJointInfo(self.body, k, physicsClientId=self.client)
            self.links[info[12].decode()] = k
            if info[2] in (bullet.JOINT_REVOLUTE, bullet.JOINT_PRISMATIC):
                limits = (float(info[8]), float(info[9]))
                self.joints.append(ReadBack(info[1].decode(), info[12].decode(), limits if limits[0] <= limits[1] else None))
                self.index.append(k)
        by_name = {m.joint: m for m in motors}
        self.motors = [by_name[j.name] for j in self.joints]

    def reset(self) -> None:
        for k in self.index:
            self.bullet.resetJointState(self.body, k, 0.0, 0.0, physicsClientId=self.client)

    def step(self, targets: Float[np.ndarray, " n"]) -> None:
        for k, target, motor in zip(self.index, targets, self.motors, strict=True):
            self.bullet.setJointMotorControl2(
                self.body, k, self.bullet.POSITION_CONTROL, targetPosition=float(target), force=motor.effort,
                physicsClientId=self.client,
            )  # fmt: skip
        self.bullet.stepSimulation(physicsClientId=self.client)

    def positions(self) -> Float[np.ndarray, " n"]:
        states = self.bullet.getJointStates(self.body, self.index, physicsClientId=self.client)
        return np.array([state[0] for state in states])

    def _state(self, link: str) -> tuple:
        return self.bullet.getLinkState(self.body, self.links[link], computeForwardKinematics=1, physicsClientId=self.client)

    def origin(self, link: str) -> Float[np.ndarray, " 3"]:
        return np.array(self._state(link)[4])

    def turned(self, link: str) -> Float[np.ndarray, "3 3"]:
        return np.array(self.bullet.getMatrixFromQuaternion(self._state(link)[5])).reshape(3, 3)
