"""The account through a socket: what a worker on another machine asks of the ledger."""

from __future__ import annotations

import pytest

from anymesh.applications.annotate.accounts import spent
from anymesh.applications.annotate.bridge import Bridge, Meter, RemoteMeter
from anymesh.applications.annotate.entering import enter_objects
from anymesh.applications.annotate.ledger import Ledger
from anymesh.applications.annotate.requests import ObjectRequest
from anymesh.errors import BudgetError, OutputError
from anymesh.prompted.models.budget import Limit


@pytest.fixture
def ledger(tmp_path):
    with Ledger.open(tmp_path / "out", create=True) as made:
        enter_objects(made, [ObjectRequest("a", "/a.glb")])
        yield made


def test_a_budget_and_a_rate_hold_through_a_bridge(tmp_path, ledger) -> None:
    def ask(method: str, *values: object) -> object:  # as an actor would: in another thread than the ledger's owner
        return getattr(Meter(str(tmp_path / "out"), (2, None)), method)(*values)

    with Bridge(ask) as address:
        remote = RemoteMeter(address, "a", "token")
        hold = remote.hold("marks", 0.5, Limit(cost=0.6))
        with pytest.raises(BudgetError, match=r"could exceed --max-cost 0\.6"):
            remote.hold("marks", 0.5, Limit(cost=0.6))
        remote.settle(hold, 0.2)
        assert (remote.calls, remote.cost) == spent(ledger) == (1, 0.2)
        remote.correct(remote.acquire(1000), 10)
        remote.acquire(1000)
        assert remote._ask("attempt", 1)[0] is None
        assert ledger.rows("SELECT tokens FROM rates ORDER BY id") == [(10,), (1000,)]
        word, _, path = address.partition("@")
        with pytest.raises(OutputError, match="cannot be reached"):
            _ = RemoteMeter(f"{word[::-1]}x@{path}", "a", "token").calls
        assert remote.calls == 1  # a stranger does not end it
    with pytest.raises(OutputError, match="cannot be reached"):
        _ = remote.calls
