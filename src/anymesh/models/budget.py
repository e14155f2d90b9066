"""A limit to what is asked and what it costs."""

from __future__ import annotations

from dataclasses import dataclass, replace
from threading import Lock

from anymesh.errors import BudgetError, OptionError
from anymesh.models.prices import cost_of, most_input_tokens
from anymesh.models.vision import Reply, Request, VisionModel


@dataclass
class Spent:
    """Calls and their cost [USD, of known prices] so far; shared by the runs of a batch."""

    calls: int = 0
    cost: float = 0.0


class Budgeted:
    """Stops before the call that could pass a limit: max_calls, or max_cost [USD]. Fills in each reply's cost.

    A call counts when it is answered: one that failed was not billed. `spent` counts them, and may be shared with models
    before and after. A call in progress holds its upper bound, so threads cannot pass the limit together.
    """

    def __init__(
        self,
        model: VisionModel,
        *,
        max_calls: int | None = None,
        max_cost: float | None = None,
        spent: Spent | None = None,
    ) -> None:
        if max_calls is not None and max_calls < 0:
            raise OptionError(f"--max-calls must be 0 or more, found {max_calls}")
        if max_cost is not None and not max_cost >= 0:
            raise OptionError(f"--max-cost must be 0 USD or more, found {max_cost}")
        if max_cost is not None and cost_of(model.name, 0, 0) is None:
            raise OptionError(f"--max-cost needs a known price, and that of {model.name} is not: use --max-calls")
        self.name = model.name
        self.spent = spent if spent is not None else Spent()
        self._model, self._max_calls, self._max_cost = model, max_calls, max_cost
        self._lock, self._waiting, self._held = Lock(), 0, 0.0

    @property
    def calls(self) -> int:
        """Calls answered so far."""
        return self.spent.calls

    @property
    def cost(self) -> float:
        """What they cost [USD], of known prices."""
        return self.spent.cost

    def ask(self, request: Request) -> Reply:
        """Raises BudgetError instead of the call."""
        most = cost_of(self.name, most_input_tokens(self.name, request), request.max_tokens) or 0.0
        self._hold(request.kind, most)
        reply = None
        try:
            reply = self._model.ask(request)
        finally:
            cost = None if reply is None else cost_of(self.name, reply.input_tokens, reply.output_tokens)
            with self._lock:
                self._waiting -= 1
                self._held -= most
                self.spent.calls += reply is not None
                self.spent.cost += cost or 0.0
        return replace(reply, cost=cost)

    def _hold(self, kind: str, most: float) -> None:
        with self._lock:
            calls, cost = self.spent.calls + self._waiting, self.spent.cost + self._held
            if self._max_calls is not None and calls >= self._max_calls:
                raise BudgetError(f"{kind}: call {calls + 1} would pass --max-calls {self._max_calls}; {self._spent()}")
            if self._max_cost is not None and cost + most > self._max_cost:
                raise BudgetError(
                    f"{kind}: the next call may cost up to {most:.4f} USD, which could pass --max-cost {self._max_cost:g}; "
                    f"{self._spent()}"
                )
            self._waiting += 1
            self._held += most

    def _spent(self) -> str:
        return f"spent so far: {self.spent.calls} calls, {self.spent.cost:.4f} USD"
