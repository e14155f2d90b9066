"""Calls to models and their cost, counted towards the limits of one run or of several."""

from __future__ import annotations

from dataclasses import dataclass, field
from threading import Lock
from typing import Protocol, runtime_checkable

from anymesh.errors import BudgetError


@dataclass(frozen=True)
class Limit:
    """Maximum number of calls, and maximum cost [USD]; None for no limit."""

    calls: int | None = None
    cost: float | None = None

    def check(self, kind: str, calls: int, cost: float, most: float, spent: str) -> None:
        """Raise BudgetError if one more call of at most `most` [USD] could exceed the limit.

        calls, cost: spent and reserved so far; kind: kind of the question; spent: both in words.
        """
        if self.calls is not None and calls >= self.calls:
            raise BudgetError(f"{kind}: call {calls + 1} would exceed --max-calls {self.calls}; {spent}")
        if self.cost is not None and cost + most > self.cost:
            reason = f"the next call may cost up to {most:.4f} USD, which could exceed --max-cost {self.cost:g}"
            raise BudgetError(f"{kind}: {reason}; {spent}")


@runtime_checkable
class Account(Protocol):
    """Protocol of a counter of calls and their cost [USD], shared by threads or by processes."""

    @property
    def calls(self) -> int: ...

    @property
    def cost(self) -> float: ...

    def hold(self, kind: str, most: float, limit: Limit) -> int:
        """Reserve a call of at most `most` [USD] and return the reservation's number. Raise BudgetError beyond the limit."""
        ...

    def settle(self, hold: int, cost: float | None) -> None:
        """Replace a reservation by the cost of the call; None for a call that failed and was not billed."""
        ...


@dataclass
class Spent:
    """Calls and their cost [USD, of known prices] so far; shared by threads and by the runs of a batch."""

    calls: int = 0
    cost: float = 0.0
    _held: dict[int, float] = field(default_factory=dict, repr=False)
    _lock: Lock = field(default_factory=Lock, repr=False, compare=False)
    _last: int = field(default=0, repr=False)

    def hold(self, kind: str, most: float, limit: Limit) -> int:
        """Reserve a call, so that threads cannot exceed the limit together. Raise BudgetError beyond the limit."""
        with self._lock:
            spent = spent_words(self.calls, self.cost)
            limit.check(kind, self.calls + len(self._held), self.cost + sum(self._held.values()), most, spent)
            self._last += 1
            self._held[self._last] = most
            return self._last

    def settle(self, hold: int, cost: float | None) -> None:
        """Count an answered call; drop the reservation of a failed one."""
        with self._lock:
            del self._held[hold]
            self.calls += cost is not None
            self.cost += cost or 0.0


def spent_words(calls: int, cost: float) -> str:
    """Describe calls and cost [USD] in words."""
    return f"spent so far: {calls} calls, {cost:.4f} USD"
