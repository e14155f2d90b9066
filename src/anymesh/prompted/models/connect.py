"""Opening of models by name, with cache, budget, retries and rate limits."""

from __future__ import annotations

from pathlib import Path

from anymesh.errors import OptionError
from anymesh.pipeline.options import Account
from anymesh.prompted.models.budget import Budgeted
from anymesh.prompted.models.cache import Cached
from anymesh.prompted.models.pydantic_ai_ import connect
from anymesh.prompted.models.rates import Limiter, RateLimited
from anymesh.prompted.models.replay import Replay
from anymesh.prompted.models.retry import Retrying
from anymesh.prompted.models.vision import VisionModel
from anymesh.runtime import CALL_SECONDS


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
    """Open the model of that name, or a recording of one (`replay:FOLDER`); cache: folder, None for no cache.

    The cache is the outermost wrapper, so hits do not count towards the budget. Retries are inside the budget, so only answers
    count.
    `timeout` [s] applies to one attempt; waiting for the limiter is not included.
    Raise OptionError for an invalid name or budget, ModelError without a key, MissingExtraError without the libraries.
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
