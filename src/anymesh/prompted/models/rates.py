"""Limits of the requests and tokens sent to a provider per minute."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from threading import Lock

from anymesh.errors import OptionError
from anymesh.prompted.models.budget import max_input_tokens
from anymesh.prompted.models.vision import Reply, Request, VisionModel

WINDOW = 60.0  # [s] window over which providers count


@dataclass(frozen=True)
class Rate:
    """Requests, and tokens of input and output, that a provider accepts per minute; None for no limit."""

    requests: int | None = None
    tokens: int | None = None

    def __post_init__(self) -> None:
        for name, value in (("requests", self.requests), ("tokens", self.tokens)):
            if value is not None and value < 1:
                raise OptionError(f"--{name}-per-minute: found {value}; valid are integers from 1 up")

    def allows(self, requests: int, used: int, tokens: int) -> bool:
        """Return whether a request of this many tokens fits beside those of the last minute.

        A request larger than the whole limit fits if no tokens were used in the last minute.
        """
        fits = self.tokens is None or used + tokens <= self.tokens or used == 0
        return fits and (self.requests is None or requests < self.requests)


class Limiter:
    """Counter of the requests and tokens of the last minute, shared by the threads of a process."""

    def __init__(
        self, rate: Rate, *, clock: Callable[[], float] = time.monotonic, sleep: Callable[[float], None] = time.sleep
    ) -> None:
        self._rate, self._clock, self._sleep = rate, clock, sleep
        self._entries: deque[list[float]] = deque()  # time, tokens, number
        self._last, self._lock = 0, Lock()

    def acquire(self, tokens: int) -> int:
        """Wait until a request of this many tokens may be sent; return the number of its entry."""
        while True:
            with self._lock:
                now = self._clock()
                while self._entries and not now - WINDOW < self._entries[0][0] <= now:
                    self._entries.popleft()
                if self._rate.allows(len(self._entries), int(sum(e[1] for e in self._entries)), tokens):
                    self._last += 1
                    self._entries.append([now, tokens, self._last])
                    return self._last
                wait = self._entries[0][0] + WINDOW - now
            self._sleep(max(wait, 0.01))

    def correct(self, entry: int, tokens: int) -> None:
        """Replace the estimate of an entry by the tokens that were billed."""
        with self._lock:
            for e in self._entries:
                if e[2] == entry:
                    e[1] = tokens


class RateLimited:
    """Wrapper that waits before a request that would exceed the provider's limit; retries wait as well."""

    def __init__(self, model: VisionModel, limiter: Limiter) -> None:
        self.name = model.name
        self._model, self._limiter = model, limiter

    def ask(self, request: Request) -> Reply:
        """Ask the model. A request counts with its upper bound until its reply gives the actual tokens."""
        entry = self._limiter.acquire(max_input_tokens(self.name, request) + request.max_tokens)
        reply = self._model.ask(request)
        self._limiter.correct(entry, reply.input_tokens + reply.output_tokens)
        return reply
