"""`anymesh annotate`: articulation of all objects of a collection, each in its own folder, with a ledger."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from importlib.util import find_spec
from itertools import chain, islice
from pathlib import Path
from typing import Any

from anymesh.applications.annotate.inputs import ObjectRequest, find_objects
from anymesh.applications.annotate.ledger import OBJECTS, Ledger, driven_ledger
from anymesh.applications.annotate.report import write_report
from anymesh.applications.annotate.runner import Outage, Plan, Runner
from anymesh.applications.annotate.states import AttemptOutcome
from anymesh.applications.annotate.tally import Tally, tally
from anymesh.applications.annotate.workers import LocalWorkers, Workers, object_limits
from anymesh.errors import OptionError
from anymesh.export.options import ExportOptions
from anymesh.pipeline.answering import choose_answerer
from anymesh.pipeline.options import FILES, GEOMETRY, Answering
from anymesh.runtime import DEFAULT_SECONDS, Deadline, usable_cores, writing

PARQUET = "ledger.parquet"
UNPINNED = ("max_calls", "max_cost", "cache", "timeout")  # options that may differ between runs on one output
KILL, MIN_KILL = 4.0, 60.0  # maximum duration of an object, as a multiple of its time limit; at least, for reading it [s]
PATIENCE = 3600.0  # [s] for which a run waits for an unreachable model


@dataclass(frozen=True)
class Speed:
    """Number of parallel objects, and their limits.

    workers: None for one per core; memory: address space [GiB]; kill_after: [s] processor time after which an object is ended,
    4 times its time limit by default; attempts: before quarantine;
    requests, tokens: of a model per minute; patience: [s] with an unreachable model; ray: address of a cluster.
    """

    workers: int | None = None
    memory: float | None = None
    kill_after: float | None = None
    attempts: int = 3
    requests: int | None = None
    tokens: int | None = None
    patience: float = PATIENCE
    ray: str | None = None


@dataclass(frozen=True)
class Annotated:
    """Result of a run. ended: what ended it early, None if all was done; report: path of the page."""

    found: Tally
    ended: AttemptOutcome | None
    report: Path


def annotate(
    source: str,
    out: str | Path,
    *,
    speed: Speed = Speed(),
    again: bool = False,
    on_tally: Callable[[Tally], None] = lambda _: None,
    work: Workers | None = None,
    **options: Any,
) -> Annotated:
    """Annotate every unfinished object of a collection, and write the report.

    source: a folder, a pattern, a table (.csv, .parquet), or `objaverse:` with ids or a file of them; again: include
    quarantined objects; options: as for `articulate`, for all objects; work: workers, local processes by default.
    A KeyboardInterrupt ends the workers immediately, and finished results are kept.
    Raise InputError, OptionError, OutputError, MissingExtraError or ModelError before the work starts.
    """
    out = Path(out).absolute()
    who = checked(options)
    if speed.attempts < 1:
        raise OptionError(f"--attempts: found {speed.attempts}; valid are integers from 1 up")
    objects = _begun(find_objects(source, without=out))
    metered = who not in (GEOMETRY, FILES)
    workers = work or _workers(speed, options, waits=metered)
    try:
        plan = Plan(options, speed.attempts, worker_rate(speed, workers.count), metered)
        with driven_ledger(out, workers.count) as ledger:
            _pin(ledger, options)
            runner = Runner(ledger, workers, plan, Outage(speed.patience), on_tally)
            runner.recover()
            ledger.enter(objects)
            ledger.reopen(quarantined=again)
            runner.loop()
            report = write_report(ledger)
            if find_spec("pyarrow") is not None:
                export_ledger(ledger, out / PARQUET)
            return Annotated(tally(ledger), runner.ended, report)
    finally:
        workers.close()


def killed_after(speed: Speed, options: Mapping[str, Any]) -> float:
    """Return the processor time after which an object is ended [s]. Raise OptionError for a time limit that is not valid."""
    limit = Deadline(float(options.get("time_limit", DEFAULT_SECONDS))).seconds
    return speed.kill_after or max(KILL * limit, MIN_KILL)


def _begun(objects: Iterator[ObjectRequest]) -> Iterator[ObjectRequest]:
    """Return the objects once there is one, so that a mistyped INPUT leaves no ledger."""
    return chain(list(islice(objects, 1)), objects)


def checked(options: Mapping[str, Any]) -> str:
    """Check the options common to all objects; return the answerer: geometry, files:, or a model's name.

    Raise OptionError, ModelError (no key) or MissingExtraError.
    """
    answering: Answering = {k: v for k, v in options.items() if k in Answering.__annotations__}  # ty: ignore[invalid-assignment]
    ExportOptions.parse(options)
    who = choose_answerer(answering).name
    return FILES if who.startswith(FILES) else who


def _pin(ledger: Ledger, options: Mapping[str, Any]) -> None:
    """Store the options of an output, or compare them with the stored ones. Raise OptionError if they differ."""
    options_json = json.dumps({k: str(v) for k, v in sorted(options.items()) if k not in UNPINNED})
    kept = ledger.setting("options", options_json)
    if kept != options_json:
        ours, theirs = json.loads(options_json), json.loads(kept or "{}")
        names = sorted(k for k in {*ours, *theirs} if ours.get(k) != theirs.get(k))
        shown = ", ".join(f"{k} {theirs.get(k, 'default')!r}, now {ours.get(k, 'default')!r}" for k in names)
        raise OptionError(f"{ledger.out} was begun with {shown}; use the same options, or another output")


def _workers(speed: Speed, options: Mapping[str, Any], *, waits: bool) -> Workers:
    if speed.workers is not None and speed.workers < 1:
        raise OptionError(f"--workers: found {speed.workers}; valid are integers from 1 up")
    seconds = killed_after(speed, options)
    if speed.ray is not None:
        from anymesh.applications.annotate.ray_ import RayWorkers

        return RayWorkers(speed.ray, object_limits(1, speed.memory or 4.0, seconds, waits=waits), speed.workers)
    count = speed.workers or usable_cores()
    return LocalWorkers(count, object_limits(count, speed.memory, seconds, waits=waits))


def worker_rate(speed: Speed, workers: int) -> tuple[int | None, int | None]:
    """Return requests and tokens per minute of one worker. Raise OptionError if there is less than one for each."""
    for name, limit in (("requests", speed.requests), ("tokens", speed.tokens)):
        if limit is not None and limit < workers:
            raise OptionError(f"--{name}-per-minute: found {limit}; valid are integers from {workers} up, 1 per worker")
    share = [None if limit is None else limit // workers for limit in (speed.requests, speed.tokens)]
    return share[0], share[1]


def export_ledger(ledger: Ledger, path: Path) -> None:
    """Write the table of objects as Parquet. Raise MissingExtraError or OutputError."""
    from anymesh.applications.annotate.parquet_ import write_rows

    with writing(path):
        write_rows(path, OBJECTS, ledger.export_rows())


def collection_status(out: str | Path) -> Tally:
    """Return the progress of a collection, also while runs work on it. Raise OutputError if there is none."""
    with Ledger.open(Path(out)) as ledger:
        return tally(ledger)
