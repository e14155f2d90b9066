"""Handling of an unreachable model or hub: wait, retry with one object at a time, and give up eventually."""

from __future__ import annotations

import time
from collections.abc import Callable

FIRST_WAIT, MAX_WAIT = 5.0, 120.0  # [s] between attempts


class Outage:
    """State of an outage. patience: [s] from the first failure, after which the run ends."""

    def __init__(self, patience: float, *, clock: Callable[[], float] = time.monotonic, first: float = FIRST_WAIT) -> None:
        self._patience, self._clock, self._first = patience, clock, first
        self._since: float | None = None
        self._next, self._wait = 0.0, first

    @property
    def is_on(self) -> bool:
        """Whether the last result was a failure."""
        return self._since is not None

    @property
    def is_over(self) -> bool:
        """Whether the outage has lasted longer than the patience."""
        return self._since is not None and self._clock() - self._since > self._patience

    def failed(self) -> None:
        """Record a failure; simultaneous failures count as one."""
        now = self._clock()
        self._since = now if self._since is None else self._since
        if now >= self._next:
            self._next, self._wait = now + self._wait, min(2 * self._wait, MAX_WAIT)

    def reached(self) -> None:
        """Record a success."""
        self._since, self._next, self._wait = None, 0.0, self._first

    def allowed(self, free: int, running: int) -> int:
        """Return how many objects may be started now: all free slots, or during an outage one after each wait."""
        if not self.is_on:
            return free
        return int(free > 0 and running == 0 and self._clock() >= self._next)
