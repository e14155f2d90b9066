"""From a model's name to a model with everything around it."""

from __future__ import annotations

from pathlib import Path

from anymesh.deadline import CALL_SECONDS
from anymesh.errors import OptionError
from anymesh.models.budget import Account, Budgeted
from anymesh.models.cache import Cached
from anymesh.models.pydantic_ai_ import connect
from anymesh.models.rates import Limiter, RateLimited
from anymesh.models.replay import Replay
from anymesh.models.retry import Retrying
from anymesh.models.vision import VisionModel


def open_model(
    name: str,
    *,
    cache: Path | None = None,
    max_calls: int | None = None,
    max_cost: float | None = None,
    spent: Account | None = None,
    limiter: Limiter | None = None,
    timeout: float = CALL_SECONDS,
) -> VisionModel:
    """The model of that name, or a recording of one (`replay:FOLDER`); cache: the folder, None for none.

    The cache stands outermost, so a hit takes nothing from the budget; retries inside, so only answers do. `timeout` [s]
    holds for one attempt, before which the limiter may wait. Raises OptionError for a name or a budget that is not valid,
    ModelError without a key, MissingExtraError without the libraries.
    """
    kind, _, folder = name.partition(":")
    if kind == "replay":
        if not folder:
            raise OptionError("a recording is named replay:FOLDER")
        return Replay(Path(folder))
    model: VisionModel = connect(name, timeout=timeout)
    model = Retrying(model if limiter is None else RateLimited(model, limiter))
    model = Budgeted(model, max_calls=max_calls, max_cost=max_cost, spent=spent)
    return model if cache is None else Cached(model, cache)
