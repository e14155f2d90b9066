"""Test that reserved kinds stay held out, and that a figure below the baseline is reported."""

import json
import sys
from pathlib import Path

import pytest

from anymesh.evaluation.evaluating import trained_objects
from anymesh.evaluation.record import Record
from anymesh.evaluation.score import ObjectScore
from benchmarks import REPORTS, held_out
from training.kinds import __main__ as command
from training.kinds import registry as kinds


def test_no_shipped_classifier_was_trained_on_a_kind_for_measuring() -> None:
    names = {name.partition("/")[2] for name in trained_objects()}
    assert len(names) > 500
    measured = kinds.RESERVED | kinds.TEST
    assert not set(measured) & set(kinds.KINDS)
    assert not [name for name in names for kind in measured if name.startswith(f"{kind}-")]


def test_kinds_for_training_are_written_by_default(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    written: list[str] = []
    monkeypatch.setattr(command, "write", lambda kind, *_: written.append(kind))
    for options, expected in (
        ([], kinds.KINDS),
        (["--test"], kinds.TEST),
        (["--reserved"], kinds.RESERVED),
    ):
        monkeypatch.setattr(sys, "argv", ["kinds.py", str(tmp_path), "--count", "1", *options])
        written.clear()
        command.main()
        assert written == list(expected)


def test_a_figure_that_gets_worse_or_is_missing_is_told() -> None:
    baseline = {"end-to-end": {"part F1": 0.7, "opens": 0.5}}
    within = {"end-to-end": {"part F1": 0.7 - held_out.TOLERANCE / 2, "opens": 0.9}}
    assert held_out.worse(within, baseline) == []
    assert held_out.worse({"end-to-end": {"part F1": 0.6, "opens": 0.5}}, baseline) == [
        "end-to-end, part F1: 0.6 (baseline 0.7)"
    ]
    assert len(held_out.worse({}, baseline)) == 2


def test_each_kind_counts_once_in_a_mean_over_kinds(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of two kinds with F1 1 and 0, the second with more objects, the mean is .5; a figure that a kind lacks is left out."""
    monkeypatch.setattr(held_out, "summarize", sum)
    monkeypatch.setattr(held_out, "FIGURES", {"part F1": float, "opens": lambda found: found or None})
    assert held_out.means_over_kinds({"parts": [("door", [1]), ("key", [0, 0, 0])]})[2:] == ["| parts | 0.50 | 1.00 |"]


def test_the_baseline_has_a_figure_of_each_kind() -> None:
    baseline = json.loads((REPORTS / "held_out.json").read_text())
    for group, measured in (("all", held_out.MEASURED), ("sample", held_out.CHECKED)):
        assert set(baseline[group]) == set(measured)
        for row in baseline[group].values():
            assert set(row) == set(held_out.FIGURES)
            assert all(0 <= value <= 1 for value in row.values())


def test_no_model_that_should_stay_without_parts_is_trained_on() -> None:
    trained = set(trained_objects())
    assert "sweethome3d/fridgeFreezer" in trained
    assert not {f"sweethome3d/{name}" for name in held_out.STILL} & trained


def test_the_page_of_models_that_do_not_move_counts_objects_and_parts() -> None:
    records = [Record(ObjectScore(f"{name}-{name}", (), count, 0, 0)) for name, count in [("bed", 0), ("bath", 4), ("lamp", 1)]]
    lines = held_out.still_page(records).splitlines()
    assert "On 1 of them no part is found; on the others 5:" in lines
    assert "bath (4), lamp." in lines
