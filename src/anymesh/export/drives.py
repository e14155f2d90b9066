"""Drive of a joint: a spring and a damper towards a commanded position, with the same values in every format."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from anymesh.export.model import Driven, ExportLink, Model
from anymesh.types import Joint, JointType

GRAVITY = 9.81  # [m/s^2]
WITHIN = 0.02  # of a joint's range: maximum steady-state error of a drive under its load

UPRIGHT = 0.999  # minimum cosine to the vertical of an upright joint, which tilts nothing that it carries


@dataclass(frozen=True)
class Drive:
    """Gains of a drive.

    stiffness [N m/rad or N/m]; damping [N m s/rad or N s/m]; effort: maximum [N m or N].
    """

    stiffness: float
    damping: float
    effort: float


def drives(model: Model) -> Mapping[str, Drive]:
    """Return a drive for each moving joint, by name. A passive one has neither stiffness nor damping.

    Damping over stiffness is the time in which the joint crosses its range at its velocity, which limits the speed of a drive.
    The stiffness keeps the error due to friction and weight within a share of the range. It is at least that of critical
    damping, so that no drive oscillates or overshoots.
    """
    moving = [j for j in model.asset.joints if j.type is not JointType.FIXED]
    if model.driven is Driven.PASSIVE:
        return {j.name: Drive(0.0, 0.0, j.effort) for j in moving}
    return {j.name: _drive(model, j) for j in moving}


def _drive(model: Model, joint: Joint) -> Drive:
    span = 2 * np.pi if joint.limits is None else joint.limits[1] - joint.limits[0]
    seconds = span / joint.velocity
    inertia, load = _carried(model, joint)
    stiffness = max(4 * inertia / seconds**2, (joint.friction + load) / (WITHIN * span))
    return Drive(float(stiffness), float(stiffness * seconds), joint.effort)


def _carried(model: Model, joint: Joint) -> tuple[float, float]:
    """Return the inertia that the joint moves at rest [kg m^2 or kg], and the maximum load from gravity [N m or N]."""
    bodies = _subtree(model, joint.child)
    masses = np.array([b.inertia.mass for b in bodies])
    along, tilt = (1.0, 1.0) if _is_tilted(model, joint) else (abs(joint.axis[2]), float(np.linalg.norm(joint.axis[:2])))
    if joint.type is JointType.PRISMATIC:
        return float(masses.sum()), float(masses.sum() * GRAVITY * along)
    levers = np.array([b.link.origin + b.inertia.center - joint.origin for b in bodies])
    levers -= np.outer(levers @ joint.axis, joint.axis)
    own = sum(float(joint.axis @ b.inertia.tensor @ joint.axis) for b in bodies)
    return own + float(masses @ (levers**2).sum(1)), float(np.linalg.norm(masses @ levers)) * GRAVITY * tilt


def _is_tilted(model: Model, joint: Joint) -> bool:
    """Return whether a joint before this one can tilt its axis."""
    carriers = {j.child: j for j in model.asset.joints}
    at = carriers.get(joint.parent)
    while at is not None:
        if at.type in (JointType.REVOLUTE, JointType.CONTINUOUS) and abs(at.axis[2]) < UPRIGHT:
            return True
        at = carriers.get(at.parent)
    return False


def _subtree(model: Model, name: str) -> list[ExportLink]:
    """Return a link and all links that it carries."""
    names = {name}
    waiting = [name]
    while waiting:
        at = waiting.pop()
        children = {j.child for j in model.asset.joints if j.parent == at}
        names |= children
        waiting += sorted(children)
    return [b for b in model.bodies if b.name in names]
