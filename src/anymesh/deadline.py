"""Time limit of a run, divided among its stages."""

from __future__ import annotations

import math
import time
from collections.abc import Generator
from contextlib import contextmanager

from anymesh.errors import OptionError

CALL_SECONDS = 120.0  # [s] default of `--timeout`, for one call of a model
DEFAULT_SECONDS = 600.0  # [s] default of `--time-limit`
SEGMENT, JOINTS, COMPLETION, COLLISION = 0.4, 0.7, 0.7, 0.9  # shares of the limit after which each stage is cut short


class Deadline:
    """A time limit of a run [s] that begins with its construction, and a record of what was left out to keep it.

    Raise OptionError for a limit that is not positive.
    """

    def __init__(self, seconds: float = math.inf) -> None:
        if not seconds > 0:
            raise OptionError(f"--time-limit: found {seconds}; valid are seconds above 0")
        self.seconds = seconds
        self._begin = time.monotonic()
        self._left_out: list[str] = []

    def late(self, share: float) -> bool:
        """Return whether more than a share of the limit is spent."""
        return time.monotonic() - self._begin > share * self.seconds

    @contextmanager
    def paused(self) -> Generator[None]:
        """Do not count the time spent inside, such as waiting for a person."""
        begin = time.monotonic()
        try:
            yield
        finally:
            self._begin += time.monotonic() - begin

    def leave_out(self, what: str) -> None:
        """Record in words what was left out."""
        if what not in self._left_out:
            self._left_out.append(what)

    def warnings(self) -> tuple[str, ...]:
        """Return what was left out since the last call, as warnings."""
        found, self._left_out = self._left_out, []
        return tuple(f"time limit of {self.seconds:g} s: {what}" for what in found)
