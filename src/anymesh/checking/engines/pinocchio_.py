"""Pinocchio: rigid-body dynamics of a URDF without contact; motor forces are integrated implicitly by this module."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.driving import STEP, Limits, Motor, engine_version, load_engine
from anymesh.checking.engines.robot import Robot
from anymesh.errors import InputError


class World:
    """The asset of a URDF in Pinocchio. Raise InputError if it cannot be loaded, MissingExtraError without the engine."""

    def __init__(self, path: Path, robot: Robot, motors: Mapping[str, Motor]) -> None:
        pinocchio = load_engine("pinocchio", shown="Pinocchio", extra="pinocchio")
        self.engine = engine_version("pin", "pinocchio")
        self.pin = pinocchio
        try:
            self.model = pinocchio.buildModelFromUrdf(str(path))
        except Exception as error:  # ValueError, RuntimeError or ArgumentError, depending on the fault
            raise InputError(f"Pinocchio cannot load {path}: {error}") from error
        self.model.gravity.setZero()
        self.data = self.model.createData()
        numbers = range(1, self.model.njoints)  # 0 is the world
        names = [self.model.names[k] for k in numbers]
        self.limits = {n: self._limits(k) for k, n in zip(numbers, names, strict=True)}
        self.stiffness = np.array([motors[n].stiffness for n in names])
        self.damping = np.array([motors[n].damping for n in names])
        self.effort = np.array([motors[n].effort for n in names])
        self.reset(np.zeros(len(names)))

    def _limits(self, number: int) -> Limits:
        joint = self.model.joints[number]
        if joint.nq != 1:
            return None
        return float(self.model.lowerPositionLimit[joint.idx_q]), float(self.model.upperPositionLimit[joint.idx_q])

    def reset(self, positions: Float[np.ndarray, " n"]) -> None:
        self.q, self.v = self.pin.integrate(self.model, self.pin.neutral(self.model), positions), np.zeros(self.model.nv)
        self.at = np.array(positions, float)

    def step(self, targets: Float[np.ndarray, " n"]) -> None:
        """Make one implicit Euler step of M dv = force * dt, with the motor's force at the end of the step."""
        mass, bias = self._dynamics()
        gain = self.stiffness * STEP + self.damping
        error = self.stiffness * (targets - self.positions()) - gain * self.v
        solved = np.linalg.solve(mass + STEP * np.diag(gain), error - bias)
        force = np.clip(error - STEP * gain * solved, -self.effort, self.effort)
        self._advance(mass, force - bias)

    def push(self, forces: Float[np.ndarray, " n"]) -> None:
        """Advance without the friction and damping of the file, which the engine does not apply."""
        mass, bias = self._dynamics()
        self._advance(mass, forces - bias)

    def _dynamics(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the mass matrix and the bias forces of the present state."""
        mass = self.pin.crba(self.model, self.data, self.q)
        return mass, self.pin.nonLinearEffects(self.model, self.data, self.q, self.v)

    def _advance(self, mass: np.ndarray, force: np.ndarray) -> None:
        self.v = self.v + STEP * np.linalg.solve(mass, force)
        self.q = self.pin.integrate(self.model, self.q, STEP * self.v)
        self.at = self.at + STEP * self.v

    def positions(self) -> Float[np.ndarray, " n"]:
        """Return the integrated velocities, since a continuous joint is stored as cosine and sine."""
        return self.at

    def pose(self, link: str) -> Float[np.ndarray, "4 4"]:
        self.pin.framesForwardKinematics(self.model, self.data, self.q)
        return np.array(self.data.oMf[self.model.getFrameId(link, self.pin.FrameType.BODY)].homogeneous)
