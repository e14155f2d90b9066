"""Worker processes on this machine: one object per core, each with limits on memory and time."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Protocol, runtime_checkable

from anymesh.applications.annotate.states import AttemptOutcome, Job, Result
from anymesh.errors import OptionError
from anymesh.isolation import ChildError, ChildLimits, ChildPool, Failure

TARGET = ("anymesh.applications.annotate.work", "annotate_object")
RENEWED = 100  # number of objects after which a worker process is replaced, to limit leaks
GIB = 1 << 30
MIN_GIB = 1.5  # of address space, needed by the libraries alone
WAITING = 10.0  # maximum elapsed time over processor time for an object that waits for a model


def object_limits(workers: int, memory: float | None, seconds: float, *, waits: bool = False) -> ChildLimits:
    """Return the limits of the processes of a number of workers. Raise OptionError if one is not valid.

    memory: address space [GiB], None for an equal share of nine tenths of the machine's memory, 2 to 16 GiB; seconds: processor
    time of one object; waits: whether objects wait for a model, which takes elapsed time but no processor time.
    """
    if memory is not None and not memory >= MIN_GIB:
        raise OptionError(f"--memory: found {memory:g}; valid are numbers from {MIN_GIB:g} GiB up")
    if not seconds > 0:
        raise OptionError(f"--kill-after: found {seconds:g}; valid are seconds above 0")
    share = 0.9 * machine_memory() / max(workers, 1)
    size = int(memory * GIB) if memory else int(min(max(share, 2 * GIB), 16 * GIB))
    return ChildLimits(seconds=seconds, memory=size, wall=WAITING * seconds if waits else seconds, calls=RENEWED)


@runtime_checkable
class Workers(Protocol):
    """Protocol of workers: processes on this machine, or tasks of a cluster."""

    @property
    def count(self) -> int:
        """Number of objects that are processed at once."""
        ...

    @property
    def free(self) -> int:
        """Number of further jobs that can be accepted."""
        ...

    def submit(self, job: Job) -> None: ...

    def collect(self, timeout: float) -> Iterator[tuple[Job, AttemptOutcome]]:
        """Yield finished jobs; wait up to `timeout` [s] if there are none."""
        ...

    def close(self) -> None:
        """End all work immediately."""
        ...


class LocalWorkers:
    """`count` child processes. target: module and function that they call."""

    def __init__(self, count: int, limits: ChildLimits, target: tuple[str, str] = TARGET) -> None:
        self.count, self._target = count, target
        self._pool = ChildPool(count, limits)
        self._threads = ThreadPoolExecutor(count, "anymesh-annotate")
        self._running: dict[Future[AttemptOutcome], Job] = {}
        cores = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else [None]
        self._cores: deque[int | None] = deque(cores[k % len(cores)] for k in range(count))

    @property
    def free(self) -> int:
        """Number of further jobs that can be accepted."""
        return self.count - len(self._running)

    def submit(self, job: Job) -> None:
        """Start a job."""
        job = replace(job, core=self._cores.popleft())
        self._running[self._threads.submit(run_in_child, self._pool, self._target, job)] = job

    def collect(self, timeout: float) -> Iterator[tuple[Job, AttemptOutcome]]:
        """Yield finished jobs; wait up to `timeout` [s] if there are none."""
        done, _ = wait(self._running, timeout, FIRST_COMPLETED)
        for future in done:
            job = self._running.pop(future)
            self._cores.append(job.core)
            yield job, future.result()

    def close(self) -> None:
        """End all processes immediately."""
        self._pool.close()
        self._threads.shutdown(wait=True, cancel_futures=True)


def run_in_child(pool: ChildPool, target: tuple[str, str], job: Job) -> AttemptOutcome:
    """Run a job in a child process; convert the failure of a process without a result to an outcome."""
    try:
        return pool.run(*target, {"job": job})
    except ChildError as error:
        names = {Failure.CRASH: "CrashError", Failure.TIME: "TimeLimitError", Failure.MEMORY: "MemoryLimitError"}
        return AttemptOutcome(Result.FAILED, names.get(error.failure, "ChildError"), str(error)[:500])


def machine_memory() -> int:
    """Return the memory of this machine, or of its container [bytes]; 8 GiB if unknown."""
    sizes = [8 * GIB]
    with suppress(AttributeError, ValueError, OSError):
        sizes = [os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")]
    with suppress(ValueError, OSError):
        sizes.append(int(Path("/sys/fs/cgroup/memory.max").read_text()))
    return min(sizes)
