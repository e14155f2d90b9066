"""Output of the command line: tables, one JSON object, progress on a terminal."""

from __future__ import annotations

import json
import os
import shutil
import signal
import sys
import textwrap
import time
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from anymesh.entry_points import MOTION_WORDS, resolve
from anymesh.runtime import Progress, silent

if TYPE_CHECKING:
    from anymesh.types import Asset, Joint

MAX_WIDTH = 100  # [characters] of tables and of wrapped lines, also on wider terminals
GAP, MIN_CELL = 2, 8  # [characters] between columns; width below which a column is not cut
STEPS = {  # words; begin and length as shares of a run: medians of the 21 examples (quartiles of the last: 0.36 to 0.52)
    "load": ("reading the mesh", 0.0, 0.04),
    "segment": ("finding the parts", 0.04, 0.48),
    "joints": ("finding the joints", 0.52, 0.02),
    "export": ("writing the asset", 0.54, 0.46),
}
OTHER_STEPS = {
    "finish": "completing shapes", "picture": "drawing", "report": "writing the report", "eval": "evaluating",
    "interaction": "moving joints", "train": "training", "generate": "making the mesh", "targets": "choosing where to touch",
    "route": "planning the arm's way", "check": "checking frames", "splat": "making depth", "allocate": "finding the space",
    "fuse": "fusing depth", "color": "colouring", "clean": "cleaning", "smooth": "smoothing", "simplify": "simplifying",
    "samples": "writing variants", "grasps": "trying grasps",
}  # fmt: skip
MANY = ("batch", "scene")  # steps whose items are meshes, with steps of their own
MIN_SHARE, MIN_SECONDS = 0.1, 3.0  # done, and time taken, below which no time left is estimated
ESTIMATE_WIDTH = 36  # [characters] for the times in a line of progress
COLORS = {"sure": "green", "check": "yellow", "guess": "red"}


def joint_row(asset: Asset, joint: Joint) -> dict[str, Any]:
    from anymesh.pipeline.results import verdict
    from anymesh.rendering.preview import extent

    word, why = verdict(asset.segmentation, joint, asset.warnings)
    part = next(p.confidence for p in asset.segmentation.parts if p.name == joint.child)
    return {
        "name": joint.name, "type": joint.type.value, "parent": joint.parent, "child": joint.child,
        "origin": [float(v) for v in joint.origin], "axis": [float(v) for v in joint.axis],
        "limits": None if joint.limits is None else list(joint.limits), "range": extent(joint),
        "motion": resolve(MOTION_WORDS)(asset, joint), "part": part, "confidence": joint.confidence, "reason": joint.reason,
        "verdict": word, "why": why,
    }  # fmt: skip


def print_joints(asset: Asset, record: dict[str, Any], json_: bool, verbose: bool) -> None:
    """Print a record with the joints of an asset as JSON; or the joints as a table, with their reasons if verbose."""
    from anymesh.pipeline.results import summary

    rows = [joint_row(asset, j) for j in asset.joints]
    line = summary(asset.segmentation, asset.joints, asset.warnings, len(asset.proposals))
    proposals = [{"part": p.part.name, "motion": p.motion, "probability": p.probability} for p in asset.proposals]
    record |= {"joints": rows, "proposals": proposals, "summary": line}
    if json_:
        typer.echo(json.dumps(record, indent=2))
        return
    shown = [{"part": r["child"], "motion": r["motion"], "range": r["range"], "verdict": r["verdict"]} for r in rows]
    lines = table(shown, ("part", "motion", "range", "verdict"))
    typer.echo(lines[0] if rows else "nothing moves")
    for row, line in zip(rows, lines[1:], strict=True):
        word = row["verdict"]
        colored = word if os.environ.get("NO_COLOR") else typer.style(word, fg=COLORS[word])
        typer.echo(line.removesuffix(word) + colored)  # without colour where it is no terminal
        if verbose:
            sure = f"part {row['part']:.2f}, joint {row['confidence']:.2f}"
            echo(f"{row['name']}, on {row['parent']}; {sure}: {row['reason']}", indent=4)


def print_asset(asset: Asset, out: Path, json_: bool, quiet: bool, verbose: bool = False) -> None:
    """Print what was made: the joints, then warnings and files, and at last one line on all joints."""
    if quiet and not json_:
        return
    from anymesh.export.asset_json import usage

    record: dict[str, Any] = {
        "name": asset.name, "out": str(out), "answerer": asset.answerer, "hint": unsure_hint(asset, out),
        "parts": [p.name for p in asset.segmentation.parts], "notes": list(asset.source.notes), "finish": list(asset.notes),
        "warnings": list(asset.warnings), "usage": usage(asset.exchanges), "timing": dict(asset.timing),
    }  # fmt: skip
    if not json_:
        for line in (*asset.source.notes, *asset.notes):
            echo(line)
    print_joints(asset, record, json_, verbose)
    if json_:
        return
    for warning in asset.warnings:
        echo(f"warning: {warning}")
    if asset.exchanges:
        echo(_spent(record["usage"], out))
    files = json.loads((out / "asset.json").read_bytes())["files"].values()
    echo(f"wrote {', '.join(files)}, preview.png and asset.json to {out}")
    for p in asset.proposals:
        echo(f"proposed, not written ({p.probability:.2f}): {p.part.name}, {p.motion}")
    if asset.proposals:
        echo(f"accept a proposal: anymesh correct {out} PART --accept")
    if record["hint"]:
        echo(record["hint"])
    echo(record["summary"])


def unsure_hint(asset: Asset, out: Path) -> str:
    """Return advice if a joint is not sure; empty otherwise."""
    from anymesh.pipeline.options import GEOMETRY
    from anymesh.pipeline.results import verdict

    if all(verdict(asset.segmentation, j, asset.warnings).word == "sure" for j in asset.joints):
        return ""
    models = ", or ask a model: --answerer ollama:MODEL (`anymesh models`) or files:FOLDER (you, or an agent)"
    return f"look at preview.png; correct a joint in `anymesh view {out}`{models if asset.answerer == GEOMETRY else ''}"


def _spent(usage: dict[str, Any], out: Path) -> str:
    cost = "at an unknown price" if usage["cost_usd"] is None else f"{usage['cost_usd']:.4f} USD"
    tokens = f"{usage['input_tokens']} + {usage['output_tokens']} tokens"
    summary = f"{usage['calls']} calls ({usage['cached_calls']} from the cache), {tokens}, {cost}"
    return f"{summary}; every question with its pictures: {out / 'transcript' / 'index.html'}"


def echo(line: str, indent: int = 0) -> None:
    """Print a line as text, on a terminal wrapped at words. indent: of all of it; further lines have two characters more."""
    text = " " * indent + plain(line)
    if sys.stdout.isatty():
        text = textwrap.fill(text, width(), subsequent_indent=" " * (indent + GAP), break_on_hyphens=False)
    typer.echo(text)


def width() -> int:
    """Return the number of characters of a line that are used."""
    return min(MAX_WIDTH, shutil.get_terminal_size((MAX_WIDTH, 0)).columns)


def table(rows: list[dict[str, Any]], columns: tuple[str, ...]) -> list[str]:
    """Return a head and one line per row. On a terminal they fit its width: wide columns are cut, and the last is wrapped."""
    from rich.cells import cell_len, set_cell_size

    cells = [list(columns), *([f"{r[c]:.2f}" if isinstance(r[c], float) else plain(str(r[c])) for c in columns] for r in rows)]
    sizes = [max(cell_len(row[k]) for row in cells) for k in range(len(columns))]
    while sys.stdout.isatty() and sum(sizes) + GAP * (len(sizes) - 1) > width() and max(sizes) > MIN_CELL:
        sizes[sizes.index(max(sizes))] -= 1
    lines = []
    for *row, last in cells:
        cut = (c if cell_len(c) <= n else f"{set_cell_size(c, n - 2)}.." for c, n in zip(row, sizes, strict=False))
        begin = "".join(set_cell_size(c, n + GAP) for c, n in zip(cut, sizes, strict=False))
        lines.append(f"\n{' ' * cell_len(begin)}".join(textwrap.wrap(last, max(sizes[-1], 1)) or [""]))
        lines[-1] = (begin + lines[-1]).rstrip()
    return lines


def print_result(
    record: dict[str, Any], rows: list[dict[str, Any]], columns: tuple[str, ...], json_: bool, quiet: bool
) -> None:
    """Print the record as JSON, or these columns of the rows as a table; with `quiet`, no table."""
    if json_:
        typer.echo(json.dumps(record, indent=2))
    elif not quiet:
        typer.echo("\n".join(table(rows, columns)))


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
    """Progress on stderr, only on a terminal: the step in words, its item, the time, and about how much is left.

    whole: whether the steps are those of one mesh by geometry, whose usual shares of a run are known. Else the time left is
    that of the step, by how fast its items went so far.
    """

    def __init__(self, hidden: bool, *, whole: bool = False) -> None:
        self._status: Any = None
        self._hidden = hidden or not sys.stderr.isatty()
        self._whole, self._outer, self._outer_share = whole, "", 0.0
        self._begin = self._step_begin = time.monotonic()
        self._step = ""

    def __enter__(self) -> Progress:
        if self._hidden:
            return silent
        from rich.console import Console

        self._status = Console(stderr=True).status("")
        self._status.start()
        return self._show_progress

    def _show_progress(self, stage: str, item: str, done: int, total: int) -> None:
        self._status.update(self.line(stage, item, done, total, time.monotonic()))

    def line(self, stage: str, item: str, done: int, total: int, now: float) -> str:
        """Return what is shown at a time [s]."""
        if stage != self._step:
            self._step, self._step_begin = stage, now
        words, begin, length = STEPS.get(stage, (OTHER_STEPS.get(stage, stage), 0.0, 0.0))
        share, since = done / max(total, 1), self._step_begin
        if stage in MANY:
            self._outer, self._outer_share = f"{item} ({done + 1} of {total}), ", share
        if self._outer:
            share, since = self._outer_share, self._begin
        elif self._whole:
            share, since = begin + length * share, self._begin
        text = f"{words}: {item}" + (f" ({done + 1}/{total})" if total > 1 else "")
        if self._outer:
            text = self._outer.rstrip(", ") if stage in MANY else self._outer + words
        left = (now - since) * (1 / share - 1) if share > MIN_SHARE and now - since > MIN_SECONDS else 0.0
        about = f", about {_rounded(left)} left" if left > MIN_SECONDS else ""
        return f"{plain(text)[: width() - ESTIMATE_WIDTH]}, {now - self._begin:.0f} s{about}"

    def __exit__(self, *_: object) -> None:
        if self._status is not None:
            self._status.stop()


def _rounded(seconds: float) -> str:
    return f"{5 * round(seconds / 5)} s" if seconds < 90 else f"{round(seconds / 60)} min"
