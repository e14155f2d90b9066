"""Check "joints": types, axes, limits and strengths of joints are valid."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from anymesh.articulation.vetting import TOLERANCE, stops
from anymesh.checking.content import Content, rigid_groups
from anymesh.checking.engines import sweep_in
from anymesh.checking.engines.driving import SweepReport, resisting_of
from anymesh.checking.engines.locate import mjcf_beside
from anymesh.checking.engines.pushing import damping_text
from anymesh.checking.engines.robot import MOVING, Robot, RobotJoint
from anymesh.checking.report import Finding, Severity, failure, warning
from anymesh.errors import InputError, MissingExtraError
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.sweep import Obstacles, free_amount
from anymesh.geometry.topology import triangle_set_of
from anymesh.geometry.triangle_set import TriangleSet, sample_surface
from anymesh.types import JointType, Motion

JOINTS = "joints"
PROVED = ("floating", "ball")  # types that are proved as mechanisms where there is an MJCF
TYPES = (*MOVING, *PROVED, "fixed", "planar")
UNIT = 1e-3  # tolerance of the length of an axis
MAX_RANGE_RAD = 4 * np.pi  # [rad] a wider range of a hinge is probably in degrees, or a mistake
TRAVEL = 3.0  # share of the object's diagonal; a longer slide is probably in other units
DIRECTION = "direction"
FACES = 20_000
MOTION, MECHANISMS = "motion", "mechanisms"
BUTTON = 0.15  # share of the object's diagonal: a smaller part may be a button, as in articulation/rank_motions.py
STROKE = 0.1  # share of its extent along the axis that a button moves inwards at least, as in articulation/limits.py
GUIDED, LOOSE = 0.1, 0.01  # shares of a part's surface between walls: from which it is in a guide, up to which it has left it
PROBES, STROKE_STEPS = 500, 8  # points of that surface, and poses of the stroke


def check_joints(robot: Robot, diagonal: float) -> Iterator[Finding]:
    """Check that types are known, axes have a direction, limits are ordered and include 0, effort and velocity are given.

    diagonal: of the object [m].
    """
    for joint in robot.joints:
        if joint.type not in TYPES:
            yield failure(JOINTS, joint.name, f"its type is {joint.type!r}; valid are {', '.join(TYPES)}")
        elif joint.moves:
            yield from _axis(joint)
            yield from _limits(joint, diagonal, accepted=robot.format == "MJCF" or joint.name in robot.followers)
            if robot.format == "URDF":  # in an MJCF they belong to motors, not to joints
                yield from _strength(joint)
        elif joint.type != "fixed" and (joint.type not in PROVED or mjcf_beside(robot.path) is None):
            yield warning(JOINTS, joint.name, f"its type {joint.type} has several degrees of freedom; it is not driven here")
    if not robot.moving:
        yield warning(JOINTS, "", "no joint moves; an articulated asset has at least one")


def check_damping(robot: Robot) -> Iterator[Finding]:
    """Check that engines that apply damping explicitly can: damping * (1/60 s) / inertia about the axis is below 1."""
    at = robot.placements({})
    for joint in (j for j in robot.moving if np.linalg.norm(j.axis) > 0):
        text = damping_text(joint.damping, resisting_of(robot, joint, at), joint.type == "prismatic")
        if text:
            yield warning(JOINTS, joint.name, text)


def _axis(joint: RobotJoint) -> Iterator[Finding]:
    length = float(np.linalg.norm(joint.axis))
    if length < UNIT:
        yield failure(JOINTS, joint.name, f"its axis is {_vector(joint)}; valid is a direction")
    elif abs(length - 1) > UNIT:
        yield warning(JOINTS, joint.name, f"its axis {_vector(joint)} has length {length:.4g}; some engines need length 1")


def _vector(joint: RobotJoint) -> str:
    return "(" + ", ".join(f"{v:.4g}" for v in joint.axis) + ")"


def _limits(joint: RobotJoint, diagonal: float, *, accepted: bool) -> Iterator[Finding]:
    """Check limits. accepted: whether engines accept a joint without them."""
    if joint.type == "continuous":
        return
    if joint.limits is None:
        told = warning if accepted else failure
        yield told(JOINTS, joint.name, f"it has no limits; a {joint.type} joint needs lower and upper")
        return
    lower, upper = joint.limits
    shown = f"its limits are {lower:.4g} to {upper:.4g}"
    if lower > upper:
        yield failure(JOINTS, joint.name, f"{shown}; the lower must come first")
    elif lower == upper:
        yield failure(JOINTS, joint.name, f"{shown}; a joint that moves needs a range (fixed is a type of its own)")
    elif not lower <= 0 <= upper:
        yield warning(
            JOINTS,
            joint.name,
            f"{shown}, without the rest position 0; engines start it outside its limits, which causes a jerk",
        )
    most = MAX_RANGE_RAD if joint.type == "revolute" else TRAVEL * diagonal
    unit = "rad" if joint.type == "revolute" else "m"
    if upper - lower > most > 0:
        yield warning(JOINTS, joint.name, f"{shown} {unit}, a range beyond {most:.3g} {unit}; are the units right?")


def _strength(joint: RobotJoint) -> Iterator[Finding]:
    for word, value in (("effort", joint.effort), ("velocity", joint.velocity)):
        if value is None and joint.type != "continuous":
            yield warning(JOINTS, joint.name, f"it has no {word} limit; engines use 0 or their own")
        elif value is not None and value <= 0:
            yield warning(JOINTS, joint.name, f"its {word} limit is {value:.4g}; no motor can move it; it must be above 0")


def check_direction(content: Content) -> Iterator[Finding]:
    """Check that each direction within the limits is free of the parent, by the visible surfaces at rest."""
    groups = rigid_groups(content.robot)
    for joint in content.robot.moving:
        length = float(np.linalg.norm(joint.axis))
        part = content.at_rest(content.robot.carried(joint.child))
        rest = content.at_rest(groups[joint.parent] - content.robot.carried(joint.child))
        usable = length > 0 and joint.range[0] < joint.range[1] and len(part) and len(rest)
        if usable and np.isfinite(part).all() and np.isfinite(rest).all():
            yield from _ways(content, joint, *(triangle_set_of(simplify(shape, FACES)) for shape in (part, rest)))


def _leaving(content: Content, joint: RobotJoint, motion: Motion, obstacles: Obstacles) -> Iterator[Finding]:
    """Check that a small part that can be pushed in does not leave its guide instead, as a button with a reversed range."""
    part, rest = obstacles.part, obstacles.rest
    lower, upper = joint.range
    sign, most = (1, upper) if upper > -lower else (-1, -lower)
    if part.box.diagonal > BUTTON * content.diagonal or upper - lower - most > STROKE * most:
        return
    points = sample_surface(part.triangles, PROBES, 0).points
    if _between_walls(part, rest, points, motion.axis) < GUIDED:
        return
    end = points + sign * most * motion.axis
    least = STROKE * float(np.ptp(part.corners @ motion.axis))
    if (
        _between_walls(part, rest, end, motion.axis) <= LOOSE
        and free_amount(obstacles, motion, -sign, least, STROKE_STEPS)[0] >= least
    ):
        way = "positive" if sign > 0 else "negative"
        text = f"{way} motion takes {joint.child!r} out of its guide in {joint.parent!r} within {most:.3g} m"
        yield warning(DIRECTION, joint.name, f"{text}, and it can be pushed the other way; is the direction reversed?")


def _between_walls(part: TriangleSet, rest: TriangleSet, points: np.ndarray, axis: np.ndarray) -> float:
    """Return the share of points with a surface on two opposite sides across an axis, within a size of the part and a half."""
    across = np.linalg.svd(axis[None])[2][1:]
    ways = 1.5 * across * np.ptp(part.corners @ across.T, axis=0)[:, None]
    hit = [rest.scene.first_hit(points, np.tile(way, (len(points), 1))).distance <= 1 for way in (*ways, *-ways)]
    return float(((hit[0] & hit[2]) | (hit[1] & hit[3])).mean())


def _ways(content: Content, joint: RobotJoint, part: TriangleSet, rest: TriangleSet) -> Iterator[Finding]:
    T = content.places[joint.child]
    axis = T[:3, :3] @ joint.axis / np.linalg.norm(joint.axis)
    slides = joint.type == "prismatic"
    motion = Motion(JointType.PRISMATIC if slides else JointType.REVOLUTE, axis, T[:3, 3], joint.name)
    own = rigid_groups(content.robot)[joint.child]
    alone = content.at_rest(own) if own != content.robot.carried(joint.child) else np.zeros((0, 3, 3))
    link = triangle_set_of(simplify(alone, FACES)) if len(alone) else None
    unit = "m" if slides else "rad"
    obstacles = Obstacles(part, rest, TOLERANCE * content.diagonal)
    if slides:
        yield from _leaving(content, joint, motion, obstacles)
    for stop in stops(obstacles, motion, joint.range, content.diagonal, link):
        way = "positive" if stop.sign > 0 else "negative"
        problem = f"{way} motion drives {joint.child!r} into {joint.parent!r} after {stop.free:.3g} of {stop.most:.3g} {unit}"
        if stop.reversed:
            free_for = f"the opposite direction is free for {stop.other:.3g} {unit}"
            yield failure(DIRECTION, joint.name, f"{problem}; {free_for}, so the axis is reversed")
        else:
            yield warning(DIRECTION, joint.name, f"{problem}; the visible surfaces meet")


def check_motion(path: Path, engine: str, *, ours: bool) -> tuple[list[Finding], SweepReport | None]:
    """Drive every joint in an engine; also return its report, None without one.

    There is a failure for each fault of a joint, or if the engine cannot load the file, and a warning if it is not installed.
    ours: whether this package wrote the asset; contacts that hold a joint of others are warnings, as those at rest.
    """
    try:
        report = sweep_in(engine, path)
    except MissingExtraError as error:
        return [warning(MOTION, engine, str(error))], None
    except InputError as error:
        return [failure(MOTION, engine, str(error))], None
    findings = [
        (warning if j.touching and not ours else failure)(MOTION, j.name, f"{report.engine}: {fault}")
        for j in report.joints
        if not j.posture
        for fault in j.faults
    ]
    told = failure if ours else warning  # others may close a loop over a part of the range only
    findings += [told(MECHANISMS, m.name, f"{report.engine}: {fault}") for m in report.mechanisms for fault in m.faults]
    if report.mechanisms and not any(m.faults for m in report.mechanisms):
        findings.append(Finding(MECHANISMS, Severity.OK, report.engine, _proved(report)))
    for j in (j for j in report.joints if j.posture):
        findings.append(warning(MOTION, j.name, f"{report.engine}: {j.faults[0]} with the other joints at rest"))
    if report.ok:
        opened = [f"{j.name} after {' and '.join(j.opened)} moved" for j in report.joints if j.opened]
        left = [f"{name} is not driven: {why}" for name, why in report.undriven]
        note = f" ({'; '.join((*opened, *left))})" if opened or left else ""
        findings.append(Finding(MOTION, Severity.OK, report.engine, f"{len(report.joints)} joints reach both limits{note}"))
    return findings, report


def _proved(report: SweepReport) -> str:
    """Describe how well the mechanisms work."""
    words = {
        "follower": "{} joints follow, within {:.2g} rad or m",
        "loop": "{} loops stay closed within {:.2g} m",
        "ball": "{} balls stay within their limits, and turn by up to {:.2g} rad",
        "free": "{} loose parts can be lifted off",
    }
    of = {kind: [m.error for m in report.mechanisms if m.kind == kind] for kind in words}
    return ", ".join(words[kind].format(len(errors), max(errors)) for kind, errors in of.items() if errors)
