"""A limit to how much is asked of a provider in a minute."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from threading import Lock
from typing import Protocol, runtime_checkable

from anymesh.errors import OptionError
from anymesh.models.prices import max_input_tokens
from anymesh.models.vision import Reply, Request, VisionModel

WINDOW = 60.0  # [s] over which providers count


@dataclass(frozen=True)
class Rate:
    """What a provider takes in a minute: requests, and tokens of input and output; None: without limit."""

    requests: int | None = None
    tokens: int | None = None

    def __post_init__(self) -> None:
        for name, value in (("requests", self.requests), ("tokens", self.tokens)):
            if value is not None and value < 1:
                raise OptionError(f"--{name}-per-minute: found {value}; valid are integers from 1 up")

    def allows(self, requests: int, used: int, tokens: int) -> bool:
        """Tell whether a request of so many tokens fits beside those of the last minute.

        A request that is larger than the whole limit fits when nothing else was asked in that time.
        """
        fits = self.tokens is None or used + tokens <= self.tokens or used == 0
        return fits and (self.requests is None or requests < self.requests)


@runtime_checkable
class Limiter(Protocol):
    """Counts requests and tokens of the last minute over everything that shares it, also over processes."""

    def acquire(self, tokens: int) -> int:
        """Wait until a request of so many tokens may be sent; return the number of its entry."""
        ...

    def correct(self, entry: int, tokens: int) -> None:
        """Replace the estimate of an entry by the tokens that were billed."""
        ...


class WindowLimiter:
    """The limiter of one process: entries of the last 60 s."""

    def __init__(
        self, rate: Rate, *, clock: Callable[[], float] = time.monotonic, sleep: Callable[[float], None] = time.sleep
    ) -> None:
        self._rate, self._clock, self._sleep = rate, clock, sleep
        self._entries: deque[list[float]] = deque()  # time, tokens, number
        self._last, self._lock = 0, Lock()

    def acquire(self, tokens: int) -> int:
        """Wait until a request of so many tokens may be sent; return the number of its entry."""
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
            for found in self._entries:
                if found[2] == entry:
                    found[1] = tokens


class RateLimited:
    """Waits before a request that would pass the provider's limit; retries wait as well."""

    def __init__(self, model: VisionModel, limiter: Limiter) -> None:
        self.name = model.name
        self._model, self._limiter = model, limiter

    def ask(self, request: Request) -> Reply:
        """As the model. A request counts with its upper bound until its reply tells what it took."""
        entry = self._limiter.acquire(max_input_tokens(self.name, request) + request.max_tokens)
        reply = self._model.ask(request)
        self._limiter.correct(entry, reply.input_tokens + reply.output_tokens)
        return reply
