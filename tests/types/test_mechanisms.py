"""Followers go where their leaders lead, screws rise as they turn, and what cannot be is refused."""

from dataclasses import replace

import numpy as np
import pytest
from assets import joint
from mechanical import UP, doors, gears, jar, linkage, pot, stick
from scipy.spatial.transform import Rotation

from anymesh.geometry.kinematics import joint_motion, joint_transform, link_transforms
from anymesh.types import JointType, Loop, Mimic, StatedJoint
from anymesh.types.motion import extent, leaders, led, with_implied_limits

DOORS = doors()
HINGE, RIGHT, FIRST, SECOND, THIRD = DOORS.joints
SCREW, BALL = jar().joints[0], stick().joints[0]


def test_a_chain_is_multiplied_out():
    found = leaders(DOORS.joints)
    assert found == {"twin": Mimic("hinge", -1.0), "second": Mimic("first", 0.5), "third": Mimic("first", 1.0)}
    offset = replace(THIRD, mimic=Mimic("second", 2.0, 0.1)), replace(SECOND, mimic=Mimic("first", 0.5, 0.3)), FIRST
    assert leaders(offset)["third"] == Mimic("first", 1.0, 0.7)


def test_followers_move_with_their_leader_whatever_is_given_for_them():
    at = led(DOORS.joints, {"hinge": 0.4, "twin": 9.0, "first": 0.1})
    assert at == {"hinge": 0.4, "twin": -0.4, "first": 0.1, "second": 0.05, "third": 0.1}
    T = link_transforms(DOORS, {"first": 0.1})
    np.testing.assert_allclose(T["inner"][:3, 3], (0, -0.25, 0), atol=1e-12)
    np.testing.assert_allclose(T["left"], np.eye(4))


def test_limits_of_followers_follow():
    wider = with_implied_limits([replace(j, limits=(0.0, 0.3)) if j.name == "first" else j for j in DOORS.joints])
    assert [j.limits for j in wider[3:]] == [(0.0, 0.15), (0.0, 0.3)]
    endless = with_implied_limits([replace(HINGE, type=JointType.CONTINUOUS, limits=None), RIGHT])
    assert (endless[1].type, endless[1].limits) == (JointType.CONTINUOUS, None)
    assert with_implied_limits(gears().joints) == gears().joints or gears().joints[1].limits is None
    with pytest.raises(ValueError, match=r"'twin' follows .*limits \(-1\.5, .*found revolute with \(-1\.0, 0\.0\)"):
        replace(DOORS, joints=(HINGE, replace(RIGHT, limits=(-1.0, 0.0)), *DOORS.joints[2:]))


def test_a_screw_rises_as_it_turns_and_in_any_frame():
    T = joint_transform(SCREW, np.pi)
    np.testing.assert_allclose(T[:3, :3], np.diag([-1, -1, 1]), atol=1e-12)
    np.testing.assert_allclose(T[:3, 3], (0.2, 0.2, 0.01), atol=1e-12)
    assert extent(SCREW) == "0..688 deg, 20.0 mm a turn"
    stated = StatedJoint(JointType.SCREW, SCREW.origin, UP, SCREW.limits, pitch=0.02, name="lid")
    S = np.diag([-2.0, 2, 2, 1])  # mirrored and twice as large
    moved = stated.transformed(S)
    np.testing.assert_allclose(moved.opening_motion.transform(1.1) @ S, S @ stated.opening_motion.transform(1.1), atol=1e-12)


def test_a_ball_swings_across_its_arm_within_its_cone():
    motion = joint_motion(BALL)
    assert abs(motion.axis @ UP) < 1e-12
    assert BALL.span == (-0.5, 0.5)
    assert Rotation.from_matrix(motion.transform(0.5)[:3, :3]).magnitude() == pytest.approx(0.5)
    assert pot().joints[0].span == (0.0, 0.0)
    assert extent(pot().joints[0]) == ""


LOOP = linkage().loops[0]
WRONG = {
    "own leader": (lambda: replace(RIGHT, mimic=Mimic("twin")), "cannot follow 'twin'"),
    "no ratio": (lambda: replace(RIGHT, mimic=Mimic("hinge", 0.0)), "ratio is not 0"),
    "infinite offset": (lambda: replace(RIGHT, mimic=Mimic("hinge", 1.0, np.inf)), "finite"),
    "a fixed follower": (lambda: replace(RIGHT, type=JointType.FIXED, limits=None), "of type fixed"),
    "no leader": (lambda: leaders([RIGHT]), "'twin' cannot follow 'hinge', which is no joint"),
    "a circle": (lambda: leaders([replace(HINGE, mimic=Mimic("twin")), RIGHT]), "which is led by it"),
    "led by a ball": (lambda: leaders([replace(BALL, name="hinge"), RIGHT]), "no joint of the types revolute, continuous"),
    "a hinge with a pitch": (lambda: replace(HINGE, pitch=0.1), "found 0.1"),
    "a screw without": (lambda: replace(SCREW, pitch=0.0), "a screw has a pitch"),
    "an infinite pitch": (lambda: replace(SCREW, pitch=np.inf), "inf"),
    "a ball with two ends": (lambda: replace(BALL, limits=(-0.5, 0.5)), "half the angle of its cone"),
    "a ball that opens too far": (lambda: replace(BALL, limits=(0.0, 4.0)), "half the angle"),
    "a free part with limits": (lambda: joint("a", "free", "b", "c", (0, 0, 0), UP, (0.0, 1.0)), "do not match type free"),
    "a loop that screws": (lambda: replace(LOOP, kind=JointType.SCREW), "found kind screw; valid are revolute, ball"),
    "a loop without axis": (lambda: replace(LOOP, axis=np.zeros(3)), "axis is unit"),
    "a loop of one link": (lambda: replace(LOOP, second="coupler"), "'coupler' twice"),
    "a loop of others": (lambda: replace(linkage(), loops=(replace(LOOP, second="roof"),)), "'roof'; parts are"),
    "a loop of a joint's name": (
        lambda: replace(linkage(), loops=(replace(LOOP, name="crank_joint"),)),
        "names must be unique",
    ),
}


@pytest.mark.parametrize(("make", "message"), WRONG.values(), ids=WRONG)
def test_what_cannot_be_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_a_loop_is_printed_in_one_line():
    assert repr(Loop("pin", "a", "b", np.zeros(3), UP)).startswith("Loop(name='pin', first='a', second='b', origin=(0, 0, 0)")
