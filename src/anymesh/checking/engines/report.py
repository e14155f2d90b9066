"""Reports of simulations, in the same form for every engine."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class JointSweep:
    """Motion of one joint through its range. Positions [rad or m]; `reached_*`: reached by a motor within the joint's effort.

    penetration: increase over that at rest, along the path [m], None if not tested; against: link with the deepest penetration,
    empty if none; drift: maximum motion of any other joint [rad or m];
    off: maximum distance of its link from the position given by the joint [m]; faults: in words.
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
    opened: tuple[str, ...] = ()  # joints that were opened first, because their links were in the way

    @property
    def ok(self) -> bool:
        return not self.faults


@dataclass(frozen=True)
class SweepReport:
    """All joints of an asset in one engine. excluded: pairs of links whose contact was not tested, and why."""

    engine: str
    joints: tuple[JointSweep, ...]
    excluded: tuple[tuple[str, str, str], ...]

    @property
    def ok(self) -> bool:
        return all(joint.ok for joint in self.joints)


def as_record(report: SweepReport) -> dict[str, Any]:
    """Convert the report to plain values for JSON."""
    return asdict(report)


def from_record(record: Mapping[str, Any]) -> SweepReport:
    """Restore the report from the values of `as_record`."""
    lists: list[dict[str, Any]] = [dict(j, faults=tuple(j["faults"]), opened=tuple(j["opened"])) for j in record["joints"]]
    joints = tuple(JointSweep(**values) for values in lists)
    return SweepReport(record["engine"], joints, tuple((a, b, why) for a, b, why in record["excluded"]))
