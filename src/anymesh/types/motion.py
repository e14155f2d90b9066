"""Motion hypotheses: candidate rigid motions of a part, and the results of their sweeps."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from jaxtyping import Float


class JointType(StrEnum):
    """Kind of motion of a part relative to its parent: the joint types that are written to every format."""

    REVOLUTE = "revolute"
    CONTINUOUS = "continuous"
    PRISMATIC = "prismatic"
    FIXED = "fixed"


MOVING = (JointType.REVOLUTE, JointType.CONTINUOUS, JointType.PRISMATIC)


@dataclass(frozen=True, eq=False)
class Motion:
    """A candidate motion.

    kind: REVOLUTE or PRISMATIC; axis: unit, asset frame; origin: a point on the axis [m, asset frame] (any point for a slide).
    """

    kind: JointType
    axis: Float[np.ndarray, " 3"]
    origin: Float[np.ndarray, " 3"]
    source: str  # the generator that proposed it, in words

    def __post_init__(self) -> None:
        length = float(np.linalg.norm(self.axis))
        if abs(length - 1) > 1e-6:
            raise ValueError(f"a motion's axis must be a unit vector, found length {length:.6f}")

    def transform(self, amount: float) -> Float[np.ndarray, "4 4"]:
        """Return the rigid transform (asset frame) at `amount` [rad for revolute, m for prismatic]."""
        return self.transforms(np.array([amount]))[0]

    def transforms(self, amounts: Float[np.ndarray, " k"]) -> Float[np.ndarray, "k 4 4"]:
        """Return the rigid transforms at several amounts."""
        T = np.tile(np.eye(4), (len(amounts), 1, 1))
        if self.kind is JointType.PRISMATIC:
            T[:, :3, 3] = amounts[:, None] * self.axis
            return T
        x, y, z = self.axis
        K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        T[:, :3, :3] += np.sin(amounts)[:, None, None] * K + (1 - np.cos(amounts))[:, None, None] * (K @ K)
        T[:, :3, 3] = self.origin - T[:, :3, :3] @ self.origin
        return T

    def distance(self, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, " n"]:
        """Return the distance of points from the axis [m]."""
        arms = points - self.origin
        across = arms - (arms @ self.axis)[:, None] * self.axis
        return np.sqrt(np.einsum("ij,ij->i", across, across))


@dataclass(frozen=True)
class Sweep:
    """Free range of a motion in both directions from rest [rad or m, both >= 0]."""

    forward: float  # free amount along +axis
    backward: float  # free amount along -axis
    clear_forward: bool  # True if the whole tested range is free
    clear_backward: bool

    def reversed(self) -> Sweep:
        """Return the same ranges of the motion along the opposite axis."""
        return Sweep(self.backward, self.forward, self.clear_backward, self.clear_forward)


@dataclass(frozen=True)
class Handle:
    """A handle that protrudes from a part's outer face.

    across: (2,) position on the face, -1..1 along the face's long and short side; along: side that it is parallel to (0 long, 1
    short, None for a knob); size: its length relative to the part's diagonal.
    """

    across: tuple[float, float]
    along: int | None
    size: float
