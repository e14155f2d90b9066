"""Facts about prices and budgets."""

from __future__ import annotations

import threading
from datetime import UTC, datetime
from importlib.metadata import version

import pytest
from model_wire import a_request, png
from scripted import ScriptedModel

from anymesh.errors import BudgetError, ModelError, OptionError
from anymesh.prompted.models.budget import LONG, PRICES, Budgeted, Limiter, Rate, cost_of, max_input_tokens, max_picture_tokens
from anymesh.prompted.models.vision import Reply, Request
from anymesh.types import Picture


class Billed:
    """Bills so many tokens a call."""

    name = "openai:gpt-4o"

    def __init__(self, tokens_in: int = 1_000_000, tokens_out: int = 500_000) -> None:
        self.tokens = tokens_in, tokens_out

    def ask(self, request: Request) -> Reply:
        return Reply("{}", self.name, *self.tokens)


@pytest.mark.parametrize("name", PRICES)
def test_the_table_agrees_with_genai_prices(name: str) -> None:
    genai = pytest.importorskip("genai_prices")
    if version("genai-prices") != "0.2.3":
        pytest.skip("prices are those of another day there; the table is dated")
    provider, _, model = name.partition(":")
    when = datetime(2027, 2, 1, tzinfo=UTC)
    cases = [(10_000, 1000)] + ([(LONG[name][0] + 1, 1000)] if name in LONG else [])
    for tokens_in, tokens_out in cases:
        usage = genai.Usage(input_tokens=tokens_in, output_tokens=tokens_out)
        try:
            theirs = genai.calc_price(usage, model, provider_id=provider, genai_request_timestamp=when)
        except LookupError:
            pytest.skip("not known there")
        assert cost_of(name, tokens_in, tokens_out) == pytest.approx(float(theirs.total_price), rel=1e-9)


def test_a_long_request_costs_more_for_all_its_tokens() -> None:
    assert cost_of("google:gemini-2.5-pro", 200_000, 0) == pytest.approx(0.25)
    assert cost_of("google:gemini-2.5-pro", 200_001, 0) == pytest.approx(0.5000025)


@pytest.mark.parametrize(
    "name", ["openai:gpt-4o-2024-08-06", "anthropic:claude-sonnet-4-5-20250929", "google:gemini-2.5-flash-001"]
)
def test_a_dated_snapshot_costs_what_its_model_costs(name: str) -> None:
    base = next(k for k in sorted(PRICES, key=len, reverse=True) if name.startswith(k))
    assert cost_of(name, 1000, 1000) == cost_of(base, 1000, 1000)


@pytest.mark.parametrize(
    "name", ["openai:gpt-4o-audio-preview", "openai:gpt-9", "openai-compatible:http://localhost:8000/v1#gpt-4o", "scripted"]
)
def test_another_model_has_no_known_price(name: str) -> None:
    assert cost_of(name, 1000, 1000) is None


def test_the_documented_examples_of_picture_tokens() -> None:
    assert max_picture_tokens("openai", "gpt-4o", 1024, 1024) == 765  # 2 x 2 tiles
    assert max_picture_tokens("openai", "gpt-4o", 2048, 4096) == 1105  # 2 x 3 tiles
    assert max_picture_tokens("openai", "gpt-4o-mini", 1024, 1024) == 25501
    assert max_picture_tokens("openai", "gpt-4.1-mini", 1024, 1024) >= 1024 * 1.62
    assert max_picture_tokens("anthropic", "claude-sonnet-4-5", 1000, 1000) >= 1334
    assert max_picture_tokens("google", "gemini-2.5-flash", 960, 540) >= 6 * 258
    assert max_picture_tokens("google", "gemini-3.8-flash", 300, 300) >= 1120


def test_every_picture_and_word_counts_in_the_upper_bound() -> None:
    name = "anthropic:claude-sonnet-4-5"
    few = max_input_tokens(name, a_request())
    assert max_input_tokens(name, a_request(text="word " * 1000)) > few + 1000
    assert max_input_tokens(name, a_request(pictures=(Picture(png(750, 1000), ""),) * 3)) > few + 2000


def test_fills_in_the_cost_and_adds_up() -> None:
    model = Budgeted(Billed())
    assert [model.ask(a_request()).cost for _ in range(2)] == [7.5, 7.5]
    assert (model.name, model.calls, model.cost) == ("openai:gpt-4o", 2, 15.0)


def test_stops_before_one_call_too_many() -> None:
    inner = ScriptedModel(["a", "b", "c"])
    model = Budgeted(inner, max_calls=2)
    model.ask(a_request())
    model.ask(a_request())
    with pytest.raises(BudgetError, match="hinge: call 3 would exceed --max-calls 2; spent so far: 2 calls"):
        model.ask(a_request())
    assert len(inner.requests) == 2


def test_no_call_at_all_may_be_wanted() -> None:
    with pytest.raises(BudgetError):
        Budgeted(ScriptedModel(["a"]), max_calls=0).ask(a_request())


def test_stops_before_a_call_that_could_pass_the_cost() -> None:
    request = a_request(max_tokens=1000)
    most = cost_of("openai:gpt-4o", max_input_tokens("openai:gpt-4o", request), 1000)
    assert most is not None
    assert most > 0.01  # the tokens out alone
    inner = ScriptedModel(["a", "b"], name="openai:gpt-4o")
    with pytest.raises(BudgetError, match=r"up to 0\.0\d+ USD, which could exceed --max-cost .*; spent so far: 0 calls"):
        Budgeted(inner, max_cost=0.99 * most).ask(request)
    assert not inner.requests
    assert Budgeted(inner, max_cost=1.01 * most).ask(request).text == "a"


def test_goes_on_until_the_next_call_could_pass_the_cost_and_never_passes_it() -> None:
    request = a_request(max_tokens=1000)
    most = cost_of("openai:gpt-4o", max_input_tokens("openai:gpt-4o", request), 1000)
    assert most is not None
    model = Budgeted(Billed(1000, 900), max_cost=0.1)
    for _ in range(8):
        model.ask(request)
    with pytest.raises(BudgetError, match=r"spent so far: 8 calls, 0\.0920 USD"):
        model.ask(request)
    assert 0.1 - most < model.cost <= 0.1


def test_a_call_that_failed_takes_nothing() -> None:
    model = Budgeted(ScriptedModel([ModelError("no"), "a"]), max_calls=1)
    with pytest.raises(ModelError, match="no"):
        model.ask(a_request())
    assert (model.calls, model.cost) == (0, 0)
    assert model.ask(a_request()).text == "a"


def test_threads_do_not_pass_the_limit_together() -> None:
    begun, done = threading.Barrier(3, timeout=5), threading.Barrier(3, timeout=5)  # two calls, and this test

    def slow(_: Request) -> str:
        begun.wait()
        done.wait()
        return "a"

    model = Budgeted(ScriptedModel(slow), max_calls=2)
    threads = [threading.Thread(target=model.ask, args=(a_request(),)) for _ in range(2)]
    for thread in threads:
        thread.start()
    begun.wait()
    with pytest.raises(BudgetError):
        model.ask(a_request())
    done.wait()
    for thread in threads:
        thread.join(5)
    assert model.calls == 2


def test_a_cost_limit_needs_a_known_price() -> None:
    with pytest.raises(OptionError, match="use --max-calls"):
        Budgeted(ScriptedModel([], name="openai-compatible:http://localhost/v1#m"), max_cost=1.0)


@pytest.mark.parametrize("limits", [{"max_calls": -1}, {"max_cost": -0.5}, {"max_cost": float("nan")}])
def test_limits_that_make_no_sense(limits: dict) -> None:
    with pytest.raises(OptionError, match="or more, found"):
        Budgeted(Billed(), **limits)


def test_an_unknown_price_leaves_the_cost_unknown() -> None:
    model = Budgeted(ScriptedModel(["a"]))
    assert model.ask(a_request()).cost is None
    assert (model.calls, model.cost) == (1, 0)


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
