"""Loop of a run: take objects from the ledger, submit them to workers, record their outcomes."""

from __future__ import annotations

import shutil
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import Any

from anymesh.applications.annotate.ledger import LOSSES, Ledger
from anymesh.applications.annotate.states import ENDING, AttemptOutcome, Job, Result, State
from anymesh.applications.annotate.tally import Tally, tally, write_metrics
from anymesh.applications.annotate.work import read_spending
from anymesh.applications.annotate.workers import Workers
from anymesh.errors import ModelError, OutputError

TICK = 2.0  # [s] between metrics
POLL = 0.25  # [s]
MAX_MODEL_ERRORS = 5  # without a success in between, after which the run ends
FREE = 256 << 20  # [bytes] of free disk space below which no object is started
FIRST_WAIT, MAX_WAIT = 5.0, 120.0  # [s] between attempts to reach a model or hub
LOST = AttemptOutcome(
    Result.LOST, "LostError", f"its run ended unexpectedly {LOSSES} times (killed, out of memory, power failure?)"
)


class Outage:
    """State of an unreachable model or hub: wait, try with one object at a time, and give up eventually.

    patience: [s] from the first failure, after which the run ends.
    """

    def __init__(self, patience: float, *, clock: Callable[[], float] = time.monotonic, first: float = FIRST_WAIT) -> None:
        self._patience, self._clock, self._first = patience, clock, first
        self._since: float | None = None
        self._next, self._wait = 0.0, first
        self.last = AttemptOutcome(Result.OUTAGE)

    @property
    def is_on(self) -> bool:
        """Whether the last result was a failure."""
        return self._since is not None

    @property
    def is_over(self) -> bool:
        """Whether the outage has lasted longer than the patience."""
        return self._since is not None and self._clock() - self._since > self._patience

    def failed(self, outcome: AttemptOutcome) -> None:
        """Record a failure; simultaneous failures count as one."""
        now, self.last = self._clock(), outcome
        self._since = now if self._since is None else self._since
        if now >= self._next:
            self._next, self._wait = now + self._wait, min(2 * self._wait, MAX_WAIT)

    def reached(self) -> None:
        """Record a success."""
        self._since, self._next, self._wait = None, 0.0, self._first

    def allowed(self, free: int, running: int) -> int:
        """Return how many objects may be started now: all free slots, or during an outage one after each wait."""
        if not self.is_on:
            return free
        return int(free > 0 and running == 0 and self._clock() >= self._next)


@dataclass(frozen=True)
class Plan:
    """Settings of a run.

    options: of `articulate`, for all objects; attempts: before quarantine; rate: requests and tokens of a model per minute and
    worker; metered: whether a model is used.
    """

    options: Mapping[str, Any]
    attempts: int = 3
    rate: tuple[int | None, int | None] = (None, None)
    metered: bool = False


@dataclass
class Runner:
    """One run over the pending objects of a ledger. ended: what ended it early, None if all was done."""

    ledger: Ledger
    workers: Workers
    plan: Plan
    outage: Outage
    on_tally: Callable[[Tally], None] = lambda _: None
    finished: int = 0
    ended: AttemptOutcome | None = None
    _running: dict[int, Job] = field(default_factory=dict)
    _model_errors: int = 0  # since the last success
    _begin: float = field(default_factory=time.monotonic)
    _last_tick: float = 0.0

    def recover(self) -> None:
        """Set the objects of a run that was killed to pending, and count their loss."""
        for job in self.ledger.running():
            self._record(job, LOST)

    def loop(self) -> None:
        """Work until nothing is pending, or something ends the run. Raise OutputError if the ledger cannot be written.

        If the run is interrupted, its workers end immediately, and its objects are pending again.
        """
        try:
            while self._step():
                pass
            self._tick(last=True)
        finally:
            self.workers.close()
            with suppress(OutputError):  # if the ledger cannot be written, the next run does this
                for job in self._running.values():
                    self._record(job, AttemptOutcome(Result.STOPPED))

    def _step(self) -> bool:
        """Begin objects, record outcomes; return whether there is more to do."""
        begun = self._begin_some()
        for job, outcome in self.workers.collect(POLL):
            self._enter(job, outcome)
        self._tick()
        return bool(self._running) or (self.ended is None and (begun > 0 or self._is_pending()))

    def _begin_some(self) -> int:
        if self.ended is not None:
            return 0
        if self.outage.is_over:
            self.ended = self.outage.last
            return 0
        if shutil.disk_usage(self.ledger.out).free < FREE:
            message = f"less than {FREE >> 20} MiB are free where {self.ledger.out} is"
            self.ended = AttemptOutcome(Result.STORAGE, "OutputError", message, exit_code=OutputError.exit_code)
            return 0
        plan, jobs = self.plan, self.ledger.take(self.outage.allowed(self.workers.free, len(self._running)))
        for job in jobs:
            options = {**plan.options, **job.options}
            job = replace(job, options=options, metered=plan.metered, spent=self.ledger.spent, rate=plan.rate)
            self._running[job.seq] = job
            self.workers.submit(job)
        return len(jobs)

    def _enter(self, job: Job, outcome: AttemptOutcome) -> None:
        del self._running[job.seq]
        self.finished += self._record(job, outcome) in (State.DONE, State.QUARANTINED)
        if outcome.result is Result.OUTAGE:
            self.outage.failed(outcome)
        elif outcome.result in (Result.DONE, Result.BUDGET):
            self.outage.reached()
        if outcome.result in ENDING and self.ended is None:
            self.ended = outcome
        self._count_model_errors(outcome)

    def _record(self, job: Job, outcome: AttemptOutcome) -> State:
        """Record an outcome in the ledger, with the calls that were made, also by a process that was killed."""
        state = self.ledger.finish(job, outcome, most=self.plan.attempts, spent=read_spending(job.spending))
        with suppress(OSError):
            job.spending.unlink()
        return state

    def _count_model_errors(self, outcome: AttemptOutcome) -> None:
        """End the run if a model fails for object after object, as with a wrong key or wrong weights."""
        if outcome.result is Result.DONE:
            self._model_errors = 0
        elif outcome.exit_code == ModelError.exit_code and outcome.result is Result.FAILED:
            self._model_errors += 1
            if self._model_errors >= MAX_MODEL_ERRORS and self.ended is None:
                self.ended = outcome

    def _is_pending(self) -> bool:
        return bool(self.ledger.rows("SELECT 1 FROM objects WHERE state = 'pending' LIMIT 1"))

    def _tick(self, *, last: bool = False) -> None:
        now = time.monotonic()
        if last or now - self._last_tick >= TICK:
            self._last_tick = now
            note = "waiting for a model or hub that cannot be reached" if self.outage.is_on else ""
            seconds, workers = now - self._begin, self.workers.count
            status = tally(self.ledger, finished=self.finished, seconds=seconds, workers=workers, note=note)
            write_metrics(self.ledger.out, status, self.ledger.seconds)
            self.on_tally(status)
