"""What a simulator says of an asset, the same whichever engine it was."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class JointSweep:
    """One joint through its range. Positions [rad or m]; `reached_*` is how far a motor within the joint's effort came.

    penetration: how much deeper it went into others than at rest, on its path [m], None where the engine was not asked;
    against: the link it went deepest into, empty when none; drift: the most that any other joint moved meanwhile [rad or m];
    off: the most that its link was away from where the joint says [m]; faults: what is wrong, in words.
    """

    name: str
    type: str
    lower: float
    upper: float
    reached_lower: float
    reached_upper: float
    penetration: float | None
    against: str
    drift: float
    off: float
    faults: tuple[str, ...]
    opened: tuple[str, ...] = ()  # joints that had to be opened first, for what they carry was in the way

    @property
    def ok(self) -> bool:
        return not self.faults


@dataclass(frozen=True)
class SweepReport:
    """All joints of an asset in one engine. excluded: pairs of links whose contact was not looked at, and why."""

    engine: str
    joints: tuple[JointSweep, ...]
    excluded: tuple[tuple[str, str, str], ...]

    @property
    def ok(self) -> bool:
        return all(joint.ok for joint in self.joints)


def as_record(report: SweepReport) -> dict[str, Any]:
    """As plain values for JSON."""
    return asdict(report)


def from_record(record: Mapping[str, Any]) -> SweepReport:
    """The report that `as_record` was given."""
    lists: list[dict[str, Any]] = [dict(j, faults=tuple(j["faults"]), opened=tuple(j["opened"])) for j in record["joints"]]
    joints = tuple(JointSweep(**values) for values in lists)
    return SweepReport(record["engine"], joints, tuple((a, b, why) for a, b, why in record["excluded"]))
