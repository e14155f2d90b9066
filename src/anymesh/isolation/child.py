"""Main loop of a child process: read a call from standard input, run it, write its progress and its result.

A message is an 8-byte little-endian length and a pickle. Only the parent writes here, so the pickles are trusted.
"""

from __future__ import annotations

import contextlib
import faulthandler
import math
import os
import pickle
import threading
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import IO, Any

from anymesh.errors import AnymeshError

LENGTH = 8  # [bytes] of the length before each message
PATIENCE = 6.0  # maximum wall time per processor time; a slower call hangs, even on a busy machine
GRACE = 2.0  # [s] after the limit, at which a child without a parent ends itself


def write_message(stream: IO[bytes], value: Any) -> None:
    """Write one value and flush."""
    data = pickle.dumps(value, protocol=5)
    stream.write(len(data).to_bytes(LENGTH, "little") + data)
    stream.flush()


def read_message(stream: IO[bytes]) -> Any:
    """Read one value. Raise EOFError if the stream ends before or within it."""
    head = stream.read(LENGTH)
    size = int.from_bytes(head, "little")
    data = stream.read(size)
    if len(head) < LENGTH or len(data) < size:
        raise EOFError
    return pickle.loads(data)


class Reporter:
    """Sends messages of the running call to the parent; may be called from any thread."""

    def __init__(self, replies: IO[bytes]) -> None:
        self._replies, self._lock = replies, threading.Lock()

    def __call__(self, *fields: Any) -> None:
        """Send picklable values, which the parent passes to the call's `on_message`."""
        with self._lock:
            write_message(self._replies, ("message", fields))


def limit_memory(size: int) -> None:
    """Limit the address space of this process to `size` bytes (0: no limit), if the system can (not on Windows)."""
    if size:
        with contextlib.suppress(ImportError, ValueError, OSError):
            import resource

            resource.setrlimit(resource.RLIMIT_AS, (size, size))


def limit_time(seconds: float | None) -> None:
    """Limit the further processor time of this process [s], if the system can; after it, SIGXCPU ends the process.

    None lifts the limit.
    """
    if seconds == math.inf:
        return
    with contextlib.suppress(ImportError, ValueError, OSError):
        import resource

        used, most = sum(resource.getrusage(resource.RUSAGE_SELF)[:2]), resource.getrlimit(resource.RLIMIT_CPU)[1]
        resource.setrlimit(resource.RLIMIT_CPU, (most if seconds is None else math.ceil(used + seconds), most))


def end_with_parent(lifeline: int) -> None:
    """End this process as soon as the parent has ended, in any way and whatever native code runs here.

    lifeline: read end of a pipe that only the parent holds open and never writes to (-1: none). The kernel signals its end. If
    it cannot (Windows), a child ends at its next call or time limit.
    """
    if lifeline < 0:
        return
    with contextlib.suppress(ImportError, AttributeError, OSError):  # BlockingIOError: the parent is alive
        import fcntl

        fcntl.fcntl(lifeline, fcntl.F_SETOWN, os.getpid())
        fcntl.fcntl(lifeline, fcntl.F_SETFL, os.O_ASYNC | os.O_NONBLOCK)
        if os.read(lifeline, 1) == b"":  # the parent had already ended
            os._exit(1)


def call(module: str, function: str, arguments: dict[str, Any]) -> tuple[str, Any]:
    """Run one call.

    Return ("done", its result), ("memory", why), ("time", why), ("invalid", the message of an AnymeshError) or ("error", why).
    """
    try:
        return "done", getattr(import_module(module), function)(**arguments)
    except MemoryError as error:
        return "memory", str(error)
    except TimeoutError as error:  # a limit of the called function
        return "time", str(error)
    except AnymeshError as error:
        return "invalid", str(error)
    except Exception as error:
        return "error", f"{type(error).__name__}: {error}"


def main(memory: int, modules: Sequence[str], lifeline: int) -> None:
    """Serve calls until standard input ends. Output of native code is discarded.

    memory: limit [bytes]; modules: to import at once; lifeline: as for `end_with_parent`.
    """
    end_with_parent(lifeline)
    requests, replies = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.dup2(nowhere, 2)
    limit_memory(memory)
    for module in modules:
        with contextlib.suppress(ImportError):  # the call that needs it reports the error
            import_module(module)
    with contextlib.suppress(EOFError):
        while True:
            serve(read_message(requests), replies)


def forked(requests: int, replies: int, memory: int, lifeline: int) -> None:
    """Run `main` in a forked process, which keeps no other open file of its parent."""
    os.setsid()
    os.dup2(requests, 0)
    os.dup2(replies, 1)
    for descriptor in {int(path.name) for path in Path("/proc/self/fd").iterdir()} - {0, 1, 2, lifeline}:
        with contextlib.suppress(OSError):  # the listing itself was one
            os.close(descriptor)
    main(memory, (), lifeline)


def serve(request: tuple[Any, ...], replies: IO[bytes]) -> None:
    """Run one call within its limits and write its result.

    request: module, function, arguments, limits of processor time and elapsed time [s], and whether it gets a `report`.
    """
    module, function, arguments, seconds, wall, reports = request
    if reports:
        arguments = {**arguments, "report": Reporter(replies)}
    if wall < math.inf:
        faulthandler.dump_traceback_later(wall + GRACE, exit=True)
    limit_time(seconds)
    answer = call(module, function, arguments)
    faulthandler.cancel_dump_traceback_later()
    limit_time(None)
    write_message(replies, answer)
