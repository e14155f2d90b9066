"""Summary figures of a group of records. Missing joints and parts count as failures and are never left out."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from statistics import fmean, median

from anymesh.evaluation.particulate_metrics import ParticulateMetrics
from anymesh.evaluation.record import Record
from anymesh.evaluation.score import ObjectScore
from anymesh.evaluation.success import articulate_anything, opd, right, s2o
from anymesh.types import JointType

FARTHEST_ANGLE = 90.0  # [deg] angle error of a joint that was not found: the maximum between axes
FARTHEST = 1.0  # its length errors: half the object's diagonal
UNLIKE = ParticulateMetrics(
    -1.0, 0.0, 3**0.5 / 2
)  # values of a failed object; half the longest possible diagonal if the longest side is 1
RULES = {"right": right, "articulate_anything": articulate_anything, "opd": opd, "s2o": s2o}  # success criteria of a joint


@dataclass(frozen=True)
class Mean:
    """Mean over all true joints, with missing ones counted as `FARTHEST_ANGLE` or `FARTHEST`, and over the found ones.

    None if there are no values.
    """

    all: float | None = None
    median: float | None = None  # median of all
    found: float | None = None


@dataclass(frozen=True)
class Summary:
    """Figures of a group of records; None without values. Shares are 0..1; lengths are relative to a diagonal of 2."""

    objects: int
    joints: int
    errors: int
    found: float | None  # share of joints whose part was found and has a joint
    type_right: float | None
    angle: Mean  # [deg]
    line_distance: Mean  # of true rotating joints
    at_part: Mean  # of the same joints
    displacement: Mean
    opens_right: float | None  # of joints whose true range is known and not endless
    range_iou: float | None  # of joints whose true range is known
    parent_right: float | None
    success: Mapping[str, float | None]  # share of successful joints, by the names of RULES
    tree_right: float | None  # share of objects
    part_precision: float | None
    part_recall: float | None
    part_f1: float | None
    part_miou: float | None  # over all true parts
    rest: ParticulateMetrics | None
    posed: ParticulateMetrics | None
    opened: ParticulateMetrics | None
    executable: float | None  # share of tested objects
    seconds: float | None  # median per object, without errors


def summarize(records: Sequence[Record]) -> Summary:
    """Compute the figures over all joints, or all objects, of these records."""
    joints = [j for r in records for j in r.score.joints]
    turning = [j for j in joints if j.type_true is not JointType.PRISMATIC]
    ranged = [j for j in joints if j.range_known]
    matched, true, predicted = (sum(getattr(r.score, k) for r in records) for k in ("matched", "true", "predicted"))
    return Summary(
        objects=len(records),
        joints=len(joints),
        errors=sum(bool(r.error) for r in records),
        found=_share(j.type_found is not None for j in joints),
        type_right=_share(j.type_right for j in joints),
        angle=_mean([j.angle for j in joints], FARTHEST_ANGLE),
        line_distance=_mean([j.line_distance for j in turning], FARTHEST),
        at_part=_mean([j.at_part for j in turning], FARTHEST),
        displacement=_mean([j.displacement for j in joints], FARTHEST),
        opens_right=_share(bool(j.opens_right) for j in ranged if j.type_true is not JointType.CONTINUOUS),
        range_iou=_share(j.range_iou or 0.0 for j in ranged),
        parent_right=_share(bool(j.parent_right) for j in joints),
        success={name: _share(map(rule, joints)) for name, rule in RULES.items()},
        tree_right=_share(r.score.tree_right and not r.error for r in records),
        part_precision=matched / predicted if predicted else None,
        part_recall=matched / true if true else None,
        part_f1=2 * matched / (predicted + true) if predicted + true else None,
        part_miou=sum(r.score.part_miou * r.score.true for r in records if not r.error) / true if true else None,
        rest=_particulate(records, lambda s: s.rest),
        posed=_particulate(records, lambda s: s.posed),
        opened=_particulate(records, lambda s: s.opened),
        executable=_executable(records),
        seconds=median(r.seconds for r in records if not r.error) if any(not r.error for r in records) else None,
    )


def of_type(records: Iterable[Record], kind: JointType) -> list[Record]:
    """Return the records with only the joints of one true type; figures of whole objects stay."""
    return [replace(r, score=replace(r.score, joints=tuple(j for j in r.score.joints if j.type_true is kind))) for r in records]


def _share(values: Iterable[float]) -> float | None:
    numbers = list(values)
    return fmean(numbers) if numbers else None


def _mean(values: Sequence[float | None], missing: float) -> Mean:
    if not values:
        return Mean()
    every = [missing if v is None else v for v in values]
    return Mean(fmean(every), median(every), _share(v for v in values if v is not None))


def _particulate(
    records: Sequence[Record], of: Callable[[ObjectScore], ParticulateMetrics | None]
) -> ParticulateMetrics | None:
    """Compute the mean over measured objects; failed objects count as `UNLIKE`."""
    measured = [of(r.score) for r in records if not r.error]
    known = [m for m in measured if m is not None]
    if not known:
        return None
    known += [UNLIKE for r in records if r.error]
    return ParticulateMetrics(*(fmean(getattr(m, name) for m in known) for name in ("giou", "miou", "chamfer")))


def _executable(records: Sequence[Record]) -> float | None:
    """Compute the share of executable objects; failed objects count as not executable if others of the group were tested."""
    if all(r.score.executable is None for r in records):
        return None
    return _share(bool(r.score.executable) for r in records if r.error or r.score.executable is not None)
