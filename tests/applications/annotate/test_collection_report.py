"""The report: counts, causes, and pictures of the least confident; what files say is only ever text in it."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path

import pytest
from PIL import Image

from anymesh.applications.annotate.inputs import ObjectRequest
from anymesh.applications.annotate.ledger import driven_ledger
from anymesh.applications.annotate.report import GALLERY, write_report
from anymesh.applications.annotate.states import AttemptOutcome, Result
from anymesh.applications.annotate.tally import METRICS, tally, write_metrics

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
