"""Worker processes on this machine: one object per core, each with limits on memory and time."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from anymesh.applications.annotate.states import AttemptOutcome, Claim, Result
from anymesh.applications.annotate.work import Job
from anymesh.errors import OptionError
from anymesh.isolation import ChildError, ChildLimits, ChildPool, Failure

TARGET = ("anymesh.applications.annotate.work", "annotate_object")
RENEWED = 100  # number of objects after which a worker process is replaced, to limit leaks
GIB = 1 << 30
MIN_GIB = 1.5  # of address space, needed by the libraries alone
WAITING = 10.0  # maximum elapsed time over processor time for an object that waits for a model


@dataclass(frozen=True)
class ObjectLimits:
    """Limits of one object.

    memory: address space of its process [bytes]; seconds, wall: processor time and elapsed time [s] after which it is ended.
    """

    memory: int
    seconds: float
    wall: float

    @classmethod
    def default(cls, workers: int, memory: float | None, seconds: float, *, waits: bool = False) -> ObjectLimits:
        """Return the limits for a number of workers.

        memory: [GiB], None for an equal share of nine tenths of the machine's memory, 2 to 16 GiB; waits: whether it waits for
        a model, which takes elapsed time but no processor time.
        """
        if memory is not None and not memory >= MIN_GIB:
            raise OptionError(f"--memory: found {memory:g}; valid are numbers from {MIN_GIB:g} GiB up")
        if not seconds > 0:
            raise OptionError(f"--kill-after: found {seconds:g}; valid are seconds above 0")
        share = 0.9 * machine_memory() / max(workers, 1)
        size = int(memory * GIB) if memory else int(min(max(share, 2 * GIB), 16 * GIB))
        return cls(size, seconds, WAITING * seconds if waits else seconds)


@runtime_checkable
class Workers(Protocol):
    """Protocol of workers: processes on this machine, or tasks of a cluster."""

    @property
    def free(self) -> int:
        """Number of further jobs that can be accepted."""
        ...

    def submit(self, claim: Claim, job: Job) -> None: ...

    def collect(self, timeout: float) -> Iterator[tuple[Claim, AttemptOutcome]]:
        """Yield finished jobs; wait up to `timeout` [s] if there are none."""
        ...

    def close(self) -> None:
        """End all work immediately."""
        ...


class LocalWorkers:
    """`count` child processes. target: module and function that they call."""

    def __init__(self, count: int, limits: ObjectLimits, target: tuple[str, str] = TARGET) -> None:
        self._count, self._target = count, target
        child = ChildLimits(seconds=limits.seconds, memory=limits.memory, wall=limits.wall, calls=RENEWED)
        self._pool = ChildPool(count, child)
        self._threads = ThreadPoolExecutor(count, "anymesh-annotate")
        self._running: dict[Future[AttemptOutcome], Claim] = {}
        cores = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else [None]
        self._cores: deque[int | None] = deque(cores[k % len(cores)] for k in range(count))
        self._on_core: dict[Future[AttemptOutcome], int | None] = {}

    @property
    def free(self) -> int:
        """Number of further jobs that can be accepted."""
        return self._count - len(self._running)

    def submit(self, claim: Claim, job: Job) -> None:
        """Start a job."""
        core = self._cores.popleft()
        future = self._threads.submit(self._run, replace(job, core=core))
        self._running[future], self._on_core[future] = claim, core

    def _run(self, job: Job) -> AttemptOutcome:
        try:
            return as_outcome(self._pool.run(*self._target, {"job": job.as_dict()}))
        except ChildError as error:
            return child_failure(error)

    def collect(self, timeout: float) -> Iterator[tuple[Claim, AttemptOutcome]]:
        """Yield finished jobs; wait up to `timeout` [s] if there are none."""
        done, _ = wait(self._running, timeout, FIRST_COMPLETED)
        for future in done:
            self._cores.append(self._on_core.pop(future))
            yield self._running.pop(future), future.result()

    def close(self) -> None:
        """End all processes immediately."""
        self._pool.close()
        self._threads.shutdown(wait=True, cancel_futures=True)


def child_failure(error: ChildError) -> AttemptOutcome:
    """Convert the failure of a process without a result to an outcome."""
    names = {Failure.CRASH: "CrashError", Failure.TIME: "TimeLimitError", Failure.MEMORY: "MemoryLimitError"}
    return AttemptOutcome(Result.FAILED, names.get(error.failure, "ChildError"), str(error)[:500])


def as_outcome(values: Mapping[str, Any]) -> AttemptOutcome:
    """Restore the outcome that a worker returned as a dictionary."""
    rest: dict[str, Any] = {k: v for k, v in values.items() if k != "result"}
    return AttemptOutcome(Result(values["result"]), **rest)


def machine_memory() -> int:
    """Return the memory of this machine, or of its container [bytes]; 8 GiB if unknown."""
    sizes = [8 * GIB]
    with suppress(AttributeError, ValueError, OSError):
        sizes = [os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")]
    with suppress(ValueError, OSError):
        sizes.append(int(Path("/sys/fs/cgroup/memory.max").read_text()))
    return min(sizes)
