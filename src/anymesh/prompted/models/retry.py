"""Retries after transient failures. All retries are made here; the services' own clients do none."""

from __future__ import annotations

import logging
import random
import time
from collections.abc import Callable
from typing import TypeVar

from anymesh.errors import ModelError, OptionError
from anymesh.prompted.models.vision import Reply, Request, VisionModel

log = logging.getLogger("anymesh")
T = TypeVar("T")
PATIENCE = 120.0  # [s] longest wait requested by a service that is accepted


class TransientError(ModelError):
    """A failure that may be temporary: too many requests, a server error, a time-out, a broken connection.

    retry_after: wait requested by the service [s], None if it gave none.
    """

    def __init__(self, message: str, retry_after: float | None = None) -> None:
        super().__init__(message)
        self.retry_after = retry_after


class UnavailableError(ModelError):
    """A service that answered no attempt; it may be available later."""


class Retrying:
    """Wrapper that asks up to `attempts` times, with exponential backoff from `first` to `most` [s] and random jitter.

    The jitter (`chance` returns numbers in [0, 1)) prevents processes that failed together from retrying together. A longer
    wait requested by the service is respected.
    Raise ModelError if the last attempt fails, or if the failure is not transient.
    """

    def __init__(
        self,
        model: VisionModel,
        *,
        attempts: int = 5,
        first: float = 1.0,
        most: float = 30.0,
        sleep: Callable[[float], None] = time.sleep,
        chance: Callable[[], float] = random.random,
    ) -> None:
        if attempts < 1:
            raise OptionError(f"attempts must be 1 or more, found {attempts}")
        self.name = model.name
        self._model, self._attempts, self._first, self._most = model, attempts, first, most
        self._sleep, self._chance = sleep, chance

    def ask(self, request: Request) -> Reply:
        return persist(
            lambda: self._model.ask(request),
            attempts=self._attempts,
            first=self._first,
            max_wait=self._most,
            sleep=self._sleep,
            chance=self._chance,
        )


def persist(
    call: Callable[[], T],
    *,
    attempts: int = 5,
    first: float = 1.0,
    max_wait: float = 30.0,
    sleep: Callable[[float], None] = time.sleep,
    chance: Callable[[], float] = random.random,
) -> T:
    """Return the result of `call`, repeated after a TransientError, with the waits of `Retrying`.

    Raise ModelError as `Retrying` does.
    """
    failure = TransientError("nothing was tried")
    for attempt in range(1, attempts + 1):
        try:
            return call()
        except TransientError as error:
            failure = error.with_traceback(None)  # which would hold this frame, and with it all that its callers hold
        if attempt == attempts:
            break
        if (failure.retry_after or 0) > PATIENCE:
            raise UnavailableError(
                f"{failure}; it asks to wait {failure.retry_after:.0f} s, which is longer than {PATIENCE:.0f} s"
            )
        wait = max(min(max_wait, first * 2 ** (attempt - 1)) * (1 - chance() / 2), failure.retry_after or 0.0)
        log.info("%s; attempt %d of %d in %.1f s", failure, attempt + 1, attempts, wait)
        sleep(wait)
    raise UnavailableError(f"{failure}; gave up after {attempts} attempts")
