"""Tables of a report, as text for Markdown and HTML."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import NamedTuple

from anymesh.evaluation.particulate_metrics import ParticulateMetrics
from anymesh.evaluation.record import Record
from anymesh.evaluation.summary import FARTHEST, FARTHEST_ANGLE, UNLIKE, Mean, Summary, of_type, summarize
from anymesh.evaluation.worst import Off, what_is_off
from anymesh.types import JointType


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
