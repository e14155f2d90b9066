"""Workers on a Ray cluster (the extra `ray`): one task per object; the ledger stays with the driver process.

INPUT and OUT must be on a file system shared by all nodes; the results of tasks are small. A task runs its object in a child
process, as on one machine, so that a crash or a limit affects the object and not the node.
Ray restarts a task on another node if its node is lost. If it gives up, the object becomes pending again, and the loss is
counted.
"""

from __future__ import annotations

import importlib
import os
import socket
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

from anymesh.applications.annotate.states import AttemptOutcome, Job, Result
from anymesh.applications.annotate.workers import TARGET, run_in_child
from anymesh.errors import MissingExtraError, OptionError, pip_install
from anymesh.isolation import ChildLimits, ChildPool

RETRIES = 3  # maximum number of restarts of a task whose node is lost
REACH = 5.0  # [s] time-out of the connection to the cluster
AHEAD = 2  # tasks per core submitted to the cluster, so that no core waits for the driver


def _ray() -> Any:
    try:
        return importlib.import_module("ray")
    except ImportError:
        message = f"a cluster needs Ray, which is not installed; install it with {pip_install('ray')}"
        raise MissingExtraError(message) from None


class RayWorkers:
    """Tasks on the cluster at an address. most: number of parallel tasks, two per core of the cluster by default."""

    def __init__(self, address: str, limits: ChildLimits, most: int | None = None, target: tuple[str, str] = TARGET) -> None:
        self._ray = ray = _ray()
        self._began = not ray.is_initialized()
        if self._began:
            _check_address(address)
            try:
                ray.init(address=address, logging_level="ERROR", log_to_driver=False, runtime_env=_environment())
            except (ConnectionError, ValueError, RuntimeError) as error:
                reason = " ".join(str(error).split())[:200]
                raise OptionError(f"--ray: found no cluster at {address!r} ({type(error).__name__}: {reason})") from None
        self._most, self._limits, self._target = most, limits, target
        self._task = ray.remote(
            num_cpus=1, memory=limits.memory // 2, max_retries=RETRIES, retry_exceptions=False, scheduling_strategy="SPREAD"
        )(_task)
        self._running: dict[Any, Job] = {}
        self._closed = False

    @property
    def count(self) -> int:
        """Number of objects that are processed at once; it follows changes of the nodes."""
        return self._most or max(int(self._ray.cluster_resources().get("CPU", 1)), 1)

    @property
    def free(self) -> int:
        """Number of further jobs that can be accepted."""
        if self._closed:
            return 0
        return max((self._most or AHEAD * self.count) - len(self._running), 0)

    def submit(self, job: Job) -> None:
        """Submit a job to the cluster."""
        self._running[self._task.remote(self._target, job, self._limits)] = job

    def collect(self, timeout: float) -> Iterator[tuple[Job, AttemptOutcome]]:
        """Yield finished jobs; wait up to `timeout` [s] if there are none."""
        if not self._running:
            return
        done, _ = self._ray.wait(list(self._running), num_returns=len(self._running), timeout=timeout)
        for reference in done:
            yield self._running.pop(reference), self._outcome(reference)

    def _outcome(self, reference: Any) -> AttemptOutcome:
        try:
            return self._ray.get(reference)
        except self._ray.exceptions.RayTaskError as error:  # error of the task itself, not of the object
            return AttemptOutcome(Result.FAILED, "RayTaskError", " ".join(str(error.cause).split())[:300])
        except self._ray.exceptions.RayError as error:
            return AttemptOutcome(Result.LOST, type(error).__name__, "the node that worked on it was lost")

    def close(self) -> None:
        """End all tasks immediately."""
        for reference in self._running:
            self._ray.cancel(reference, force=True)
        self._running, self._closed = {}, True
        if self._began:
            self._ray.shutdown()


def _check_address(address: str) -> None:
    """Check that a cluster is reachable at an address, since Ray itself retries for minutes. Raise OptionError if not."""
    host, _, port = address.removeprefix("ray://").rpartition(":")
    if not (host and port.isdecimal()):
        return  # `auto`, or an address that Ray validates itself
    try:
        socket.create_connection((host, int(port)), REACH).close()
    except (OSError, OverflowError) as error:
        reason = getattr(error, "strerror", None) or error
        raise OptionError(f"--ray: found no cluster at {address!r} ({reason}); `ray status` shows the address") from None


def _environment() -> dict[str, Any]:
    """Return the environment variables that tasks need to import this package."""
    paths = [str(Path(__file__).parents[3]), os.environ.get("PYTHONPATH", "")]
    return {"env_vars": {"PYTHONPATH": os.pathsep.join(filter(None, paths))}}


def _task(target: tuple[str, str], job: Job, limits: ChildLimits) -> AttemptOutcome:
    """Run one object in a child process of the task."""
    return run_in_child(_children(limits), target, job)


@cache
def _children(limits: ChildLimits) -> ChildPool:
    """Return the pool of one child that a worker process of Ray keeps for its tasks."""
    return ChildPool(1, limits)
