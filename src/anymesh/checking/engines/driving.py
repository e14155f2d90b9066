"""Driving of every joint through its range by a motor: the loop, motors and report shared by the engines."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from importlib import import_module
from importlib.metadata import version
from types import ModuleType
from typing import Any, Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.pushing import STEP, PassiveWorld, Resisting, push_faults
from anymesh.checking.engines.robot import Robot, RobotJoint
from anymesh.errors import InputError, MissingExtraError, pip_install

HOLD_STEPS = 100  # steps for which a motor is held at a limit
SAME = 1e-4  # tolerance of limits as read by the engine [rad or m]
DEEP = 0.01  # share of the asset's extent: penetration or displacement that counts as a fault
REACHED_RATIO = 0.02  # share of a joint's range: tolerance for a limit being reached, and for a joint being stuck
MOTOR_FREQUENCY = 20.0  # [rad/s] natural frequency of the motors
MIN_SETTLING_RATIO = 10.0  # minimum ratio of the duration of a motion to the time constant of the joint's damping
MAX_ENGINE_SECONDS = 10.0  # [s] maximum duration of a motion in the engines other than MuJoCo
DEFAULT_EFFORT = 1000.0  # [N or N m] default effort of a motor
ENDLESS = 8.0  # ratio to half a turn, or to the asset, from which a range means that there is none (some write 1e16)
UNSTABLE = "the simulation became unstable"
Limits = tuple[float, float] | None


@dataclass(frozen=True)
class JointSweep:
    """Motion of one joint through its range. Positions [rad or m]; `reached_*`: reached by a motor within the joint's effort.

    penetration: increase over that at rest, along the path [m], None if not tested; against: link with the deepest penetration,
    empty if none; drift: maximum motion of any other joint [rad or m];
    off: maximum distance of its link from the position given by the joint [m]; faults: in words.
    """

    name: str
    type: str
    lower: float
    upper: float
    reached_lower: float
    reached_upper: float
    penetration: float | None
    against: str
    drift: float
    off: float
    faults: tuple[str, ...]
    opened: tuple[str, ...] = ()  # joints that were moved first, because their links were in the way
    posture: bool = False  # whether its faults depend on the positions of further joints, as of the arms of a robot
    touching: bool = False  # whether its only fault is that contacts hold or shake it without motors

    @property
    def ok(self) -> bool:
        return self.posture or not self.faults


@dataclass(frozen=True)
class ProvedMechanism:
    """What was proved of a mechanism. kind: follower, loop, ball, free, or a leader that falls short.

    error: how far a follower was from its place [rad or m], a loop opened [m], a ball turned [rad], or a loose part was lifted
    [m]; faults: in words.
    """

    kind: str
    name: str
    error: float
    faults: tuple[str, ...] = ()


@dataclass(frozen=True)
class SweepReport:
    """All joints of an asset in one engine. excluded: pairs of links whose contact was not tested, and why.

    undriven: joints that were not driven themselves, and why.
    """

    engine: str
    joints: tuple[JointSweep, ...]
    excluded: tuple[tuple[str, str, str], ...]
    undriven: tuple[tuple[str, str], ...] = ()
    mechanisms: tuple[ProvedMechanism, ...] = ()

    @property
    def ok(self) -> bool:
        return all(joint.ok for joint in self.joints)


def from_record(record: Mapping[str, Any]) -> SweepReport:
    """Restore the report from plain values, as `dataclasses.asdict` makes them."""
    lists: list[dict[str, Any]] = [dict(j, faults=tuple(j["faults"]), opened=tuple(j["opened"])) for j in record["joints"]]
    joints = tuple(JointSweep(**values) for values in lists)
    excluded, undriven = ((tuple(entry) for entry in record[key]) for key in ("excluded", "undriven"))
    mechanisms = tuple(ProvedMechanism(m["kind"], m["name"], m["error"], tuple(m["faults"])) for m in record["mechanisms"])
    return SweepReport(record["engine"], joints, tuple(excluded), tuple(undriven), mechanisms)


@dataclass(frozen=True)
class Motor:
    """A position motor. stiffness [N m/rad or N/m], damping [N m s/rad or N s/m], effort [N m or N]."""

    stiffness: float
    damping: float
    effort: float
    seconds: float  # duration of a motion from limit to limit


def motors_of(robot: Robot) -> dict[str, Motor]:
    """Return a critically damped motor for each moving joint, by name, from its inertia at rest and its friction."""
    motors = {}
    at = robot.placements({})
    for joint in robot.moving:
        inertia = max(moved_inertia(robot, joint, at), 1e-6)
        span = float(np.ptp(joint.range))
        effort = joint.effort or DEFAULT_EFFORT
        fastest = np.pi / 2 * span / joint.velocity if joint.velocity else 0.0  # PhysX keeps to the file's velocity
        seconds = min(max(1.0, np.pi * np.sqrt(inertia * span / effort), fastest), MAX_ENGINE_SECONDS)
        against = max(4 * joint.friction / max(REACHED_RATIO * span, 1e-9), MIN_SETTLING_RATIO * joint.damping / seconds)
        stiffness = max(inertia * MOTOR_FREQUENCY**2, against)
        motors[joint.name] = Motor(stiffness, 2 * float(np.sqrt(stiffness * inertia)), effort, float(seconds))
    return motors


def moved_inertia(robot: Robot, joint: RobotJoint, at: Mapping[str, np.ndarray]) -> float:
    """Compute the inertia that a joint moves at rest [kg or kg m2]. at: placements of the links; without the armature."""
    carried, T = robot.carried(joint.child), at[joint.child]
    axis = T[:3, :3] @ joint.axis / np.linalg.norm(joint.axis)
    total = 0.0
    for link in robot.links:
        inertial = link.inertial if link.name in carried else None
        if inertial is None:
            continue
        if joint.type == "prismatic":
            total += inertial.mass
            continue
        turn, place = at[link.name][:3, :3], at[link.name][:3, 3]
        arm = np.cross(axis, turn @ inertial.center + place - T[:3, 3])
        own = axis @ turn @ inertial.tensor @ turn.T @ axis
        total += float(own + inertial.mass * arm @ arm)
    return total


def readable(robot: Robot) -> Robot:
    """Return the robot if engines can load it. Raise InputError if its joints do not form a tree, or an axis is zero."""
    names = {link.name for link in robot.links}
    lost = [j.name for j in robot.joints if not {j.parent, j.child} <= names]
    if lost or len(robot.roots) != 1 or any(not np.linalg.norm(j.axis) > 0 for j in robot.moving):
        raise InputError(f"{robot.path.name} is not a tree of joints with one root and nonzero axes")
    try:
        robot.placements({})
    except ValueError as error:
        raise InputError(f"{robot.path.name}: {error}") from None
    return robot


def load_engine(module: str, *, shown: str, extra: str) -> ModuleType:
    """Import an engine's module. Raise MissingExtraError, naming the extra, if it cannot be imported."""
    try:
        return import_module(module)
    except ImportError as error:
        message = f"{shown} is not installed ({error}); install it with {pip_install(extra)}"
        raise MissingExtraError(message) from error


def engine_version(distribution: str, shown: str) -> str:
    """Return name and version, as in reports."""
    return f"{shown} {version(distribution)}"


def finite_limits(lower: float, upper: float) -> Limits:
    """Return limits as read by an engine; None if they are infinite, as engines write those of continuous joints."""
    return (float(lower), float(upper)) if np.isfinite([lower, upper]).all() else None


def pose_matrix(position: np.ndarray, quaternion: np.ndarray) -> Float[np.ndarray, "4 4"]:
    """Convert a position and a unit quaternion (x, y, z, w) to a transform."""
    from scipy.spatial.transform import Rotation

    T = np.eye(4)
    T[:3, :3], T[:3, 3] = Rotation.from_quat(quaternion).as_matrix(), position
    return T


@runtime_checkable
class EngineWorld(PassiveWorld, Protocol):
    """Protocol of one asset in one engine: root fixed, no gravity, one motor per joint; joints in the order of `limits`.

    After the first push its motors stay off.
    """

    engine: str  # name and version
    limits: dict[str, Limits]  # moving joint -> limits as the engine read them, None if it has none

    def step(self, targets: Float[np.ndarray, " n"]) -> None:
        """Advance by STEP seconds, with motor targets [rad or m]."""

    def pose(self, link: str) -> Float[np.ndarray, "4 4"]:
        """Return the transform from a link's frame to the root's."""


def drive(world: EngineWorld, robot: Robot) -> SweepReport:
    """Drive every joint to its upper limit, then to its lower one, with the others held at rest; push it; return the report.

    A joint that fails is tried again with others opened (such as a drawer behind a door), which the report states. A joint that
    the engine does not know is a fault, and so are limits that differ from the file.
    """
    motors, extent, followers = motors_of(robot), _extent(robot), robot.followers
    sweeps = []
    for joint in (j for j in robot.moving if j.name not in followers):
        if joint.name in world.limits:
            sweeps.append(_cleared(world, robot, joint, motors, extent))
        else:
            missing = ("the engine does not know this joint",)
            sweeps.append(JointSweep(joint.name, joint.type, *joint.range, 0.0, 0.0, None, "", 0.0, 0.0, missing))
    undriven = tuple((name, f"follows {m.joint}") for name, m in followers.items())
    return SweepReport(world.engine, tuple(_pushed(world, robot, s, motors[s.name].seconds) for s in sweeps), (), undriven)


def _pushed(world: EngineWorld, robot: Robot, sweep: JointSweep, seconds: float) -> JointSweep:
    """Add the faults of a push, if the joint has none so far and leads no other."""
    if sweep.faults or sweep.name in {m.joint for m in robot.followers.values()}:
        return sweep
    joint = next(j for j in robot.moving if j.name == sweep.name)
    resisting = resisting_of(robot, joint, robot.placements({}))
    names, ranges = list(world.limits), {j.name: j.range for j in robot.moving}
    start = np.array([ranges[name][1] if name in sweep.opened else 0.0 for name in names])
    return replace(sweep, faults=tuple(push_faults(world, names.index(joint.name), resisting, joint.range, seconds, start)))


def resisting_of(robot: Robot, joint: RobotJoint, at: Mapping[str, np.ndarray]) -> Resisting:
    """Return what resists a push of a joint by its file. at: placements of the links at rest."""
    inertia = max(moved_inertia(robot, joint, at) + joint.armature, 1e-12)
    return Resisting(inertia, joint.friction, joint.damping, joint.effort or DEFAULT_EFFORT)


def _extent(robot: Robot) -> float:
    """Return a reference length for displacements: the spread of the links' centres of mass and frames [m]."""
    at = robot.placements({})
    points = [at[link.name][:3, 3] for link in robot.links]
    points += [(at[b.name] @ np.r_[b.inertial.center, 1])[:3] for b in robot.links if b.inertial is not None]
    return max(float(np.linalg.norm(np.ptp(points, axis=0))), 1e-3)


def _cleared(world: EngineWorld, robot: Robot, joint: RobotJoint, motors: Mapping[str, Motor], extent: float) -> JointSweep:
    """Sweep a joint at rest; if that fails, with one other joint opened that may be in the way, or with all of those."""
    sweep = _swept(world, robot, joint, motors, extent, ())
    related, followers = robot.carried(joint.child), robot.followers
    others = [j for j in robot.moving if j.name in world.limits and j.child not in related and j.name not in followers]
    free = [j.name for j in others if joint.child not in robot.carried(j.child)]
    tries = [(name,) for name in free] + ([tuple(free)] if len(free) > 1 else [])
    for opened in tries if sweep.faults else ():
        again = _swept(world, robot, joint, motors, extent, opened)
        if again.ok:
            return replace(again, opened=opened)
    return sweep


def _swept(
    world: EngineWorld, robot: Robot, joint: RobotJoint, motors: Mapping[str, Motor], extent: float, opened: Sequence[str]
) -> JointSweep:
    """Drive a joint to both limits, after opening other joints."""
    lower, upper = joint.range
    reached, drift, off = {}, 0.0, 0.0
    names, ranges = list(world.limits), {j.name: j.range for j in robot.moving}
    index = names.index(joint.name)
    followers = robot.followers
    others = np.array([name != joint.name and name not in followers for name in names])
    open_at = np.array([ranges[name][1] if name in opened else 0.0 for name in names])

    def coupled(targets: np.ndarray) -> np.ndarray:
        led = dict(zip(names, targets.tolist(), strict=True))
        led = robot.coupled({name: at for name, at in led.items() if name not in followers})
        return np.array([led[name] for name in names])

    world.reset(np.zeros(len(names)))
    for share in _smooth(max(motors[name].seconds for name in opened)) if opened else ():
        world.step(coupled(share * open_at))
    targets = open_at.copy()
    smooth = _smooth(motors[joint.name].seconds)
    start = 0.0
    for goal in (upper, lower):
        for command in (*(start + (goal - start) * smooth), *[goal] * HOLD_STEPS):
            targets[index] = command
            world.step(coupled(targets))
        now = world.positions()
        drift = max(drift, float(np.abs((now - open_at)[others]).max(initial=0.0)))
        off = max(off, _off(world, robot, joint, now))
        reached[goal] = float(now[index])
        start = goal
    faults = _faults(joint, world.limits[joint.name], (reached[lower], reached[upper]), off, extent)
    return JointSweep(joint.name, joint.type, lower, upper, reached[lower], reached[upper], None, "", drift, off, faults)


def _smooth(seconds: float) -> Float[np.ndarray, " n"]:
    """Return shares of a smooth motion from 0 to 1, one per step."""
    return (1 - np.cos(np.linspace(0, np.pi, round(seconds / STEP)))) / 2


def _off(world: EngineWorld, robot: Robot, joint: RobotJoint, positions: np.ndarray) -> float:
    """Compute the distance of the link's centre of mass from its position by the file's joints [m]."""
    at = robot.placements(dict(zip(world.limits, positions.tolist(), strict=True)))
    T = np.linalg.inv(at[robot.roots[0]]) @ at[joint.child]
    inertial = next(b.inertial for b in robot.links if b.name == joint.child)
    there = world.pose(joint.child)
    center = np.zeros(3) if inertial is None else inertial.center
    return float(np.linalg.norm(T[:3, :3] @ center + T[:3, 3] - (there[:3, :3] @ center + there[:3, 3])))


def distance_off(slides: bool, step: float, place: tuple[np.ndarray, np.ndarray, np.ndarray], now: np.ndarray) -> float:
    """Compute the distance of the link's shapes from their positions by the joint alone [m].

    step: from where place was taken: the joint's axis, its anchor and the positions of the shapes; now: their positions.
    """
    axis, anchor, start = place
    if slides:
        expected = start + step * axis
    else:
        r = start - anchor
        turned = np.cos(step) * r + np.sin(step) * np.cross(axis, r)
        expected = anchor + turned + (1 - np.cos(step)) * (r @ axis)[:, None] * axis
    return float(np.linalg.norm(now - expected, axis=1).max(initial=0.0))


def _faults(joint: RobotJoint, read: Limits, reached: tuple[float, float], off: float, extent: float) -> tuple[str, ...]:
    if not np.isfinite([*reached, off]).all():
        return (UNSTABLE,)
    faults = []
    if joint.type != "continuous" and (read is None or np.abs(np.subtract(read, joint.range)).max() > SAME):
        faults.append(f"the engine reads the limits {joint.range} as {read}")
    return (*faults, *motor_faults(joint.range, reached), *place_faults(off, extent))


def motor_faults(limits: tuple[float, float], reached: tuple[float, float]) -> list[str]:
    """Describe what a motor did not do. limits, reached: lower and upper [rad or m]."""
    faults, tolerance = [], REACHED_RATIO * float(np.ptp(limits))
    for word, limit, at in (("upper", limits[1], reached[1]), ("lower", limits[0], reached[0])):
        if abs(at - limit) > tolerance:
            faults.append(f"a motor brings it to {at:.4g} only, not to its {word} limit {limit:.4g}")
    if abs(reached[1] - reached[0]) < tolerance:
        faults.append("it does not move")
    return faults


def place_faults(off: float, extent: float) -> list[str]:
    """Describe a link that left its axis. off: distance from its place [m]; extent: of the asset [m]."""
    return [f"its link is {off:.4g} m from where the joint should place it"] if off > DEEP * extent else []
