"""Test that each joint that is not right has the first cause that applies."""

import pytest

from anymesh.evaluation.record import Record
from anymesh.evaluation.score import JointScore, ObjectScore
from anymesh.types import JointType
from training.error_sources import CAUSES, cause, causes_table


def joint(**changes) -> JointScore:
    """Return the score of a hinge that is right in all respects, with changes."""
    right = {"type_found": JointType.REVOLUTE, "angle": 1.0, "at_part": 0.01, "opens_right": True, "range_iou": 0.9}
    return JointScore("door", 0.9, JointType.REVOLUTE, **(right | changes))


RIGHT, MISSED, TURNED, FAR = joint(), JointScore("door", 0.2, JointType.REVOLUTE), joint(angle=6.0), joint(at_part=0.09)
SLIDES = joint(type_found=JointType.PRISMATIC, at_part=None)


@pytest.mark.parametrize(
    ("found", "given", "proposed", "expected"),
    [
        (RIGHT, RIGHT, (True, True), "right"),
        (RIGHT, TURNED, (True, True), "right"),
        (joint(opens_right=None, range_iou=None), RIGHT, (True, True), "right"),
        (MISSED, RIGHT, (False, True), "part not proposed"),
        (MISSED, RIGHT, (True, True), "part not chosen"),
        (TURNED, FAR, (True, False), "motion not proposed"),
        (FAR, SLIDES, (True, True), "motion not chosen"),
        (SLIDES, RIGHT, (True, True), "wrong part context"),
        (joint(opens_right=False), RIGHT, (True, True), "wrong side or limits"),
        (joint(range_iou=0.4), RIGHT, (True, True), "wrong side or limits"),
    ],
)
def test_the_first_cause_counts(found: JointScore, given: JointScore, proposed: tuple[bool, bool], expected: str) -> None:
    assert cause(found, given, proposed) == expected


def test_a_slide_has_no_distance() -> None:
    slide = JointScore("drawer", 0.9, JointType.PRISMATIC, JointType.PRISMATIC, angle=2.0, opens_right=True, range_iou=0.8)
    assert cause(slide, slide, (True, True)) == "right"


def test_shares_of_a_group_add_up_to_one() -> None:
    def record(*joints: JointScore) -> Record:
        return Record(ObjectScore("cabinet", joints, 2, 2, 1))

    one = (record(RIGHT, MISSED), record(RIGHT, RIGHT), {"door": (True, True)})
    head, _, row = causes_table([("cabinets", [one, one])])
    cells = [cell.strip() for cell in row.strip("|").split("|")]
    shares = dict(zip([cell.strip() for cell in head.strip("|").split("|")][2:], map(float, cells[2:]), strict=True))
    assert cells[:2] == ["cabinets", "4"]
    assert tuple(shares) == CAUSES
    assert shares == dict.fromkeys(CAUSES, 0.0) | {"right": 0.5, "part not chosen": 0.5}
