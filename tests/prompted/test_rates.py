"""Limits of requests and tokens per minute."""

from __future__ import annotations

import pytest

from anymesh.errors import OptionError
from anymesh.prompted.models.budget import Limiter, Rate


class Clock:
    def __init__(self) -> None:
        self.now = 1000.0

    def __call__(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.now += seconds


def test_requests_and_tokens_of_a_minute_are_limited() -> None:
    clock = Clock()

    def limiter(rate: Rate) -> Limiter:
        return Limiter(rate, clock=clock, sleep=clock.sleep)

    by_count = limiter(Rate(requests=3))
    for _ in range(3):
        by_count.acquire(10)
    assert clock.now == 1000.0
    by_count.acquire(10)
    assert clock.now == 1060.0
    clock.now += 100
    by_tokens = limiter(Rate(tokens=1000))
    entry = by_tokens.acquire(900)
    by_tokens.correct(entry, 300)
    by_tokens.acquire(700)
    begin = clock.now
    by_tokens.acquire(1)
    assert clock.now == begin + 60
    clock.now += 100
    by_tokens.acquire(5000)  # more than the limit alone: asked when nothing else was
    begin = clock.now
    by_tokens.acquire(1)
    assert clock.now == begin + 60


def test_rates_are_checked() -> None:
    with pytest.raises(OptionError, match="--requests-per-minute: found 0"):
        Rate(requests=0)
