"""The interaction protocol: a scripted gripper moves joints, or the report says why not."""

import json

import pytest

from anymesh.applications.policy.controller_ import InteractionFailure, move_joint
from anymesh.applications.policy.interaction_ import evaluate_interaction, summary
from anymesh.applications.policy.objects_ import object_at_rest
from anymesh.cli import run
from anymesh.errors import OptionError

KNOB = """
<mujoco model="{name}">
  <worldbody>
    <body name="base">
      <geom type="box" size="0.1 0.1 0.1" pos="0 0.1 0.1" mass="2"/>
      <body name="knob" pos="0 -0.02 0.1">
        <joint name="knob_joint" type="slide" axis="0 -1 0" range="0 0.05" frictionloss="0.5"/>
        <geom type="box" size="{half} 0.02 {half}" mass="0.1"/>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


def test_a_drawer_is_pulled_by_its_handle_and_a_flush_front_is_not(objects, tmp_path):
    done = move_joint(object_at_rest(objects / "drawer.xml", "tray_joint"), tries=3)
    assert done.failure is None
    assert done.share > 0.9
    path = tmp_path / "flush.xml"
    path.write_text(KNOB.format(name="flush", half=0.1))
    flush = move_joint(object_at_rest(path, "knob_joint"), tries=2)
    assert flush.failure is InteractionFailure.NO_PLACE
    assert flush.share == flush.tries == 0


def test_a_folder_is_reported_per_joint_and_resumed(tmp_path, monkeypatch):
    for name, half in (("flush", 0.1), ("knob", 0.01)):
        (tmp_path / "set" / name).mkdir(parents=True)
        (tmp_path / "set" / name / f"{name}.xml").write_text(KNOB.format(name=name, half=half))
        (tmp_path / "set" / name / "asset.json").write_text("{}")
    rows = evaluate_interaction(tmp_path / "set", tmp_path / "out", tries=2)
    assert [(r.asset, r.success) for r in rows] == [("flush", False), ("knob", True)]
    assert summary(rows)["slide"]["interaction"] == 0.5
    report = (tmp_path / "out" / "report.md").read_text()
    assert "| slide | 2 | 0.500 |" in report
    assert InteractionFailure.NO_PLACE in report
    monkeypatch.setattr("anymesh.applications.policy.interaction_.move_joint", None)  # nothing is evaluated again
    assert evaluate_interaction(tmp_path / "set", tmp_path / "out", tries=2) == rows
    with pytest.raises(OptionError, match="valid are flush, knob"):
        evaluate_interaction(tmp_path / "set", tmp_path / "other", only=("missing",))


def test_assets_of_one_name_are_all_evaluated(tmp_path):
    for folder in ("first", "second"):
        place = tmp_path / "set" / folder / "knob"
        place.mkdir(parents=True)
        (place / "knob.xml").write_text(KNOB.format(name="knob", half=0.1))
        (place / "asset.json").write_text("{}")
    rows = evaluate_interaction(tmp_path / "set", tmp_path / "out", tries=1)
    assert [r.asset for r in rows] == ["knob", "knob_2"]


def test_an_asset_that_cannot_be_read_is_a_row(tmp_path):
    (tmp_path / "broken.xml").write_text("<mujoco><worldbody><body><geom type='ball'/></body></worldbody></mujoco>")
    (row,) = evaluate_interaction(tmp_path / "broken.xml", tmp_path / "out")
    assert not row.success
    assert not row.executable
    assert "cannot load" in row.reason


def test_the_command_prints_shares(objects, tmp_path, capsys):
    code = run(["eval", str(objects / "drawer.xml"), "--protocol", "interaction", "-o", str(tmp_path / "out"), "--json"])
    assert code == 0
    told = json.loads(capsys.readouterr().out)
    assert told["results"]["all"]["joints"] == 1
    assert told["joints"][0]["success"] is True
