"""Tasks on an articulated object: reward and success as in DexArt, as functions of a few measured numbers.

And the randomization of a scene at a reset: pose of the object, physics of the object and its joint.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from anymesh.errors import OptionError

MAX_DISTANCE = 0.5  # [m] distance above which the reaching term is constant
FINGERS, HELD_DISTANCE = 2, 0.2  # fingers on the part, and [m] to its handle point, that count as holding it
OPEN_SUCCESS, LIFT_SUCCESS = 0.95, 0.7  # progress of the joint that counts as done
LIFTED, LIFT_HEIGHT = 0.25, 0.3  # [m] rise that counts as done, and rise up to which lifting is rewarded
MAX_OPENING = math.pi / 2  # [rad] the goal of `open` from closed, as for DexArt's laptops
MAX_TURN = math.pi / 3  # [rad] goal for a joint without limits
AJAR = 0.2  # [rad] opening at the start of `open`, so that a finger fits below a lid without a handle (DexArt: 0.2)
AJAR_SHARE = 0.15  # of the travel of a slide, for the same purpose
Range = tuple[float, float]


class PolicyTask(StrEnum):
    """What is done with the object."""

    OPEN = "open"  # the joint moves from nearly closed to its goal
    CLOSE = "close"  # back
    LIFT = "lift"  # the handle is raised and the whole object lifted by it


@dataclass(frozen=True)
class JointGoal:
    """Values of a joint at the start and at the goal [rad or m]."""

    start: float
    goal: float

    def progress(self, value: float) -> float:
        """Return 0 at the start and 1 at the goal; negative if the joint moved the wrong way."""
        return (value - self.start) / (self.goal - self.start)


@dataclass(frozen=True)
class Situation:
    """Measurements after a step.

    distance: from the tool to the handle point [m]; fingers: number of fingers that touch the part; collides: whether the rest
    of the robot touches the object; progress: of the joint; rise: of the object [m]; tool_rise: of the tool in the last
    step [m]; effort: mean squared action; step, horizon: counts.
    """

    distance: float
    fingers: int
    collides: bool
    progress: float
    rise: float
    tool_rise: float
    effort: float
    step: int
    horizon: int

    @property
    def held(self) -> bool:
        """Whether two fingers touch the part near its handle point."""
        return self.fingers >= FINGERS and self.distance < HELD_DISTANCE


def joint_goal(task: PolicyTask, limits: tuple[float, float] | None, slides: bool, opening: float | None = None) -> JointGoal:
    """Return start and goal of `open` and `close`. The lower limit is closed, since positive opens.

    limits: None for a joint without; opening: at the goal, from closed [rad or m], None for 90 degrees or the whole range.
    Raise OptionError if the joint cannot move that far.
    """
    low, high = (0.0, MAX_TURN) if limits is None else limits
    if limits is not None and high - low < 1e-6:
        raise OptionError(f"the joint's range from {low:.4g} to {high:.4g} is empty")
    travel = opening if opening is not None else (high - low if slides else min(high - low, MAX_OPENING))
    if not 0 < travel <= high - low + 1e-6:
        raise OptionError(f"the opening must be above 0 and at most {high - low:.4g}, the joint's range; found {travel:.4g}")
    ajar = AJAR_SHARE * travel if slides or limits is None else min(AJAR, AJAR_SHARE * 2 * travel)
    closed, opened = low, low + travel
    return JointGoal(closed + ajar, opened) if task is PolicyTask.OPEN else JointGoal(opened, closed)


def reward(task: PolicyTask, s: Situation) -> float:
    """Return the reward of a step: DexArt's terms for reaching, contact, progress and lifting (see docs/policy.md)."""
    total = -min(s.distance, MAX_DISTANCE) if s.fingers == 0 else 0.1 * min(s.fingers, FINGERS)
    total -= 0.1 * s.collides + 0.01 * s.effort
    if s.progress < 0:
        total += 0.5 * s.progress
    elif s.fingers > 0:
        total += (1.0 if s.held else 0.5) * min(s.progress, 1.0)
    if task is PolicyTask.LIFT and s.fingers > 0 and s.rise < LIFT_HEIGHT:
        total += 20 * s.tool_rise * (s.rise > 0.01) + s.rise / LIFT_HEIGHT * 3
    if success(task, s):
        total += (s.horizon - s.step) * 1.2 * min(s.progress, 1.0) * (1.0 if task is not PolicyTask.LIFT else 3.0)
    return total


def success(task: PolicyTask, s: Situation) -> bool:
    """Return whether the task is done: the joint at its goal while it is held, or the object lifted by its raised handle.

    As in DexArt, an object that hangs on one finger is lifted.
    """
    if task is PolicyTask.LIFT:
        return s.progress > LIFT_SUCCESS and s.rise > LIFTED
    return s.progress > OPEN_SUCCESS and s.held


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
