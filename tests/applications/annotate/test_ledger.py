"""Test the ledger: exclusive claims, clock jumps, damaged pages, a budget and rates shared by processes."""

from __future__ import annotations

import json
import sqlite3
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path

import pytest

from anymesh.applications.annotate import claims
from anymesh.applications.annotate.accounts import LedgerAccount, spent
from anymesh.applications.annotate.claims import begun_run, claim, finish, free_lost, live_runs
from anymesh.applications.annotate.entering import enter_objects
from anymesh.applications.annotate.ledger import NAME, Ledger
from anymesh.applications.annotate.requests import ObjectRequest
from anymesh.applications.annotate.salvage import open_ledger
from anymesh.applications.annotate.states import AttemptOutcome, Claim, Result, State
from anymesh.errors import BudgetError, InputError, OutputError
from anymesh.prompted.models.budget import Limit

DONE = AttemptOutcome(Result.DONE, record={"confidence": 0.5, "sha256": "x"})


def requests(count: int) -> list[ObjectRequest]:
    return [ObjectRequest(f"object {k}", f"/in/{k}.glb") for k in range(count)]


def counts(ledger: Ledger) -> dict[str, int]:
    return dict(ledger.rows("SELECT state, count(*) FROM objects GROUP BY state"))


def test_claims_are_exclusive(tmp_path, ledger) -> None:
    enter_objects(ledger, requests(300))

    def take(_: int) -> list[int]:
        mine = []
        with Ledger.open(tmp_path / "out") as own, begun_run(own, 1) as run:
            while found := claim(own, run, 7):
                mine += [c.seq for c in found]
                for one in found:
                    assert finish(own, one, DONE, most=3) is State.DONE
        return mine

    with ThreadPoolExecutor(6) as threads:
        taken = [seq for mine in threads.map(take, range(6)) for seq in mine]
    assert sorted(taken) == list(range(1, 301))


def test_a_late_result_of_a_claim_that_was_taken_over_is_not_taken(ledger) -> None:
    enter_objects(ledger, requests(1))
    with begun_run(ledger, 1) as first:
        (old,) = claim(ledger, first, 1)
    with begun_run(ledger, 1) as second:
        (new,) = claim(ledger, second, 1)
        assert finish(ledger, old, DONE, most=3) is None
        assert counts(ledger) == {"running": 1}
        assert finish(ledger, new, DONE, most=3) is State.DONE
        assert finish(ledger, new, DONE, most=3) is None


def test_the_claims_of_a_dead_run_are_freed_and_those_of_a_live_one_are_not(tmp_path, ledger) -> None:
    enter_objects(ledger, requests(4))
    with Ledger.open(tmp_path / "out") as other, begun_run(other, 1) as live, begun_run(ledger, 1) as mine:
        claim(other, live, 1)
        (taken,) = claim(ledger, mine, 1)
        with ledger.writing() as connection:  # a run of which only its entry is left
            connection.execute("INSERT INTO runs(run, boot, beat) VALUES('dead', ?, ?)", (claims.boot_id(), time.monotonic()))
            connection.execute("UPDATE objects SET state = 'running', run = 'dead', token = 'dead.1' WHERE seq = 4")
        assert free_lost(ledger, mine) == 1
        assert counts(ledger) == {"running": 2, "pending": 2}
        assert live_runs(ledger, mine) == 1
        assert taken.seq == 2


def test_a_jump_of_the_clock_frees_nothing(tmp_path, ledger, monkeypatch) -> None:
    enter_objects(ledger, requests(1))
    with Ledger.open(tmp_path / "out") as other, begun_run(other, 1) as live, begun_run(ledger, 1) as mine:
        claim(other, live, 1)
        for jump in (1e9, -1e9):
            monkeypatch.setattr(claims.time, "time", lambda jump=jump: jump)
            assert free_lost(ledger, mine) == 0
        assert counts(ledger) == {"running": 1}


@pytest.mark.parametrize("what", ["stuck", "booted"])
def test_a_run_that_does_not_beat_is_taken_for_gone(tmp_path, ledger, what) -> None:
    enter_objects(ledger, requests(1))
    with Ledger.open(tmp_path / "out") as other, begun_run(other, 1) as live, begun_run(ledger, 1) as mine:
        claim(other, live, 1)
        change = "beat = beat - 1000" if what == "stuck" else "boot = 'another'"
        with ledger.writing() as connection:
            connection.execute(f"UPDATE runs SET {change} WHERE run = ?", (live,))
        assert free_lost(ledger, mine) == 1


def test_an_object_whose_runs_are_killed_again_and_again_is_quarantined(ledger) -> None:
    enter_objects(ledger, requests(1))
    for _ in range(claims.LOSSES):
        with begun_run(ledger, 1) as run:
            (taken,) = claim(ledger, run, 1)
            state = finish(ledger, taken, AttemptOutcome(Result.LOST, "LostError", "gone"), most=3)
    assert state is State.QUARANTINED


def test_two_objects_of_one_name_are_an_error(ledger) -> None:
    with pytest.raises(InputError, match="two objects of the name 'object 1'"):
        enter_objects(ledger, [*requests(3), ObjectRequest("object 1", "/elsewhere.glb")])


def test_no_ledger_and_a_ledger_of_another_version(tmp_path) -> None:
    with pytest.raises(OutputError, match="holds no ledger"):
        Ledger.open(tmp_path)
    with sqlite3.connect(tmp_path / NAME) as connection:
        connection.execute("PRAGMA user_version = 99")
    connection.close()
    with pytest.raises(OutputError, match="has version 99; valid is 1"):
        Ledger.open(tmp_path)


@pytest.mark.parametrize("where", ["header", "first page", "middle", "end", "cut", "empty page"])
def test_a_damaged_ledger_is_put_aside_and_read_as_far_as_it_can_be(tmp_path, where) -> None:
    out = tmp_path / "out"
    with Ledger.open(out, create=True) as ledger, begun_run(ledger, 1) as run:
        ledger.setting("options", "{}")
        enter_objects(ledger, requests(500))
        for one in claim(ledger, run, 250):
            finish(ledger, one, DONE, most=3)
        ledger.rows("PRAGMA wal_checkpoint(TRUNCATE)")
    path = out / NAME
    data = bytearray(path.read_bytes())
    at = {"header": 0, "first page": 40, "middle": len(data) // 2, "end": len(data) - 5000, "empty page": 8192}
    if where == "cut":
        data = data[: len(data) // 2]
    else:
        data[at[where] : at[where] + 4000] = b"\x55" * 4000
    path.write_bytes(data)
    with open_ledger(out) as ledger:
        enter_objects(ledger, requests(500))
        found = counts(ledger)
        assert sum(found.values()) == 500
        assert set(found) <= {"done", "pending"}
    if where in ("middle", "end"):
        assert found["done"] > 50
    assert list(out.glob("ledger.damaged-1.sqlite")) or found == {"done": 250, "pending": 250}


def test_the_budget_holds_over_processes_and_counts_by_object(tmp_path, ledger) -> None:
    enter_objects(ledger, requests(2))
    with ExitStack() as stack:
        accounts = [LedgerAccount(stack.enter_context(Ledger.open(tmp_path / "out")), f"object {k}", f"t{k}") for k in range(2)]
        limit = Limit(cost=1.0)
        first = accounts[0].hold("marks", 0.6, limit)
        with pytest.raises(BudgetError, match=r"could exceed --max-cost 1; spent so far: 0 calls"):
            accounts[1].hold("marks", 0.6, limit)
        accounts[0].settle(first, 0.25)
        second = accounts[1].hold("marks", 0.6, limit)
        accounts[1].settle(second, None)  # not answered: not billed
        assert (accounts[1].calls, accounts[1].cost) == (1, 0.25)
        with pytest.raises(BudgetError, match="call 2 would exceed --max-calls 1"):
            accounts[1].hold("marks", 0.0, Limit(calls=1))
    assert ledger.rows("SELECT name, calls, cost FROM objects") == [("object 0", 1, 0.25), ("object 1", 0, None)]


def test_a_call_whose_process_died_counts_at_its_upper_bound(ledger) -> None:
    enter_objects(ledger, requests(1))
    with begun_run(ledger, 1) as run:
        (taken,) = claim(ledger, run, 1)
        hold = LedgerAccount(ledger, taken.name, taken.token).hold("marks", 0.6, Limit())
        finish(ledger, taken, AttemptOutcome(Result.FAILED, "CrashError"), most=3)
        assert spent(ledger) == (1, 0.6)
        LedgerAccount(ledger, taken.name, taken.token).settle(hold, 0.1)  # it was alive after all: not counted twice
        assert spent(ledger) == (1, 0.6)


def test_the_table_is_exported_whole(tmp_path, ledger) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    from anymesh.applications.annotate.annotate import export_ledger

    enter_objects(ledger, [ObjectRequest("a", "/a.glb", {"seed": 3}), *requests(4500)])
    export_ledger(ledger, tmp_path / "t.parquet")
    rows = parquet.read_table(tmp_path / "t.parquet").to_pylist()
    assert len(rows) == 4501
    assert (rows[0]["name"], json.loads(rows[0]["options"]), rows[0]["state"], rows[0]["cost"]) == (
        "a",
        {"seed": 3},
        "pending",
        None,
    )
    assert {p.name for p in tmp_path.iterdir()} == {"out", "t.parquet"}


def test_claims_carry_what_the_worker_needs(ledger) -> None:
    enter_objects(ledger, [ObjectRequest("a", "/a.glb", {"up": "z"})])
    with begun_run(ledger, 1) as run:
        (taken,) = claim(ledger, run, 5)
    assert isinstance(taken, Claim)
    assert (taken.source, taken.options, taken.redo, Path(taken.folder).parts[0]) == ("/a.glb", {"up": "z"}, False, "objects")
