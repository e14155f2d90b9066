"""The report as one self-contained HTML file."""

from __future__ import annotations

import base64
import io
from collections.abc import Mapping, Sequence
from html import escape

import numpy as np
from jaxtyping import UInt8
from PIL import Image

from anymesh.evaluation.charts import error_charts
from anymesh.evaluation.record import Record
from anymesh.evaluation.score import JointScore
from anymesh.evaluation.tables import Cell, Table
from anymesh.evaluation.worst import Off, what_is_off

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
