"""Report of an evaluation: joints.jsonl, report.md, report.html and worst.png."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import UInt8
from PIL import Image

from anymesh.errors import OutputError
from anymesh.evaluation.drawing import captioned, contact_sheet, without_caption
from anymesh.evaluation.record import Record
from anymesh.evaluation.report_html import html_report
from anymesh.evaluation.summary import RULES
from anymesh.evaluation.tables import Table, report_tables
from anymesh.evaluation.worst import what_is_off, worst
from anymesh.rendering.render import encode

SHEET = "worst.png"
MAX_SHEET_JOINTS = 24  # maximum number of joints on the contact sheet
SHEET_COLUMNS, SHEET_WIDTH = 3, 620  # number of columns and their width [px]


def write_report(records: Sequence[Record], folder: Path, *, title: str, settings: Mapping[str, str]) -> None:
    """Write the report atomically, file by file, to the folder; worst.png only if a joint was drawn.

    settings: what determines the figures (data set, protocol, answerer, seed, versions, date), in display order.
    Raise OutputError if a file cannot be written.
    """
    drawn = ((o, _pixels(folder / o.picture)) for o in worst(records, MAX_SHEET_JOINTS))
    shown = [(o, without_caption(pixels)) for o, pixels in drawn if pixels is not None]
    tables = report_tables(records, settings, [o for o, _ in shown])
    rows = "".join(json.dumps(row, allow_nan=False) + "\n" for row in joint_rows(records))
    try:
        if shown:
            pictures = [captioned(pixels, o.title, what_is_off(o.joint)) for o, pixels in shown]
            _write(folder / SHEET, encode(contact_sheet(pictures, SHEET_COLUMNS, SHEET_WIDTH)).png)
        else:
            (folder / SHEET).unlink(missing_ok=True)
        _write(folder / "joints.jsonl", rows.encode())
        _write(folder / "report.md", markdown_report(title, tables, sheet=SHEET if shown else "").encode())
        _write(folder / "report.html", html_report(title, settings, records, tables, shown).encode())
    except OSError as error:
        raise OutputError(f"cannot write the report to {folder}: {error.strerror or error}") from error


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
