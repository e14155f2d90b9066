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
from contextlib import ExitStack
from dataclasses import asdict
from pathlib import Path
from typing import Any

from anymesh.applications.annotate.bridge import Bridge, Meter
from anymesh.applications.annotate.states import AttemptOutcome, Claim, Result
from anymesh.applications.annotate.work import Job
from anymesh.applications.annotate.workers import TARGET, ObjectLimits, as_outcome, child_failure
from anymesh.errors import MissingExtraError, OptionError
from anymesh.isolation import ChildError, ChildLimits, ChildPool

RETRIES = 3  # maximum number of restarts of a task whose node is lost
REACH = 5.0  # [s] time-out of the connection to the cluster
AHEAD = 2  # tasks per core submitted to the cluster, so that no core waits for the driver


def _ray() -> Any:
    try:
        return importlib.import_module("ray")
    except ImportError:
        message = "a cluster needs Ray, which is not installed; install it with `pip install articulate-anymesh[ray]`"
        raise MissingExtraError(message) from None


class RayWorkers:
    """Tasks on the cluster at an address. most: number of parallel tasks, two per core of the cluster by default."""

    def __init__(self, address: str, limits: ObjectLimits, most: int | None = None, target: tuple[str, str] = TARGET) -> None:
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
        self._running: dict[Any, Claim] = {}
        self._meters: dict[str, Any] = {}
        self._closed = False

    @property
    def free(self) -> int:
        """Number of further jobs that can be accepted; it follows changes of the nodes."""
        if self._closed:
            return 0
        most = self._most or AHEAD * max(int(self._ray.cluster_resources().get("CPU", 1)), 1)
        return max(most - len(self._running), 0)

    def submit(self, claim: Claim, job: Job) -> None:
        """Submit a job to the cluster."""
        meter = self._meter(job) if job.metered else None
        reference = self._task.remote(self._target, job.as_dict(), self._limits, meter)
        self._running[reference] = claim

    def _meter(self, job: Job) -> Any:
        """Return the actor with the account, on the driver's machine, where the ledger is."""
        if job.collection not in self._meters:
            here = importlib.import_module("ray.util.scheduling_strategies").NodeAffinitySchedulingStrategy(
                self._ray.get_runtime_context().get_node_id(), soft=False
            )
            make = self._ray.remote(num_cpus=0, scheduling_strategy=here)(Meter)
            self._meters[job.collection] = make.remote(job.collection, job.rate)
        return self._meters[job.collection]

    def collect(self, timeout: float) -> Iterator[tuple[Claim, AttemptOutcome]]:
        """Yield finished jobs; wait up to `timeout` [s] if there are none."""
        if not self._running:
            return
        done, _ = self._ray.wait(list(self._running), num_returns=len(self._running), timeout=timeout)
        for reference in done:
            claim = self._running.pop(reference)
            yield claim, self._outcome(reference)

    def _outcome(self, reference: Any) -> AttemptOutcome:
        try:
            return as_outcome(self._ray.get(reference))
        except self._ray.exceptions.RayTaskError as error:  # error of the task itself, not of the object
            return AttemptOutcome(Result.FAILED, "RayTaskError", " ".join(str(error.cause).split())[:300])
        except self._ray.exceptions.RayError as error:
            return AttemptOutcome(Result.LOST, type(error).__name__, "the node that worked on it was lost")

    def close(self) -> None:
        """End all tasks immediately."""
        for reference in self._running:
            self._ray.cancel(reference, force=True)
        for meter in self._meters.values():
            self._ray.kill(meter)
        self._running, self._meters, self._closed = {}, {}, True
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
    paths = [str(Path(__file__).parents[2]), os.environ.get("PYTHONPATH", "")]
    return {"env_vars": {"PYTHONPATH": os.pathsep.join(filter(None, paths))}}


def _task(target: tuple[str, str], job: dict[str, Any], limits: ObjectLimits, meter: Any) -> dict[str, Any]:
    """Run one object in a child process of the task; its requests to the account pass through a socket."""
    how = ChildLimits(seconds=limits.seconds, memory=limits.memory, wall=limits.wall)
    with ExitStack() as stack:
        pool = stack.enter_context(ChildPool(1, how))
        if meter is not None:
            ray = _ray()

            def ask(method: str, *values: Any) -> Any:
                return ray.get(getattr(meter, method).remote(*values))

            job = job | {"bridge": stack.enter_context(Bridge(ask))}
        try:
            return pool.run(*target, {"job": job})
        except ChildError as error:
            failed = child_failure(error)
            return asdict(failed) | {"result": str(failed.result)}
