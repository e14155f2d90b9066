"""Randomization of a scene at a reset: pose of the object, and physics of the object and its joint."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from anymesh.applications.policy.tasks import PolicyTask
from anymesh.errors import OptionError

Range = tuple[float, float]


@dataclass(frozen=True)
class SceneSample:
    """One draw: displacement x, y [m], yaw [rad], friction coefficient, factors, and start value as a share of the travel."""

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0
    friction: float = 1.0
    mass: float = 1.0
    damping: float = 1.0
    joint_friction: float = 1.0
    start: float = 0.0


NOMINAL = SceneSample()


@dataclass(frozen=True)
class Randomization:
    """Ranges drawn uniformly; factors in their logarithm.

    position: largest displacement along x and y [m]; yaw: largest turn [deg]; friction: coefficient; mass, damping,
    joint_friction: largest factor, also downwards; start: largest share of the travel made before the start.
    """

    position: float = 0.03
    yaw: float = 15.0
    friction: Range = (0.6, 1.2)
    mass: float = 1.5
    damping: float = 2.0
    joint_friction: float = 1.5
    start: float = 0.05

    def __post_init__(self) -> None:
        values = (self.position, self.yaw, *self.friction, self.start)
        factors = (self.mass, self.damping, self.joint_friction)
        if (
            not np.isfinite((*values, *factors)).all()
            or min(values) < 0
            or min(factors) < 1
            or self.friction[0] > self.friction[1]
        ):
            raise OptionError(f"a randomization needs ranges of at least 0 and factors of at least 1, found {self}")

    def draw(self, rng: np.random.Generator) -> SceneSample:
        """Draw a sample."""
        x, y, yaw = rng.uniform(-1, 1, 3) * [self.position, self.position, np.deg2rad(self.yaw)]
        factors = np.exp(rng.uniform(-1, 1, 3) * np.log([self.mass, self.damping, self.joint_friction]))
        mass, damping, joint_friction = (float(f) for f in factors)
        friction, start = float(rng.uniform(*self.friction)), float(rng.uniform(0, self.start))
        return SceneSample(float(x), float(y), float(yaw), friction, mass, damping, joint_friction, start)


NO_RANDOMIZATION = Randomization(0.0, 0.0, (1.0, 1.0), 1.0, 1.0, 1.0, 0.0)
DEXART = {  # its ranges of pose: a square of 0.1 m and 60 degrees for laptops, 0.05 m and none for buckets
    PolicyTask.OPEN: Randomization(position=0.05, yaw=60.0),
    PolicyTask.CLOSE: Randomization(position=0.05, yaw=60.0),
    PolicyTask.LIFT: Randomization(position=0.025, yaw=0.0),
}
