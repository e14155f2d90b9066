"""The command line of `anymesh annotate`."""

from __future__ import annotations

import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from anymesh.cli.options import Formats, Json, OptionsOf, Parts, Quiet, Time, with_options
from anymesh.cli.output import ended_by_signal, plain
from anymesh.errors import InputError, OpenQuestionError, OptionError
from anymesh.pipeline.options import AnswererOptions, PlacementOptions

if TYPE_CHECKING:
    from anymesh.applications.annotate.annotate import Speed
    from anymesh.applications.annotate.tally import Tally

Source = Annotated[
    str | None,
    typer.Argument(metavar="INPUT", help="A folder, a pattern, a table (.csv, .parquet), objaverse:IDS or objaverse:FILE."),
]
Out = Annotated[Path | None, typer.Option("--out", "-o", metavar="OUT", help="Folder of the ledger, assets and report.")]
Status = Annotated[Path | None, typer.Option("--status", metavar="OUT", help="Print the progress of an output, and exit.")]
Export = Annotated[
    Path | None,
    typer.Option("--export", metavar="FILE", help="With --status: write the ledger as Parquet (extra parquet)."),
]
Workers = Annotated[int | None, typer.Option("--workers", "-j", help="Parallel objects; one per core by default.")]
Memory = Annotated[
    float | None,
    typer.Option("--memory", metavar="GIB", help="Address space of one object; default: a share of the machine's."),
]
KillAfter = Annotated[
    float | None,
    typer.Option(
        "--kill-after", metavar="SECONDS", help="Processor time of one object; default: 4 times --time-limit, from 60."
    ),
]
Attempts = Annotated[int, typer.Option(help="Attempts before an object that crashes, hangs or exceeds memory is quarantined.")]
Again = Annotated[bool, typer.Option("--retry-quarantined", help="Try quarantined objects again.")]
Requests = Annotated[
    int | None, typer.Option("--requests-per-minute", help="Limit of requests to a model, in equal shares per worker.")
]
Tokens = Annotated[
    int | None, typer.Option("--tokens-per-minute", help="Limit of a model's input and output tokens, likewise.")
]
Patience = Annotated[
    float, typer.Option("--patience", metavar="SECONDS", help="How long to wait for an unreachable model or hub.")
]
Ray = Annotated[
    str | None,
    typer.Option("--ray", metavar="ADDRESS", help="Address of a Ray cluster: auto or HOST:PORT (extra ray)."),
]


@with_options
def annotate(
    source: Source = None,
    *,
    out: Out = None,
    status: Status = None,
    export: Export = None,
    workers: Workers = None,
    memory: Memory = None,
    kill_after: KillAfter = None,
    attempts: Attempts = 3,
    retry_quarantined: Again = False,
    ray: Ray = None,
    requests_per_minute: Requests = None,
    tokens_per_minute: Tokens = None,
    patience: Patience = 3600.0,
    parts: Parts = "auto",
    answering: Annotated[dict[str, Any], OptionsOf(AnswererOptions, without=("wait",))],
    placement: Annotated[dict[str, Any], OptionsOf(PlacementOptions, without=("root",))],
    writing: Formats,
    time: Time,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Articulate every object of a collection INPUT into OUT. Run it again to resume after any interruption."""
    if status is not None:
        _tell_status(status, export, json_)
        return
    if source is None or out is None:
        raise OptionError("found no INPUT or no --out; valid is `anymesh annotate INPUT -o OUT`, or `--status OUT`")
    from anymesh.applications.annotate.annotate import Speed

    options: dict[str, Any] = {"parts": parts, **placement, **writing, **time, **answering}
    speed = Speed(workers, memory, kill_after, attempts, requests_per_minute, tokens_per_minute, patience, ray)
    _run(source, out, speed, retry_quarantined, options, json_, quiet)


def _run(source: str, out: Path, speed: Speed, again: bool, options: dict[str, Any], json_: bool, quiet: bool) -> None:
    from anymesh.applications.annotate.annotate import annotate as run

    with ended_by_signal(), Live(json_ or quiet) as live:
        annotated = run(source, out, speed=speed, again=again, on_tally=live.show, **options)
    ended = annotated.ended
    if json_:
        why = None if ended is None else {"kind": ended.error_class, "error": ended.error}
        typer.echo(
            json.dumps({"out": str(out), "report": str(annotated.report), "ended": why, **asdict(annotated.found)}, indent=2)
        )
    elif not quiet:
        typer.echo(plain(annotated.found.words()))
        typer.echo(plain(f"wrote {annotated.report}"))
    if ended is not None:
        if not json_:
            typer.echo(
                plain(f"error: ended early, {ended.error_class}: {ended.error}; run the same command again to resume"), err=True
            )
        raise typer.Exit(ended.exit_code)
    if annotated.found.counts["waiting"]:
        raise typer.Exit(OpenQuestionError.exit_code)
    if annotated.found.counts["quarantined"]:
        raise typer.Exit(InputError.exit_code)


def _tell_status(out: Path, export: Path | None, json_: bool) -> None:
    from anymesh.applications.annotate.annotate import collection_status, export_ledger
    from anymesh.applications.annotate.ledger import Ledger

    tally = collection_status(out)
    typer.echo(json.dumps({"out": str(out), **asdict(tally)}, indent=2) if json_ else plain(tally.words()))
    if export is not None:
        with Ledger.open(out) as ledger:
            export_ledger(ledger, export)


class Live:
    """Progress on stderr: an updated line on a terminal, else one line per minute."""

    EVERY = 60.0  # [s]

    def __init__(self, hidden: bool) -> None:
        self._hidden, self._status, self._last = hidden, None, 0.0

    def __enter__(self) -> Live:
        if not self._hidden and sys.stderr.isatty():
            from rich.console import Console

            self._status: Any = Console(stderr=True).status("")
            self._status.start()
        return self

    def show(self, tally: Tally) -> None:
        """Show the progress of the collection."""
        import time

        if self._status is not None:
            self._status.update(plain(tally.words()))
        elif not self._hidden and time.monotonic() - self._last >= self.EVERY:
            self._last = time.monotonic()
            typer.echo(plain(tally.words()), err=True)

    def __exit__(self, *_: object) -> None:
        if self._status is not None:
            self._status.stop()
