"""Access to an output's account from processes that cannot open its ledger, such as on other machines."""

from __future__ import annotations

import secrets
import socket
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from multiprocessing import AuthenticationError
from multiprocessing.connection import Client, Connection, Listener
from pathlib import Path
from threading import Thread
from typing import Any

from anymesh.applications.annotate.accounts import LedgerAccount, LedgerLimiter
from anymesh.applications.annotate.ledger import Ledger
from anymesh.errors import BudgetError, OutputError
from anymesh.prompted.models.budget import Limit
from anymesh.prompted.models.rates import Rate

Ask = Callable[..., Any]
CLOSING = 5.0  # [s] to wait for the thread of a bridge


class Meter:
    """The account and the limiter of an output, called sequentially. rate: requests and tokens per minute."""

    def __init__(self, collection: str, rate: tuple[int | None, int | None]) -> None:
        self._ledger = Ledger.open(Path(collection))
        self._limiter = LedgerLimiter(self._ledger, Rate(*rate))

    def spent(self) -> tuple[int, float]:
        """Return the calls and their cost [USD]."""
        account = LedgerAccount(self._ledger, "", "")
        return account.calls, account.cost

    def hold(self, name: str, token: str, kind: str, most: float, limit: Limit) -> int | str:
        """Return the number of a reservation, or an error text, since exceptions do not survive the transport."""
        try:
            return LedgerAccount(self._ledger, name, token).hold(kind, most, limit)
        except BudgetError as error:
            return str(error)

    def settle(self, name: str, token: str, hold: int, cost: float | None) -> None:
        """Replace a reservation by the cost of the call."""
        LedgerAccount(self._ledger, name, token).settle(hold, cost)

    def attempt(self, tokens: int) -> tuple[int | None, float]:
        """Return the entry of a request that may be sent now, or the time to wait [s]."""
        return self._limiter.attempt(tokens)

    def correct(self, entry: int, tokens: int) -> None:
        """Replace the estimate of an entry."""
        self._limiter.correct(entry, tokens)


class Bridge:
    """A socket through which a child process reaches a Meter, in a folder readable only by this user.

    ask: calls a method of the meter by name. Entering the context returns the address, which contains the secret of clients.
    """

    def __init__(self, ask: Ask) -> None:
        self._ask, self._word, self._closed = ask, secrets.token_hex(16), False

    def __enter__(self) -> str:
        self._folder = tempfile.TemporaryDirectory(prefix="anymesh-")
        self._path = str(Path(self._folder.name, "meter"))
        self._listener = Listener(self._path, "AF_UNIX", authkey=self._word.encode())
        self._thread = Thread(target=self._serve, name="anymesh-bridge", daemon=True)
        self._thread.start()
        return f"{self._word}@{self._path}"

    def __exit__(self, *_: object) -> None:
        self._closed = True
        with suppress(OSError), socket.socket(socket.AF_UNIX) as waking:
            waking.connect(self._path)  # wakes the thread that waits for a client; without the secret it is rejected
        self._thread.join(CLOSING)
        self._listener.close()
        self._folder.cleanup()

    def _serve(self) -> None:
        while not self._closed:
            try:
                connection = self._listener.accept()
            except (AuthenticationError, OSError, EOFError):
                continue  # a client without the secret, or one that disconnected
            with connection, suppress(OSError, EOFError):
                self._answer(connection)

    def _answer(self, connection: Connection) -> None:
        while True:
            method, values = connection.recv()
            try:
                answer = ("value", self._ask(method, *values))
            except Exception as error:
                answer = ("error", f"{type(error).__name__}: {error}"[:300])
            connection.send(answer)


class RemoteMeter:
    """The account and the limiter of an object, through a bridge."""

    def __init__(self, address: str, name: str, token: str) -> None:
        self._name, self._token = name, token
        self._word, _, self._path = address.partition("@")

    def _ask(self, method: str, *values: Any) -> Any:
        try:
            with Client(self._path, "AF_UNIX", authkey=self._word.encode()) as connection:
                connection.send((method, values))
                kind, answer = connection.recv()
        except (OSError, EOFError, AuthenticationError) as error:
            raise OutputError(f"the process that keeps the ledger cannot be reached ({type(error).__name__})") from None
        if kind == "error":
            raise OutputError(f"the ledger cannot be written: {answer}")
        return answer

    @property
    def calls(self) -> int:
        """Number of calls answered so far, of all objects."""
        return self._ask("spent")[0]

    @property
    def cost(self) -> float:
        """Their cost [USD, of known prices]."""
        return self._ask("spent")[1]

    def hold(self, kind: str, most: float, limit: Limit) -> int:
        """Reserve a call of at most `most` [USD] and return the reservation's number. Raise BudgetError beyond the limit."""
        reply = self._ask("hold", self._name, self._token, kind, most, limit)
        if isinstance(reply, str):
            raise BudgetError(reply)
        return reply

    def settle(self, hold: int, cost: float | None) -> None:
        """Replace a reservation by the cost of the call; None for a call that failed and was not billed."""
        self._ask("settle", self._name, self._token, hold, cost)

    def acquire(self, tokens: int) -> int:
        """Wait until a request of this many tokens may be sent; return the number of its entry."""
        while True:
            entry, wait = self._ask("attempt", tokens)
            if entry is not None:
                return entry
            time.sleep(wait)

    def correct(self, entry: int, tokens: int) -> None:
        """Replace the estimate of an entry by the tokens that were billed."""
        self._ask("correct", entry, tokens)
