"""Test the limits of requests and tokens per minute, and the pauses in an outage."""

from __future__ import annotations

import pytest

from anymesh.applications.annotate.accounts import LedgerLimiter
from anymesh.applications.annotate.outages import Outage
from anymesh.errors import OptionError
from anymesh.prompted.models.rates import Rate, WindowLimiter


class Clock:
    def __init__(self) -> None:
        self.now, self.slept = 1000.0, []

    def __call__(self) -> float:
        return self.now

    def sleep(self, seconds: float) -> None:
        self.slept.append(seconds)
        self.now += seconds


@pytest.mark.parametrize("kind", ["ledger", "process"])
def test_requests_and_tokens_of_a_minute_are_limited(ledger, kind) -> None:
    clock = Clock()

    def limiter(rate: Rate):
        if kind == "ledger":
            return LedgerLimiter(ledger, rate, clock=clock, sleep=clock.sleep)
        return WindowLimiter(rate, clock=clock, sleep=clock.sleep)

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


def test_a_clock_that_begins_anew_does_not_block_a_provider(ledger) -> None:
    clock = Clock()
    limiter = LedgerLimiter(ledger, Rate(requests=1), clock=clock, sleep=clock.sleep)
    limiter.acquire(1)
    clock.now = 5.0  # the machine was started anew
    limiter.acquire(1)
    assert clock.slept == []


def test_rates_are_checked() -> None:
    with pytest.raises(OptionError, match="--requests-per-minute: found 0"):
        Rate(requests=0)


def test_an_outage_is_tried_less_and_less_and_ends_with_the_first_answer() -> None:
    clock = Clock()
    outage = Outage(600.0, clock=clock, first=5.0)
    assert outage.allowed(4, 0) == 4
    tries = []
    for _ in range(5):
        outage.failed()
        outage.failed()  # of another worker, at once
        while not outage.allowed(4, 0):
            clock.now += 1
        tries.append(clock.now)
        assert outage.allowed(4, 1) == 0
    assert [round(b - a) for a, b in zip([1000.0, *tries], tries, strict=False)] == [5, 10, 20, 40, 80]
    assert not outage.is_over
    clock.now += 600
    assert outage.is_over
    outage.reached()
    assert outage.allowed(4, 0) == 4
    assert not outage.is_over
