"""When a joint is right, and when it succeeds by the rules of others."""

from dataclasses import replace

import numpy as np
import pytest

from anymesh.evaluation.score import JointScore, ObjectScore
from anymesh.evaluation.success import articulate_anything, motion_anymesh, opd, right, s2o
from anymesh.types import JointType

HINGE = JointScore("door", 0.9, JointType.REVOLUTE, JointType.REVOLUTE, 0.0, 0.0, 0.0, part_size=0.5, origin=0.0)
SLIDE = JointScore("drawer", 0.9, JointType.PRISMATIC, JointType.PRISMATIC, 0.0, part_size=0.5)
RULES = (right, articulate_anything, opd, s2o)
WORST = {right: 10.0, articulate_anything: float(np.degrees(0.25)), opd: 10.0, s2o: 5.0}  # [deg]
FAR = {right: 0.1, articulate_anything: 0.05, opd: 0.25 * 2, s2o: 0.1 * 0.5}  # the object's diagonal is 2, the part's .5
PLACE = {right: "at_part", articulate_anything: "line_distance", opd: "origin", s2o: "origin"}


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("joint", [HINGE, SLIDE], ids=["hinge", "slide"])
def test_the_axis_may_be_off_so_much(rule, joint: JointScore) -> None:
    assert rule(joint)
    assert rule(replace(joint, angle=WORST[rule] - 0.01))
    assert not rule(replace(joint, angle=WORST[rule] + 0.01))


@pytest.mark.parametrize("rule", RULES)
def test_the_place_of_a_hinge_may_be_off_so_much_and_a_slide_has_none(rule) -> None:
    assert rule(replace(HINGE, **{PLACE[rule]: FAR[rule] - 1e-4}))
    assert not rule(replace(HINGE, **{PLACE[rule]: FAR[rule] + 1e-4}))
    others = {"line_distance", "at_part", "origin"} - {PLACE[rule]}
    assert rule(replace(HINGE, **dict.fromkeys(others, 9.0)))


@pytest.mark.parametrize("rule", RULES)
def test_type_and_what_is_missing(rule) -> None:
    assert not rule(replace(HINGE, type_found=JointType.PRISMATIC, line_distance=None, at_part=None, origin=None))
    assert not rule(replace(SLIDE, type_found=JointType.REVOLUTE))
    assert not rule(replace(SLIDE, type_found=JointType.FIXED))
    assert rule(replace(HINGE, type_true=JointType.CONTINUOUS))
    assert not rule(JointScore("door", 0.4, JointType.REVOLUTE))
    assert not rule(JointScore("drawer", 0.0, JointType.PRISMATIC))


@pytest.mark.parametrize("joint", [HINGE, SLIDE], ids=["hinge", "slide"])
def test_a_joint_that_opens_to_the_wrong_side_is_not_right(joint: JointScore) -> None:
    assert not right(replace(joint, opens_right=False))
    assert right(replace(joint, opens_right=True))
    assert all(rule(replace(joint, opens_right=False)) for rule in RULES if rule is not right)


@pytest.mark.parametrize("told", [True, False, None])
def test_executability_is_told_by_the_simulator(told) -> None:
    assert motion_anymesh(ObjectScore("x", (), 0, 0, 0, executable=told)) is told
