"""The interaction protocol: a scripted gripper moves joints, or the report says why not."""

import json
import math
from dataclasses import replace

import pytest

from anymesh.applications.policy.controller_ import InteractionFailure, move_joint
from anymesh.applications.policy.interaction_ import evaluate_interaction, summary
from anymesh.applications.policy.objects_ import object_at_rest
from anymesh.applications.policy.tasks import (
    AJAR,
    NO_RANDOMIZATION,
    NOMINAL,
    JointGoal,
    PolicyTask,
    Randomization,
    Situation,
    joint_goal,
    reward,
    success,
)
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


OPEN, LIFT = PolicyTask.OPEN, PolicyTask.LIFT
AWAY = Situation(0.15, 0, False, 0.0, 0.0, 0.0, 0.0, 5, 70)


def test_nearer_is_better_until_a_finger_touches():
    assert reward(OPEN, AWAY) == pytest.approx(-0.15)
    assert reward(OPEN, replace(AWAY, distance=0.1)) > reward(OPEN, AWAY)
    assert reward(OPEN, replace(AWAY, distance=3.0)) == pytest.approx(-0.5)
    assert (
        reward(OPEN, replace(AWAY, fingers=2))
        > reward(OPEN, replace(AWAY, fingers=1))
        > reward(OPEN, replace(AWAY, distance=0.0))
    )


def test_progress_pays_only_in_contact_and_regress_always_costs():
    assert reward(OPEN, replace(AWAY, progress=0.5)) == reward(OPEN, AWAY)
    held = replace(AWAY, fingers=2)
    assert reward(OPEN, replace(held, progress=0.5)) == pytest.approx(reward(OPEN, held) + 0.5)
    assert reward(OPEN, replace(AWAY, progress=-0.5)) == pytest.approx(reward(OPEN, AWAY) - 0.25)


def test_the_lid_is_open_at_its_goal_in_contact_and_an_early_end_pays_more():
    done = replace(AWAY, fingers=2, progress=0.96)
    assert success(OPEN, done)
    assert not success(OPEN, replace(done, progress=0.94))
    assert not success(OPEN, replace(done, fingers=1))
    assert not success(OPEN, replace(done, distance=0.3))
    assert reward(OPEN, done) - reward(OPEN, replace(done, step=6)) == pytest.approx(1.2 * 0.96)


def test_the_bucket_is_lifted_by_its_raised_handle():
    held = replace(AWAY, fingers=2, progress=0.8, rise=0.26)
    assert success(LIFT, held)
    assert not success(LIFT, replace(held, rise=0.24))
    assert not success(LIFT, replace(held, progress=0.6))
    assert success(LIFT, replace(held, fingers=0))  # DexArt asks for no contact here
    low, high = (reward(LIFT, replace(held, rise=rise)) for rise in (0.05, 0.2))
    assert high > low


def test_a_collision_and_effort_cost():
    assert reward(OPEN, replace(AWAY, collides=True)) == pytest.approx(reward(OPEN, AWAY) - 0.1)
    assert reward(OPEN, replace(AWAY, effort=1.0)) < reward(OPEN, AWAY)


def test_open_ends_at_90_degrees_or_at_the_limit():
    assert joint_goal(OPEN, (-2.0, 1.0), slides=False) == JointGoal(-2.0 + AJAR, -2.0 + math.pi / 2)
    assert joint_goal(OPEN, (0.0, 1.0), slides=False).goal == pytest.approx(1.0)
    assert joint_goal(OPEN, (0.0, 0.2), slides=True).goal == pytest.approx(0.2)
    assert joint_goal(PolicyTask.CLOSE, (0.0, 0.2), slides=True) == JointGoal(0.2, 0.0)
    assert joint_goal(OPEN, (0.0, 1.0), slides=False, opening=0.5).goal == pytest.approx(0.5)


@pytest.mark.parametrize(("limits", "opening"), [((0.0, 0.0), None), ((0.0, 1.0), 1.5), ((0.0, 1.0), -0.1)])
def test_an_opening_out_of_range_is_refused(limits, opening):
    with pytest.raises(OptionError):
        joint_goal(OPEN, limits, False, opening)


def test_progress_counts_from_start_to_goal_in_both_directions():
    assert JointGoal(1.0, 0.0).progress(0.25) == pytest.approx(0.75)
    assert JointGoal(0.0, 2.0).progress(-1.0) == pytest.approx(-0.5)


def test_the_randomization_is_that_of_its_seed_and_within_its_ranges():
    import numpy as np

    ranges = Randomization()
    draws = [ranges.draw(np.random.default_rng(k)) for k in range(200)]
    assert draws[3] == ranges.draw(np.random.default_rng(3)) != draws[4]
    assert max(abs(d.x) for d in draws) <= ranges.position < 1.05 * max(abs(d.x) for d in draws)
    assert all(ranges.friction[0] <= d.friction <= ranges.friction[1] for d in draws)
    assert all(1 / ranges.mass <= d.mass <= ranges.mass for d in draws)
    assert min(d.mass for d in draws) < 0.8 < 1.25 < max(d.mass for d in draws)
    assert NO_RANDOMIZATION.draw(np.random.default_rng(0)) == NOMINAL


@pytest.mark.parametrize("wrong", [{"position": -1.0}, {"mass": 0.5}, {"friction": (2.0, 1.0)}, {"yaw": float("nan")}])
def test_a_randomization_out_of_range_is_refused(wrong):
    with pytest.raises(OptionError):
        Randomization(**wrong)
