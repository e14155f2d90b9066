"""What is printed about an asset: fits the terminal, one row per joint, colours only on a terminal, the verdict last."""

import io
import re
import time
from contextlib import redirect_stdout
from dataclasses import replace
from pathlib import Path

import pytest
from assets import cabinet
from called import called

from anymesh.cli.output import MAX_WIDTH, Shown, echo, print_joints, print_result, table, unsure_hint
from anymesh.pipeline.results import summary

COLOR = re.compile(r"\x1b\[[\d;]*m")


class Terminal(io.StringIO):
    """A stream that says that it is a terminal."""

    def isatty(self) -> bool:
        return True


@pytest.fixture
def shown(monkeypatch):
    """Return a function that gives the lines that a call prints to a terminal of 60 columns."""
    monkeypatch.setenv("COLUMNS", "60")
    monkeypatch.delenv("NO_COLOR", raising=False)

    def lines(call, *arguments) -> list[str]:
        with redirect_stdout(Terminal()) as stream:
            call(*arguments)
        return stream.getvalue().splitlines()

    return lines


def unsure_cabinet():
    asset = cabinet()
    first, *others = asset.joints
    return replace(asset, joints=(replace(first, confidence=0.6), *(replace(j, confidence=0.95) for j in others)))


def test_one_row_per_joint_in_the_width_of_the_terminal(shown, monkeypatch) -> None:
    asset, record = unsure_cabinet(), {}
    head, *rows = shown(print_joints, asset, record, False, False)
    assert head.split() == ["part", "motion", "range", "verdict"]
    assert [row.split()[0] for row in rows] == [j.child for j in asset.joints]
    assert COLOR.findall(rows[0]) == ["\x1b[33m", "\x1b[0m"]
    assert max(len(COLOR.sub("", row)) for row in rows) <= 60
    assert record["summary"] == summary(asset.segmentation, asset.joints, asset.warnings)
    assert [j["verdict"] for j in record["joints"]][:2] == ["check", "sure"]
    assert "anymesh view out" in unsure_hint(asset, Path("out"))
    assert unsure_hint(replace(asset, joints=tuple(replace(j, confidence=0.95) for j in asset.joints)), Path("out")) == ""
    monkeypatch.setenv("NO_COLOR", "1")
    lines = shown(print_joints, asset, {}, False, True)
    assert not any(map(COLOR.search, lines))
    assert len(lines) > len(rows) + 1  # the reasons
    assert max(map(len, lines)) <= 60


def test_long_lines_are_wrapped_on_a_terminal_only(shown) -> None:
    long = "warning: " + "word " * 30
    rows = [{"mesh": "m" * 90, "note": "note " * 20}]
    assert max(map(len, shown(echo, long))) <= 60
    assert max(map(len, shown(print_result, {}, rows, ("mesh", "note"), False, False))) <= 60


def test_nothing_is_cut_in_a_file(capsys) -> None:
    echo("word " * 60)
    assert capsys.readouterr().out.count("\n") == 1
    rows = [{"mesh": "m" * 90, "note": "note " * 20}]
    assert table(rows, ("mesh", "note"))[1] == f"{'m' * 90}  {('note ' * 20).strip()}"
    assert MAX_WIDTH == 100


def test_progress_names_the_step_and_estimates_from_shares_or_from_the_items_so_far() -> None:
    run = Shown(hidden=True, whole=True)
    begin = time.monotonic()
    assert re.fullmatch(r"reading the mesh: a.glb, \d s", run.line("load", "a.glb", 0, 1, begin))
    assert "left" not in run.line("segment", "candidate 1", 0, 20, begin + 1)
    assert run.line("export", "files", 0, 2, begin + 27) == "writing the asset: files (1/2), 27 s, about 25 s left"
    items = Shown(hidden=True)
    items.line("eval", "a", 0, 100, begin)
    assert items.line("eval", "b", 20, 100, begin + 60).endswith("evaluating: b (21/100), 60 s, about 4 min left")
    many = Shown(hidden=True)
    many.line("batch", "a", 0, 2, begin)
    many.line("batch", "b", 1, 2, begin + 40)
    assert many.line("joints", "door", 0, 3, begin + 41) == "b (2 of 2), finding the joints, 41 s, about 40 s left"


def test_the_help_is_in_groups_and_fits(capfd, monkeypatch) -> None:
    monkeypatch.setenv("COLUMNS", "100")
    code, out, _ = called(capfd, "articulate", "--help")
    places = [out.index(f" {group} ─") for group in ("Input", "Parts", "Output", "With a model", "Advanced")]
    assert (code, places) == (0, sorted(places))
    assert max(map(len, out.splitlines())) <= 100
