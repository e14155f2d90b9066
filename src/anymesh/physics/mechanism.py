"""Springs, catches, detents and handles of joints, as formats describe them; `mechanisms`, outside of the core, finds them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from jaxtyping import Float, Int

from anymesh.types import Brief


class MechanismKind(StrEnum):
    """What a mechanism does."""

    RETURN = "return"  # a spring presses back to rest
    CLOSE = "close"  # a spring and a damper close
    HOLD = "hold"  # friction, and a spring against the weight, hold at any position
    LATCH = "latch"  # a catch holds closed up to a force, and snaps shut
    TOGGLE = "toggle"  # a catch snaps to either end
    DETENT = "detent"  # snaps to steps of a turn


@dataclass(frozen=True)
class Mechanism:
    """A mechanism of a joint, in N and m for slides and in N m and rad for turning joints.

    force: at the handle, in the unit of the joint's pull, that starts the motion from where the mechanism keeps it, friction
    and weight included; stiffness, reference: of a spring; least, most: bounds of `slope * (position - at)`, the force of a
    catch; torque, steps: of `-torque * sin(steps * position)`, the torque of a detent. What is 0 is not there.
    """

    kind: MechanismKind
    confidence: float
    reason: str
    force: float
    stiffness: float = 0.0
    reference: float = 0.0
    least: float = 0.0
    most: float = 0.0
    at: float = 0.0
    slope: float = 0.0
    torque: float = 0.0
    steps: int = 0


@dataclass(frozen=True, eq=False)
class HandleFrame(Brief):
    """Where a hand takes hold of a part to move a joint, at rest in the asset frame.

    place: a point of the handle's surface that the hand reaches first [m]; R: columns x, y, z, where z is the direction of the
    approach and y that in which fingers close; size: length along x, width between the fingers, and depth that they reach
    beyond the place [m]; faces: of the mesh.
    """

    name: str
    link: str
    joint: str
    place: Float[np.ndarray, " 3"]
    R: Float[np.ndarray, "3 3"]
    size: Float[np.ndarray, " 3"]
    faces: Int[np.ndarray, " k"]
