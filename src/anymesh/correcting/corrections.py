"""Kinds of manual corrections. Each is a frozen, self-contained value, so that a log can be replayed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from anymesh.errors import OptionError
from anymesh.types import JointType

Vector = tuple[float, float, float]


def vector(values: Float[np.ndarray, " 3"]) -> Vector:
    """Convert an array to three numbers."""
    x, y, z = (float(v) for v in values)
    return x, y, z


class CorrectionError(OptionError):
    """A correction is not applicable to this asset: unknown part, cycle, empty part, or limits without the rest pose."""


@dataclass(frozen=True)
class FaceSet:
    """Face indices as runs (first, one after the last), ascending and disjoint; equal sets are equal values."""

    runs: tuple[tuple[int, int], ...]

    @classmethod
    def of(cls, faces: Int[np.ndarray, " n"] | Iterable[int]) -> FaceSet:
        """Return the set of some face indices, in any order."""
        numbers = np.unique(np.fromiter(faces, np.int64) if not isinstance(faces, np.ndarray) else faces.astype(np.int64))
        if len(numbers) == 0:
            return cls(())
        cuts = np.flatnonzero(np.diff(numbers) != 1) + 1
        starts, ends = np.r_[0, cuts], np.r_[cuts, len(numbers)]
        return cls(tuple((int(numbers[a]), int(numbers[b - 1]) + 1) for a, b in zip(starts, ends, strict=True)))

    @property
    def numbers(self) -> Int[np.ndarray, " n"]:
        """The face indices, ascending."""
        return np.concatenate([np.zeros(0, np.int64), *(np.arange(a, b) for a, b in self.runs)])


@dataclass(frozen=True)
class ChangeType:
    """Change the type of the joint that carries `part`; incompatible limits are replaced by the usual ones."""

    part: str
    type: JointType


@dataclass(frozen=True)
class ChooseMotion:
    """Replace the joint that carries `part` by another of its free motions.

    axis, origin [m], limits [rad or m]: asset frame.
    """

    part: str
    type: JointType
    axis: Vector
    origin: Vector
    limits: tuple[float, float] | None
    confidence: float  # as computed for this motion
    reason: str
    pitch: float = 0.0  # of a screw [m per turn]


@dataclass(frozen=True)
class SetAxis:
    """Set the joint's axis and a point on it [m], asset frame. `how`: in words, such as the snapped mesh feature."""

    part: str
    axis: Vector
    origin: Vector
    how: str = "by numbers"


@dataclass(frozen=True)
class FlipSign:
    """Reverse the positive direction; the limits keep their numbers."""

    part: str


@dataclass(frozen=True)
class SetLimits:
    """Set (lower, upper) [rad or m], which include the rest pose 0; a continuous joint becomes revolute."""

    part: str
    lower: float
    upper: float


@dataclass(frozen=True)
class SetScrew:
    """Make the joint a screw about its axis. pitch: [m per turn]."""

    part: str
    pitch: float


@dataclass(frozen=True)
class SetMimic:
    """Let `part` follow the part `leader`: its amount is `ratio` times that of the leader. leader None: it follows none."""

    part: str
    leader: str | None
    ratio: float = 1.0


@dataclass(frozen=True)
class SetLoop:
    """Let `part` stay joined to the part `other` at a point [m, asset frame at rest]; other None: remove its loops.

    type: of `LOOP_KINDS`, along the axis of the part's joint.
    """

    part: str
    other: str | None
    origin: Vector = (0.0, 0.0, 0.0)
    type: JointType = JointType.REVOLUTE


@dataclass(frozen=True)
class ChangeParent:
    """Attach `part` to another part; its motion is unchanged."""

    part: str
    parent: str


@dataclass(frozen=True)
class MergeParts:
    """Merge `part` into `into`, which keeps its name and joint; children of `part` become children of `into`."""

    part: str
    into: str


@dataclass(frozen=True)
class SplitPart:
    """Split some faces of `part` into a new part, which is fixed to it until a motion is chosen."""

    part: str
    faces: FaceSet
    name: str
    label: str = "part"


@dataclass(frozen=True)
class SplitComponents:
    """Split each connected component of `part` except the largest into a new part, fixed to it."""

    part: str


@dataclass(frozen=True)
class MoveFaces:
    """Move some faces, of any parts, to `into`."""

    faces: FaceSet
    into: str


@dataclass(frozen=True)
class Relabel:
    """Set the label of `part`."""

    part: str
    label: str


@dataclass(frozen=True)
class Rename:
    """Set the link name of `part`."""

    part: str
    name: str


@dataclass(frozen=True)
class Confirm:
    """State that `part` and its joint are right as they are: both are certain, and their warnings are removed."""

    part: str


@dataclass(frozen=True)
class RemovePart:
    """Merge `part` into its parent, so that it no longer moves by itself; what it carries is carried by the parent."""

    part: str


Correction = (
    ChangeType
    | ChooseMotion
    | SetAxis
    | FlipSign
    | SetLimits
    | SetScrew
    | SetMimic
    | SetLoop
    | ChangeParent
    | MergeParts
    | SplitPart
    | SplitComponents
    | MoveFaces
    | Relabel
    | Rename
    | Confirm
    | RemovePart
)
