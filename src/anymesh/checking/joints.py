"""Check "joints": types, axes, limits and strengths of joints are valid."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from anymesh.checking.engines.robot import MOVING, Robot, RobotJoint
from anymesh.checking.report import Finding, failure, warning

CHECK = "joints"
TYPES = (*MOVING, "fixed", "floating", "planar")
UNIT = 1e-3  # tolerance of the length of an axis
MAX_RANGE_RAD = 4 * np.pi  # [rad] a wider range of a hinge is probably in degrees, or a mistake
TRAVEL = 3.0  # share of the object's diagonal; a longer slide is probably in other units


def check_joints(robot: Robot, diagonal: float) -> Iterator[Finding]:
    """Check that types are known, axes have a direction, limits are ordered and include 0, effort and velocity are given.

    diagonal: of the object [m].
    """
    for joint in robot.joints:
        if joint.type not in TYPES:
            yield failure(CHECK, joint.name, f"its type is {joint.type!r}; valid are {', '.join(TYPES)}")
        elif joint.moves:
            yield from _axis(joint)
            yield from _limits(joint, diagonal)
            if robot.format == "URDF":  # in an MJCF they belong to motors, not to joints
                yield from _strength(joint)
        elif joint.type != "fixed":
            yield warning(CHECK, joint.name, f"its type {joint.type} has several degrees of freedom; it is not driven here")
    if not robot.moving:
        yield warning(CHECK, "", "no joint moves; an articulated asset has at least one")


def _axis(joint: RobotJoint) -> Iterator[Finding]:
    length = float(np.linalg.norm(joint.axis))
    if length < UNIT:
        yield failure(CHECK, joint.name, f"its axis is {_vector(joint)}; valid is a direction")
    elif abs(length - 1) > UNIT:
        yield warning(CHECK, joint.name, f"its axis {_vector(joint)} has length {length:.4g}; some engines need length 1")


def _vector(joint: RobotJoint) -> str:
    return "(" + ", ".join(f"{v:.4g}" for v in joint.axis) + ")"


def _limits(joint: RobotJoint, diagonal: float) -> Iterator[Finding]:
    if joint.type == "continuous":
        return
    if joint.limits is None:
        yield failure(CHECK, joint.name, f"it has no limits; a {joint.type} joint needs lower and upper")
        return
    lower, upper = joint.limits
    shown = f"its limits are {lower:.4g} to {upper:.4g}"
    if lower > upper:
        yield failure(CHECK, joint.name, f"{shown}; the lower must come first")
    elif lower == upper:
        yield failure(CHECK, joint.name, f"{shown}; a joint that moves needs a range (fixed is a type of its own)")
    elif not lower <= 0 <= upper:
        yield warning(
            CHECK, joint.name, f"{shown}, without the rest position 0; engines start it outside its limits, which causes a jerk"
        )
    most = MAX_RANGE_RAD if joint.type == "revolute" else TRAVEL * diagonal
    unit = "rad" if joint.type == "revolute" else "m"
    if upper - lower > most > 0:
        yield warning(CHECK, joint.name, f"{shown} {unit}, a range beyond {most:.3g} {unit}; are the units right?")


def _strength(joint: RobotJoint) -> Iterator[Finding]:
    for word, value in (("effort", joint.effort), ("velocity", joint.velocity)):
        if value is None and joint.type != "continuous":
            yield warning(CHECK, joint.name, f"it has no {word} limit; engines use 0 or their own")
        elif value is not None and value <= 0:
            yield warning(CHECK, joint.name, f"its {word} limit is {value:.4g}; no motor can move it; it must be above 0")
