"""A run over a collection: what becomes of each object, whatever becomes of its process, the machine, and the model."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from ledger_rows import column, states, trace

from anymesh.applications.annotate import annotate as module
from anymesh.applications.annotate import runner
from anymesh.applications.annotate.annotate import Speed, annotate, collection_status, killed_after
from anymesh.applications.annotate.workers import ObjectLimits
from anymesh.errors import InputError, OptionError, OutputError

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


def test_a_ledger_that_becomes_read_only_or_full_is_one_clear_error(tmp_path, collection) -> None:
    from anymesh.applications.annotate.entering import enter_objects
    from anymesh.applications.annotate.inputs import find_objects
    from anymesh.applications.annotate.ledger import Ledger

    source = collection(**{f"n{k}": "ok" for k in range(400)})
    with Ledger.open(tmp_path / "out", create=True) as ledger:
        ledger.rows("PRAGMA max_page_count = 30")  # as a disk that is full
        with pytest.raises(OutputError, match="full"):
            enter_objects(ledger, find_objects(str(source), without=tmp_path / "out"))
        assert ledger.rows("SELECT count(*) FROM objects") == [(0,)]
        ledger.rows("PRAGMA query_only = 1")  # as a file system that turned read-only
        with pytest.raises(OutputError, match="readonly"):
            ledger.setting("key", "value")


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
    log = (source.parent / f"stderr-{time.monotonic_ns()}").open("w")
    return subprocess.Popen([sys.executable, HERE / "fake_run.py", str(source), str(out)], stderr=log)


def wait_for(count: int, out: Path) -> None:
    end = time.monotonic() + 30
    while len(trace(out)) < count and time.monotonic() < end:
        time.sleep(0.01)
    assert len(trace(out)) >= count


@pytest.mark.parametrize("how", [signal.SIGKILL, pytest.param(signal.SIGINT, marks=pytest.mark.slow)])
def test_a_run_that_is_killed_loses_nothing_and_redoes_nothing(tmp_path, collection, how) -> None:
    source, out = collection(**{f"n{k}": f"slow 0.0{k % 7}" for k in range(30)}), tmp_path / "out"
    process = begun(source, out)
    wait_for(10, out)
    process.send_signal(how)
    process.wait(timeout=20)
    process = begun(source, out)
    assert process.wait(timeout=60) == 0
    assert set(states(out).values()) == {"done"}
    assert len(trace(out)) == len(set(trace(out))) == 30
    assert collection_status(out).counts["done"] == 30
    assert not list((out / "runs").iterdir())


def test_two_runs_on_one_output_share_the_work(tmp_path, collection) -> None:
    source, out = collection(**{f"n{k}": "slow 0.04" for k in range(40)}), tmp_path / "out"
    both = [begun(source, out), begun(source, out)]
    assert [process.wait(timeout=60) for process in both] == [0, 0]
    assert len(trace(out)) == len(set(trace(out))) == 40
    assert set(states(out).values()) == {"done"}


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
        ObjectLimits.default(2, 0.1, 10.0)
    assert ObjectLimits.default(2, 3.0, 10.0, waits=True) == ObjectLimits(3 << 30, 10.0, 100.0)


@pytest.mark.parametrize(
    ("speed", "limit", "seconds"), [(Speed(), 0.01, 60.0), (Speed(), 100.0, 400.0), (Speed(kill_after=7.0), 100.0, 7.0)]
)
def test_an_object_is_ended_long_after_its_time_limit(speed: Speed, limit: float, seconds: float) -> None:
    """Reading the file counts too, so that a short limit still leaves a minute."""
    assert killed_after(speed, {"time_limit": limit}) == seconds
