"""Reports say which of their objects the shipped classifiers were trained on."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from anymesh.evaluation.evaluating import trained_note, trained_objects, trained_on

REPORTS = sorted((Path(__file__).parents[2] / "benchmarks" / "reports").glob("*-*.md"))
ROW = re.compile(r"^\| ([a-z ]+) \| (.*) \|$", re.M)


def test_objects_are_found_by_source_and_name_and_those_of_folders_by_name() -> None:
    assert "examples/cabinet" in trained_objects()
    assert trained_on("examples", ["cabinet", "no such object"]) == 1
    assert trained_on("metaworld", ["cabinet"]) == 0
    assert trained_on("urdf", ["cabinet", "no such object"]) == 1


def test_a_report_says_that_its_objects_are_not_held_out() -> None:
    assert trained_note("examples", ["cabinet", "other"]).startswith("1 of 2 objects")
    assert trained_note("examples", ["other"]) == "other objects of this set: figures are not held out"
    assert trained_note("urdf", ["no such object"]) == "none of these objects"


@pytest.mark.parametrize("path", [p for p in REPORTS if "| trained on |" in p.read_text()], ids=lambda p: p.stem)
def test_committed_reports_agree_with_the_manifests(path: Path) -> None:
    settings = dict(ROW.findall(path.read_text().split("## ")[1]))
    source = settings["dataset"].partition(":")[0]
    known = {name.partition("/")[0] for name in trained_objects()}
    assert (source in known) == ("not held out" in settings["trained on"])
