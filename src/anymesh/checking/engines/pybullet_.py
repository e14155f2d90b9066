"""PyBullet: a URDF loaded unchanged; links collide with all links except their parents."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.driving import STEP, Limits, Motor, engine_version, load_engine
from anymesh.checking.engines.robot import Robot
from anymesh.errors import InputError


class World:
    """The asset of a URDF in PyBullet. Raise InputError if it cannot be loaded, MissingExtraError without the engine."""

    def __init__(self, path: Path, robot: Robot, motors: Mapping[str, Motor]) -> None:
        bullet = load_engine("pybullet", shown="PyBullet", extra="pybullet")
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
        self.index, self.links, self.limits = [], {}, dict[str, Limits]()
        for k in range(bullet.getNumJoints(self.body, physicsClientId=self.client)):
            info = bullet.getJointInfo(self.body, k, physicsClientId=self.client)
            self.links[info[12].decode()] = k
            if info[2] in (bullet.JOINT_REVOLUTE, bullet.JOINT_PRISMATIC):
                limits = (float(info[8]), float(info[9]))
                self.limits[info[1].decode()] = limits if limits[0] <= limits[1] else None
                self.index.append(k)
        self.motors = [motors[name] for name in self.limits]

    def reset(self, positions: Float[np.ndarray, " n"]) -> None:
        for k, at in zip(self.index, positions, strict=True):
            self.bullet.resetJointState(self.body, k, float(at), 0.0, physicsClientId=self.client)

    def step(self, targets: Float[np.ndarray, " n"]) -> None:
        for k, target, motor in zip(self.index, targets, self.motors, strict=True):
            self.bullet.setJointMotorControl2(
                self.body, k, self.bullet.POSITION_CONTROL, targetPosition=float(target), force=motor.effort,
                physicsClientId=self.client,
            )  # fmt: skip
        self.bullet.stepSimulation(physicsClientId=self.client)

    def push(self, forces: Float[np.ndarray, " n"]) -> None:
        modes = (
            (self.bullet.VELOCITY_CONTROL, np.zeros(len(forces))),
            (self.bullet.TORQUE_CONTROL, forces),
        )  # brakes off first
        for mode, some in modes:
            self.bullet.setJointMotorControlArray(
                self.body, self.index, mode, forces=some.tolist(), physicsClientId=self.client
            )  # fmt: skip
        self.bullet.stepSimulation(physicsClientId=self.client)

    def positions(self) -> Float[np.ndarray, " n"]:
        states = self.bullet.getJointStates(self.body, self.index, physicsClientId=self.client)
        return np.array([state[0] for state in states])

    def pose(self, link: str) -> Float[np.ndarray, "4 4"]:
        state = self.bullet.getLinkState(self.body, self.links[link], computeForwardKinematics=1, physicsClientId=self.client)
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = np.array(self.bullet.getMatrixFromQuaternion(state[5])).reshape(3, 3), state[4]
        return T
