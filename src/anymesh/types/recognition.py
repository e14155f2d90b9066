"""What an object is, and which kinds of its parts move, in the words of someone who sees it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

BASE = "base"  # the label of what stands still


class Moves(StrEnum):
    """How a kind of part moves, as asked before any picture of its joint."""

    REVOLUTE = "revolute"
    CONTINUOUS = "continuous"
    PRISMATIC = "prismatic"


@dataclass(frozen=True)
class RecognizedLabel:
    """A kind of movable part. limits: (lower, upper) from the pose shown [rad, or m], None when nobody said."""

    label: str
    moves: Moves | None  # None when nobody said
    parent: str | None  # another label, or "base"; None when nobody said
    limits: tuple[float, float] | None


@dataclass(frozen=True)
class Recognition:
    """The answer. size: longest side of the real thing [m]; front: azimuth of the view that shows the front [deg]; None when
    nobody said."""

    category: str
    size: float | None
    labels: tuple[RecognizedLabel, ...]
    front: float | None = None
