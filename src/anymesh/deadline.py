"""Time limit of a run, divided among its stages."""

from __future__ import annotations

import math
import time
from collections.abc import Generator
from contextlib import contextmanager

from anymesh.errors import OptionError

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
