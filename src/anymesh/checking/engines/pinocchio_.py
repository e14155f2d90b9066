"""Pinocchio: rigid-body dynamics of a URDF without contact; motor forces are integrated implicitly by this module."""

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
    """Drive every joint of a URDF over its range. Raise InputError if Pinocchio cannot load it.

    Raise MissingExtraError without Pinocchio.
    """
    pinocchio = load_engine("pinocchio", shown="Pinocchio", extra="pinocchio")
    robot = readable(read_urdf(path))
    return drive(_World(pinocchio, Path(path), motors_of(robot)), robot)


class _World:
    def __init__(self, pinocchio: Any, path: Path, motors: tuple[Motor, ...]) -> None:
        self.engine = engine_version("pin", "pinocchio")
        self.pin = pinocchio
        try:
            self.model = pinocchio.buildModelFromUrdf(str(path))
        except Exception as error:  # ValueError, RuntimeError or ArgumentError, depending on the fault
            raise InputError(f"Pinocchio cannot load {path}: {error}") from error
        self.model.gravity.setZero()
        self.data = self.model.createData()
        self.numbers = range(1, self.model.njoints)  # 0 is the world
        names = [self.model.names[k] for k in self.numbers]
        self.joints = [ReadBack(n, self._child(n), self._limits(k)) for k, n in zip(self.numbers, names, strict=True)]
        by_name = {m.joint: m for m in motors}
        self.stiffness = np.array([by_name[n].stiffness for n in names])
        self.damping = np.array([by_name[n].damping for n in names])
        self.effort = np.array([by_name[n].effort for n in names])
        self.reset()

    def _child(self, joint: str) -> str:
        number = self.model.getJointId(joint)
        kind = self.pin.FrameType.BODY
        return next(f.name for f in self.model.frames if f.type == kind and f.parentJoint == number)

    def _limits(self, number: int) -> tuple[float, float] | None:
        joint = self.model.joints[number]
        if joint.nq != 1:
            return None
        return float(self.model.lowerPositionLimit[joint.idx_q]), float(self.model.upperPositionLimit[joint.idx_q])

    def reset(self) -> None:
        self.q, self.v, self.at = self.pin.neutral(self.model), np.zeros(self.model.nv), np.zeros(self.model.nv)

    def step(self, targets: Float[np.ndarray, " n"]) -> None:
        """Make one implicit Euler step of M dv = force * dt, with the motor's force at the end of the step."""
        mass = self.pin.crba(self.model, self.data, self.q)
        bias = self.pin.nonLinearEffects(self.model, self.data, self.q, self.v)
        gain = self.stiffness * STEP + self.damping
        error = self.stiffness * (targets - self.positions()) - gain * self.v
        solved = np.linalg.solve(mass + STEP * np.diag(gain), error - bias)
        force = np.clip(error - STEP * gain * solved, -self.effort, self.effort)
        self.v = self.v + STEP * np.linalg.solve(mass, force - bias)
        self.q = self.pin.integrate(self.model, self.q, STEP * self.v)
        self.at = self.at + STEP * self.v

    def positions(self) -> Float[np.ndarray, " n"]:
        """Return the integrated velocities, since a continuous joint is stored as cosine and sine."""
        return self.at

    def _placed(self, link: str) -> Any:
        self.pin.framesForwardKinematics(self.model, self.data, self.q)
        return self.data.oMf[self.model.getFrameId(link, self.pin.FrameType.BODY)]

    def origin(self, link: str) -> Float[np.ndarray, " 3"]:
        return np.array(self._placed(link).translation)

    def turned(self, link: str) -> Float[np.ndarray, "3 3"]:
        return np.array(self._placed(link).rotation)
