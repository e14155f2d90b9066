"""Loop of a run: claim objects, submit them to workers, record their outcomes."""

from __future__ import annotations

import logging
import shutil
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from anymesh.applications.annotate.claims import claim, finish, free_lost, live_runs, renew
from anymesh.applications.annotate.ledger import Ledger
from anymesh.applications.annotate.outages import Outage
from anymesh.applications.annotate.states import ENDING, AttemptOutcome, Claim, Result, State
from anymesh.applications.annotate.tally import Tally, tally, write_metrics
from anymesh.applications.annotate.work import Job
from anymesh.applications.annotate.workers import Workers
from anymesh.errors import ModelError, OutputError

log = logging.getLogger("anymesh")
TICK, BEAT = 2.0, 15.0  # [s] between metrics, and between beats with a check for dead runs
POLL = 0.25  # [s]
SAME = 5  # consecutive model errors of one kind, without a success, that end the run
FREE = 256 << 20  # [bytes] of free disk space below which no object is started


@dataclass(frozen=True)
class Plan:
    """Settings of a run.

    options: of `articulate`, for all objects; attempts: before quarantine; rate: requests and tokens of a model per minute;
    metered: whether a model is used.
    """

    options: Mapping[str, Any]
    attempts: int = 3
    rate: tuple[int | None, int | None] = (None, None)
    metered: bool = False


@dataclass
class Runner:
    """One run over the pending objects of a ledger. ended: what ended it early, None if all was done."""

    ledger: Ledger
    run: str
    workers: Workers
    plan: Plan
    outage: Outage
    on_tally: Callable[[Tally], None] = lambda _: None
    finished: int = 0
    ended: AttemptOutcome | None = None
    count: int = 1  # workers, for the metrics
    _running: int = 0
    _same: list[str] = field(default_factory=list)
    _begin: float = field(default_factory=time.monotonic)
    _last_tick: float = 0.0
    _last_beat: float = 0.0

    def loop(self) -> None:
        """Work until nothing is pending, or something ends the run. Raise OutputError if the ledger cannot be written."""
        while True:
            self._beat()
            claimed = self._begin_some()
            for taken, outcome in self.workers.collect(POLL):
                self._enter(taken, outcome)
            self._tick()
            if not self._running and (self.ended is not None or (not claimed and not self._is_pending())):
                break
        self._tick(last=True)

    def _begin_some(self) -> int:
        if self.ended is not None:
            return 0
        if self.outage.is_over:
            self.ended = self._last_outage
            return 0
        if shutil.disk_usage(self.ledger.out).free < FREE:
            message = f"less than {FREE >> 20} MiB are free where {self.ledger.out} is"
            self.ended = AttemptOutcome(Result.STORAGE, "OutputError", message, exit_code=OutputError.exit_code)
            return 0
        claims = claim(self.ledger, self.run, self.outage.allowed(self.workers.free, self._running))
        for taken in claims:
            self.workers.submit(taken, self._job(taken))
            self._running += 1
        return len(claims)

    def _job(self, taken: Claim) -> Job:
        return Job(
            name=taken.name, source=taken.source, out=str(self.ledger.out / taken.folder), collection=str(self.ledger.out),
            token=taken.token, options={**self.plan.options, **taken.options}, redo=taken.redo, rate=self.plan.rate,
            metered=self.plan.metered,
        )  # fmt: skip

    def _enter(self, taken: Claim, outcome: AttemptOutcome) -> None:
        self._running -= 1
        state = finish(self.ledger, taken, outcome, most=self.plan.attempts)
        if state is None:
            log.warning("%s was taken over by another run; its result here is dropped", taken.name[:200])
            return
        self.finished += state in (State.DONE, State.QUARANTINED)
        if outcome.result is Result.OUTAGE:
            self.outage.failed()
            self._last_outage = outcome
        elif outcome.result in (Result.DONE, Result.BUDGET):
            self.outage.reached()
        if outcome.result in ENDING and self.ended is None:
            self.ended = outcome
        self._note_same(outcome)

    def _note_same(self, outcome: AttemptOutcome) -> None:
        """End the run if a model fails for object after object, as with a wrong key or wrong weights."""
        if outcome.result is Result.DONE:
            self._same = []
        elif outcome.exit_code == ModelError.exit_code and outcome.result is Result.FAILED:
            self._same.append(outcome.error_class)
            if len(self._same) >= SAME and self.ended is None:
                self.ended = outcome

    def _is_pending(self) -> bool:
        return bool(self.ledger.rows("SELECT 1 FROM objects WHERE state = 'pending' LIMIT 1"))

    def _beat(self) -> None:
        now = time.monotonic()
        if now - self._last_beat >= BEAT:
            self._last_beat = now
            renew(self.ledger, self.run)
            free_lost(self.ledger, self.run)

    def _tick(self, *, last: bool = False) -> None:
        now = time.monotonic()
        if last or now - self._last_tick >= TICK:
            self._last_tick = now
            note = "waiting for a model or hub that cannot be reached" if self.outage.is_on else ""
            if others := live_runs(self.ledger, self.run):
                note = "; ".join(filter(None, [note, f"{others} other run(s) work on the same output"]))
            status = tally(self.ledger, finished=self.finished, seconds=now - self._begin, workers=self.count, note=note)
            write_metrics(self.ledger.out, status, self.ledger.seconds)
            self.on_tally(status)

    _last_outage: AttemptOutcome = field(default_factory=lambda: AttemptOutcome(Result.OUTAGE))
