"""Limits of the number of model calls and of their cost."""

from __future__ import annotations

from dataclasses import replace

from anymesh.errors import OptionError
from anymesh.pipeline.options import Account, Limit, Spent
from anymesh.prompted.models.prices import cost_of, max_input_tokens
from anymesh.prompted.models.vision import Reply, Request, VisionModel


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
