"""Joints of several axes as joints of one axis each, one after another, for formats that have no others."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from anymesh.geometry.kinematics import joint_motion
from anymesh.names import legal_names
from anymesh.types import Joint, JointType, Mimic
from anymesh.types.motion import HALF_TURN

MANY = 1000  # of an endless screw, up to which its slide goes
ROOM = 2.0  # [diagonals] up to which a free part slides each way; an estimate


def one_axis(joint: Joint, taken: Collection[str], size: float) -> tuple[Joint, ...]:
    """Return the joints of one axis that move a part as a screw, a ball or a free one does; others as they are.

    All have the same origin and are joined by links without shapes; the last moves the part and has the joint's name, but of a
    screw the first, whose turn the slide follows. A ball turns about two lines across its arm, each as far as its cone is wide,
    and about its arm. taken: names of links and joints; size: of the object [m].
    """
    across = joint_motion(replace(joint, type=JointType.BALL, limits=None, pitch=0.0, mimic=None)).axis
    R = (np.cross(across, joint.axis), across, joint.axis)
    cone = HALF_TURN if joint.limits is None else (-joint.limits[1], joint.limits[1])
    steps: list[tuple[JointType, np.ndarray, tuple[float, float] | None, Mimic | None]] = []
    match joint.type:
        case JointType.SCREW:
            rate = joint.pitch / (2 * np.pi)
            ends = sorted(rate * end for end in joint.limits or (-MANY * 2 * np.pi, MANY * 2 * np.pi))
            way = Mimic(joint.name, rate) if joint.mimic is None else joint.mimic
            way = way if joint.mimic is None else Mimic(way.joint, rate * way.ratio, rate * way.offset)
            kind = JointType.CONTINUOUS if joint.limits is None else JointType.REVOLUTE
            steps += [(kind, joint.axis, joint.limits, joint.mimic), (JointType.PRISMATIC, joint.axis, (ends[0], ends[1]), way)]
        case JointType.BALL:
            steps += [(JointType.REVOLUTE, axis, cone, None) for axis in R[:2]]
            steps += [(JointType.CONTINUOUS, joint.axis, None, None)]
        case JointType.FREE:
            steps += [(JointType.PRISMATIC, axis, (-ROOM * size, ROOM * size), None) for axis in np.eye(3)]
            steps += [(JointType.CONTINUOUS, axis, None, None) for axis in np.eye(3)]
        case _:
            return (joint,)
    numbers = range(1, len(steps))
    wanted = [*(f"{joint.name}_{k}" for k in numbers), *(f"{joint.child}_{k}" for k in numbers)]
    names = legal_names([*taken, *wanted])[len(taken) :]
    links, named = [joint.parent, *names[len(steps) - 1 :], joint.child], [*names[: len(steps) - 1], joint.name]
    named = named[::-1] if joint.type is JointType.SCREW else named
    made = []
    for k, (kind, axis, limits, mimic) in enumerate(steps):
        values = {"type": kind, "axis": axis, "limits": limits, "mimic": mimic, "pitch": 0.0, "others": ()}
        made.append(replace(joint, name=named[k], parent=links[k], child=links[k + 1], **values))
    return tuple(made)
