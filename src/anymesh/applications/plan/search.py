"""Search for a route over bases and targets, which counts why attempts fail; candidate poses of the robot's base."""

from __future__ import annotations

import math
import time
from collections import Counter
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float

from anymesh.applications.plan.asset_ import ArticulatedObject
from anymesh.applications.plan.attempt import Reason, Route, WorkCell
from anymesh.applications.plan.hand_ import Hand
from anymesh.applications.plan.kinematics_ import Kinematics
from anymesh.applications.plan.plans import BasePose, PlanError, Target
from anymesh.applications.plan.robot_ import RobotArm
from anymesh.applications.plan.scene_ import CollisionWorld

DISTANCES = (0.55, 0.45, 0.65, 0.38, 0.75)  # [m] from the middle of the tool's path, the most promising first
ANGLES = np.deg2rad([0, 25, -25, 50, -50, 80, -80, 110, -110])  # about the part, relative to its front
USUAL_REACH = 1.0  # [m] reach of the arm for which `DISTANCES` are stated
HEIGHTS = (0.35, 0.5)  # [m] of the part above the base, for bases that are not on the ground
ENOUGH = 3  # routes per base, of which the shortest is taken
SCREENED = 10  # targets used to assess a base
GOOD = 0.3  # share of them that must be reachable for a base to be tried at once
BASES = 6  # bases that are tried in full


@dataclass(frozen=True)
class Settings:
    """Planning settings. speed: share of the robot's limits; seconds: after which no further target is tried.

    The search is bounded by the number of bases, targets and checked postures; a limit of time only ends it earlier.
    """

    seed: int = 0
    speed: float = 0.3
    seconds: float = math.inf


@dataclass(frozen=True, eq=False)
class Arm:
    """Robot with its measured gripper and kinematics."""

    robot: RobotArm
    hand: Hand
    kinematics: Kinematics


class Search:
    """Search over bases and targets that counts the reasons of failures."""

    def __init__(
        self, thing: ArticulatedObject, arm: Arm, value: float, targets: list[Target], settings: Settings, begin: float
    ) -> None:
        self.thing, self.arm, self.value, self.targets, self.settings = thing, arm, value, targets, settings
        self._end = begin + settings.seconds
        self.failures: Counter[Reason] = Counter()
        self.blocked: str | None = None
        self.farthest = 0.0
        self.bases = 0
        self.cell: WorkCell
        self._worlds: dict[float, CollisionWorld] = {}

    def _open(self, base: BasePose) -> WorkCell | None:
        arm = self.arm
        if base.z not in self._worlds:
            self._worlds[base.z] = CollisionWorld(self.thing, arm.robot, arm.hand, base)
        world = self._worlds[base.z]
        cell = WorkCell(self.thing, arm.robot, arm.hand, arm.kinematics, base, self.value, world, self.settings.seed)
        self.blocked = cell.home_touches()
        return cell if self.blocked is None else None

    def at(self, base: BasePose) -> Route | None:
        """Return the shortest of up to `ENOUGH` routes from a base; None if there are none."""
        cell = self._open(base)
        if cell is None:
            return None
        self.cell, self.bases = cell, self.bases + 1
        routes: list[Route] = []
        for target in self.targets:
            if len(routes) >= ENOUGH or time.perf_counter() > self._end:
                break
            if routes and target.contact is not routes[0].target.contact:
                break
            route = cell.route(target)
            if route is not None:
                routes.append(route)
        self.farthest = max(self.farthest, cell.farthest, key=abs)
        for route in sorted(routes, key=lambda r: r.length):
            path = cell.approach(route)
            if path is not None:
                self.failures += cell.failures
                return replace(route, approach=path)
        self.failures += cell.failures
        return None

    def anywhere(self, *, near: BasePose | None = None) -> Route | None:
        """Return a route from the first base that reaches a good share of the targets, else from the best of the other bases.

        near: bases near it are tried first.
        """
        poses = self._poses()
        if near is not None:
            poses.sort(key=lambda b: float(np.hypot(b.x - near.x, b.y - near.y) + abs(b.z - near.z)))
        rng, some = np.random.default_rng([self.settings.seed, 2]), self.targets[:SCREENED]
        worse: list[tuple[int, int, BasePose]] = []
        tried = 0
        for number, base in enumerate(poses):
            if tried >= BASES or time.perf_counter() > self._end:
                return None
            cell = self._open(base)
            count = 0 if cell is None else sum(cell.reachable(t, rng) for t in some)
            if count < GOOD * len(some):
                worse += [(-count, number, base)] if count else []
                continue
            tried += 1
            route = self.at(base)
            if route is not None:
                return route
        for _, _, base in sorted(worse, key=lambda w: w[:2])[: BASES - tried]:
            route = self.at(base)
            if route is not None or time.perf_counter() > self._end:
                return route
        return None

    def _poses(self) -> list[BasePose]:
        """Return candidate bases around the middle of the tool's path."""
        some = self.targets[:SCREENED]
        half = self.thing.motion.transform(self.value / 2)
        at = np.mean([(half @ t.T_asset_tool)[:3, 3] for t in some], axis=0)
        outwards = -np.mean([(half @ t.T_asset_tool)[:3, 2] for t in some], axis=0)
        return base_poses(at, outwards, self.arm.kinematics.reach)

    def notes(self) -> tuple[str, ...]:
        dropped = [f"{count} targets dropped: {reason.value}" for reason, count in self.failures.most_common()]
        return (f"{len(self.targets)} targets, {self.bases} bases tried", *dropped)

    def failure(self, base: BasePose | None) -> PlanError:
        """Return an error that states why no route was found, with the nearest feasible value and base."""
        say, joint = self.thing.say, self.thing.joint
        where = f"from the base {base}" if base is not None else "from any base that was tried"
        clauses = [f"{joint} cannot be brought to {say(self.value)} {where}"]
        if base is not None and self.blocked is not None:
            clauses.append(f"the robot collides there ({self.blocked})")
        clauses += [f"{reason.value}: {count} targets" for reason, count in self.failures.most_common(3)]
        nearest = self._nearest(base)
        if nearest is not None:
            clauses.append(f"it can be brought to {say(nearest)} ({nearest:.4g})")
        if base is not None:
            other = Search(self.thing, self.arm, self.value, self.targets, self.settings, time.perf_counter())
            route = other.anywhere(near=base)
            clauses.append("no nearby base is better" if route is None else f"the nearest feasible base is {route.base}")
        return PlanError("; ".join(clauses), nearest)

    def _nearest(self, base: BasePose | None) -> float | None:
        """Return 98% or else 80% of the farthest value reached, if a route from the base exists for it; else None."""
        for share in (0.98, 0.8):
            value = self.farthest * share
            if base is None or abs(value) < 0.03 * abs(self.value):
                return None
            again = Search(self.thing, self.arm, value, self.targets, self.settings, time.perf_counter())
            if again.at(base) is not None:
                return float(value)
        return None


def base_poses(middle: Float[np.ndarray, " 3"], outwards: Float[np.ndarray, " 3"], reach: float) -> list[BasePose]:
    """Return base poses around the tool's path, each facing it, the most promising first.

    middle: of the tool's path [m]; outwards: direction from which the tool comes; reach: of the arm [m].
    """
    flat = outwards[:2] if np.linalg.norm(outwards[:2]) > 0.2 else np.array([0.0, -1.0])  # objects face -y
    front = float(np.arctan2(flat[1], flat[0]))
    heights = [0.0] + [z for h in HEIGHTS if abs(z := round(float(middle[2]) - h, 2)) > 0.05 and z > -0.6]
    candidates: list[tuple[float, BasePose]] = []
    for level, z in enumerate(heights):
        rise = float(middle[2]) - z - 0.3  # approximate height of an arm's shoulder above its base
        for far, distance in enumerate(DISTANCES):
            if np.hypot(distance * reach / USUAL_REACH, rise) > reach:
                continue
            for side, turn in enumerate(ANGLES):
                angle = front + turn
                x, y = middle[:2] + distance * reach / USUAL_REACH * np.array([np.cos(angle), np.sin(angle)])
                yaw = float(np.arctan2(middle[1] - y, middle[0] - x))
                pose = BasePose(round(float(x), 3), round(float(y), 3), z, round(yaw, 4))
                candidates.append((far + 0.7 * side + 2 * level, pose))
    return [pose for _, pose in sorted(candidates, key=lambda f: f[0])]
