"""When a joint succeeds by the rules of others."""

from dataclasses import replace

import numpy as np
import pytest

from anymesh.evaluation.score import JointScore, ObjectScore
from anymesh.evaluation.success import articulate_anything, motion_anymesh, opd, s2o
from anymesh.types import JointType

HINGE = JointScore("door", 0.9, JointType.REVOLUTE, JointType.REVOLUTE, 0.0, 0.0, 0.0, part_size=0.5, origin=0.0)
SLIDE = JointScore("drawer", 0.9, JointType.PRISMATIC, JointType.PRISMATIC, 0.0, part_size=0.5)
RULES = (articulate_anything, opd, s2o)
WORST = {articulate_anything: float(np.degrees(0.25)), opd: 10.0, s2o: 5.0}  # [deg]
FAR = {articulate_anything: 0.05, opd: 0.25 * 2, s2o: 0.1 * 0.5}  # the object's diagonal is 2, the part's .5
PLACE = {articulate_anything: "line_distance", opd: "origin", s2o: "origin"}


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
    other = {"line_distance": "origin", "origin": "line_distance"}[PLACE[rule]]
    assert rule(replace(HINGE, **{other: 9.0}))


@pytest.mark.parametrize("rule", RULES)
def test_type_and_what_is_missing(rule) -> None:
    assert not rule(replace(HINGE, type_found=JointType.PRISMATIC, line_distance=None, origin=None))
    assert not rule(replace(SLIDE, type_found=JointType.REVOLUTE))
    assert not rule(replace(SLIDE, type_found=JointType.FIXED))
    assert rule(replace(HINGE, type_true=JointType.CONTINUOUS))
    assert not rule(JointScore("door", 0.4, JointType.REVOLUTE))
    assert not rule(JointScore("drawer", 0.0, JointType.PRISMATIC))


@pytest.mark.parametrize("told", [True, False, None])
def test_executability_is_told_by_the_simulator(told) -> None:
    assert motion_anymesh(ObjectScore("x", (), 0, 0, 0, executable=told)) is told
