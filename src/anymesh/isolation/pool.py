"""A pool of warm child processes with limits on time and memory; each runs one call at a time."""

from __future__ import annotations

import atexit
import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

from anymesh.isolation.child import PATIENCE, forked, read_message, write_message
from anymesh.runtime import usable_cores

START_AFTER = 0.3  # [s] total waiting time of calls before another child is started, which takes about as long
FORKED = 2  # children that are forked at once
ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")  # sums would depend on the number of threads


class Failure(StrEnum):
    """Reason why a call gave no result."""

    CRASH = "crash"  # the process ended
    TIME = "time limit"
    MEMORY = "memory limit"
    INVALID = "invalid"  # the function raised an AnymeshError, whose message is the detail
    ERROR = "error"  # the function raised anything else


FAILURES = {  # by the kind of a child's answer
    "memory": Failure.MEMORY,
    "time": Failure.TIME,
    "invalid": Failure.INVALID,
    "error": Failure.ERROR,
}


class ChildError(Exception):
    """A call that gave no result. The message states the reason, `detail` without the kind of failure."""

    def __init__(self, failure: Failure, detail: str = "") -> None:
        super().__init__(f"{failure.value}: {detail}" if detail else failure.value)
        self.failure, self.detail = failure, detail


@dataclass(frozen=True)
class ChildLimits:
    """Limits of one child process.

    seconds: processor time of one call [s], math.inf for no limit; wall: elapsed time of one call [s], by default PATIENCE
    times its processor time; memory: address space [bytes], 0 for no limit; calls: number of calls after which a child is
    replaced.
    """

    seconds: float = 60.0
    memory: int = 4 << 30
    wall: float | None = None
    calls: int | None = None


class ChildPool:
    """Child processes that are started on demand, kept warm, and replaced when one fails.

    At most `size` calls run at once; calls from more threads wait. Children end with the pool, with the parent's pipes, or when
    a call exceeds its time limit.
    """

    def __init__(self, size: int | None = None, limits: ChildLimits = ChildLimits()) -> None:
        self.size, self.limits = size or usable_cores(), limits
        self._idle: list[_Child] = []
        self._room = self.size  # children that may still be started
        self._waited = 0.0  # [s] total of all calls
        self._changed = threading.Condition()
        self._live: set[_Child] = set()
        self._closed = False

    def run(
        self,
        module: str,
        function: str,
        arguments: Mapping[str, Any],
        *,
        seconds: float | None = None,
        on_message: Callable[..., None] | None = None,
    ) -> Any:
        """Call a function of a module in a child and return its result.

        arguments: keyword arguments, which are pickled; seconds: processor time for this call [s], at most the pool's;
        on_message: the function gets a further argument `report`; what it passes to it, this is called with, in this thread.

        Raise ChildError on failure, after which the next call gets a new child if the process ended.
        """
        limit = min(self.limits.seconds, seconds) if seconds is not None else self.limits.seconds
        child, kept = self._free_child(), None
        try:
            child = child or self._started((module,))
            wall = PATIENCE * limit if self.limits.wall is None else self.limits.wall
            kind, result = child.call((module, function, dict(arguments), limit, wall, on_message is not None), on_message)
            kept = child if self.limits.calls is None or child.calls < self.limits.calls else None
        finally:
            if kept is None and child is not None:
                self._end(child)
            self._give_back(kept)
        if kind != "done":
            raise ChildError(FAILURES[kind], result)
        return result

    def warm(self, *modules: str) -> None:
        """Start a child, if there is none, and make it import modules, without waiting for it."""
        with self._changed:
            if self._room < self.size:
                return
            self._room -= 1
        child = None
        with contextlib.suppress(ChildError):  # the next call tries again and reports the error
            child = self._started(modules)
        self._give_back(child)

    def fork(self, *modules: str) -> None:
        """Import modules and fork the first children, which share them; where this process may not fork, `warm` one.

        Only for a process whose memory is within the limit. A process with several threads may not fork.
        """
        alone = sys.platform == "linux" and all(map(import_module, modules)) and len([*Path("/proc/self/task").iterdir()]) == 1
        if not alone:
            self.warm(*modules)
        with self._changed:
            count = min(self._room, FORKED) if alone and self._room == self.size else 0
            self._room -= count
        for _ in range(count):
            self._give_back(self._started(None))

    def _free_child(self) -> _Child | None:
        """Wait for an idle child; return None if a new one must be started.

        The first one is started at once, others after calls have waited.
        """
        with self._changed:
            while not self._idle:
                if self._room and (self._room == self.size or self._waited >= START_AFTER):
                    self._room -= 1
                    return None
                begin = time.monotonic()
                self._changed.wait(START_AFTER - self._waited if self._room else None)
                self._waited += time.monotonic() - begin
            return self._idle.pop()

    def _give_back(self, child: _Child | None) -> None:
        """Release a child, or the place of one that ended, for the next call."""
        with self._changed:
            if child is None:
                self._room += 1
            else:
                self._idle.append(child)
            self._changed.notify()

    def close(self) -> None:
        """End all children, even during calls."""
        self._closed = True
        for child in list(self._live):
            self._end(child)

    def _started(self, modules: Sequence[str] | None) -> _Child:
        if self._closed:
            raise ChildError(Failure.ERROR, "the pool is closed")
        child = _Child(self.limits.memory, modules)
        self._live.add(child)
        return child

    def _end(self, child: _Child) -> None:
        child.kill()
        self._live.discard(child)

    def __enter__(self) -> ChildPool:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class _Forked:
    """A forked child process, with those methods of `subprocess.Popen` that are used."""

    def __init__(self, memory: int, lifeline: int) -> None:
        from multiprocessing import get_context  # import on use: help does without

        (requests, to), (back, replies) = os.pipe(), os.pipe()
        self.stdin, self.stdout = os.fdopen(to, "wb"), os.fdopen(back, "rb")
        arguments = (requests, replies, memory, lifeline)
        self._process = get_context("fork").Process(target=forked, args=arguments, daemon=True)
        self._process.start()
        os.close(requests)
        os.close(replies)
        self.kill = self._process.kill

    def wait(self) -> int:
        self._process.join()
        return self._process.exitcode or 0


class _Child:
    """One child process. modules: what it imports at once, None to fork it."""

    def __init__(self, memory: int, modules: Sequence[str] | None) -> None:
        self.calls, self._lock = 0, threading.Lock()
        theirs, self._lifeline = os.pipe() if os.name == "posix" else (-1, -1)
        try:
            self._process = _Forked(memory, theirs) if modules is None else _spawned(memory, modules, theirs)
        except OSError as error:
            _close(self._lifeline)
            raise ChildError(Failure.ERROR, f"a child process cannot be started: {error}") from None
        finally:
            _close(theirs)

    def call(self, request: tuple[Any, ...], on_message: Callable[..., None] | None) -> tuple[str, Any]:
        """Send a request (see `child.serve`) and wait for the answer.

        Raise ChildError if the process ends or the time is over.
        """
        self.calls += 1
        *_, seconds, wall, _ = request
        late = threading.Event()
        timer = threading.Timer(min(wall, threading.TIMEOUT_MAX), lambda: (late.set(), self._process.kill()))
        timer.daemon = True
        timer.start()
        try:
            assert self._process.stdin is not None
            assert self._process.stdout is not None
            write_message(self._process.stdin, request)
            while True:
                kind, content = read_message(self._process.stdout)
                if kind != "message":
                    return kind, content
                if on_message is not None:
                    on_message(*content)
        except (OSError, EOFError):
            code = self._process.wait()
            if late.is_set() or -code == getattr(signal, "SIGXCPU", None):
                raise ChildError(Failure.TIME, f"{wall if late.is_set() else seconds:g} s") from None
            raise ChildError(Failure.CRASH, f"signal {-code}" if code < 0 else f"exit code {code}") from None
        finally:
            timer.cancel()

    def kill(self) -> None:
        self._process.kill()
        for stream in (self._process.stdin, self._process.stdout):
            if stream is not None:
                with contextlib.suppress(OSError):
                    stream.close()
        self._process.wait()
        with self._lock:  # two threads may end it
            _close(self._lifeline)
            self._lifeline = -1


def _spawned(memory: int, modules: Sequence[str], lifeline: int) -> subprocess.Popen[bytes]:
    environment = {**os.environ, **dict.fromkeys(ONE_THREAD, "1"), "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    program = f"from anymesh.isolation.child import main; main({memory}, {list(modules)}, {lifeline})"
    return subprocess.Popen(
        [sys.executable, "-c", program],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment, start_new_session=True,
        pass_fds=(lifeline,) if lifeline >= 0 else (),
    )  # fmt: skip


def _close(descriptor: int) -> None:
    if descriptor >= 0:
        os.close(descriptor)


SIZE = "ANYMESH_CHILDREN"  # environment variable: number of children of the shared pool, by default one per core


@cache
def shared_pool() -> ChildPool:
    """Return the pool of this process, with one child per core; the environment may set another size."""
    size = os.environ.get(SIZE, "")
    pool = ChildPool(int(size) if size.isdecimal() and int(size) else None)
    atexit.register(pool.close)
    return pool


if hasattr(os, "register_at_fork"):  # a forked process must not share the pipes
    os.register_at_fork(after_in_child=shared_pool.cache_clear)
