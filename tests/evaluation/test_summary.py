"""Figures of a group: means by hand, and what is missing counts."""

from dataclasses import astuple, replace

import numpy as np
import pytest
from records import ALIKE, DOOR, DRAWER, KNOB, MISSING, record

from anymesh.evaluation.score import JointScore
from anymesh.evaluation.summary import Mean, articulate_anything, of_type, opd, right, s2o, summarize
from anymesh.types import JointType

HINGE = JointScore("door", 0.9, JointType.REVOLUTE, JointType.REVOLUTE, 0.0, 0.0, 0.0, part_size=0.5, origin=0.0)
SLIDE = JointScore("drawer", 0.9, JointType.PRISMATIC, JointType.PRISMATIC, 0.0, part_size=0.5)
RULES = (right, articulate_anything, opd, s2o)
WORST = {right: 10.0, articulate_anything: float(np.degrees(0.25)), opd: 10.0, s2o: 5.0}  # [deg]
FAR = {right: 0.1, articulate_anything: 0.05, opd: 0.25 * 2, s2o: 0.1 * 0.5}  # the object's diagonal is 2, the part's .5
PLACE = {right: "at_part", articulate_anything: "line_distance", opd: "origin", s2o: "origin"}


def test_figures_of_joints_that_were_found_are_their_means() -> None:
    s = summarize([record(DOOR, seconds=1.0), record(DRAWER, KNOB, seconds=3.0)])
    assert (s.objects, s.joints, s.errors, s.found, s.type_right) == (2, 3, 0, 1.0, 1.0)
    assert astuple(s.angle) == pytest.approx((8 / 3, 2.0, 8 / 3))
    assert astuple(s.line_distance) == pytest.approx((0.02, 0.02, 0.02))  # a slide has none, and misses none
    assert s.displacement.all == pytest.approx(0.05 / 3)
    assert s.opens_right == 0.5  # of door and drawer; a knob opens nowhere
    assert s.range_iou == pytest.approx(2.2 / 3)
    assert (s.parent_right, s.tree_right, s.part_f1, s.seconds) == (1.0, 1.0, 1.0, 2.0)
    assert s.success == {"right": pytest.approx(2 / 3), "articulate_anything": 1.0, "opd": 1.0, "s2o": 1.0}  # one opens wrongly


def test_a_missing_joint_counts_as_the_farthest_and_as_no_success() -> None:
    s = summarize([record(DOOR, MISSING)])
    assert s.angle == Mean(46.0, 46.0, 2.0)
    assert astuple(s.line_distance) == pytest.approx((0.51, 0.51, 0.02))
    assert s.at_part.all == pytest.approx(0.515)
    assert s.displacement.all == pytest.approx(0.505)
    assert (s.found, s.type_right, s.opens_right, s.range_iou, s.parent_right) == (0.5, 0.5, 0.5, 0.4, 0.5)
    assert set(s.success.values()) == {0.5}
    assert (s.part_precision, s.part_recall, s.part_f1) == (1.0, 0.5, pytest.approx(2 / 3))


def test_a_slide_taken_for_a_hinge_has_no_line_and_the_other_way_round_misses_it() -> None:
    hinge = replace(DOOR, type_found=JointType.PRISMATIC, line_distance=None, at_part=None)
    slide = replace(DRAWER, type_found=JointType.REVOLUTE)
    s = summarize([record(hinge, slide)])
    assert s.type_right == 0
    assert s.line_distance == Mean(1.0, 1.0, None)


def test_joints_of_unknown_range_are_scored_on_the_rest() -> None:
    unknown = replace(DOOR, range_known=False, opens_right=None, range_iou=None)
    s = summarize([record(unknown, MISSING)])
    assert (s.opens_right, s.range_iou) == (0.0, 0.0)  # of the missing one
    assert summarize([record(unknown)]).opens_right is None
    assert summarize([record(unknown)]).range_iou is None


def test_part_figures_are_over_all_parts_not_over_objects() -> None:
    s = summarize([record(DOOR, part_miou=1.0), record(DOOR, DRAWER, KNOB, part_miou=0.5, predicted=5)])
    assert (s.part_precision, s.part_recall) == (pytest.approx(4 / 6), 1.0)
    assert s.part_f1 == pytest.approx(8 / 10)
    assert s.part_miou == pytest.approx(2.5 / 4)


def test_an_error_is_a_failure_of_all_that_was_asked() -> None:
    right = record(DOOR, rest=ALIKE, executable=True, seconds=5.0)
    s = summarize([right, record(MISSING, error="ValueError: no", part_miou=0.0, tree_right=False)])
    assert (s.errors, s.tree_right, s.executable, s.part_miou) == (1, 0.5, 0.5, 0.45)
    assert s.rest is not None
    assert (s.rest.giou, s.rest.miou) == (pytest.approx(-0.1), pytest.approx(0.35))
    assert s.seconds == 5.0
    # an object that could not even be read has no joints to be missing, yet is none that succeeded
    unread = summarize([right, record(error="InputError: no file", part_miou=1.0)])
    assert (unread.tree_right, unread.executable) == (0.5, 0.5)


def test_nothing_to_score_is_told_as_none() -> None:
    for records in ([], [record()]):
        s = summarize(records)
        assert s.angle == s.displacement == Mean()
        assert all(v is None for v in (s.type_right, s.opens_right, s.part_f1, s.part_miou, s.executable, s.rest, s.posed))
        assert set(s.success.values()) == {None}
    assert summarize([]).tree_right is None


def test_what_was_not_tried_is_no_failure() -> None:
    assert summarize([record(DOOR), record(MISSING, error="x")]).executable is None
    assert summarize([record(DOOR, executable=True), record(DOOR)]).executable == 1.0


def test_joints_of_one_type() -> None:
    (only,) = of_type([record(DOOR, DRAWER, KNOB)], JointType.PRISMATIC)
    assert only.score.joints == (DRAWER,)


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
