"""Joints between parts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from anymesh.types.motion import JointType


@dataclass(frozen=True, eq=False)
class Joint:
    """A joint at rest in the asset frame. Positive motion opens.

    origin: a point on the axis [m]; axis: unit; limits: (lower, upper) [rad or m] containing 0, None if and only if the joint
    is continuous or fixed; effort [N or N m], velocity [m/s or rad/s], damping [N s/m or N m s/rad], friction [N or N m].
    """

    name: str
    type: JointType
    parent: str
    child: str
    origin: Float[np.ndarray, " 3"]
    axis: Float[np.ndarray, " 3"]
    limits: tuple[float, float] | None
    confidence: float
    reason: str
    effort: float = 50.0
    velocity: float = 2.0
    damping: float = 0.1
    friction: float = 0.05

    def __post_init__(self) -> None:
        if not abs(float(np.linalg.norm(self.axis)) - 1) <= 1e-6:  # also rejects NaN
            raise ValueError(f"joint {self.name!r}: axis must be a unit vector, found {self.axis}")
        if not np.isfinite(self.origin).all():
            raise ValueError(f"joint {self.name!r}: origin must be finite, found {self.origin}")
        if not 0 <= self.confidence <= 1:
            raise ValueError(f"joint {self.name!r}: confidence must lie in 0..1, found {self.confidence}")
        if not self.reason:
            raise ValueError(f"joint {self.name!r}: a reason in words is needed")
        limited = self.type in (JointType.REVOLUTE, JointType.PRISMATIC)
        if limited != (self.limits is not None):
            raise ValueError(f"joint {self.name!r}: limits {self.limits} do not go with type {self.type}")
        if self.limits is None:
            return
        lower, upper = self.limits
        if not (-np.inf < lower <= 0 <= upper < np.inf and lower < upper):
            raise ValueError(
                f"joint {self.name!r}: limits must be finite, hold the rest pose 0 and a range, found {self.limits}"
            )
