"""Driving of every joint through its range by a motor: the loop shared by all engines except MuJoCo."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.motors import REACHED_RATIO, Motor, motors_of
from anymesh.checking.engines.report import JointSweep, SweepReport
from anymesh.checking.engines.robot import Robot, RobotJoint

STEP = 0.005  # [s] simulated time step
HOLD_STEPS = 100  # steps for which a motor is held at a limit
SAME = 1e-4  # tolerance of limits as read by the engine [rad or m]
DEEP = 0.01  # share of the asset's extent: displacement that counts as a fault


@dataclass(frozen=True)
class ReadBack:
    """A joint as read by an engine; limits are None if it has none."""

    name: str
    child: str
    limits: tuple[float, float] | None


@runtime_checkable
class World(Protocol):
    """Protocol of one asset in one engine: root fixed, no gravity, one motor per joint."""

    engine: str  # name and version

    @property
    def joints(self) -> Sequence[ReadBack]:
        """Moving joints."""

    def reset(self) -> None:
        """Set all joints to 0, at rest."""

    def step(self, targets: Float[np.ndarray, " n"]) -> None:
        """Advance by STEP seconds, with motor targets [rad or m], in the order of `joints`."""

    def positions(self) -> Float[np.ndarray, " n"]:
        """Return the positions of the joints, in the order of `joints`."""

    def origin(self, link: str) -> Float[np.ndarray, " 3"]:
        """Return the origin of a link's frame, in the root's frame [m]."""

    def turned(self, link: str) -> Float[np.ndarray, "3 3"]:
        """Return the rotation of a link's axes in the root's frame."""


def drive(world: World, robot: Robot) -> SweepReport:
    """Drive every joint to its upper limit, then to its lower one, with the others held at rest; return the report.

    A joint that fails is tried again with others opened (such as a drawer behind a door), which the report states. A joint that
    the engine does not know is a fault, and so are limits that differ from the file.
    """
    known = {j.name: k for k, j in enumerate(world.joints)}
    motors = {m.joint: m for m in motors_of(robot)}
    extent = _extent(robot)
    sweeps = []
    for joint in robot.moving:
        if joint.name not in known:
            lower, upper = joint.range
            missing = ("the engine does not know this joint",)
            sweeps.append(JointSweep(joint.name, joint.type, lower, upper, 0.0, 0.0, None, "", 0.0, 0.0, missing))
            continue
        sweeps.append(_cleared(world, robot, joint, motors, extent))
    return SweepReport(world.engine, tuple(sweeps), ())


def _extent(robot: Robot) -> float:
    """Return a reference length for displacements: the spread of the links' centres of mass and frames [m]."""
    at = robot.placements({})
    points = [at[link.name][:3, 3] for link in robot.links]
    points += [(at[b.name] @ np.r_[b.inertial.center, 1])[:3] for b in robot.links if b.inertial is not None]
    return max(float(np.linalg.norm(np.ptp(points, axis=0))), 1e-3)


def _cleared(world: World, robot: Robot, joint: RobotJoint, motors: Mapping[str, Motor], extent: float) -> JointSweep:
    """Sweep a joint at rest; if that fails, with one other joint opened that may be in the way, or with all of those."""
    sweep = _swept(world, robot, joint, motors, extent, ())
    related = robot.carried(joint.child)
    known = {j.name for j in world.joints}
    free = [
        j.name for j in robot.moving if j.name in known and j.child not in related and joint.child not in robot.carried(j.child)
    ]
    tries = [(name,) for name in free] + ([tuple(free)] if len(free) > 1 else [])
    for opened in tries if sweep.faults else ():
        again = _swept(world, robot, joint, motors, extent, opened)
        if again.ok:
            return replace(again, opened=opened)
    return sweep


def _swept(
    world: World, robot: Robot, joint: RobotJoint, motors: Mapping[str, Motor], extent: float, opened: Sequence[str]
) -> JointSweep:
    lower, upper = joint.range
    reached, drift, off = {}, 0.0, 0.0
    names = [j.name for j in world.joints]
    index = names.index(joint.name)
    others = np.arange(len(names)) != index
    targets = np.zeros(len(names))
    open_at = np.array([j.range[1] if j.name in opened else 0.0 for name in names for j in robot.moving if j.name == name])
    world.reset()
    for share in _smooth(max(motors[name].seconds for name in opened)) if opened else ():
        targets = share * open_at
        world.step(targets)
    smooth = _smooth(motors[joint.name].seconds)
    start = 0.0
    for goal in (upper, lower):
        for command in (*(start + (goal - start) * smooth), *[goal] * HOLD_STEPS):
            targets[index] = command
            world.step(targets)
        now = world.positions()
        drift = max(drift, float(np.abs((now - open_at)[others]).max(initial=0.0)))
        off = max(off, _off(world, robot, joint, now))
        reached[goal] = float(now[index])
        start = goal
    faults = _faults(joint, world.joints[index], (reached[lower], reached[upper]), off, extent)
    return JointSweep(joint.name, joint.type, lower, upper, reached[lower], reached[upper], None, "", drift, off, faults)


def _smooth(seconds: float) -> Float[np.ndarray, " n"]:
    """Return shares of a smooth motion from 0 to 1, one per step."""
    return (1 - np.cos(np.linspace(0, np.pi, round(seconds / STEP)))) / 2


def _off(world: World, robot: Robot, joint: RobotJoint, positions: np.ndarray) -> float:
    """Compute the distance of the link's centre of mass from its position by the file's joints [m]."""
    at = robot.placements(dict(zip((j.name for j in world.joints), positions.tolist(), strict=True)))
    T = np.linalg.inv(at[robot.roots[0]]) @ at[joint.child]
    link = next(b for b in robot.links if b.name == joint.child)
    center = np.zeros(3) if link.inertial is None else link.inertial.center
    there = world.turned(joint.child) @ center + world.origin(joint.child)
    return float(np.linalg.norm(T[:3, :3] @ center + T[:3, 3] - there))


def _faults(joint: RobotJoint, read: ReadBack, reached: tuple[float, float], off: float, extent: float) -> tuple[str, ...]:
    if not np.isfinite([*reached, off]).all():
        return ("the simulation became unstable",)
    faults = []
    span = float(np.ptp(joint.range))
    if joint.type != "continuous" and (read.limits is None or np.abs(np.subtract(read.limits, joint.range)).max() > SAME):
        faults.append(f"the engine reads the limits {joint.range} as {read.limits}")
    for word, limit, at in (("upper", joint.range[1], reached[1]), ("lower", joint.range[0], reached[0])):
        if abs(at - limit) > REACHED_RATIO * span:
            faults.append(f"a motor brings it to {at:.4g} only, not to its {word} limit {limit:.4g}")
    if abs(reached[1] - reached[0]) < REACHED_RATIO * span:
        faults.append("it does not move")
    if off > DEEP * extent:
        faults.append(f"its link is {off:.4g} m from where the joint should place it")
    return tuple(faults)
