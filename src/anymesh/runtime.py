"""What every run shares: its processor cores, its time limit, its progress, and small files that are written atomically."""

from __future__ import annotations

import json
import math
import os
import sys
import tempfile
import time
from collections.abc import Generator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

from anymesh.errors import OptionError, OutputError


def usable_cores() -> int:
    """Return the number of cores that this process may use, which can be fewer than the machine has."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@runtime_checkable
class Progress(Protocol):
    """Receives the stage, its current item (such as a part's name), and the counts of items."""

    def __call__(self, stage: str, item: str, done: int, total: int) -> None: ...


def silent(stage: str, item: str, done: int, total: int) -> None:
    """Report nothing; the default."""


def write_json(path: Path, value: Mapping[str, Any]) -> None:
    """Write indented ASCII JSON."""
    path.write_text(json.dumps(value, indent=1, allow_nan=False) + "\n", encoding="ascii", newline="\n")


def read_json(path: Path) -> dict[str, Any] | None:
    """Read the JSON object in a file, None if there is none."""
    try:
        record = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return None
    return record if isinstance(record, dict) else None


def write_whole(path: Path, content: bytes) -> None:
    """Write a file atomically."""
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.stem[:20]}-", suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        Path(temporary).replace(path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


@contextmanager
def writing(path: Path) -> Generator[None]:
    """Convert errors of the file system, in whatever is written to a file or folder, to OutputError."""
    try:
        yield
    except OSError as error:
        raise OutputError(f"cannot write {path}: {error.strerror or error}") from error


CALL_SECONDS = 120.0  # [s] default of `--timeout`, for one call of a model
DEFAULT_SECONDS = 600.0  # [s] default of `--time-limit`
CONTACTS = 0.2  # share after which no further contact of patches is measured
SEGMENT, JOINTS, COMPLETION, COLLISION, PREVIEW = 0.4, 0.7, 0.7, 0.9, 0.9  # shares after which a stage is cut short


class Deadline:
    """Time limit of a run [s] that starts at construction, with a record of work omitted to keep it.

    Raise OptionError for a limit that is not positive.
    """

    def __init__(self, seconds: float = math.inf) -> None:
        if not seconds > 0:
            raise OptionError(f"--time-limit: found {seconds}; valid are seconds above 0")
        self.seconds = seconds
        self._begin = time.monotonic()
        self._left_out: list[str] = []

    @property
    def limit(self) -> float | None:
        """Return the limit [s], None if there is none."""
        return None if math.isinf(self.seconds) else self.seconds

    def late(self, share: float) -> bool:
        """Return whether more than a share of the limit has passed."""
        return time.monotonic() - self._begin > share * self.seconds

    @contextmanager
    def paused(self) -> Generator[None]:
        """Exclude the time spent inside from the limit, such as waiting for a person."""
        begin = time.monotonic()
        try:
            yield
        finally:
            self._begin += time.monotonic() - begin

    def leave_out(self, what: str) -> None:
        """Record omitted work, described in words."""
        if what not in self._left_out:
            self._left_out.append(what)

    def warnings(self) -> tuple[str, ...]:
        """Return the work omitted since the last call, as warnings."""
        omissions, self._left_out = self._left_out, []
        return tuple(f"time limit of {self.seconds:g} s: {what}" for what in omissions)


def cache_folder(kind: str = "answers") -> Path:
    """Return the folder of one kind of cached data, in $ANYMESH_CACHE or in the system's cache folder.

    The folder is not created.
    """
    if own := os.environ.get("ANYMESH_CACHE"):
        return Path(own) / kind
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or str(Path.home() / "AppData" / "Local")
    elif sys.platform == "darwin":
        base = str(Path.home() / "Library" / "Caches")
    else:
        base = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    return Path(base) / "anymesh" / kind
