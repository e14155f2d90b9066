"""What calls of models cost, and limits of their number, their cost and their rate."""

from __future__ import annotations

import re
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import ceil
from threading import Lock

from anymesh.errors import OptionError
from anymesh.pipeline.options import Account, Limit, Spent
from anymesh.prompted.models.vision import Reply, Request, VisionModel

# [USD per million tokens of (input, output)] for standard service without discounts for batches and repeated input, so a bill
# is never higher than stated here. From genai-prices 0.2.3 on 2026-11-21; prices that are announced to end before February 2027
# are replaced by their successors. A test compares the rows with that package.
PRICES: dict[str, tuple[float, float]] = {
    "openai:gpt-4-turbo": (10, 30),
    "openai:gpt-4.1": (2, 8),
    "openai:gpt-4.1-mini": (0.4, 1.6),
    "openai:gpt-4.1-nano": (0.1, 0.4),
    "openai:gpt-4o": (2.5, 10),
    "openai:gpt-4o-2024-05-13": (5, 15),
    "openai:gpt-4o-mini": (0.15, 0.6),
    "openai:gpt-5": (1.25, 10),
    "openai:gpt-5-mini": (0.25, 2),
    "openai:gpt-5-nano": (0.05, 0.4),
    "openai:gpt-5.1": (1.25, 10),
    "openai:gpt-5.2": (1.75, 14),
    "openai:gpt-5.4": (2.5, 15),
    "openai:gpt-5.4-mini": (0.75, 4.5),
    "openai:gpt-5.4-nano": (0.2, 1.25),
    "openai:gpt-5.5": (5, 30),
    "openai:gpt-5.6-luna": (0.2, 1.2),
    "openai:gpt-5.6-sol": (4, 20),
    "openai:gpt-5.6-terra": (2, 12),
    "openai:gpt-6-astra": (10, 50),
    "openai:gpt-6-luna": (0.1, 0.5),
    "openai:gpt-6-sol": (2, 10),
    "openai:gpt-6.1-sol": (2, 10),
    "openai:gpt-6.1-terra": (1, 5),
    "openai:o1": (15, 60),
    "openai:o3": (2, 8),
    "openai:o4-mini": (1.1, 4.4),
    "anthropic:claude-haiku-4-5": (1, 5),
    "anthropic:claude-haiku-5-5": (0.1, 0.5),
    "anthropic:claude-opus-4-1": (15, 75),
    "anthropic:claude-opus-4-5": (5, 25),
    "anthropic:claude-opus-4-6": (5, 25),
    "anthropic:claude-opus-4-7": (5, 25),
    "anthropic:claude-opus-4-8": (5, 25),
    "anthropic:claude-opus-5": (5, 25),
    "anthropic:claude-opus-5-5": (4, 20),
    "anthropic:claude-sonnet-4-5": (3, 15),
    "anthropic:claude-sonnet-4-6": (3, 15),
    "anthropic:claude-sonnet-5": (2, 10),
    "anthropic:claude-sonnet-5-5": (2, 10),
    "google:gemini-2.5-flash": (0.3, 2.5),
    "google:gemini-2.5-flash-lite": (0.1, 0.4),
    "google:gemini-2.5-pro": (1.25, 10),
    "google:gemini-3-flash-preview": (0.5, 3),
    "google:gemini-3.1-flash-lite": (0.25, 1.5),
    "google:gemini-3.1-pro-preview": (2, 12),
    "google:gemini-3.5-flash": (1.5, 9),
    "google:gemini-3.5-flash-lite": (0.3, 2.5),
    "google:gemini-3.6-flash": (1.5, 7.5),
    "google:gemini-3.7-flash": (1.5, 7.5),
    "google:gemini-3.8-flash": (1.5, 7.5),
    "google:gemini-4-argon": (4, 20),
}
# Number of input tokens above which all tokens of the request have these prices.
LONG: dict[str, tuple[int, float, float]] = {
    "openai:gpt-5.4": (272_000, 5, 22.5),
    "openai:gpt-5.5": (272_000, 10, 45),
    "openai:gpt-5.6-luna": (272_000, 0.4, 1.8),
    "openai:gpt-5.6-sol": (272_000, 8, 30),
    "openai:gpt-5.6-terra": (272_000, 4, 18),
    "openai:gpt-6-astra": (272_000, 20, 75),
    "openai:gpt-6-luna": (272_000, 0.2, 0.75),
    "openai:gpt-6-sol": (272_000, 4, 15),
    "openai:gpt-6.1-sol": (272_000, 4, 15),
    "openai:gpt-6.1-terra": (272_000, 2, 7.5),
    "anthropic:claude-haiku-5-5": (100_000, 0.5, 2.5),
    "anthropic:claude-sonnet-4-5": (200_000, 6, 22.5),
    "google:gemini-2.5-pro": (200_000, 2.5, 15),
    "google:gemini-3.1-pro-preview": (200_000, 4, 18),
}
SNAPSHOT = re.compile(r"-(\d{4}-\d\d-\d\d|\d{8}|\d{3}|latest)$")  # suffix of a snapshot, which has the price of its model


def cost_of(model_name: str, input_tokens: int, output_tokens: int) -> float | None:
    """Return the cost [USD] of a call; None if the price is not known, as for local servers."""
    model_name = model_name.replace("openai-responses:", "openai:", 1)  # both interfaces have the same prices
    row = model_name if model_name in PRICES else SNAPSHOT.sub("", model_name)
    if row not in PRICES:
        return None
    dear_from, *dear = LONG.get(row, (input_tokens, 0.0, 0.0))
    price_in, price_out = dear if input_tokens > dear_from else PRICES[row]
    return (input_tokens * price_in + output_tokens * price_out) / 1e6


def max_input_tokens(model_name: str, request: Request) -> int:
    """Return an upper bound of the request's input tokens, at two bytes of text per token; English has about four."""
    words = sum(len(text.encode()) for text in request.texts)
    provider, _, model = model_name.replace("openai-responses:", "openai:", 1).partition(":")
    # 1000 tokens for what the service adds: the wrapping of the tool, and the schema in words.
    return 1000 + words // 2 + sum(max_picture_tokens(provider, model, *picture.size) for picture in request.pictures)


def max_picture_tokens(provider: str, model: str, width: int, height: int) -> int:
    """Return an upper bound of the tokens of one picture [px], by the providers' formulas as of 2026-11.

    The most expensive formula is used if a provider has several.
    OpenAI: tiles of 512 px after downscaling the short side to 768 px, or, for some models, patches of 32 px times a factor of
    the model. Anthropic: pixels divided by 750, up to the value of the largest side. Google: a fixed number, or tiles.
    """
    match provider:
        case "openai" if re.match(r"gpt-4o-mini", model):
            return 2833 + 5667 * _tiles(width, height)
        case "openai" if re.match(r"(gpt-4o|gpt-4\.1|gpt-4-turbo|gpt-5|o1|o3)(-\d|$)", model):
            return 85 + 170 * _tiles(width, height)
        case "openai":
            return ceil(2.5 * min(ceil(width / 32) * ceil(height / 32), 2500))
        case "anthropic":
            return min(ceil(width * height / 750), 4784) + 50
        case "google":
            unit = min(768, max(256, int(min(width, height) / 1.5)))
            return max(1120, 258 * ceil(width / unit) * ceil(height / unit))
        case _:
            return ceil(width / 14) * ceil(height / 14)  # the smallest patch size of common local models


def _tiles(width: int, height: int) -> int:
    shrink = min(1.0, 2048 / max(width, height))
    shrink *= min(1.0, 768 / (min(width, height) * shrink))
    return ceil(width * shrink / 512) * ceil(height * shrink / 512)


class Budgeted:
    """Wrapper that stops before a call that could exceed a limit: max_calls, or max_cost [USD].

    It sets the cost of each reply. Only answered calls count: a failed call is not billed. A call in progress reserves its
    upper bound.
    `spent` holds the counts, and may be shared with earlier and later models, and with other processes.
    """

    def __init__(
        self,
        model: VisionModel,
        *,
        max_calls: int | None = None,
        max_cost: float | None = None,
        spent: Account | None = None,
    ) -> None:
        if max_calls is not None and max_calls < 0:
            raise OptionError(f"--max-calls must be 0 or more, found {max_calls}")
        if max_cost is not None and not max_cost >= 0:
            raise OptionError(f"--max-cost must be 0 USD or more, found {max_cost}")
        if max_cost is not None and cost_of(model.name, 0, 0) is None:
            raise OptionError(f"--max-cost needs a known price, and that of {model.name} is not: use --max-calls")
        self.name = model.name
        self.spent: Account = spent if spent is not None else Spent()
        self._model, self._limit = model, Limit(max_calls, max_cost)

    @property
    def calls(self) -> int:
        """Number of calls answered so far."""
        return self.spent.calls

    @property
    def cost(self) -> float:
        """Their cost [USD, of known prices]."""
        return self.spent.cost

    def ask(self, request: Request) -> Reply:
        """Ask the model. Raise BudgetError if the call could exceed a limit."""
        most = cost_of(self.name, max_input_tokens(self.name, request), request.max_tokens) or 0.0
        hold = self.spent.hold(request.kind, most, self._limit)
        try:
            reply = self._model.ask(request)
        except BaseException:
            self.spent.settle(hold, None)
            raise
        cost = cost_of(self.name, reply.input_tokens, reply.output_tokens)
        self.spent.settle(hold, cost or 0.0)
        return replace(reply, cost=cost)


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
