"""How strongly a joint resists, as the formats describe it; `mechanisms`, outside of the core, computes it.

The pull of a joint is the force [N] at its handle that starts its opening motion from rest, with the base fixed and gravity
along -Z: dry friction plus what gravity adds, over the lever arm. Knobs, wheels and the like state a torque about the axis
[N m]. It is negative if gravity opens the joint by itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from jaxtyping import Float, Int

from anymesh.types import Brief, Joint

GRAVITY = 9.81  # [m/s^2]


class ResistanceLevel(StrEnum):
    """How strongly joints resist, within the range of their kind."""

    LIGHT = "light"
    TYPICAL = "typical"
    STIFF = "stiff"


@dataclass(frozen=True, eq=False)
class FoundHandle(Brief):
    """Faces of a part that are a handle, by index in its own, and the unit direction in which they protrude."""

    part: str
    faces: Int[np.ndarray, " k"]
    way: Float[np.ndarray, " 3"]


@dataclass(frozen=True, eq=False)
class Pull(Brief):
    """What starts the opening motion of a joint at rest.

    unit: "N" at the handle or "N m" about the axis; typical: as written; least, most: of the lightest and stiffest such joint;
    at: the handle [m, asset frame]; direction: unit, of the force, or of the torque by the right-hand rule; handle: what was
    found to take hold of, if anything was.
    """

    unit: str
    typical: float
    least: float
    most: float
    at: Float[np.ndarray, " 3"]
    direction: Float[np.ndarray, " 3"]
    handle: FoundHandle | None = None


@dataclass(frozen=True, eq=False)
class Resistance:
    """Resistance of a joint, in N, kg and m for slides and in N m, kg m^2 and rad for turning joints.

    friction: dry; friction_range: of the lightest and stiffest such joint; damping: per unit of speed; effort, velocity:
    limits; armature: inertia added to that of the links; inertia: of all that the joint moves, at rest; load: largest from
    gravity; kind: in a word; source: where the values come from, in words.
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
    kind: str
    source: str


def crossing(joint: Joint, velocity: float) -> float:
    """Return the time constant of a drive [s]: in which the joint crosses its range, or a turn, at a velocity."""
    return max((joint.span[1] - joint.span[0]) / velocity, 0.1)
