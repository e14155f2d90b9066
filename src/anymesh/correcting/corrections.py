"""What a person corrects: each kind of correction is one frozen value that says all it needs, so that a log replays."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from anymesh.errors import OptionError
from anymesh.types import JointType

Vector = tuple[float, float, float]


def vector(values: Float[np.ndarray, " 3"]) -> Vector:
    """Three numbers of an array."""
    x, y, z = (float(v) for v in values)
    return x, y, z


class CorrectionError(OptionError):
    """A correction makes no sense for this asset: no such part, a circle, an empty part, limits without the rest pose."""


@dataclass(frozen=True)
class FaceSet:
    """Face numbers as runs (first, one after the last), ascending and apart; equal sets are equal values."""

    runs: tuple[tuple[int, int], ...]

    @classmethod
    def of(cls, faces: Int[np.ndarray, " n"] | Iterable[int]) -> FaceSet:
        """The set of some face numbers, in any order."""
        numbers = np.unique(np.fromiter(faces, np.int64) if not isinstance(faces, np.ndarray) else faces.astype(np.int64))
        if len(numbers) == 0:
            return cls(())
        cuts = np.flatnonzero(np.diff(numbers) != 1) + 1
        starts, ends = np.r_[0, cuts], np.r_[cuts, len(numbers)]
        return cls(tuple((int(numbers[a]), int(numbers[b - 1]) + 1) for a, b in zip(starts, ends, strict=True)))

    @property
    def numbers(self) -> Int[np.ndarray, " n"]:
        """The face numbers, ascending."""
        return np.concatenate([np.zeros(0, np.int64), *(np.arange(a, b) for a, b in self.runs)])


@dataclass(frozen=True)
class ChangeType:
    """The joint that carries `part` becomes another type; limits that do not go with it become the usual ones."""

    part: str
    type: JointType


@dataclass(frozen=True)
class ChooseMotion:
    """The joint that carries `part` becomes another of its free motions. axis, origin [m], limits [rad or m]: asset frame."""

    part: str
    type: JointType
    axis: Vector
    origin: Vector
    limits: tuple[float, float] | None
    confidence: float  # that the finder gave it
    reason: str


@dataclass(frozen=True)
class SetAxis:
    """The joint's axis and a point on it [m], asset frame. `how`: in words, such as what on the mesh it was snapped to."""

    part: str
    axis: Vector
    origin: Vector
    how: str = "by numbers"


@dataclass(frozen=True)
class FlipSign:
    """Positive goes the other way; the limits keep their numbers."""

    part: str


@dataclass(frozen=True)
class SetLimits:
    """(lower, upper) [rad or m] that hold the rest pose 0; a continuous joint becomes a revolute one."""

    part: str
    lower: float
    upper: float


@dataclass(frozen=True)
class ChangeParent:
    """`part` hangs on another part; its motion stays as it is."""

    part: str
    parent: str


@dataclass(frozen=True)
class MergeParts:
    """`part` becomes one with `into`, which keeps its name and joint; what hung on `part` hangs on `into`."""

    part: str
    into: str


@dataclass(frozen=True)
class SplitPart:
    """Some faces of `part` become a part of their own, fixed to it until someone says how it moves."""

    part: str
    faces: FaceSet
    name: str
    label: str = "part"


@dataclass(frozen=True)
class SplitComponents:
    """Each connected component of `part` but the largest becomes a part of its own, fixed to it."""

    part: str


@dataclass(frozen=True)
class MoveFaces:
    """Some faces, of whichever parts, become faces of `into`."""

    faces: FaceSet
    into: str


@dataclass(frozen=True)
class Relabel:
    """The field's word for `part`."""

    part: str
    label: str


@dataclass(frozen=True)
class Rename:
    """The link name of `part`."""

    part: str
    name: str


Correction = (
    ChangeType
    | ChooseMotion
    | SetAxis
    | FlipSign
    | SetLimits
    | ChangeParent
    | MergeParts
    | SplitPart
    | SplitComponents
    | MoveFaces
    | Relabel
    | Rename
)
