"""A plan is free of collisions, keeps the gripper on the part along its arc, within limits, the same for the same seed."""

import math
from itertools import pairwise

import numpy as np
import pytest

from anymesh.applications.plan.approach_ import STRIDE, free_path, straight_is_free
from anymesh.applications.plan.planner import plan, plan_motion
from anymesh.applications.plan.plans import BasePose, GripperContact, Phase, PlanError, parse_value
from anymesh.applications.plan.scene_ import CollisionWorld, tool_pose
from anymesh.errors import OptionError

LOW, HIGH = np.full(2, -1.0), np.full(2, 1.0)
START, GOAL = np.array([-0.8, 0.0]), np.array([0.8, 0.0])


def rows_of(found, *phases: Phase) -> np.ndarray:
    return np.flatnonzero([p in phases for p in found.trajectory.phase])


def test_the_phases_follow_one_another(door_plan):
    kinds = list(dict.fromkeys(door_plan.trajectory.phase))
    assert kinds[:6] == [Phase.APPROACH, Phase.REACH, Phase.CLOSE, Phase.MOVE, Phase.HOLD, Phase.OPEN]
    assert door_plan.trajectory.value[0] == 0
    assert door_plan.trajectory.value[-1] == pytest.approx(0.7)
    assert np.allclose(np.diff(door_plan.trajectory.time), 0.01)


def test_the_tool_stays_on_the_part_along_its_arc(door_plan, cupboard, arm):
    rest = tool_pose(door_plan.target, arm.hand, 0.0)
    moving = rows_of(door_plan, Phase.MOVE)
    for row in moving[::10]:
        T = door_plan.base.transform @ arm.kinematics.forward(door_plan.trajectory.position[row])
        meant = cupboard.motion.transform(float(door_plan.trajectory.value[row])) @ rest
        np.testing.assert_allclose(T[:3, 3], meant[:3, 3], atol=2e-4)  # between postures the curve is a spline
        np.testing.assert_allclose(T[:3, :3], meant[:3, :3], atol=2e-3)


def test_every_sample_is_within_the_limits(door_plan, arm):
    t, robot = door_plan.trajectory, arm.robot
    assert (np.abs(t.velocity) <= 0.3 * robot.velocity + 1e-9).all()
    assert (np.abs(t.acceleration) <= 0.3 * robot.acceleration + 1e-9).all()
    assert ((t.position >= robot.limits[:, 0]) & (t.position <= robot.limits[:, 1])).all()
    steps = np.diff(t.position, axis=0) / 0.01
    assert (np.abs(steps) <= 0.3 * robot.velocity + 1e-6).all()  # also between samples, across the phases


def test_the_approach_is_free_on_a_finer_grid(door_plan, cupboard, arm):
    world = CollisionWorld(cupboard, arm.robot, arm.hand, door_plan.base, clearance=0.0)
    rows = rows_of(door_plan, Phase.APPROACH)
    path = door_plan.trajectory.position[rows]
    for share in (0.0, 0.33, 0.67):
        between = path[:-1] + share * np.diff(path, axis=0)
        for posture in between[::3]:
            assert world.touching(posture, float(door_plan.trajectory.gap[0]), 0.0) is None


def test_the_world_sees_a_collision(door_plan, cupboard, arm):
    """The test above can fail: the same postures collide where the robot stands in the object."""
    world = CollisionWorld(cupboard, arm.robot, arm.hand, BasePose(0.0, -0.3, 0.0, 1.57))
    path = door_plan.trajectory.position[rows_of(door_plan, Phase.APPROACH)]
    assert any(world.touching(posture, 0.05, 0.0) for posture in path[::20])


def test_the_same_seed_gives_the_same_plan(door_plan, cupboard, arm):
    again = plan_motion(cupboard, arm, 0.7)
    assert again.base == door_plan.base
    np.testing.assert_array_equal(again.trajectory.position, door_plan.trajectory.position)


def test_a_button_is_pushed(things, arm):
    from anymesh.applications.plan.asset_ import open_object

    found = plan_motion(open_object(things / "panel.xml", "button_joint"), arm, -0.01)
    assert found.target.contact is GripperContact.PUSH
    assert not found.trajectory.gap.any()
    tool = [found.base.transform @ arm.kinematics.forward(q) for q in found.trajectory.position[rows_of(found, Phase.MOVE)]]
    way = tool[-1][:3, 3] - tool[0][:3, 3]
    assert way[1] == pytest.approx(0.01 + 0.003 + 0.004, abs=4e-3)  # the way, from before the face to beyond its goal


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"joint": "lid"}, r"--joint: found 'lid'; valid are door_joint"),
        ({"to": 2.5}, r"door_joint moves from 0.0 deg to 103.1 deg, found 143.2 deg; the nearest value is 103.1 deg"),
        ({"to": float("nan")}, "a finite number is needed"),
        ({"to": 0.0}, "is at 0 at rest already"),
        ({"robot": "pandda"}, "found the robot 'pandda'"),
        ({"base": "1,2"}, r"--base: found '1,2'; valid are auto or X,Y,Z,YAW"),
        ({"contact": "kick"}, "--contact: found 'kick'; valid are auto, grasp, push"),
        ({"speed": 0.0}, "--speed: found 0.0; valid is a share above 0 up to 1"),
    ],
)
def test_what_cannot_be_is_told(things, arm, change, told):
    options = {"robot": "ur5e", "joint": "door_joint", "to": 0.5} | change
    with pytest.raises(OptionError, match=told):
        plan(things / "cupboard.xml", **options)


def test_out_of_range_names_the_nearest_value(cupboard):
    with pytest.raises(PlanError) as told:
        cupboard.check_value(2.5)
    assert told.value.nearest == pytest.approx(1.8)


def test_a_base_in_the_object_or_too_far_is_told_with_one_that_works(cupboard, arm):
    with pytest.raises(
        PlanError, match=r"cannot be brought to 40.1 deg from the base 0.000,2.500.*out of reach.*feasible base is"
    ):
        plan_motion(cupboard, arm, 0.7, base=BasePose(0.0, 2.5, 0.0, -1.57))
    with pytest.raises(PlanError, match="the robot collides there"):
        plan_motion(cupboard, arm, 0.7, base=BasePose(0.0, -0.1, 0.0, 1.57))


@pytest.mark.parametrize(
    ("text", "value"), [("60deg", math.pi / 3), ("-10 mm", -0.01), ("0.5", 0.5), ("1e-2m", 0.01), ("2cm", 0.02), (".5rad", 0.5)]
)
def test_a_value_with_its_unit(text, value):
    assert parse_value(text) == pytest.approx(value)


@pytest.mark.parametrize("text", ["", "far", "10 feet", "1,5", "--"])
def test_what_is_no_value(text):
    with pytest.raises(OptionError, match="valid is a number, in radians or metres or followed by one of rad, m, deg, mm, cm"):
        parse_value(text)


def test_a_base_is_written_as_it_is_read():
    base = BasePose.parse("0.1,-0.7,0,90")
    assert str(base) == "0.100,-0.700,0.000,90.0"
    assert base.transform[:3, 0] == pytest.approx([0, 1, 0], abs=1e-12)


def wall_with_a_gap(posture: np.ndarray) -> bool:
    return abs(posture[0]) > 0.1 or posture[1] > 0.6


def test_a_free_line_is_taken():
    np.testing.assert_array_equal(free_path(START, GOAL, LOW, HIGH, lambda _: True, seed=0), [START, GOAL])


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_the_way_round_is_free_on_a_finer_grid_and_repeatable(seed):
    first, second = (free_path(START, GOAL, LOW, HIGH, wall_with_a_gap, seed=seed) for _ in range(2))
    np.testing.assert_array_equal(first, second)
    np.testing.assert_array_equal(first[[0, -1]], [START, GOAL])
    assert ((first >= LOW) & (first <= HIGH)).all()
    for a, b in pairwise(first):
        fine = a + np.linspace(0, 1, 500)[:, None] * (b - a)
        inside = 1 - np.mean([wall_with_a_gap(p) for p in fine])
        assert inside * np.linalg.norm(b - a) < STRIDE  # a corner may be cut by less than what is between two checks


def test_different_seeds_go_different_ways():
    paths = [free_path(START, GOAL, LOW, HIGH, wall_with_a_gap, seed=seed) for seed in range(3)]
    assert any(a.shape != b.shape or (a != b).any() for a in paths for b in paths)


def test_no_way_is_none():
    assert free_path(START, GOAL, LOW, HIGH, lambda p: abs(p[0]) > 0.1, seed=0, checks=2000) is None


def test_a_line_through_something_is_not_free():
    assert not straight_is_free(START, GOAL, wall_with_a_gap)
    assert straight_is_free(START, START + 0.1, wall_with_a_gap)
