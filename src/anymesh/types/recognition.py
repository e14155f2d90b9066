"""Recognized category of an object, and its kinds of movable parts."""

from __future__ import annotations

from dataclasses import dataclass

from anymesh.types.motion import JointType

BASE = "base"  # label of the static base


@dataclass(frozen=True)
class RecognizedLabel:
    """A kind of movable part.

    moves: as answered before any picture of its joint, never FIXED; limits: (lower, upper) from the pose shown [rad, or m],
    None if unknown.
    """

    label: str
    moves: JointType | None  # None if unknown
    parent: str | None  # another label, or "base"; None if unknown
    limits: tuple[float, float] | None


@dataclass(frozen=True)
class Recognition:
    """The recognized object.

    size: longest side of the real object [m]; front: azimuth of the view that shows the front [deg]. Both are None if unknown.
    """

    category: str
    size: float | None
    labels: tuple[RecognizedLabel, ...]
    front: float | None = None
