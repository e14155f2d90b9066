"""Planning: a base, a target and a route that work, and the trajectory along it."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import Float

from anymesh.applications.plan.asset_ import ArticulatedObject, open_object
from anymesh.applications.plan.attempt import PRESS, Cell, Reason, Route
from anymesh.applications.plan.bases import base_poses
from anymesh.applications.plan.fitting_ import HandWorld
from anymesh.applications.plan.hand_ import Hand, measure_hand
from anymesh.applications.plan.kinematics_ import Kinematics
from anymesh.applications.plan.plans import BasePose, Contact, Plan, PlanError, Target
from anymesh.applications.plan.robot_ import Robot, load_robot
from anymesh.applications.plan.robot_packages_ import find_robot
from anymesh.applications.plan.scene_ import CollisionWorld
from anymesh.applications.plan.targets import Surfaces, sample_targets, velocity
from anymesh.applications.plan.trajectory import build_trajectory
from anymesh.errors import OptionError
from anymesh.progress import Progress, silent

TARGETS = 60  # that are tried from a base
ENOUGH = 3  # routes of which the shortest is taken
SCREENED = 10  # targets with which a base is judged
GOOD = 0.3  # share of them that a base must reach to be tried at once
BASES = 6  # bases that are tried in full
SHORT = 0.03  # [m] what moves less is pushed rather than grasped
AUTO = "auto"
CONTACTS = {AUTO: (), **{c.value: (c,) for c in Contact}}


@dataclass(frozen=True)
class Settings:
    """How to plan. speed: share of the robot's limits; seconds: after which no further target is tried."""

    seed: int = 0
    speed: float = 0.3
    seconds: float = 20.0


@dataclass(frozen=True, eq=False)
class Arm:
    """A robot ready to plan with."""

    robot: Robot
    hand: Hand
    kinematics: Kinematics


def open_arm(robot: str | Path, *, tool: str | None = None, gripper: Sequence[str] = ()) -> Arm:
    """Loads a robot by short name or file and measures its gripper. Raises as `find_robot`, `load_robot`, `measure_hand`."""
    loaded = load_robot(find_robot(robot), tool=tool, gripper=gripper)
    hand = measure_hand(loaded)
    return Arm(loaded, hand, Kinematics(loaded, hand))


def plan(
    asset: str | Path,
    *,
    robot: str | Path = "panda",
    joint: str,
    to: float,
    base: BasePose | str = AUTO,
    contact: str = AUTO,
    tool: str | None = None,
    gripper: Sequence[str] = (),
    seed: int = 0,
    speed: float = 0.3,
    seconds: float = 20.0,
    progress: Progress = silent,
) -> Plan:
    """Plans how a robot arm moves a joint of an asset from rest to a value (paper, 4.2).

    asset: a folder that anymesh made, a URDF or an MJCF; robot: panda, ur5e, or a URDF or MJCF; joint: its name or that of
    the part it carries; to: [rad or m]; base: auto, "X,Y,Z,YAW" [m, deg] or a pose; contact: auto, grasp or push; tool,
    gripper: as for `load_robot`; speed: share of the joints' limits; seconds: after which nothing further is tried.
    Raises PlanError with the reason and the nearest value where nothing works, OptionError, InputError, MissingExtraError.
    """
    if contact not in CONTACTS:
        raise OptionError(f"--contact: found {contact!r}; valid are {', '.join(CONTACTS)}")
    if not 0 < speed <= 1:
        raise OptionError(f"--speed: found {speed}; valid is a share above 0 up to 1")
    place = base if isinstance(base, BasePose) else None if base == AUTO else BasePose.parse(base)
    begin = time.perf_counter()
    progress("load", str(robot), 0, 3)
    arm = open_arm(robot, tool=tool, gripper=gripper)
    thing = open_object(asset, joint)
    loaded = time.perf_counter() - begin
    found = plan_motion(thing, arm, to, base=place, contacts=CONTACTS[contact], settings=Settings(seed, speed, seconds), progress=progress)
    return replace(found, seconds={"load": round(loaded, 3), **found.seconds})


def plan_motion(
    thing: ArticulatedObject,
    arm: Arm,
    to: float,
    *,
    base: BasePose | None = None,
    contacts: tuple[Contact, ...] = (),
    settings: Settings = Settings(),  # noqa: B008 - frozen
    progress: Progress = silent,
) -> Plan:
    """`plan` for an object and a robot that are loaded. base: None for automatic; contacts: none for automatic."""
    begin = time.perf_counter()
    value = thing.check_value(to)
    if value == 0:
        raise PlanError(f"{thing.joint} is at 0 at rest already; --to needs another value")
    contacts = contacts or _usual(thing, value)
    progress("targets", thing.part, 1, 3)
    surfaces = Surfaces(thing.part_triangles, thing.other_triangles)
    targets = sample_targets(surfaces, thing.motion, value, arm.hand.stroke, settings.seed, contacts)
    if not targets:
        words = " or ".join(contacts)
        raise PlanError(
            f"{thing.part} offers nothing to {words}: a grasp needs two opposite faces less than {1000 * arm.hand.stroke:.0f} mm "
            "apart with room for the fingers, a push a face that looks against the motion"
        )
    targets = HandWorld(thing, arm.robot, arm.hand).fitted(targets)[:TARGETS]
    if not targets:
        raise PlanError(f"the gripper of {arm.robot.name} fits nowhere on {thing.part}: it collides with the object or the ground")
    sampled = time.perf_counter()
    progress("route", thing.joint, 2, 3)
    search = _Search(thing, arm, value, targets, settings, begin)
    route = search.at(base) if base is not None else search.anywhere()
    if route is None:
        raise search.failure(base)
    routed = time.perf_counter()
    trajectory = build_trajectory(route, arm.robot, settings.speed, search.cell.free(route))
    took = {"targets": sampled - begin, "route": routed - sampled, "timing": time.perf_counter() - routed}
    return Plan(
        thing.name,
        arm.robot.name,
        thing.joint,
        thing.part,
        "rad" if thing.turns else "m",
        (0.0, value),
        route.base,
        route.target,
        trajectory,
        {k: round(v, 3) for k, v in took.items()},
        search.notes(),
    )


def _usual(thing: ArticulatedObject, value: float) -> tuple[Contact, ...]:
    """What moves little is pushed first, the rest grasped first."""
    corners = thing.part_triangles.reshape(-1, 3)
    travel = float(np.linalg.norm(velocity(thing.motion, corners), axis=1).max()) * abs(value)
    return (Contact.PUSH, Contact.GRASP) if travel < SHORT else (Contact.GRASP, Contact.PUSH)


class _Search:
    """Tries bases and targets, and remembers why they failed."""

    def __init__(
        self, thing: ArticulatedObject, arm: Arm, value: float, targets: list[Target], settings: Settings, begin: float
    ) -> None:
        self.thing, self.arm, self.value, self.targets, self.settings = thing, arm, value, targets, settings
        self._end = begin + settings.seconds
        self.failures: Counter[Reason] = Counter()
        self.blocked: str | None = None
        self.farthest = 0.0
        self.bases = 0
        self.cell: Cell
        self._worlds: dict[float, CollisionWorld] = {}

    def _open(self, base: BasePose) -> Cell | None:
        arm = self.arm
        if base.z not in self._worlds:
            self._worlds[base.z] = CollisionWorld(self.thing, arm.robot, arm.hand, base)
        world = self._worlds[base.z]
        cell = Cell(self.thing, arm.robot, arm.hand, arm.kinematics, base, self.value, world, self.settings.seed)
        self.blocked = cell.home_touches()
        return cell if self.blocked is None else None

    def at(self, base: BasePose) -> Route | None:
        """The shortest of some routes from a base; None when there is none."""
        cell = self._open(base)
        if cell is None:
            return None
        self.cell, self.bases = cell, self.bases + 1
        found: list[Route] = []
        for target in self.targets:
            if len(found) >= ENOUGH or time.perf_counter() > self._end:
                break
            if found and target.contact is not found[0].target.contact:
                break
            route = cell.route(target)
            if route is not None:
                found.append(route)
        self.farthest = max(self.farthest, cell.farthest, key=abs)
        for route in sorted(found, key=lambda r: r.length):
            path = cell.approach(route)
            if path is not None:
                self.failures += cell.failures
                return replace(route, approach=path)
        self.failures += cell.failures
        return None

    def anywhere(self, *, near: BasePose | None = None) -> Route | None:
        """A route from the first base that a good share of the targets is reached from, else from the best of the others.

        near: bases near it go first.
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
            found = self.at(base)
            if found is not None:
                return found
        for _, _, base in sorted(worse, key=lambda w: w[:2])[: BASES - tried]:
            found = self.at(base)
            if found is not None or time.perf_counter() > self._end:
                return found
        return None

    def _poses(self) -> list[BasePose]:
        """Where the robot might stand, by the middle of the tool's path."""
        some = self.targets[:SCREENED]
        half = self.thing.motion.transform(self.value / 2)
        at = np.mean([(half @ t.T_asset_tool)[:3, 3] for t in some], axis=0)
        outwards = -np.mean([(half @ t.T_asset_tool)[:3, 2] for t in some], axis=0)
        return base_poses(at, outwards, self.arm.kinematics.reach)

    def notes(self) -> tuple[str, ...]:
        dropped = [f"{count} targets dropped: {reason.value}" for reason, count in self.failures.most_common()]
        return (f"{len(self.targets)} targets, {self.bases} bases tried", *dropped)

    def failure(self, base: BasePose | None) -> PlanError:
        """Why nothing worked, with the nearest value and base that do."""
        say, joint = self.thing.say, self.thing.joint
        where = f"from the base {base}" if base is not None else "from any base that was tried"
        told = [f"{joint} cannot be brought to {say(self.value)} {where}"]
        if base is not None and self.blocked is not None:
            told.append(f"the robot collides there ({self.blocked})")
        told += [f"{reason.value}: {count} targets" for reason, count in self.failures.most_common(3)]
        nearest = self._nearest(base)
        if nearest is not None:
            told.append(f"it can be brought to {say(nearest)} ({nearest:.4g})")
        if base is not None:
            other = _Search(self.thing, self.arm, self.value, self.targets, self.settings, time.perf_counter())
            route = other.anywhere(near=base)
            told.append("no base near does better" if route is None else f"the nearest feasible base is {route.base}")
        return PlanError("; ".join(told), nearest)

    def _nearest(self, base: BasePose | None) -> float | None:
        """The value that is reached at most, if it can be planned for; a little less where not at all."""
        for share in (0.98, 0.8):
            value = self.farthest * share
            if base is None or abs(value) < 0.03 * abs(self.value):
                return None
            again = _Search(self.thing, self.arm, value, self.targets, self.settings, time.perf_counter())
            if again.at(base) is not None:
                return float(value)
        return None


__all__ = ["AUTO", "CONTACTS", "PRESS", "Arm", "Settings", "open_arm", "plan", "plan_motion"]
Values = Float[np.ndarray, " n"]
