"""How strongly each joint resists, from its kind and from what it moves.

The pull of a joint is the force [N] at its handle that starts its opening motion from rest, with the base fixed and gravity
along -Z: dry friction plus what gravity adds, over the lever arm. Knobs, wheels and the like state a torque about the axis
[N m]. It is negative if gravity opens the joint by itself.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from anymesh.physics.inertia import Inertia
from anymesh.types import Asset, Joint, JointType

GRAVITY = 9.81  # [m/s^2]
UPRIGHT = 0.999  # minimum cosine to the vertical of an upright joint, which tilts nothing that it carries
MIN_LEVER = 1e-3  # [m] minimum lever arm of a handle


@dataclass(frozen=True, eq=False)
class Pull:
    """What starts the opening motion of a joint at rest.

    unit: "N" at the handle or "N m" about the axis; typical: as written; least, most: of the lightest and stiffest such joint;
    at: the handle [m, asset frame]; direction: unit, of the force, or of the torque by the right-hand rule.
    """

    unit: str
    typical: float
    least: float
    most: float
    at: Float[np.ndarray, " 3"]
    direction: Float[np.ndarray, " 3"]


@dataclass(frozen=True, eq=False)
class Resistance:
    """Resistance of a joint, in N, kg and m for slides and in N m, kg m^2 and rad for turning joints.

    friction: dry; friction_range: of the lightest and stiffest such joint; damping: per unit of speed; effort, velocity:
    limits; armature: inertia added to that of the links; inertia: of all that the joint moves, at rest; load: largest from
    gravity; source: where the values come from, in words.
    """

    friction: float
    friction_range: tuple[float, float]
    damping: float
    effort: float
    velocity: float
    armature: float
    inertia: float
    load: float
    pull: Pull
    source: str


def resistances(asset: Asset, inertias: Mapping[str, Inertia]) -> dict[str, Resistance]:
    """Return the resistance of each moving joint, by name. inertias: of all links, about their joints' origins."""
    return {j.name: _resistance(asset, inertias, j) for j in asset.joints if j.type is not JointType.FIXED}


def _resistance(asset: Asset, inertias: Mapping[str, Inertia], joint: Joint) -> Resistance:
    inertia, load = _carried(asset, inertias, joint)
    friction = 0.05
    slides, opens = joint.type is JointType.PRISMATIC, -1.0 if joint.limits is not None and sum(joint.limits) < 0 else 1.0
    at = _handle(asset, joint)
    arm = np.cross(joint.axis, at - joint.origin)
    lever = 1.0 if slides else max(float(np.linalg.norm(arm)), MIN_LEVER)
    direction = opens * (joint.axis if slides else arm / lever)
    pull = Pull("N", friction / lever, friction / lever, friction / lever, at, direction)
    return Resistance(friction, (friction, friction), 0.1, 50.0, 2.0, 0.0, inertia, load, pull, "default")


def _handle(asset: Asset, joint: Joint) -> Float[np.ndarray, " 3"]:
    """Return the point of a part that is farthest from its axis, or in the middle of a slide [m, asset frame]."""
    names = [p.name for p in asset.segmentation.parts]
    mesh, faces = asset.mesh, asset.segmentation.faces(names.index(joint.child))
    corners = mesh.vertices[np.unique(mesh.faces[faces])]
    if joint.type is JointType.PRISMATIC:
        return (corners.min(0) + corners.max(0)) / 2
    return corners[int(np.linalg.norm(np.cross(joint.axis, corners - joint.origin), axis=1).argmax())]


def _carried(asset: Asset, inertias: Mapping[str, Inertia], joint: Joint) -> tuple[float, float]:
    """Return the inertia that the joint moves at rest [kg m^2 or kg], and the maximum load from gravity [N m or N]."""
    names = _subtree(asset, joint.child)
    origins = {j.child: j.origin for j in asset.joints}
    masses = np.array([inertias[n].mass for n in names])
    along, tilt = (1.0, 1.0) if _is_tilted(asset, joint) else (abs(joint.axis[2]), float(np.linalg.norm(joint.axis[:2])))
    if joint.type is JointType.PRISMATIC:
        return float(masses.sum()), float(masses.sum() * GRAVITY * along)
    levers = np.array([origins[n] + inertias[n].center - joint.origin for n in names])
    levers -= np.outer(levers @ joint.axis, joint.axis)
    own = sum(float(joint.axis @ inertias[n].tensor @ joint.axis) for n in names)
    return own + float(masses @ (levers**2).sum(1)), float(np.linalg.norm(masses @ levers)) * GRAVITY * tilt


def _is_tilted(asset: Asset, joint: Joint) -> bool:
    """Return whether a joint before this one can tilt its axis."""
    carriers = {j.child: j for j in asset.joints}
    at = carriers.get(joint.parent)
    while at is not None:
        if at.type in (JointType.REVOLUTE, JointType.CONTINUOUS) and abs(at.axis[2]) < UPRIGHT:
            return True
        at = carriers.get(at.parent)
    return False


def _subtree(asset: Asset, name: str) -> list[str]:
    """Return the names of a link and of all links that it carries."""
    names = [name]
    for at in names:
        names += [j.child for j in asset.joints if j.parent == at]
    return names
