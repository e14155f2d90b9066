"""Report of an evaluation: joints.jsonl, report.md, report.html with charts, and worst.png."""

from __future__ import annotations

import base64
import io
import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from html import escape
from math import log10
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import UInt8
from PIL import Image

from anymesh.evaluation.drawing import captioned, contact_sheet, without_caption
from anymesh.evaluation.record import Off, Record, what_is_off, worst
from anymesh.evaluation.score import JointScore
from anymesh.evaluation.summary import RULES, Cell, Table, report_tables
from anymesh.rendering.render import encode
from anymesh.runtime import writing
from anymesh.types import JointType

QUALITY = 82  # JPEG quality: a report with two dozen pictures has about a megabyte
SHOWN = 40  # number of rows above which a table is collapsed
STRENGTH, MIN_SHADE = 0.55, 0.01  # opacity of the shade of the worst cell, and the weakest that is drawn
STYLE = """
body { font: 14px/1.45 system-ui, sans-serif; color: #222; background: #fff }
body { max-width: 1240px; margin: 0 auto; padding: 0 16px 40px }
h1 { font-size: 22px; margin: 22px 0 8px } h2 { font-size: 16px; margin: 26px 0 6px }
p, figcaption, summary { color: #555; margin: 0 0 6px } figure { margin: 0 } summary { cursor: pointer }
.wide { overflow-x: auto } table { border-collapse: collapse; font-size: 13px }
th, td { padding: 2px 8px; text-align: right; border-bottom: 1px solid #e6e6e6; font-variant-numeric: tabular-nums }
th { color: #555; font-weight: 600; border-bottom: 1px solid #999; white-space: nowrap }
th.words, td.words { text-align: left } td:first-child { white-space: nowrap }
.grid { stroke: #e3e3e3; fill: none } svg { width: 100%; font: 11px system-ui, sans-serif }
.charts { display: grid; grid-template-columns: repeat(auto-fill, minmax(340px, 1fr)); gap: 12px }
.worst { display: grid; grid-template-columns: repeat(auto-fill, minmax(480px, 1fr)); gap: 14px }
.worst img { width: 100%; display: block; border: 1px solid #ddd } .worst b { color: #222 }
@media print { .worst { grid-template-columns: 1fr 1fr } }
"""
SHEET = "worst.png"
MAX_SHEET_JOINTS = 24  # maximum number of joints on the contact sheet
SHEET_COLUMNS, SHEET_WIDTH = 3, 620  # number of columns and their width [px]
COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#785a3c", "#7f7f7f")  # after Okabe and Ito
WIDTH, HEIGHT = 400, 250
LEFT, RIGHT, TOP, BOTTOM = 40, 10, 12, 36  # [px] margins of the plot
SHARES = (0.0, 0.25, 0.5, 0.75, 1.0)
TURNING = (JointType.REVOLUTE, JointType.CONTINUOUS)


def html_report(
    title: str,
    settings: Mapping[str, str],
    records: Sequence[Record],
    tables: Sequence[Table],
    worst: Sequence[tuple[Off, UInt8[np.ndarray, "H W 3"]]],
) -> str:
    """Return the report with its tables, the error distributions, and the worst joints with their pictures."""
    sections = {table.title: html_table(table) for table in tables if table.title not in ("Settings", "The worst")}
    summary = sections.pop("Summary")
    charts = "".join(f"<figure>{svg}</figure>" for svg in error_charts(curves(records)))
    pictures = "".join(_figure(off, pixels) for off, pixels in worst)
    subtitle = " · ".join(f"{escape(k)} {escape(v)}" for k, v in settings.items())
    parts = [f"<h1>{escape(title)}</h1><p>{subtitle}</p>", summary]
    if charts:
        note = "Share of joints whose error is at most so large; a curve that ends below 1 has joints that are missing."
        parts.append(f'<h2>Errors of the joints</h2><p>{note}</p><div class="charts">{charts}</div>')
    if pictures:
        note = "Left the object at rest, right the part half way open. Green: true; orange: found."
        parts.append(f'<h2>The worst</h2><p>{note}</p><div class="worst">{pictures}</div>')
    body = "\n".join([*parts, *sections.values()])
    head = f'<meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>{escape(title)}</title>'
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}<style>{STYLE}</style></head><body>\n{body}\n</body></html>\n'


def curves(records: Sequence[Record]) -> dict[str, list[JointScore]]:
    """Group the joints by change if there are several, else by their true type."""
    several = len({r.change for r in records}) > 1
    groups: dict[str, list[JointScore]] = {}
    for record in records:
        for joint in record.score.joints:
            groups.setdefault(record.change if several else str(joint.type_true), []).append(joint)
    return groups


def html_table(table: Table) -> str:
    """Return the table under its title; a long one is collapsed."""
    kinds = [_kind(cell) for cell in table.rows[0]]
    head = "".join(f"<th{kind}>{escape(name)}</th>" for kind, name in zip(kinds, table.head, strict=True))
    rows = "\n".join("<tr>" + "".join(map(_cell, row)) + "</tr>" for row in table.rows)
    made = f'<div class="wide"><table><thead><tr>{head}</tr></thead><tbody>\n{rows}\n</tbody></table></div>'
    if len(table.rows) > SHOWN:
        made = f"<details><summary>{len(table.rows)} rows</summary>{made}</details>"
    note = f"<p>{escape(table.note)}</p>" if table.note else ""
    return f"<h2>{escape(table.title)}</h2>{note}{made}"


def _kind(cell: Cell) -> str:
    return ' class="words"' if cell.shade is None else ""


def _cell(cell: Cell) -> str:
    # The square root makes small errors visible beside large ones.
    strength = STRENGTH * (cell.shade or 0.0) ** 0.5
    style = f' style="background:rgba(213,94,0,{strength:.2f})"' if strength > MIN_SHADE else ""
    return f"<td{_kind(cell)}{style}>{escape(cell.text)}</td>"


def _figure(off: Off, pixels: UInt8[np.ndarray, "H W 3"]) -> str:
    buffer = io.BytesIO()
    Image.fromarray(pixels).save(buffer, "JPEG", quality=QUALITY)
    data = base64.b64encode(buffer.getvalue()).decode()
    caption = f"<b>{escape(off.title)}</b><br>{escape(what_is_off(off.joint))}"
    image = f'<img src="data:image/jpeg;base64,{data}" alt="{escape(off.title)}" loading="lazy">'
    return f"<figure>{image}<figcaption>{caption}</figcaption></figure>"


def write_report(records: Sequence[Record], folder: Path, *, title: str, settings: Mapping[str, str]) -> None:
    """Write the report atomically, file by file, to the folder; worst.png only if a joint was drawn.

    settings: what determines the figures (data set, protocol, answerer, seed, versions, date), in display order.
    Raise OutputError if a file cannot be written.
    """
    drawn = ((o, _pixels(folder / o.picture)) for o in worst(records, MAX_SHEET_JOINTS))
    shown = [(o, without_caption(pixels)) for o, pixels in drawn if pixels is not None]
    tables = report_tables(records, settings, [o for o, _ in shown])
    rows = "".join(json.dumps(row, allow_nan=False) + "\n" for row in joint_rows(records))
    with writing(folder):
        if shown:
            pictures = [captioned(pixels, o.title, what_is_off(o.joint)) for o, pixels in shown]
            _write(folder / SHEET, encode(contact_sheet(pictures, SHEET_COLUMNS, SHEET_WIDTH)).png)
        else:
            (folder / SHEET).unlink(missing_ok=True)
        _write(folder / "joints.jsonl", rows.encode())
        _write(folder / "report.md", markdown_report(title, tables, sheet=SHEET if shown else "").encode())
        _write(folder / "report.html", html_report(title, settings, records, tables, shown).encode())


def joint_rows(records: Sequence[Record]) -> Iterator[dict[str, Any]]:
    """Yield a flat JSON object per true joint: its identity, all scores, and the published success rules."""
    for r in records:
        for j in r.score.joints:
            where = {"object": r.score.name, "category": r.category, "change": r.change}
            success = {f"success_{name}": rule(j) for name, rule in RULES.items()}
            yield {**where, **asdict(j), "type_right": j.type_right, **success, "error": r.error}


def markdown_report(title: str, tables: Sequence[Table], *, sheet: str = "") -> str:
    """Return the report as Markdown. sheet: path of the contact sheet, if any."""
    parts = [f"# {_plain(title)}"]
    for table in tables:
        parts += [f"## {table.title}", *([table.note] if table.note else []), markdown(table)]
    parts += [f"![The worst joints]({sheet})"] if sheet else []
    return "\n\n".join(parts) + "\n"


def markdown(table: Table) -> str:
    """Return the table as Markdown."""
    lines = [[*table.head], ["---"] * len(table.head), *([c.text for c in row] for row in table.rows)]
    return "\n".join("| " + " | ".join(_plain(text) for text in line) + " |" for line in lines)


def _plain(text: str) -> str:
    """Escape Markdown and HTML, and join the text to one line."""
    for sign, quoted in (("&", "&amp;"), ("<", "&lt;"), ("\\", "\\\\"), ("|", "\\|"), ("`", "\\`"), ("*", "\\*"), ("_", "\\_")):
        text = text.replace(sign, quoted)
    return " ".join(text.split())


def _pixels(path: Path) -> UInt8[np.ndarray, "H W 3"] | None:
    """Read a picture; None if there is none."""
    try:
        with Image.open(path) as image:
            return np.asarray(image.convert("RGB"))
    except OSError:
        return None


def _write(path: Path, data: bytes) -> None:
    part = path.with_name(f"{path.name}.part")
    part.write_bytes(data)
    part.replace(path)


@dataclass(frozen=True)
class Error:
    """A joint error: name, field, displayed range [low, high], and the joint types that have it."""

    name: str
    of: str  # field of JointScore
    low: float
    high: float
    types: tuple[JointType, ...] = tuple(JointType)

    def values(self, joints: Sequence[JointScore]) -> list[float | None]:
        """Return the errors of the joints; None if missing."""
        return [getattr(j, self.of) for j in joints if j.type_true in self.types]


ERRORS = (
    Error("angle between the axes [deg]", "angle", 0.01, 100.0),
    Error("distance of the axes (diagonal = 2)", "line_distance", 0.0001, 1.0, TURNING),
    Error("distance of the part's points, opened (diagonal = 2)", "displacement", 0.0001, 1.0),
)


def error_charts(groups: Mapping[str, Sequence[JointScore]]) -> list[str]:
    """Draw a chart per error: the share of each group's joints whose error is at most x."""
    error_curves = ((error, {name: error.values(joints) for name, joints in groups.items()}) for error in ERRORS)
    return [
        cumulative(error.name, {k: v for k, v in curves.items() if v}, error.low, error.high)
        for error, curves in error_curves
        if any(v is not None for values in curves.values() for v in values)
    ]


def cumulative(name: str, curves: Mapping[str, Sequence[float | None]], low: float, high: float) -> str:
    """Draw the share of values up to x, on a logarithmic axis from low to high. Curves with None values stay below 1."""
    inner = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM

    def x(value: float) -> float:
        return LEFT + inner[0] * log10(min(max(value, low), high) / low) / log10(high / low)

    def y(share: float) -> float:
        return TOP + inner[1] * (1 - share)

    lines = [f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img"><title>{escape(name)}</title>']
    for share in SHARES:
        lines.append(f'<path class="grid" d="M{LEFT} {y(share):.1f}H{WIDTH - RIGHT}"/>')
        lines.append(f'<text x="{LEFT - 5}" y="{y(share) + 4:.1f}" text-anchor="end">{share:g}</text>')
    for power in range(round(log10(low)), round(log10(high)) + 1):
        at = x(10.0**power)
        lines.append(f'<path class="grid" d="M{at:.1f} {TOP}V{HEIGHT - BOTTOM}"/>')
        lines.append(f'<text x="{at:.1f}" y="{HEIGHT - BOTTOM + 14}" text-anchor="middle">{10.0**power:g}</text>')
    for k, (label, values) in enumerate(curves.items()):
        color = COLORS[k % len(COLORS)]
        known = sorted(v for v in values if v is not None)
        steps = "".join(f"H{x(v):.1f}V{y((n + 1) / len(values)):.1f}" for n, v in enumerate(known))
        lines.append(f'<path d="M{LEFT} {y(0.0):.1f}{steps}H{WIDTH - RIGHT}" fill="none" stroke="{color}" stroke-width="2"/>')
        row = y(0.0) - 8 - 15 * (len(curves) - 1 - k)
        lines.append(f'<text x="{WIDTH - RIGHT - 6}" y="{row:.1f}" text-anchor="end" fill="{color}">{escape(label)}</text>')
    lines.append(f'<text x="{LEFT + inner[0] / 2}" y="{HEIGHT - 6}" text-anchor="middle">{escape(name)}</text></svg>')
    return "\n".join(lines)
