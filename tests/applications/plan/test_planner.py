"""A plan is free of collisions, keeps the gripper on the part along its arc, within limits, the same for the same seed."""

import numpy as np
import pytest

from anymesh.applications.plan.planner import plan, plan_motion
from anymesh.applications.plan.plans import BasePose, GripperContact, Phase, PlanError
from anymesh.applications.plan.scene_ import CollisionWorld, tool_pose
from anymesh.errors import OptionError


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
