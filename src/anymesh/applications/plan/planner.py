"""Planning: find a base, a target and a route, and compute the trajectory along the route."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.applications.plan.asset_ import AUTO, ArticulatedObject, open_object
from anymesh.applications.plan.hand_ import measure_hand
from anymesh.applications.plan.kinematics_ import Kinematics
from anymesh.applications.plan.plans import BasePose, GripperContact, MotionPlan, PlanError, Target
from anymesh.applications.plan.robot_ import load_robot
from anymesh.applications.plan.robot_packages_ import DEFAULT_ROBOT, find_robot
from anymesh.applications.plan.scene_ import HandWorld
from anymesh.applications.plan.search import Arm, Search, Settings
from anymesh.applications.plan.targets import PartSurfaces, sample_targets, velocity
from anymesh.applications.plan.trajectory import build_trajectory
from anymesh.errors import OptionError
from anymesh.runtime import Progress, silent

TARGETS = 60  # targets tried per base
SHORT = 0.03  # [m] travel of the part below which pushing is tried before grasping
CONTACTS = {AUTO: (), **{c.value: (c,) for c in GripperContact}}


def open_arm(robot: str | Path, *, tool: str | None = None, gripper: Sequence[str] = ()) -> Arm:
    """Load a robot by short name or file and measure its gripper. Raise as `find_robot`, `load_robot` and `measure_hand`."""
    loaded = load_robot(find_robot(robot), tool=tool, gripper=gripper)
    hand = measure_hand(loaded)
    return Arm(loaded, hand, Kinematics(loaded, hand))


def plan(
    asset: str | Path,
    *,
    robot: str | Path = DEFAULT_ROBOT,
    joint: str = AUTO,
    to: float | None = None,
    base: BasePose | str = AUTO,
    contact: str = AUTO,
    tool: str | None = None,
    gripper: Sequence[str] = (),
    seed: int = 0,
    speed: float = 0.3,
    seconds: float = math.inf,
    progress: Progress = silent,
) -> MotionPlan:
    """Plan how a robot arm moves a joint of an asset from rest to a value (paper, 4.2).

    asset: a folder written by anymesh, a URDF or an MJCF; robot: panda, ur5e, or a URDF or MJCF; joint: name of the joint or of
    the part that it moves, or auto (the surest); to: [rad or m], None for half of the range or what of it can be reached;
    base: auto, "X,Y,Z,YAW" [m, deg] or a pose; contact: auto, grasp or push; tool,
    gripper: as for `load_robot`; speed: share of the joints' limits; seconds: after which no further target is tried.
    Raise PlanError with the reason and the nearest feasible value if no plan is found, OptionError, InputError or
    MissingExtraError.
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
    how: dict[str, Any] = {"base": place, "contacts": CONTACTS[contact], "settings": Settings(seed, speed, seconds)}
    try:
        motion_plan = plan_motion(thing, arm, thing.usual_value() if to is None else to, progress=progress, **how)
    except PlanError as error:
        if to is not None or not error.nearest:
            raise
        motion_plan = plan_motion(thing, arm, error.nearest, progress=progress, **how)
    return replace(motion_plan, seconds={"load": round(loaded, 3), **motion_plan.seconds})


def plan_motion(
    thing: ArticulatedObject,
    arm: Arm,
    to: float,
    *,
    base: BasePose | None = None,
    contacts: tuple[GripperContact, ...] = (),
    settings: Settings = Settings(),  # noqa: B008 - frozen
    progress: Progress = silent,
) -> MotionPlan:
    """Run `plan` for a loaded object and robot. base: None for automatic; contacts: empty for automatic."""
    begin = time.perf_counter()
    value = thing.check_value(to)
    if value == 0:
        raise PlanError(f"{thing.joint} is at 0 at rest already; --to needs another value")
    contacts = contacts or _usual(thing, value)
    progress("targets", thing.part, 1, 3)
    targets = _targets(thing, arm, value, contacts, settings.seed)
    sampled = time.perf_counter()
    progress("route", thing.joint, 2, 3)
    search = Search(thing, arm, value, targets, settings, begin)
    route = search.at(base) if base is not None else search.anywhere()
    if route is None:
        raise search.failure(base)
    routed = time.perf_counter()
    trajectory = build_trajectory(route, arm.robot, settings.speed, search.cell.free(route))
    took = {"targets": sampled - begin, "route": routed - sampled, "timing": time.perf_counter() - routed}
    return MotionPlan(
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


def _targets(thing: ArticulatedObject, arm: Arm, value: float, contacts: tuple[GripperContact, ...], seed: int) -> list[Target]:
    """Return the targets where the gripper fits. Raise PlanError if there are none."""
    surfaces = PartSurfaces(thing.part_triangles, thing.other_triangles)
    sampled = sample_targets(surfaces, thing.motion, value, arm.hand.stroke, seed, contacts)
    if not sampled:
        raise PlanError(
            f"{thing.part} offers nothing to {' or '.join(contacts)}: a grasp needs two opposite faces less than "
            f"{1000 * arm.hand.stroke:.0f} mm apart with room for the fingers, a push a face that opposes the motion"
        )
    fitted = HandWorld(thing, arm.robot, arm.hand).fitted(sampled)[:TARGETS]
    if not fitted:
        raise PlanError(
            f"the gripper of {arm.robot.name} fits nowhere on {thing.part}: it collides with the object or the ground"
        )
    return fitted


def _usual(thing: ArticulatedObject, value: float) -> tuple[GripperContact, ...]:
    """Return the order of contacts to try: push first for parts that move little, else grasp first."""
    corners = thing.part_triangles.reshape(-1, 3)
    travel = float(np.linalg.norm(velocity(thing.motion, corners), axis=1).max()) * abs(value)
    return (GripperContact.PUSH, GripperContact.GRASP) if travel < SHORT else (GripperContact.GRASP, GripperContact.PUSH)
