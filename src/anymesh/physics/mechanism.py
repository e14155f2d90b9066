"""Springs, catches and detents of joints, as the formats describe them; `mechanisms`, outside of the core, chooses them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


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
