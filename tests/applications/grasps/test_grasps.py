"""Grasps are what moved the joint in the simulation; what cannot be held is pushed, hooked, or has none."""

import json

import numpy as np
import pytest

from anymesh.applications.grasps import GraspKind, rank_grasps, read_grasps
from anymesh.applications.grasps.candidates import PER_REGION, candidates
from anymesh.applications.plan.plans import GripperContact
from anymesh.applications.policy.objects_ import object_at_rest
from anymesh.applications.policy.robots_ import Gripper
from anymesh.cli import run
from anymesh.errors import InputError, OptionError

CASE = """
<mujoco model="case">
  <compiler angle="radian"/>
  <worldbody>
    <body name="base">
      <geom type="box" size="0.2 0.01 0.1" pos="0 0.3 0.1" mass="2"/>
      {more}
    </body>
  </worldbody>
</mujoco>
"""
TRAY = """
<body name="tray" pos="0 {y} 0.15">
  <joint name="tray_joint" type="slide" axis="0 -1 0" range="0 0.2" damping="2" frictionloss="1"/>
  <geom type="box" size="0.19 0.008 0.05" mass="1"/>
  <geom type="box" size="0.06 0.008 0.008" pos="0 -0.05 0" mass="0.05"/>
  <geom type="box" size="0.008 0.02 0.008" pos="0.05 -0.026 0" mass="0.02"/>
  <geom type="box" size="0.008 0.02 0.008" pos="-0.05 -0.026 0" mass="0.02"/>
</body>
"""
FRONT = """
<geom type="box" size="0.05 0.02 0.15" pos="-0.251 0.28 0.15" mass="1"/>
<geom type="box" size="0.05 0.02 0.15" pos="0.251 0.28 0.15" mass="1"/>
<geom type="box" size="0.2 0.02 0.04" pos="0 0.28 0.241" mass="1"/>
<body name="front" pos="0 0.28 0.1">
  <joint name="front_joint" type="slide" axis="0 -1 0" range="0 0.2"/>
  <geom type="box" size="0.2 0.01 0.1" mass="1"/>
</body>
"""
BUTTON = """
<body name="button" pos="0 0.28 0.1">
  <joint name="button_joint" type="slide" axis="0 1 0" range="0 0.01" stiffness="50"/>
  <geom type="box" size="0.1 0.01 0.08" mass="0.05"/>
</body>
"""
PANE = """
<geom type="box" size="0.05 0.03 0.1" pos="-0.16 0.26 0.1" mass="1"/>
<geom type="box" size="0.3 0.1 0.05" pos="0 0.26 0.26" mass="1"/>
<body name="pane" pos="0 0.28 0.1">
  <joint name="pane_joint" type="slide" axis="1 0 0" range="0 0.1" frictionloss="1"/>
  <geom type="box" size="0.1 0.01 0.1" mass="1"/>
  <geom type="box" size="0.01 0.02 0.1" pos="0.09 -0.03 0" mass="0.1"/>
  <geom type="box" size="0.07 0.02 0.1" pos="-0.02 -0.03 0" mass="0.1"/>
</body>
"""
DOOR = """
<geom type="box" size="0.22 0.01 0.15" pos="0 0.3 0.15" mass="1"/>
<geom type="box" size="0.22 0.2 0.01" pos="0 0.1 0.01" mass="1"/>
<geom type="box" size="0.01 0.2 0.15" pos="-0.21 0.1 0.15" mass="1"/>
<geom type="box" size="0.01 0.2 0.15" pos="0.21 0.1 0.15" mass="1"/>
<geom type="box" size="0.22 0.2 0.01" pos="0 0.1 0.31" mass="1"/>
<body name="door" pos="-0.22 -0.12 0.15">
  <joint name="door_joint" type="hinge" axis="0 0 -1" range="0 1.9" damping="0.1" frictionloss="0.2"/>
  <geom type="box" size="0.22 0.01 0.14" pos="0.22 0 0" mass="1"/>
  <geom type="box" size="0.008 0.02 0.06" pos="0.4 -0.03 0" mass="0.1"/>
</body>
"""


@pytest.fixture(autouse=True)
def few(monkeypatch):
    """One grasp that does it is enough, in two trials."""
    for name, value in (("GOOD", 1), ("TRIALS", 2)):
        monkeypatch.setattr(f"anymesh.applications.grasps.ranking_.{name}", value)


def case(tmp_path, more):
    path = tmp_path / "case.xml"
    path.write_text(CASE.format(more=more))
    return path


def test_a_drawer_is_pulled_by_its_handle_and_the_file_says_how(tmp_path, capsys):
    path = case(tmp_path, TRAY.format(y=0))
    assert run(["grasps", str(path), "--json", "--seed", "3"]) == 0
    told = json.loads(capsys.readouterr().out)
    written = (tmp_path / "case_grasps.json").read_bytes()
    assert (tmp_path / "case_grasps.png").is_file()
    assert told == {"out": str(tmp_path / "case_grasps.json"), **json.loads(written)}
    gripper, (found,) = read_grasps(tmp_path / "case_grasps.json")
    assert gripper == Gripper()
    assert (found.joint, found.link, found.goal, found.after, found.reason) == ("tray_joint", "tray", 0.2, (), "")
    best = found.grasps[0]
    assert best.prehensile
    assert best.score > 0.9
    assert best.reached > 0.18
    assert np.allclose(best.T_link_tool[:3, 3], (0, -0.05, 0), atol=0.06)  # in the frame of the tray
    assert run(["grasps", str(path), "-q", "--seed", "3"]) == 0
    assert (tmp_path / "case_grasps.json").read_bytes() == written


def test_a_flush_front_has_none_a_button_is_pushed_and_a_pane_hooked(tmp_path):
    (front,) = rank_grasps(case(tmp_path, FRONT))
    assert (front.grasps, front.reason) == ((), "no place where the gripper fits")
    (button,) = rank_grasps(case(tmp_path, BUTTON))
    assert button.grasps[0].kind is GraspKind.PUSH
    assert not button.grasps[0].prehensile
    (pane,) = rank_grasps(case(tmp_path, PANE), gripper=Gripper(stroke=0.015))  # its ledge is too thick to be held
    assert pane.grasps[0].kind is GraspKind.HOOK


def test_candidates_that_do_not_fit_do_not_count(tmp_path):
    object_ = object_at_rest(case(tmp_path, TRAY.format(y=0)), "tray_joint")
    refused = iter(range(2 * PER_REGION))
    found = list(candidates(object_, Gripper(), None, GripperContact.GRASP, seed=0, fits=lambda _: next(refused, None) is None))
    assert len(found) > PER_REGION / 2


def test_what_hides_a_part_is_opened_first(tmp_path):
    _, tray = rank_grasps(case(tmp_path, DOOR + TRAY.format(y=0)))
    assert tray.grasps[0].score > 0.9
    assert [name for name, _ in tray.after] == ["door_joint"]


def test_an_asset_states_its_joints_and_those_that_are_not_tried(tmp_path):
    case(tmp_path, BUTTON.replace("button_joint", "unstated"))
    joints = [{"name": "knee", "type": "ball", "child": "shin"}, {"name": "still", "type": "fixed", "child": "foot"}]
    (tmp_path / "asset.json").write_text(json.dumps({"joints": joints}))
    (knee,) = rank_grasps(tmp_path)
    assert (knee.joint, knee.link, knee.grasps, knee.reason) == (
        "knee",
        "shin",
        (),
        "only hinges and slides are tried, found ball",
    )


def test_errors_say_what_is_valid(tmp_path):
    with pytest.raises(OptionError, match="valid are tray_joint"):
        rank_grasps(case(tmp_path, TRAY.format(y=0)), "tray")
    with pytest.raises(OptionError, match="LENGTH,WIDTH,THICKNESS"):
        Gripper.parse(0.08, "7cm", 30.0)
    with pytest.raises(OptionError, match="stroke"):
        Gripper(stroke=-1.0)
    (tmp_path / "grasps.json").write_text('{"version": 2}')
    with pytest.raises(InputError, match="version 2, valid is 1"):
        read_grasps(tmp_path / "grasps.json")
