"""Routes for one robot base and one target: postures from home to the part, along its joint, and away from it."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np
from jaxtyping import Float

from anymesh.applications.plan.approach_ import Valid, free_path
from anymesh.applications.plan.asset_ import ArticulatedObject
from anymesh.applications.plan.hand_ import Hand
from anymesh.applications.plan.kinematics_ import Kinematics
from anymesh.applications.plan.plans import BasePose, GripperContact, Target
from anymesh.applications.plan.robot_ import RobotArm
from anymesh.applications.plan.scene_ import BACK, OPENING, CollisionWorld, tool_pose
from anymesh.types import Brief

BACK_LEAST = 0.03  # [m] shortest straight retreat
LINE_STEP = 0.004  # [m] between postures on a straight line
ARC_STEP, ARC_TURN = 0.003, np.deg2rad(1.5)  # [m], [rad] between postures along the joint
JUMP = 0.25  # [rad] largest step between neighbouring postures; more means that the arm changed its configuration
STAND_OFF = 0.003  # [m] before the surface at which a push starts, since the object may be nearer than planned
PRESS = 0.004  # [m] that a push continues beyond its goal, since the object may be farther than planned
TRIES, FEW = 10, 4  # random seeds of the inverse kinematics: per target, and to assess a base


class Reason(StrEnum):
    """Reason for which a target was dropped."""

    REACH = "out of reach"
    COLLISION = "in collision at the part"
    ARC = "joint limits or reach end along the joint's path"
    ARC_COLLISION = "in collision along the joint's path"
    LINE = "no straight way to the part"
    PATH = "no free path from home"


@dataclass(frozen=True, eq=False)
class Route(Brief):
    """Postures (k, J) of each motion; values: of the joint along `move`; gaps: of the fingers, open and at the part [m]."""

    base: BasePose
    target: Target
    approach: Float[np.ndarray, "k J"]
    reach: Float[np.ndarray, "m J"]
    move: Float[np.ndarray, "n J"]
    retreat: Float[np.ndarray, "r J"]
    values: Float[np.ndarray, " n"]
    open_gap: float
    hold_gap: float

    @property
    def length(self) -> float:
        """Length of the motion along the joint in joint space [rad]."""
        return float(np.linalg.norm(np.diff(self.move, axis=0), axis=1).sum())


@dataclass(eq=False)
class WorkCell:
    """Robot at a base before the object: tries targets and counts why they fail.

    The collision world is shared, so only one cell may use it at a time.
    """

    thing: ArticulatedObject
    robot: RobotArm
    hand: Hand
    kinematics: Kinematics
    base: BasePose
    value: float
    world: CollisionWorld
    seed: int = 0
    failures: Counter[Reason] = field(default_factory=Counter)
    farthest: float = 0.0

    def __post_init__(self) -> None:
        self.world.move(self.base)
        self._T_base_asset = np.linalg.inv(self.base.transform)

    def home_touches(self) -> str | None:
        """Return which links collide at the robot's home posture, None if none do."""
        touch = self.world.touching(self.robot.home, self.hand.stroke, 0.0)
        return None if touch is None else f"{touch.a} at {touch.b}"

    def tool(self, target: Target, value: float, along: float = 0.0) -> Float[np.ndarray, "4 4"]:
        """Return the tool's pose in the robot's base frame for a value of the joint; along: offset along the tool's z [m]."""
        return self._T_base_asset @ self.thing.motion.transform(value) @ tool_pose(target, self.hand, along)

    def reachable(self, target: Target, rng: np.random.Generator) -> bool:
        """Return whether the tool reaches the part without collision, and the end of the part's motion."""
        if not self._near(target):
            return False
        if next(iter(self.kinematics.search(self.tool(target, self.value), rng, FEW)), None) is None:
            return False
        start = self.start(target)
        postures = self.kinematics.search(self.tool(target, 0.0, start), rng, FEW)
        return any(self.world.touching(q, target.width, 0.0, holding=True) is None for q in postures)

    def _near(self, target: Target) -> bool:
        """Return whether both ends of the motion are within the arm's reach; cheaper than inverse kinematics."""
        ends = (self.tool(target, value)[:3, 3] for value in (self.value, 0.0))
        return all(float(np.linalg.norm(at - self.kinematics.shoulder)) <= self.kinematics.reach for at in ends)

    @staticmethod
    def start(target: Target) -> float:
        """Return the offset along the tool's z at which the part's motion begins, relative to the target [m]."""
        return -STAND_OFF if target.contact is GripperContact.PUSH else 0.0

    def route(self, target: Target) -> Route | None:
        """Compute all motions for a target except the approach; None if there are none, and the reason is counted."""
        rng = np.random.default_rng([self.seed, 1])
        open_gap = min(self.hand.stroke, target.width + OPENING) if target.contact is GripperContact.GRASP else 0.0
        start = self.start(target)
        reasons: list[Reason] = []
        first = self.tool(target, 0.0, start)
        far = float(np.linalg.norm(first[:3, 3] - self.kinematics.shoulder)) > self.kinematics.reach
        for posture in () if far else self.kinematics.search(first, rng, TRIES):
            route_or_reason = self._from(target, posture, open_gap, start)
            if isinstance(route_or_reason, Route):
                return route_or_reason
            reasons.append(route_or_reason)
        last = max(reasons, key=list(Reason).index, default=Reason.REACH)  # the reason of the attempt that got farthest
        self.failures[last] += 1
        return None

    def _from(self, target: Target, posture: np.ndarray, open_gap: float, start: float) -> Route | Reason:
        hold_gap = target.width
        if self.world.touching(posture, hold_gap, 0.0, holding=True) is not None:
            return Reason.COLLISION
        move, values = self._along(target, posture, hold_gap, start)
        if abs(values[-1]) > abs(self.farthest):
            self.farthest = float(values[-1])
        if abs(values[-1] - self.value) > 1e-9:
            return self._why
        reach = self._line(target, posture, 0.0, open_gap, start, whole=True)
        if reach is None or self.world.touching(reach[-1], open_gap, 0.0) is not None:
            return Reason.LINE
        retreat = self._line(target, move[-1], self.value, open_gap, PRESS if start else 0.0, whole=False)
        return Route(
            self.base,
            target,
            reach[-1:],
            reach[::-1],
            move,
            move[-1:] if retreat is None else retreat,
            values,
            open_gap,
            hold_gap,
        )

    def _along(
        self, target: Target, posture: np.ndarray, gap: float, start: float
    ) -> tuple[Float[np.ndarray, "n J"], Float[np.ndarray, " n"]]:
        """Return the postures along the joint up to the first failure, and the joint's values."""
        step = ARC_TURN if self.thing.turns else ARC_STEP
        count = max(8, int(np.ceil(abs(self.value) / step)))
        values = self.value * np.arange(count + 1) / count
        shifts = start + (PRESS - start) * np.arange(count + 1) / count if start else np.zeros(count + 1)
        postures = [posture]
        for value, shift in zip(values[1:], shifts[1:], strict=True):
            following = self.kinematics.solve(self.tool(target, float(value), float(shift)), postures[-1])
            if following is None or np.abs(following - postures[-1]).max() > JUMP:
                self._why = Reason.ARC
                break
            if self.world.touching(following, gap, float(value), holding=True, pressed=PRESS if start else 0.0) is not None:
                self._why = Reason.ARC_COLLISION
                break
            postures.append(following)
        return np.array(postures), values[: len(postures)]

    def _line(
        self, target: Target, posture: np.ndarray, value: float, gap: float, start: float, *, whole: bool
    ) -> Float[np.ndarray, "k J"] | None:
        """Return postures of a straight retreat from the part; None if shorter than `BACK_LEAST`, or than `BACK` if `whole`."""
        postures = [posture]
        for back in np.arange(LINE_STEP, BACK + 1e-9, LINE_STEP):
            following = self.kinematics.solve(self.tool(target, value, start - back), postures[-1])
            if following is None or np.abs(following - postures[-1]).max() > JUMP:
                break
            if self.world.touching(following, gap, value, holding=True, pressed=PRESS if start > 0 else 0.0) is not None:
                break
            postures.append(following)
        least = BACK if whole else BACK_LEAST
        return np.array(postures) if (len(postures) - 1) * LINE_STEP > least - 1e-9 else None

    def approach(self, route: Route) -> Float[np.ndarray, "k J"] | None:
        """Compute a collision-free path from home to the start of the straight motion to the part."""
        path = free_path(
            self.robot.home, route.reach[0], self.kinematics.low, self.kinematics.high, self.free(route), seed=self.seed
        )
        if path is None:
            self.failures[Reason.PATH] += 1
        return path

    def free(self, route: Route) -> Valid:
        """Return a predicate that tests whether a posture on the approach is free of collisions."""
        return lambda posture: self.world.touching(posture, route.open_gap, 0.0) is None
