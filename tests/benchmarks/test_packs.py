"""The list of public packs, and what counts as silently wrong."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from benchmarks.packs import listed, silent, verdicts

JOINT = {"name": "door_joint", "child": "door", "confidence": 0.9, "word": "sure"}


def test_every_mesh_of_the_list_can_be_found_again_and_belongs_to_one_split() -> None:
    rows = listed()
    assert len({row["name"] for row in rows}) == len(rows) >= 40
    for row in rows:
        assert re.fullmatch("[0-9a-f]{40}", row["commit"])
        assert re.fullmatch("[0-9a-f]{64}", row["sha256"])
        assert row["moves"]
        assert re.match("CC0|CC-BY-[34]|MIT|Apache", row["licence"])
    sources = {(row["source"], row["split"]) for row in rows}
    assert len(sources) == len({source for source, _ in sources})
    assert {row["split"] for row in listed(["dev"])} == {"dev"}


@pytest.mark.parametrize(
    ("wrong", "word", "confidence", "warnings", "rules"),
    [
        ("door", "sure", 0.9, [], ["sure", "0.8", "0.5"]),
        ("door_joint", "check", 0.9, [], ["0.8", "0.5"]),
        ("door", "check", 0.6, [], ["0.5"]),
        ("door", "check", 0.9, ["joint door_joint: the range is blocked"], []),
        ("door", "check", 0.9, ["part door: low confidence (0.20)"], []),
        ("door", "sure", 0.9, ["joint door_2_joint: low confidence"], ["sure", "0.8", "0.5"]),
        ("", "sure", 0.9, [], []),
    ],
)
def test_a_wrong_joint_is_silent_without_a_warning_that_names_it(
    wrong: str, word: str, confidence: float, warnings: list[str], rules: list[str]
) -> None:
    result = {"joints": [{**JOINT, "word": word, "confidence": confidence}], "warnings": warnings}
    assert [rule for rule in ("sure", "0.8", "0.5") if silent(result, {"wrong": wrong}, rule)] == rules


def test_verdicts_by_neutral_ids_are_named_by_the_key(tmp_path: Path) -> None:
    (tmp_path / "key.csv").write_text("id,state,name\n000,after,box\n001,before,box\n")
    (tmp_path / "b.csv").write_text("id,verdict,wrong,note\n000,usable,,\n001,,,\n")
    assert list(verdicts(tmp_path / "b.csv")) == [("after", "box")]
    (tmp_path / "b.csv").write_text("id,verdict,wrong,note\n000,good,,\n")
    with pytest.raises(SystemExit, match="verdicts are usable, nearly, wrong, nothing; found good"):
        verdicts(tmp_path / "b.csv")
