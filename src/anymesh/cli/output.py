"""Output of the command line: tables, one JSON object, progress on a terminal."""

from __future__ import annotations

import json
import signal
import sys
import time
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from anymesh.runtime import Progress, silent

if TYPE_CHECKING:
    from anymesh.types import Asset, Joint

JOINT_COLUMNS = ("name", "type", "parent", "range", "confidence", "reason")
ASSET_COLUMNS = ("name", "type", "parent", "range", "part", "confidence", "reason")  # part: confidence that the child is a part
FILE_WIDTH = 140  # [characters] width of a table that is not printed to a terminal; the default of 80 breaks its cells


def joint_row(joint: Joint) -> dict[str, Any]:
    from anymesh.rendering.preview import extent

    return {
        "name": joint.name,
        "type": joint.type.value,
        "parent": joint.parent,
        "child": joint.child,
        "origin": [float(v) for v in joint.origin],
        "axis": [float(v) for v in joint.axis],
        "limits": None if joint.limits is None else list(joint.limits),
        "range": extent(joint),
        "confidence": joint.confidence,
        "reason": joint.reason,
    }


def print_asset(asset: Asset, out: Path, json_: bool, quiet: bool) -> None:
    from anymesh.export.asset_json import usage

    part = {p.name: p.confidence for p in asset.segmentation.parts}
    rows = [{**joint_row(j), "part": part[j.child]} for j in asset.joints]
    record = {
        "name": asset.name,
        "out": str(out),
        "answerer": asset.answerer,
        "hint": unsure_hint(asset),
        "parts": [p.name for p in asset.segmentation.parts],
        "joints": rows,
        "notes": list(asset.source.notes),
        "finish": list(asset.notes),
        "warnings": list(asset.warnings),
        "usage": usage(asset.exchanges),
        "timing": dict(asset.timing),
    }
    if not (json_ or quiet):
        for line in (*(f"warning: {w}" for w in asset.warnings), *asset.source.notes, *asset.notes):
            typer.echo(plain(line))
    print_result(record, rows, ASSET_COLUMNS, json_, quiet)
    if not (json_ or quiet):
        if asset.exchanges:
            typer.echo(_spent(record["usage"], out))
        files = json.loads((out / "asset.json").read_bytes())["files"].values()
        typer.echo(f"wrote {', '.join(files)}, preview.png and asset.json to {out}")
        if record["hint"]:
            typer.echo(record["hint"])


def unsure_hint(asset: Asset) -> str:
    """Return advice if geometry alone answered and is unsure of a joint; empty otherwise."""
    from anymesh.pipeline.options import GEOMETRY
    from anymesh.pipeline.results import LOW_CONFIDENCE

    count = sum(j.confidence < LOW_CONFIDENCE for j in asset.joints)
    if asset.answerer != GEOMETRY or not count:
        return ""
    joints = "1 joint is" if count == 1 else f"{count} joints are"
    return (
        f"{joints} unsure; better answers: --answerer files:FOLDER (you, or an agent, answer from pictures), "
        "--answerer ollama:MODEL (a local model; `anymesh models`), or correct it in `anymesh view`"
    )


def _spent(usage: dict[str, Any], out: Path) -> str:
    cost = "at an unknown price" if usage["cost_usd"] is None else f"{usage['cost_usd']:.4f} USD"
    tokens = f"{usage['input_tokens']} + {usage['output_tokens']} tokens"
    summary = f"{usage['calls']} calls ({usage['cached_calls']} from the cache), {tokens}, {cost}"
    return f"{summary}; every question with its pictures: {out / 'transcript' / 'index.html'}"


def print_result(
    record: dict[str, Any], rows: list[dict[str, Any]], columns: tuple[str, ...], json_: bool, quiet: bool
) -> None:
    """Print the record as JSON, or these columns of the rows as a table; with `quiet`, no table."""
    if json_:
        typer.echo(json.dumps(record, indent=2))
    elif not quiet:
        from rich.console import Console
        from rich.table import Table
        from rich.text import Text

        table = Table(*columns)
        for row in rows:
            cells = (f"{row[c]:.2f}" if isinstance(row[c], float) else str(row[c]) for c in columns)
            table.add_row(*(Text(plain(cell)) for cell in cells))
        Console(width=None if sys.stdout.isatty() else FILE_WIDTH).print(table)


def plain(text: str) -> str:
    """Replace control characters, so that names from files cannot control the terminal."""
    return "".join(c if c.isprintable() else "?" for c in text)


@contextmanager
def ended_by_signal() -> Generator[None]:
    """Let SIGTERM, by which schedulers end a job, end a run as Ctrl-C does."""

    def stop(*_: object) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, stop)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


class Shown:
    """Progress on stderr (stage, item, seconds), only on a terminal."""

    def __init__(self, hidden: bool) -> None:
        self._status: Any = None
        self._hidden = hidden or not sys.stderr.isatty()
        self._begin = time.monotonic()

    def __enter__(self) -> Progress:
        if self._hidden:
            return silent
        from rich.console import Console

        self._status = Console(stderr=True).status("")
        self._status.start()
        return self._show_progress

    def _show_progress(self, stage: str, item: str, done: int, total: int) -> None:
        seconds = time.monotonic() - self._begin
        self._status.update(f"{stage} {plain(item)} ({done + 1}/{total}, {seconds:.0f} s)")

    def __exit__(self, *_: object) -> None:
        if self._status is not None:
            self._status.stop()
