"""A budget and a provider's rate limit that all processes of an output share, in its ledger."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from anymesh.annotation.ledger import Ledger
from anymesh.models.budget import Limit, spent_words
from anymesh.models.rates import WINDOW, Rate


class LedgerAccount:
    """Calls and their cost [USD] over all runs of an output. name, token: the object that is worked on, and its claim.

    A call in progress holds its upper bound; when its process ends without a word, that counts as spent.
    """

    def __init__(self, ledger: Ledger, name: str, token: str) -> None:
        self._ledger, self._name, self._token = ledger, name, token

    @property
    def calls(self) -> int:
        """Calls answered so far."""
        return spent(self._ledger)[0]

    @property
    def cost(self) -> float:
        """What they cost [USD], of known prices."""
        return spent(self._ledger)[1]

    def hold(self, kind: str, most: float, limit: Limit) -> int:
        """Reserve a call of at most `most` [USD] and return the number of the hold. Raises BudgetError."""
        with self._ledger.writing() as connection:
            calls, cost = connection.execute("SELECT calls, cost FROM account").fetchone()
            waiting, held = connection.execute("SELECT count(*), total(most) FROM holds").fetchone()
            limit.check(kind, calls + waiting, cost + held, most, spent_words(calls, cost))
            values = (self._token, self._name, most)
            return int(connection.execute("INSERT INTO holds(token, name, most) VALUES(?,?,?)", values).lastrowid or 0)

    def settle(self, hold: int, cost: float | None) -> None:
        """Replace a hold by what the call cost; None: it was not answered, and not billed."""
        with self._ledger.writing() as connection:
            there = connection.execute("DELETE FROM holds WHERE id = ?", (hold,)).rowcount
            if cost is not None and there:  # else it was charged when the claim was lost
                connection.execute("UPDATE account SET calls = calls + 1, cost = cost + ?", (cost,))
                told = "UPDATE objects SET calls = calls + 1, cost = coalesce(cost, 0) + ? WHERE name = ?"
                connection.execute(told, (cost, self._name))


class LedgerLimiter:
    """Requests and tokens of the last minute over all processes of an output; the clock knows no date, so none can jump."""

    def __init__(
        self,
        ledger: Ledger,
        rate: Rate,
        *,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._ledger, self._rate, self._clock, self._sleep = ledger, rate, clock, sleep

    def acquire(self, tokens: int) -> int:
        """Wait until a request of so many tokens may be sent; return the number of its entry."""
        while True:
            entry, wait = self.attempt(tokens)
            if entry is not None:
                return entry
            self._sleep(wait)

    def attempt(self, tokens: int) -> tuple[int | None, float]:
        """The number of the entry of a request that may be sent now; else None, and how long to wait [s]."""
        with self._ledger.writing() as connection:
            now = self._clock()
            connection.execute("DELETE FROM rates WHERE at <= ? OR at > ?", (now - WINDOW, now))  # after: an earlier boot's
            count, used, first = connection.execute("SELECT count(*), total(tokens), min(at) FROM rates").fetchone()
            if self._rate.allows(count, int(used), tokens):
                return connection.execute("INSERT INTO rates(at, tokens) VALUES(?,?)", (now, tokens)).lastrowid, 0.0
        return None, max(first + WINDOW - now, 0.01)

    def correct(self, entry: int, tokens: int) -> None:
        """Replace the estimate of an entry by the tokens that were billed."""
        with self._ledger.writing() as connection:
            connection.execute("UPDATE rates SET tokens = ? WHERE id = ?", (tokens, entry))


def spent(ledger: Ledger) -> tuple[int, float]:
    """Calls and their cost [USD] over all runs of an output."""
    calls, cost = ledger.rows("SELECT calls, cost FROM account")[0]
    return int(calls), float(cost)


def open_account(out: Path, name: str, token: str, rate: Rate | None) -> tuple[LedgerAccount, LedgerLimiter | None]:
    """The account and the limiter of an output, for one object in a worker process."""
    ledger = Ledger.open(out)
    return LedgerAccount(ledger, name, token), None if rate is None else LedgerLimiter(ledger, rate)
