"""Asking again after a failure that may pass: the one place of retries (the services' own clients do none)."""

from __future__ import annotations

import logging
import random
import time
from collections.abc import Callable
from typing import TypeVar

from anymesh.errors import ModelError, OptionError
from anymesh.models.vision import Reply, Request, VisionModel

log = logging.getLogger("anymesh")
T = TypeVar("T")
PATIENCE = 120.0  # [s]; a service that asks for a longer wait than this is not waited for


class TransientError(ModelError):
    """A call that failed in a way that may pass: too many requests, a server's fault, a time-out, a broken connection.

    retry_after: how long the service asked to wait [s], None when it did not say.
    """

    def __init__(self, message: str, retry_after: float | None = None) -> None:
        super().__init__(message)
        self.retry_after = retry_after


class UnavailableError(ModelError):
    """A service that did not answer at any attempt; it may be back later."""


class Retrying:
    """Asks up to `attempts` times, waiting `first` [s], then twice that, and so on up to `most`, each shortened by chance.

    The chance (`chance` gives numbers in [0, 1)) keeps processes that failed together from coming back together. A wait
    that the service asked for is kept. Raises ModelError when the last attempt failed too, or the failure is not one that
    may pass.
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
    """What `call` gives, called again after a TransientError, with the waits of `Retrying`. Raises ModelError as that does."""
    failure = TransientError("nothing was tried")
    for attempt in range(1, attempts + 1):
        try:
            return call()
        except TransientError as error:
            failure = error
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
