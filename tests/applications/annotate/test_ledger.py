"""The ledger: registration, exclusive driver, damage, lost runs, export."""

from __future__ import annotations

import json
import re
import sqlite3
from html.parser import HTMLParser
from pathlib import Path

import pytest
from PIL import Image

from anymesh.applications.annotate.inputs import ObjectRequest
from anymesh.applications.annotate.ledger import LOSSES, NAME, SCHEMA, Ledger, driven_ledger
from anymesh.applications.annotate.report import GALLERY, write_report
from anymesh.applications.annotate.runner import LOST
from anymesh.applications.annotate.states import AttemptOutcome, Result, State
from anymesh.applications.annotate.tally import METRICS, tally, write_metrics
from anymesh.errors import InputError, OutputError

DONE = AttemptOutcome(Result.DONE, record={"confidence": 0.5, "sha256": "x"})


def requests(count: int) -> list[ObjectRequest]:
    return [ObjectRequest(f"object {k}", f"/in/{k}.glb") for k in range(count)]


def counts(ledger: Ledger) -> dict[str, int]:
    return dict(ledger.rows("SELECT state, count(*) FROM objects GROUP BY state"))


def test_an_object_is_taken_once_with_what_the_worker_needs(ledger) -> None:
    ledger.enter([ObjectRequest("a", "/a.glb", {"up": "z"}), *requests(20)])
    jobs = [job for _ in range(8) for job in ledger.take(3)]
    assert [job.seq for job in jobs] == list(range(1, 22))
    assert (jobs[0].source, jobs[0].options, jobs[0].redo, Path(jobs[0].folder).parts[0]) == (
        "/a.glb",
        {"up": "z"},
        False,
        "objects",
    )
    assert ledger.running() == jobs


def test_calls_are_counted_by_object_over_its_attempts(ledger, tmp_path) -> None:
    ledger.enter(requests(2))
    failed = AttemptOutcome(Result.FAILED, "CrashError")
    job = ledger.take(1)[0]
    ledger.finish(job, failed, most=3, spent=(1, 0.5))
    ledger.take(2)
    ledger.finish(job, DONE, most=3, spent=(3, 0.25))
    assert ledger.rows("SELECT calls, cost FROM objects") == [(4, 0.75), (0, None)]
    with Ledger.open(tmp_path / "out") as reader:
        assert reader.spent == ledger.spent == (4, 0.75)


def test_an_object_whose_runs_are_killed_again_and_again_is_quarantined(ledger) -> None:
    ledger.enter(requests(1))
    seen = [ledger.finish(ledger.take(1)[0], LOST, most=3) for _ in range(LOSSES)]
    assert seen == [State.PENDING] * (LOSSES - 1) + [State.QUARANTINED]


def test_an_output_has_one_driver_and_any_number_of_readers(tmp_path) -> None:
    out = tmp_path / "out"
    with driven_ledger(out, 2) as ledger:
        ledger.enter(requests(3))
        with pytest.raises(OutputError, match="another run works on"), driven_ledger(out, 2):
            pass
        with Ledger.open(out) as reader:
            assert counts(reader) == {"pending": 3}
    with driven_ledger(out, 2) as ledger:
        assert (ledger.run, counts(ledger)) == (2, {"pending": 3})


def test_two_objects_of_one_name_are_an_error(ledger) -> None:
    with pytest.raises(InputError, match="two objects of the name 'object 1'"):
        ledger.enter([*requests(3), ObjectRequest("object 1", "/elsewhere.glb")])


def test_a_ledger_of_the_version_before_gets_the_new_columns(tmp_path) -> None:
    with sqlite3.connect(tmp_path / NAME) as connection:
        older = SCHEMA.replace("license TEXT , author TEXT , ", "").replace("user_version = 3", "user_version = 2")
        connection.executescript(older)
    connection.close()
    with pytest.raises(OutputError, match="has version 2"):
        Ledger.open(tmp_path)
    with Ledger.open(tmp_path, create=True) as ledger:
        assert ledger.rows("SELECT license, author FROM objects") == []


def test_no_ledger_and_a_ledger_of_another_version(tmp_path) -> None:
    with pytest.raises(OutputError, match="holds no ledger"):
        Ledger.open(tmp_path)
    with sqlite3.connect(tmp_path / NAME) as connection:
        connection.execute("PRAGMA user_version = 99")
    connection.close()
    with pytest.raises(OutputError, match="has version 99; valid is 3"):
        Ledger.open(tmp_path)


@pytest.mark.parametrize("where", ["header", "middle", "cut"])
def test_a_damaged_ledger_is_one_clear_error(tmp_path, where) -> None:
    out = tmp_path / "out"
    with driven_ledger(out, 1) as ledger:
        ledger.enter(requests(500))
        ledger.rows("PRAGMA wal_checkpoint(TRUNCATE)")
    data = bytearray((out / NAME).read_bytes())
    if where == "cut":
        data = data[: len(data) // 2]
    else:
        at = 0 if where == "header" else len(data) // 2
        data[at : at + 4000] = b"\x55" * 4000
    (out / NAME).write_bytes(data)
    with pytest.raises(OutputError, match=r"is damaged.*finished assets are kept"), driven_ledger(out, 1):
        pass


def test_a_ledger_that_becomes_read_only_or_full_is_one_clear_error(ledger) -> None:
    ledger.rows("PRAGMA max_page_count = 30")  # as a disk that is full
    with pytest.raises(OutputError, match="full"):
        ledger.enter(requests(1500))
    assert ledger.rows("SELECT count(*) FROM objects") == [(0,)]
    ledger.rows("PRAGMA query_only = 1")  # as a file system that turned read-only
    with pytest.raises(OutputError, match="readonly"):
        ledger.setting("key", "value")


def test_the_table_is_exported_whole(tmp_path, ledger) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    from anymesh.applications.annotate.annotate import export_ledger

    ledger.enter([ObjectRequest("a", "/a.glb", {"seed": 3}), *requests(4500)])
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


EVIL = '"><script>alert(1)</script>\n<img src=x onerror=alert(2)>'


@pytest.fixture(scope="module")
def out(tmp_path_factory) -> Path:
    return tmp_path_factory.mktemp("report") / "out"


@pytest.fixture(scope="module")
def page(out) -> str:
    """The report of 40 objects that are done, and three that are not."""
    with driven_ledger(out, 1) as ledger:
        ledger.enter([ObjectRequest(f"{EVIL}{k:02d}", "/x.glb") for k in range(43)])
        for k, one in enumerate(ledger.take(43)):
            if k < 40:
                folder = ledger.out / one.folder
                folder.mkdir(parents=True)
                if k:
                    Image.new("RGB", (900, 300), "red").save(folder / "preview.png")
                record = {"confidence": k / 40, "joints": 2, "parts": 3, "warnings": 1, "bytes": 5}
                outcome = AttemptOutcome(Result.DONE, record=record, seconds=2.0, memory=1 << 20)
            elif k == 40:
                outcome = AttemptOutcome(Result.REFUSED, "InputError", EVIL)
            else:
                outcome = AttemptOutcome(Result.FAILED, "CrashError", "signal 11", stage="segment")
            ledger.finish(one, outcome, most=1)
        write_metrics(ledger.out, tally(ledger, finished=43, seconds=3600.0, workers=1), 1.5)
        return write_report(ledger).read_text()


class Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.tags: dict[str, int] = {}
        self.sources: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags[tag] = self.tags.get(tag, 0) + 1
        self.sources += [value or "" for name, value in attrs if name == "src" or name.startswith("on")]


def test_the_page_shows_counts_causes_and_the_least_confident(page) -> None:
    assert "<b>43</b>objects" in page
    assert '<div class="done"><b>40</b>done</div>' in page
    assert '<div class="quarantined"><b>3</b>quarantined</div>' in page
    assert re.search(r"CrashError</td><td>segment</td><td class=n>2</td>", page)
    figures = re.findall(r"confidence (0\.\d\d)", page)
    assert figures == [f"{k / 40:.2f}" for k in range(GALLERY)]
    assert "its preview cannot be read" in page


def test_what_files_say_is_only_text(page) -> None:
    reader = Reader()
    reader.feed(page)
    assert "script" not in reader.tags
    assert reader.tags["img"] == GALLERY - 1
    assert all(source.startswith("data:image/jpeg;base64,") for source in reader.sources)
    assert "default-src 'none'" in page


def test_the_metrics_are_in_prometheus_text_format(page, out) -> None:
    lines = (out / METRICS).read_text().splitlines()
    samples = [line for line in lines if not line.startswith("#")]
    assert all(re.fullmatch(r'[a-z_]+(\{state="[a-z]+"\})? -?[0-9.e+]+', line) for line in samples)
    assert 'anymesh_annotate_objects{state="done"} 40' in samples
    assert "anymesh_annotate_rate_per_hour 43" in samples
    named = {line.split()[2] for line in lines if line.startswith("# TYPE")}
    assert {re.split(r"[ {]", line)[0] for line in samples} == named
