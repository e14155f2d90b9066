"""`anymesh.load`: an asset that is corrected in Python, and `anymesh correct`, with the same operations."""

import json
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from correctable import write_output

import anymesh
from anymesh.cli import run
from anymesh.correcting import ChooseMotion, CorrectionError, open_asset
from anymesh.errors import OutputError
from anymesh.types import JointType


def limits(folder: Path, joint: str) -> tuple[float, float]:
    root = ET.parse(folder / "cabinet.urdf").getroot()
    limit = next(j for j in root.iter("joint") if j.get("name") == joint).find("limit")
    return float(limit.get("lower")), float(limit.get("upper"))


def told(capsys) -> dict:
    return json.loads(capsys.readouterr().out)


def test_a_joint_is_set_in_degrees_and_saved(tmp_path):
    folder = write_output(tmp_path / "out")
    asset = anymesh.load(folder, author="Ada")
    door = asset.joint("hinge")
    assert door.verdict == "check"
    assert (door.part, door.name, door.type, door.parent, door.label) == ("door", "hinge", "revolute", "base", "door")
    axis = door.axis
    door.limits = (0, 90)
    assert door.flip() is door
    assert door.verdict == "sure"
    np.testing.assert_array_equal(door.axis, -axis)
    assert door.limits == pytest.approx((0, 90))
    asset.joint("drawer").limits = "0,25cm"
    assert asset.joint("drawer").limits == (0, 0.25)
    assert "not saved" in repr(asset)
    assert [(r["part"], r["change"]) for r in asset.changes()] == [("door", "changed"), ("drawer", "changed")]
    assert limits(folder, "hinge") != (0, pytest.approx(np.pi / 2))  # nothing is written before
    assert asset.save() is asset
    assert (asset.changes(), "not saved" in repr(asset)) == ([], False)
    assert limits(folder, "hinge") == (0, pytest.approx(np.pi / 2))
    log = json.loads((folder / "corrections.json").read_text())["corrections"]
    assert [(e["correction"], e["author"]) for e in log] == [("set_limits", "Ada"), ("flip_sign", "Ada"), ("set_limits", "Ada")]


def test_everything_that_a_joint_offers(tmp_path):
    asset = anymesh.load(write_output(tmp_path / "out"))
    knob, door = asset.joint("knob"), asset.joint("door")
    knob.parent, knob.label, knob.type = "door", "button", "prismatic"
    assert (knob.parent, knob.label, knob.type) == ("door", "button", "prismatic")
    knob.press("1cm").rename("bell").confirm()
    assert (knob.part, knob.limits, knob.confidence) == ("bell", (0, 0.01), 1)
    np.testing.assert_array_equal(knob.axis, (0, 1, 0))
    door.axis, door.origin = "z", (0, 0, 0)
    np.testing.assert_allclose(door.origin[:2], 0)
    assert door.type == "revolute"
    tray = asset.new_part("base", "tray", [1])
    assert (tray.part, tray.type) == ("tray", "fixed")
    assert asset.merge("tray", "drawer").parts == ("base", "door", "drawer", "bell")
    knob.remove()
    with pytest.raises(CorrectionError, match="'bell'; the parts are base, door, drawer"):
        knob.flip()
    assert asset.undo().parts[-1] == "bell"
    assert asset.redo().parts[-1] == "drawer"
    assert len(repr(asset).splitlines()) <= 10
    assert len(repr(door).splitlines()) == 1


def test_what_is_refused_changes_nothing(tmp_path):
    asset = anymesh.load(write_output(tmp_path / "out"))
    with pytest.raises(CorrectionError, match="the parts are base, door, drawer, knob"):
        asset.joint("window")
    with pytest.raises(CorrectionError, match="root"):
        asset.joint("base")
    with pytest.raises(CorrectionError):
        asset.correct("door", flip=True, limits="1,2")  # without the rest pose: not flipped either
    assert asset.changes() == []
    with pytest.raises(OutputError):
        anymesh.load(tmp_path)


def test_the_command_corrects_saves_and_tells_what_changed(tmp_path, capsys):
    out = write_output(tmp_path / "out")
    assert run(["correct", str(out), "hinge", "--limits", "-10,90", "--flip", "--json"]) == 0
    record = told(capsys)
    assert [(r["part"], r["range"], r["change"]) for r in record["changed"]] == [("door", "-10..90 deg", "changed")]
    assert {"cabinet.urdf", "preview.png", "asset.json", "corrections.json"} <= set(record["files"])
    assert limits(out, "hinge") == (pytest.approx(np.deg2rad(-10)), pytest.approx(np.pi / 2))
    assert run(["correct", str(out), "--merge", "knob", "drawer"]) == 0
    text = capsys.readouterr().out
    assert "removed, now of drawer" in text
    assert "wrote cabinet.urdf" in text
    assert run(["correct", str(out), "--undo", "--json"]) == 0
    assert [(r["part"], r["change"]) for r in told(capsys)["changed"]] == [("drawer", "changed"), ("knob", "new")]
    assert run(["correct", str(out), "door", "--undo", "--limits", "0,45", "--json"]) == 0  # both of the first command
    assert [type(e.correction).__name__ for e in open_asset(out).history.done] == ["SetLimits"]


def test_the_command_lists_parts_motions_and_regions_and_writes_nothing(tmp_path, capsys, monkeypatch):
    free = ChooseMotion("door", JointType.REVOLUTE, (0.0, 0.0, 1.0), (0.6, 0.0, 0.3), (0.0, 1.9), 0.9, "free")
    monkeypatch.setattr("anymesh.correcting.listing.ranked_motions", lambda asset, part: (free,))
    out = write_output(tmp_path / "out")
    before = {p: p.stat().st_mtime_ns for p in out.rglob("*")}
    assert run(["correct", str(out), "--json"]) == 0
    record = told(capsys)
    assert [(r["part"], r["joint"]) for r in record["joints"]] == [("door", "hinge"), ("drawer", "slide"), ("knob", "turn")]
    assert (record["joints"][0]["verdict"], record["joints"][0]["why"]) == ("check", "low confidence (0.20)")
    assert run(["correct", str(out), "door", "--motions", "--json"]) == 0
    assert [(r["number"], r["motion"]) for r in told(capsys)["motions"]] == [(1, "hinge right, vertical")]
    assert run(["correct", str(out), "base", "--regions", "--json"]) == 0
    assert [r["kind"] for r in told(capsys)["regions"]].count("piece") == 6
    assert run(["correct", str(out), "door", "--type", "revolute"]) == 0
    assert "nothing was written" in capsys.readouterr().out
    assert {p: p.stat().st_mtime_ns for p in out.rglob("*")} == before


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["dor", "--flip"], "the parts are base, door, drawer, knob"),
        (["--flip"], "name the part"),
        (["--motions"], "name the part whose motions"),
        (["door", "--motions", "--flip"], "one at a time"),
        (["door", "--limits", "0,40cm"], "not an angle"),
        (["--undo"], "nothing to undo"),
    ],
)
def test_wrong_commands_are_refused_with_what_is_valid(tmp_path, capsys, arguments, message):
    out = write_output(tmp_path / "out")
    assert run(["correct", str(out), *arguments]) == 2
    assert message in capsys.readouterr().err
