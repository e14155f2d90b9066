"""Summary figures and tables of a group of records, and published success criteria.

Missing joints and parts count as failures and are never left out. Revolute and continuous joints are treated alike. Lengths of
a score are in units of half the object's diagonal.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from operator import itemgetter
from statistics import fmean, median
from typing import NamedTuple

from anymesh.evaluation.particulate_metrics import ParticulateMetrics
from anymesh.evaluation.record import Off, Record, what_is_off
from anymesh.evaluation.score import JointScore, ObjectScore
from anymesh.types import JointType

AA_ANGLE, AA_ORIGIN = 14.3239, 0.05  # .25 rad [deg], and 50 mm for a diagonal of 2 m
OPD_ANGLE, OPD_ORIGIN = 10.0, 0.25  # [deg], share of the object's diagonal
S2O_ANGLE, S2O_ORIGIN = 5.0, 0.1  # [deg], share of the part's diagonal
DIAGONAL = 2.0  # of the object, in units of half of it
FARTHEST_ANGLE = 90.0  # [deg] angle error of a joint that was not found: the maximum between axes
FARTHEST = 1.0  # its length errors: half the object's diagonal
UNLIKE = ParticulateMetrics(
    -1.0, 0.0, 3**0.5 / 2
)  # values of a failed object; half the longest possible diagonal if the longest side is 1


def right(joint: JointScore) -> bool:
    """Return whether a user need not correct a joint but for its limits: see `JointScore.right`."""
    return joint.right


def articulate_anything(joint: JointScore) -> bool:
    """Articulate-Anything (Le et al., ICLR 2025, arXiv 2410.13882): right type, axis within .25 rad, origin within .05.

    The origin error of a rotating joint is the distance of the two axes; slides have none. The authors measure in units of
    PartNet-Mobility, whose objects fill a sphere of radius 1, so the diagonal is about 2 as here, and call .05 50 mm.
    Their code averages this with the angle between the joints' frames, which a mesh does not provide, and tolerates a
    difference of rotation ranges of up to 1.6 rad; as in ArticulateArena (arXiv 2609.33931), neither is used here.
    """
    return joint.type_right and _within(joint.angle, AA_ANGLE) and _line(joint, joint.line_distance, AA_ORIGIN)


def opd(joint: JointScore) -> bool:
    """OPD (Jiang et al., ECCV 2022, arXiv 2203.16421), "+MAO": type, axis within 10 degrees, origin within .25.

    The origin counts for rotating joints: its distance from the true axis, relative to the object's diagonal.
    The authors match parts by 2D masks with an IoU of .5; here the IoU is that of the parts' surfaces.
    """
    return joint.type_right and _within(joint.angle, OPD_ANGLE) and _line(joint, joint.origin, OPD_ORIGIN * DIAGONAL)


def s2o(joint: JointScore) -> bool:
    """S2O (Iliash et al., WACV 2026, arXiv 2409.18896), "MAO": type, axis within 5 degrees, origin within .1, at IoU .5.

    The origin counts for rotating joints: its distance from the true axis, relative to the part's diagonal.
    The authors use the IoU of the parts' axis-aligned boxes; here it is that of their surfaces.
    """
    return joint.type_right and _within(joint.angle, S2O_ANGLE) and _line(joint, joint.origin, S2O_ORIGIN * joint.part_size)


def _within(value: float | None, limit: float) -> bool:
    return value is not None and value <= limit


def _line(joint: JointScore, value: float | None, limit: float) -> bool:
    """Return whether the origin error is within the limit; slides have none."""
    return joint.type_true is JointType.PRISMATIC or _within(value, limit)


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
    followers: float | None  # share of true followers that are coupled with their leader, at the right ratio
    invented: float | None  # followers that are coupled with nothing in the truth; None where nothing follows
    executable: float | None  # share of tested objects
    seconds: float | None  # median per object, without errors


def summarize(records: Sequence[Record]) -> Summary:
    """Compute the figures over all joints, or all objects, of these records."""
    joints = [j for r in records for j in r.score.joints]
    turning = [j for j in joints if j.type_true is not JointType.PRISMATIC]
    ranged = [j for j in joints if j.range_known]
    matched, true, predicted = (sum(getattr(r.score, k) for r in records) for k in ("matched", "true", "predicted"))
    led = [r.score.followers for r in records]
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
        followers=sum(f.right for f in led) / true_led if (true_led := sum(f.true for f in led)) else None,
        invented=float(sum(f.invented for f in led)) if any(f.true or f.invented for f in led) else None,
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


class Cell(NamedTuple):
    """Cell of a table. shade: of a figure, 0 (right, or neutral) to 1 (worst); None for words."""

    text: str
    shade: float | None = None


@dataclass(frozen=True)
class Table:
    """A table. `note`: text below the title."""

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    note: str = ""


@dataclass(frozen=True)
class Column:
    """A figure of a summary. best, worst: range over which its cells are shaded, None for no shade; short: in every table."""

    name: str
    of: Callable[[Summary], float | Mean | None]
    means: str
    form: str = ".3f"
    best: float | None = 1.0
    worst: float = 0.0
    short: bool = True
    whole: bool = False  # belongs to objects, not to their joints

    def cell(self, value: float | None) -> Cell:
        if value is None:
            return Cell("-", 0.0)
        shade = 0.0 if self.best is None else (value - self.best) / (self.worst - self.best)
        return Cell(f"{value:{self.form}}", min(max(shade, 0.0), 1.0))

    def value(self, summary: Summary) -> float | None:
        figure = self.of(summary)
        return figure.all if isinstance(figure, Mean) else figure


def _length(name: str, of: Callable[[Summary], Mean], means: str) -> Column:
    return Column(name, of, f"{means}; missing: {FARTHEST:g}", ".4f", 0.0, FARTHEST)


def _alike(name: str, of: Callable[[Summary], ParticulateMetrics | None], when: str, *, short: bool) -> tuple[Column, ...]:
    def value(field: str) -> Callable[[Summary], float | None]:
        return lambda s: None if of(s) is None else getattr(of(s), field)

    meaning = f"Particulate's, {when}; failed: "
    return (
        Column(f"{name} gIoU", value("giou"), f"{meaning}{UNLIKE.giou:g}", worst=UNLIKE.giou, short=short, whole=True),
        Column(f"{name} mIoU", value("miou"), f"{meaning}{UNLIKE.miou:g}", worst=UNLIKE.miou, short=False, whole=True),
        Column(
            f"{name} Chamfer", value("chamfer"), f"{meaning}{UNLIKE.chamfer:.2f}", ".4f", 0.0, UNLIKE.chamfer, False, whole=True
        ),
    )


COLUMNS = (
    Column("objects", lambda s: float(s.objects), "objects, once for each change or view", ".0f", None, whole=True),
    Column("joints", lambda s: float(s.joints), "true joints; what is missing counts as a failure", ".0f", None),
    Column("errors", lambda s: float(s.errors), "objects that failed: all their joints are missing", ".0f", None, whole=True),
    Column("found", lambda s: s.found, "joints whose part was found (IoU .5) and has a joint"),
    Column("type", lambda s: s.type_right, "joints that turn or slide as they should"),
    Column("angle", lambda s: s.angle, f"[deg] between axes, sign ignored; missing: {FARTHEST_ANGLE:g}", ".2f", 0.0, 90.0),
    _length("line", lambda s: s.line_distance, "distance of the axes, of joints that turn"),
    _length("at part", lambda s: s.at_part, "distance of the axes level with the part, of joints that turn"),
    _length("points", lambda s: s.displacement, "how far the part's points are off, at 30 deg or half the travel"),
    Column("opens", lambda s: s.opens_right, "joints that open to the right side"),
    Column("range", lambda s: s.range_iou, "IoU of the ranges"),
    Column("parent", lambda s: s.parent_right, "joints with the right parent"),
    Column("tree", lambda s: s.tree_right, "objects with every joint, no other, each with the right parent", whole=True),
    Column("precision", lambda s: s.part_precision, "predicted movable parts that are one (IoU .5)", short=False, whole=True),
    Column("recall", lambda s: s.part_recall, "true movable parts that were found (IoU .5)", short=False, whole=True),
    Column("part F1", lambda s: s.part_f1, "of all movable parts together", whole=True),
    Column("part mIoU", lambda s: s.part_miou, "over all true movable parts", whole=True),
    Column("right", lambda s: s.success["right"], "right type, 10 degrees, .1 at the part, and side", short=False),
    Column("A-A", lambda s: s.success["articulate_anything"], "joints that succeed by Articulate-Anything's rule"),
    Column("OPD", lambda s: s.success["opd"], "joints that succeed by OPD's rule (+MAO)", short=False),
    Column("S2O", lambda s: s.success["s2o"], "joints that succeed by S2O's rule (MAO)", short=False),
    *_alike("rest", lambda s: s.rest, "at rest", short=False),
    *_alike("posed", lambda s: s.posed, "mean over five states of the ranges", short=False),
    *_alike("open", lambda s: s.opened, "at the upper ends of the ranges", short=True),
    Column("follows", lambda s: s.followers, "followers coupled with their leader, at the right ratio if told", whole=True),
    Column("invented", lambda s: s.invented, "followers that are none", ".0f", None, whole=True),
    Column("runs", lambda s: s.executable, "objects whose joints all went through their range in a simulator", whole=True),
    Column("seconds", lambda s: s.seconds, "an object, median", ".1f", None, whole=True),
)  # fmt: skip


def report_tables(records: Sequence[Record], settings: Mapping[str, str], off: Sequence[Off]) -> list[Table]:
    """Return all tables of a report, most informative first; empty ones are left out."""
    kinds = [(str(kind), of_type(records, kind)) for kind in JointType]
    by = (
        group_table("By change", grouped(records, lambda r: r.change)),
        group_table("By category", sorted(grouped(records, lambda r: r.category), key=itemgetter(0))),
        group_table("By true joint type", [k for k in kinds if any(r.score.joints for r in k[1])], whole=False),
    )
    tables = [
        Table("Settings", ("setting", "value"), tuple((Cell(k), Cell(v)) for k, v in settings.items())),
        _summary_table(summarize(records)),
        *(table for table in by if len(table.rows) > 1),
        Table("The worst", ("joint", "what is off"), tuple((Cell(o.title), Cell(what_is_off(o.joint))) for o in off)),
        Table("Errors", ("object", "error"), tuple((Cell(r.title), Cell(r.error)) for r in records if r.error)),
        group_table("Objects", [(r.title, [r]) for r in records]),
    ]
    return [table for table in tables if table.rows]


def grouped(records: Sequence[Record], of: Callable[[Record], str]) -> list[tuple[str, list[Record]]]:
    """Group records, in the order of first appearance."""
    return [(name, [r for r in records if of(r) == name]) for name in dict.fromkeys(map(of, records))]


def _summary_table(summary: Summary) -> Table:
    """Return a table with one row per figure."""
    rows = []
    for column in COLUMNS:
        figure = column.of(summary)
        mean = figure if isinstance(figure, Mean) else Mean(figure)
        if mean.all is not None:
            spread = (column.cell(v) if v is not None else Cell("", 0.0) for v in (mean.median, mean.found))
            rows.append((Cell(column.name), column.cell(mean.all), *spread, Cell(column.means)))
    head = ("figure", "all", "median", "found alone", "meaning")
    return Table("Summary", head, tuple(rows), "Lengths as the field has them: the object's diagonal is 2.")


def group_table(title: str, groups: Sequence[tuple[str, Sequence[Record]]], *, whole: bool = True) -> Table:
    """Return a table with one row per group. whole: include figures of objects."""
    summaries = [summarize(some) for _, some in groups]
    columns = [c for c in COLUMNS if c.short and (whole or not c.whole) and _is_informative(c, summaries)]
    rows = ((Cell(name), *(c.cell(c.value(s)) for c in columns)) for (name, _), s in zip(groups, summaries, strict=True))
    return Table(title, ("", *(c.name for c in columns)), tuple(rows))


def _is_informative(column: Column, summaries: Sequence[Summary]) -> bool:
    """Return whether any row has an informative value; counts of objects or errors at their minimum everywhere are not."""
    nothing = {"objects": 1.0, "errors": 0.0}.get(column.name)
    return any(column.value(s) not in (None, nothing) for s in summaries)
