"""A run over a collection: what becomes of each object, whatever becomes of its process, the machine, and the model."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from itertools import pairwise
from pathlib import Path

import pytest
from ledger_rows import column, states, trace

import anymesh
from anymesh.applications.annotate import annotate as module
from anymesh.applications.annotate import runner
from anymesh.applications.annotate.annotate import Speed, annotate, collection_status, killed_after, worker_rate
from anymesh.applications.annotate.inputs import find_objects
from anymesh.applications.annotate.ledger import driven_ledger
from anymesh.applications.annotate.states import AttemptOutcome, Result
from anymesh.applications.annotate.work import ObjectAccount
from anymesh.applications.annotate.workers import object_limits
from anymesh.errors import InputError, OptionError, OutputError
from anymesh.pipeline.options import Limit

HERE = Path(__file__).parent


def test_each_object_ends_in_a_folder_or_in_quarantine_with_the_reason(tmp_path, collection, workers) -> None:
    source = collection(
        good="ok", bad="bad", crash="crash", once="once 1", hang="hang", eat="eat", defect="defect", late="ok 2"
    )
    out = tmp_path / "out"
    found = annotate(str(source), out, work=workers(3), speed=Speed(attempts=2))
    assert states(out) == {
        "good": "done", "late": "done", "once": "done",
        "bad": "quarantined", "crash": "quarantined", "hang": "quarantined", "eat": "quarantined", "defect": "quarantined",
    }  # fmt: skip
    kinds = {n: (column(out, n, "error_class"), column(out, n, "attempts")) for n in ("bad", "crash", "hang", "eat", "defect")}
    assert kinds == {
        "bad": ("InputError", 1), "crash": ("CrashError", 2), "hang": ("TimeLimitError", 2), "eat": ("MemoryLimitError", 2),
        "defect": ("ZeroDivisionError", 2),
    }  # fmt: skip
    assert column(out, "bad", "error") == "the mesh has no extent"
    assert "signal 11" in str(column(out, "crash", "error"))
    assert "sk-" not in str(column(out, "defect", "error"))
    assert column(out, "once", "attempts") == 2
    assert column(out, "good", "memory") > 10 << 20
    assert found.found.counts["quarantined"] == 5
    assert len(trace(out)) == len(set(trace(out))) == 3


def test_a_second_run_does_nothing_that_is_done_and_what_has_changed(tmp_path, collection, workers) -> None:
    source, out = collection(a="ok", b="ok b", c="bad"), tmp_path / "out"
    annotate(str(source), out, work=workers())
    collection(b="ok changed", d="ok new")
    annotate(str(source), out, work=workers())
    finished = [name.partition("-")[0] for name in trace(out)]
    assert sorted(finished) == ["a", "b", "b", "d"]
    collection(c="ok repaired")
    annotate(str(source), out, work=workers())
    assert set(states(out).values()) == {"done"}
    assert len(trace(out)) == 5


def test_options_of_an_output_stay_but_those_of_an_object_may_change(tmp_path, collection, workers) -> None:
    out, table = tmp_path / "out", tmp_path / "list.csv"
    collection(a="ok")
    table.write_text("path,seed\nin/a.glb,1\n")
    annotate(str(table), out, work=workers(), up="z")
    with pytest.raises(OptionError, match="begun with up 'z', now 'y'"):
        annotate(str(table), out, work=workers(), up="y")
    table.write_text("path,seed\nin/a.glb,2\n")
    annotate(str(table), out, work=workers(), up="z")
    assert len(trace(out)) == 2


def test_the_output_is_no_input(tmp_path, collection, workers) -> None:
    collection(a="ok")
    out = tmp_path / "in" / "out"
    annotate(str(tmp_path / "in"), out, work=workers())
    (out / "stray.glb").write_text("ok")
    annotate(str(tmp_path / "in"), out, work=workers())
    assert len(states(out)) == 1
    with pytest.raises(InputError, match="holds no object"):
        annotate(str(out), out, work=workers())


def test_a_full_disk_ends_the_run_and_counts_against_no_object(tmp_path, collection, workers) -> None:
    source, out = collection(a="full", b="ok", c="ok c"), tmp_path / "out"
    found = annotate(str(source), out, work=workers(1))
    assert found.ended is not None
    assert (found.ended.result, found.ended.exit_code) == ("storage", 4)
    assert (column(out, "a", "state"), column(out, "a", "attempts")) == ("pending", 0)
    collection(a="ok freed")
    annotate(str(source), out, work=workers(1))
    assert set(states(out).values()) == {"done"}


def test_nothing_is_begun_where_little_is_free(tmp_path, collection, workers, monkeypatch) -> None:
    monkeypatch.setattr(runner.shutil, "disk_usage", lambda _: type("Usage", (), {"free": 1000})())
    found = annotate(str(collection(a="ok")), tmp_path / "out", work=workers())
    assert "are free" in found.ended.error
    assert states(tmp_path / "out") == {"a": "pending"}


def test_an_output_that_cannot_be_written_is_one_clear_error(tmp_path, collection, workers) -> None:
    (tmp_path / "out").write_text("a file")
    with pytest.raises(OutputError, match="cannot write"):
        annotate(str(collection(a="ok")), tmp_path / "out", work=workers())


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_read_only_output_is_one_clear_error(tmp_path, collection, workers) -> None:
    source, out = collection(a="ok"), tmp_path / "out"
    annotate(str(source), out, work=workers())
    (out / "ledger.sqlite").chmod(0o444)
    out.chmod(0o555)
    try:
        with pytest.raises(OutputError, match="cannot write"):
            annotate(str(source), out, work=workers())
    finally:
        out.chmod(0o755)


def test_a_model_that_is_down_is_waited_for_and_counts_against_no_object(tmp_path, collection, workers, monkeypatch) -> None:
    source, out = collection(a="down", b="down b", c="down c"), tmp_path / "out"
    monkeypatch.setattr(module, "Outage", lambda patience: real(patience, first=0.1))
    real = runner.Outage
    notes = []

    def on_tally(tally) -> None:
        notes.append(tally.note)
        if "cannot be reached" in tally.note:
            (out / "up").touch()

    monkeypatch.setattr(runner, "TICK", 0.3)
    found = annotate(str(source), out, work=workers(), speed=Speed(patience=60.0), on_tally=on_tally)
    assert found.ended is None
    assert set(states(out).values()) == {"done"}
    assert {column(out, n, "attempts") for n in "abc"} == {1}
    assert any("cannot be reached" in note for note in notes)


def test_a_model_that_stays_down_ends_the_run(tmp_path, collection, workers, monkeypatch) -> None:
    real = runner.Outage
    monkeypatch.setattr(module, "Outage", lambda patience: real(patience, first=0.1))
    found = annotate(str(collection(a="down")), tmp_path / "out", work=workers(), speed=Speed(patience=0.5))
    assert (found.ended.exit_code, found.ended.error_class) == (6, "UnavailableError")
    assert states(tmp_path / "out") == {"a": "pending"}


def test_a_key_that_is_refused_ends_the_run(tmp_path, collection, workers) -> None:
    source = collection(**{f"n{k}": "refused" for k in range(30)})
    found = annotate(str(source), tmp_path / "out", work=workers(1))
    assert "HTTP 401" in found.ended.error
    assert found.found.counts["pending"] == 30


def test_open_questions_wait_for_the_next_run(tmp_path, collection, workers) -> None:
    source, out = collection(a="open", b="ok"), tmp_path / "out"
    found = annotate(str(source), out, work=workers())
    assert found.found.counts["waiting"] == 1
    (out / "answered").touch()
    annotate(str(source), out, work=workers())
    assert set(states(out).values()) == {"done"}


def test_quarantined_objects_get_another_chance_when_asked(tmp_path, collection, workers) -> None:
    source, out = collection(a="crash"), tmp_path / "out"
    annotate(str(source), out, work=workers(1), speed=Speed(attempts=1))
    collection()
    annotate(str(source), out, work=workers(1), speed=Speed(attempts=1))
    assert column(out, "a", "(SELECT count(*) FROM attempts)") == 1
    annotate(str(source), out, work=workers(1), speed=Speed(attempts=1), again=True)
    assert column(out, "a", "(SELECT count(*) FROM attempts)") == 2


def begun(source: Path, out: Path) -> subprocess.Popen:
    command = [sys.executable, HERE / "fake_run.py", str(source), str(out)]
    return subprocess.Popen(command, stderr=subprocess.PIPE, text=True)


def wait_for(count: int, out: Path) -> None:
    end = time.monotonic() + 60
    while len(trace(out)) < count and time.monotonic() < end:
        time.sleep(0.01)
    assert len(trace(out)) >= count


def test_runs_that_are_killed_lose_nothing_and_redo_nothing(tmp_path, collection) -> None:
    source, out = collection(**{f"n{k}": f"slow 0.0{k % 7}" for k in range(30)}), tmp_path / "out"
    for count, how in ((5, signal.SIGKILL), (12, signal.SIGINT), (18, signal.SIGKILL)):
        process = begun(source, out)
        wait_for(count, out)
        process.send_signal(how)
        process.communicate(timeout=60)
    process = begun(source, out)
    assert process.communicate(timeout=60) == (None, "")
    assert process.returncode == 0
    assert set(states(out).values()) == {"done"}
    assert len(trace(out)) == len(set(trace(out))) == 30
    assert collection_status(out).counts["done"] == 30


def test_a_second_run_on_one_output_is_refused_and_harms_nothing(tmp_path, collection, workers) -> None:
    source, out = collection(**{f"n{k}": "slow 0.1" for k in range(20)}), tmp_path / "out"
    first = begun(source, out)
    wait_for(1, out)
    with pytest.raises(OutputError, match="another run works on"):
        annotate(str(source), out, work=workers())
    first.communicate(timeout=60)
    assert first.returncode == 0
    assert set(states(out).values()) == {"done"}
    assert len(trace(out)) == len(set(trace(out))) == 20


def test_the_budget_holds_over_the_collection_and_its_runs(tmp_path, collection, workers, metered) -> None:
    source, out = collection(**{f"n{k}": "pay" for k in range(12)}), tmp_path / "out"
    found = annotate(str(source), out, work=workers(1), max_cost=0.95)
    assert (found.ended.exit_code, found.found.calls, found.found.cost) == (7, 5, pytest.approx(0.5))  # .5 fits up to .45
    assert "could exceed --max-cost 0.95; spent so far: 5 calls, 0.5000 USD" in found.ended.error
    assert found.found.counts["done"] == 5
    found = annotate(str(source), out, work=workers(2), max_calls=8)
    assert found.ended.exit_code == 7
    assert 8 <= found.found.calls <= 9  # two objects in progress
    assert not list(out.glob("objects/*/*.json"))


def test_a_call_whose_process_dies_counts_at_its_upper_bound(tmp_path, collection, workers, metered) -> None:
    out = tmp_path / "out"
    found = annotate(str(collection(a="pay lost", b="pay")), out, work=workers(1), speed=Speed(attempts=2))
    assert (column(out, "a", "calls"), column(out, "a", "cost")) == (2, 1.0)
    assert (found.found.calls, found.found.cost) == (3, pytest.approx(1.1))


def test_calls_of_a_run_that_was_killed_are_counted_by_the_next(tmp_path, collection, workers, metered) -> None:
    source, out = collection(a="ok"), tmp_path / "out"
    with driven_ledger(out, 1) as ledger:
        ledger.enter(find_objects(str(source), without=out))
        (job,) = ledger.take(1)
        job.spending.parent.mkdir(parents=True)
        ObjectAccount((0, 0.0), job.spending).hold("marks", 0.5, Limit())
    found = annotate(str(source), out, work=workers(1))
    assert (found.found.counts["done"], found.found.calls, found.found.cost) == (1, 1, 0.5)
    assert column(out, "a", "losses") == 1


def test_rates_are_shared_equally_by_the_workers(tmp_path, collection, workers) -> None:
    with pytest.raises(OptionError, match="--requests-per-minute: found 1; valid are integers from 2 up"):
        annotate(str(collection(a="ok")), tmp_path / "out", work=workers(2), speed=Speed(requests=1))
    assert worker_rate(Speed(requests=9, tokens=1000), 4) == (2, 250)


def test_an_asset_whose_run_ended_before_the_ledger_knew_is_taken_as_it_is(tmp_path, collection, workers) -> None:
    import sqlite3

    source, out = collection(a="ok"), tmp_path / "out"
    annotate(str(source), out, work=workers())
    with sqlite3.connect(out / "ledger.sqlite") as connection:
        connection.execute("UPDATE objects SET state = 'pending', finished = NULL, confidence = NULL")
    connection.close()
    annotate(str(source), out, work=workers())
    assert states(out) == {"a": "done"}
    assert column(out, "a", "confidence") is not None
    assert len(trace(out)) == 1


def test_limits_are_checked() -> None:
    with pytest.raises(OptionError, match="--memory"):
        object_limits(2, 0.1, 10.0)
    limits = object_limits(2, 3.0, 10.0, waits=True)
    assert (limits.memory, limits.seconds, limits.wall) == (3 << 30, 10.0, 100.0)


@pytest.mark.parametrize(
    ("speed", "limit", "seconds"), [(Speed(), 0.01, 60.0), (Speed(), 100.0, 400.0), (Speed(kill_after=7.0), 100.0, 7.0)]
)
def test_an_object_is_ended_long_after_its_time_limit(speed: Speed, limit: float, seconds: float) -> None:
    """Reading the file counts too, so that a short limit still leaves a minute."""
    assert killed_after(speed, {"time_limit": limit}) == seconds


def test_an_outage_is_tried_less_and_less_and_ends_with_the_first_answer() -> None:
    now, tries = 1000.0, []
    outage, failed = runner.Outage(600.0, clock=lambda: now, first=5.0), AttemptOutcome(Result.OUTAGE)
    assert outage.allowed(4, 0) == 4
    for _ in range(5):
        outage.failed(failed)
        outage.failed(failed)  # of another worker, at once
        while not outage.allowed(4, 0):
            now += 1
        tries.append(now)
        assert outage.allowed(4, 1) == 0
    assert [b - a for a, b in pairwise([1000.0, *tries])] == [5, 10, 20, 40, 80]
    assert not outage.is_over
    now += 600
    assert outage.is_over
    outage.reached()
    assert outage.allowed(4, 0) == 4
    assert not outage.is_over


def test_tasks_of_a_cluster_find_this_package() -> None:
    """The folder that holds it, not one within it, whose modules would hide the standard library's."""
    from anymesh.applications.annotate.ray_ import _environment

    assert _environment()["env_vars"]["PYTHONPATH"].split(os.pathsep)[0] == str(Path(anymesh.__file__).parents[1])
