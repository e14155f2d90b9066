"""Budget and rate limit shared by all processes of an output, stored in its ledger."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from anymesh.applications.annotate.ledger import Ledger
from anymesh.prompted.models.budget import Limit, spent_words
from anymesh.prompted.models.rates import WINDOW, Rate


class LedgerAccount:
    """Calls and their cost [USD] over all runs of an output. name, token: object in progress, and its claim.

    A call in progress reserves its upper bound; if its process ends unexpectedly, that bound counts as spent.
    """

    def __init__(self, ledger: Ledger, name: str, token: str) -> None:
        self._ledger, self._name, self._token = ledger, name, token

    @property
    def calls(self) -> int:
        """Number of calls answered so far."""
        return spent(self._ledger)[0]

    @property
    def cost(self) -> float:
        """Their cost [USD, of known prices]."""
        return spent(self._ledger)[1]

    def hold(self, kind: str, most: float, limit: Limit) -> int:
        """Reserve a call of at most `most` [USD] and return the reservation's number. Raise BudgetError beyond the limit."""
        with self._ledger.writing() as connection:
            calls, cost = connection.execute("SELECT calls, cost FROM account").fetchone()
            waiting, held = connection.execute("SELECT count(*), total(most) FROM holds").fetchone()
            limit.check(kind, calls + waiting, cost + held, most, spent_words(calls, cost))
            values = (self._token, self._name, most)
            return int(connection.execute("INSERT INTO holds(token, name, most) VALUES(?,?,?)", values).lastrowid or 0)

    def settle(self, hold: int, cost: float | None) -> None:
        """Replace a reservation by the cost of the call; None for a call that failed and was not billed."""
        with self._ledger.writing() as connection:
            there = connection.execute("DELETE FROM holds WHERE id = ?", (hold,)).rowcount
            if cost is not None and there:  # else it was charged when the claim was lost
                connection.execute("UPDATE account SET calls = calls + 1, cost = cost + ?", (cost,))
                statement = "UPDATE objects SET calls = calls + 1, cost = coalesce(cost, 0) + ? WHERE name = ?"
                connection.execute(statement, (cost, self._name))


class LedgerLimiter:
    """Requests and tokens of the last minute over all processes of an output, by a monotonic clock."""

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
        """Wait until a request of this many tokens may be sent; return the number of its entry."""
        while True:
            entry, wait = self.attempt(tokens)
            if entry is not None:
                return entry
            self._sleep(wait)

    def attempt(self, tokens: int) -> tuple[int | None, float]:
        """Return the entry's number if a request may be sent now; else None, and the time to wait [s]."""
        with self._ledger.writing() as connection:
            now = self._clock()
            # later times are from before a restart of the machine
            connection.execute("DELETE FROM rates WHERE at <= ? OR at > ?", (now - WINDOW, now))
            count, used, first = connection.execute("SELECT count(*), total(tokens), min(at) FROM rates").fetchone()
            if self._rate.allows(count, int(used), tokens):
                return connection.execute("INSERT INTO rates(at, tokens) VALUES(?,?)", (now, tokens)).lastrowid, 0.0
        return None, max(first + WINDOW - now, 0.01)

    def correct(self, entry: int, tokens: int) -> None:
        """Replace the estimate of an entry by the tokens that were billed."""
        with self._ledger.writing() as connection:
            connection.execute("UPDATE rates SET tokens = ? WHERE id = ?", (tokens, entry))


def spent(ledger: Ledger) -> tuple[int, float]:
    """Return calls and their cost [USD] over all runs of an output."""
    calls, cost = ledger.rows("SELECT calls, cost FROM account")[0]
    return int(calls), float(cost)


def open_account(out: Path, name: str, token: str, rate: Rate | None) -> tuple[LedgerAccount, LedgerLimiter | None]:
    """Open the account and the limiter of an output, for one object in a worker process."""
    ledger = Ledger.open(out)
    return LedgerAccount(ledger, name, token), None if rate is None else LedgerLimiter(ledger, rate)
