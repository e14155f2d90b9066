"""Estimate of the resources for a collection from a sample of it, before anything is paid."""

from __future__ import annotations

import random
import shutil
import statistics
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from anymesh.applications.annotate.annotate import Speed, checked, killed_after
from anymesh.applications.annotate.inputs import find_objects
from anymesh.applications.annotate.requests import ObjectRequest
from anymesh.applications.annotate.states import AttemptOutcome, Claim, Result
from anymesh.applications.annotate.tally import duration
from anymesh.applications.annotate.work import Job
from anymesh.applications.annotate.workers import LocalWorkers, ObjectLimits
from anymesh.errors import OptionError
from anymesh.pipeline.options import GEOMETRY
from anymesh.runtime import usable_cores

REHEARSAL = ("anymesh.applications.annotate.rehearsal", "rehearse_object")
QUANTILE = 1.96  # of the normal distribution, for 95 %


@dataclass(frozen=True)
class Figure:
    """A mean over the sample, and the half width of its 95 % interval (0 for one object)."""

    mean: float
    half: float

    @classmethod
    def of(cls, values: list[float]) -> Figure:
        """Compute the figure from the values of the sample."""
        half = QUANTILE * statistics.stdev(values) / len(values) ** 0.5 if len(values) > 1 else 0.0
        return cls(statistics.fmean(values) if values else 0.0, half)


@dataclass(frozen=True)
class Estimate:
    """Estimated resources for `total` objects.

    sample: objects tried, of which `failed` gave no asset; seconds, cost [USD], calls, tokens and bytes: per object; hours: for
    the collection on `workers` workers, without waiting for the model.
    """

    total: int
    sample: int
    failed: int
    workers: int
    seconds: Figure
    bytes: Figure
    calls: Figure
    tokens: Figure
    cost: Figure | None
    hours: float

    def words(self) -> str:
        """Format the estimate as text."""
        n, size = self.total, self.bytes
        most = f"95 % interval over {self.sample} objects tried, {self.failed} of them without an asset"
        lines = [
            f"{n:,} objects on {self.workers} workers ({most}):",
            f"  time     {self.seconds.mean:.1f} +- {self.seconds.half:.1f} s per object, {duration(3600 * self.hours)} in all",
            f"  storage  {size.mean / 1e6:.2f} +- {size.half / 1e6:.2f} MB per object, {n * size.mean / 1e9:.2f} GB in all",
        ]
        if self.calls.mean:
            lines.append(f"  calls    {self.calls.mean:.1f} per object, {self.tokens.mean:,.0f} tokens")
            cost = self.cost
            lines.append(
                "  cost     not known: the model has no price in the table"
                if cost is None
                else f"  cost     {cost.mean:.4f} +- {cost.half:.4f} USD per object, {n * cost.mean:,.2f} USD in all"
            )
        return "\n".join(lines)


def estimate(source: str, count: int, *, speed: Speed, **options: Any) -> Estimate:
    """Process `count` random objects (by the seed) in a temporary folder; geometry answers in place of a model.

    The questions for a model are created and counted, with their pictures, but not sent; repeated questions after invalid
    answers are not counted. Raises errors as `annotate` does.
    """
    if count < 1:
        raise OptionError(f"--dry-run: found {count}; valid are integers from 1 up")
    who = checked({**options, "answerer": GEOMETRY, "parts_list": ()})
    who = str(options.get("answerer", who))
    requests = [r for r in find_objects(source, without=Path("/nonexistent")) if not r.refusal]
    chosen = random.Random(int(options.get("seed", 0))).sample(requests, min(count, len(requests)))
    workers = speed.workers or usable_cores()
    limits = ObjectLimits.default(workers, speed.memory, killed_after(speed, options))
    work = LocalWorkers(workers, limits, REHEARSAL)
    folder = Path(tempfile.mkdtemp(prefix="anymesh-dry-run-"))
    try:
        outcomes = _tried(work, chosen, folder, {**options, "answerer": who})
    finally:
        work.close()
        shutil.rmtree(folder, ignore_errors=True)
    return _summary(outcomes, len(requests), workers, paid=who != GEOMETRY)


def _tried(work: LocalWorkers, chosen: list[ObjectRequest], folder: Path, options: dict[str, Any]) -> list[AttemptOutcome]:
    waiting, outcomes = list(chosen), list[AttemptOutcome]()
    while len(outcomes) < len(chosen):
        while waiting and work.free:
            r = waiting.pop()
            own = {**options, **r.options}
            job = Job(r.name, r.source, str(folder / r.folder), str(folder), "", own)
            work.submit(Claim(0, r.name, r.source, own, r.folder, "", False), job)
        outcomes += [outcome for _, outcome in work.collect(0.25)]
    return outcomes


def _summary(outcomes: list[AttemptOutcome], total: int, workers: int, *, paid: bool) -> Estimate:
    done = [o for o in outcomes if o.result is Result.DONE]
    usage = [o.record.get("usage", {}) for o in done] if paid else []
    costs = [u.get("cost_usd") for u in usage]
    seconds = Figure.of([o.seconds for o in outcomes])
    return Estimate(
        total=total,
        sample=len(outcomes),
        failed=len(outcomes) - len(done),
        workers=workers,
        seconds=seconds,
        bytes=Figure.of([float(o.record["bytes"]) for o in done]),
        calls=Figure.of([float(u.get("calls", 0)) for u in usage]),
        tokens=Figure.of([float(u.get("input_tokens", 0) + u.get("output_tokens", 0)) for u in usage]),
        cost=None if None in costs else Figure.of([float(c) for c in costs if c is not None]),
        hours=seconds.mean * total / workers / 3600,
    )
