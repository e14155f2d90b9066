"""Running of a program with a time limit; its child processes end with it."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from anymesh.errors import ModelError
from anymesh.prompted.models.error_redaction import SECRET

GRACE = 3.0  # [s] between SIGTERM and SIGKILL
LOOK = 0.2  # [s] between checks of a running program
TAIL = 4000  # [bytes] at the end of a log that a message may quote
LINES = 6
LONGEST = 600  # characters


def run_program(
    words: Sequence[str], log: Path, *, environment: Mapping[str, str], timeout: float, on_wait: Callable[[float], None]
) -> int:
    """Run a program without a shell and return its exit status; its output goes to the file `log`.

    timeout [s]; on_wait: called with the seconds elapsed. Raise ModelError if the program cannot be started or exceeds the time
    limit. In the latter case, on interruption, and if the program fails, its whole process group is ended.
    """
    with log.open("wb") as output:
        try:
            process = subprocess.Popen(
                list(words), env=dict(environment), stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                start_new_session=True,
            )  # fmt: skip
        except (OSError, ValueError) as error:
            raise ModelError(f"{words[0]} cannot be run: {getattr(error, 'strerror', None) or error}") from None
        code = None
        try:
            code = _wait(process, timeout, on_wait)
        finally:
            if code != 0:
                _end(process)
    if code is None:
        raise ModelError(f"{Path(words[0]).name} was ended: it took longer than {timeout:g} s{log_tail(log)}")
    return code


def log_tail(log: Path) -> str:
    """Return the last lines of a program's output, with anything that resembles a key removed; may be empty."""
    begin = max(0, log.stat().st_size - TAIL)
    with log.open("rb") as file:
        file.seek(begin)
        text = file.read().decode("utf-8", "replace")
    lines = [re.sub(r"\s+", " ", line).strip() for line in re.split(r"[\r\n]+", text)]
    if begin:  # the first line may be cut, and half of a key does not resemble one
        del lines[0]
    tail = " | ".join([line for line in lines if line][-LINES:])
    return f"; the end of its output: {SECRET.sub('[removed]', tail)[-LONGEST:]}" if tail else ""


def _wait(process: subprocess.Popen[bytes], timeout: float, on_wait: Callable[[float], None]) -> int | None:
    """Return the exit status; None if the time limit is exceeded."""
    begin = time.monotonic()
    while (spent := time.monotonic() - begin) < timeout:
        on_wait(spent)
        with suppress(subprocess.TimeoutExpired):
            return process.wait(min(LOOK, timeout - spent))
    return None


def _end(process: subprocess.Popen[bytes]) -> None:
    """End a program and its process group, by SIGTERM and then by SIGKILL."""
    if not hasattr(os, "killpg"):
        process.kill()
        process.wait()
        return
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGTERM)
        with suppress(subprocess.TimeoutExpired):
            process.wait(GRACE)
        os.killpg(process.pid, signal.SIGKILL)  # child processes, and the program itself if it ignored SIGTERM
    process.wait()
