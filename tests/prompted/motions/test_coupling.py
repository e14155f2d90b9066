"""Parts that are answered to move together."""

import numpy as np
import pytest
from asked import PICTURE, TURNS, part, parts

from anymesh.prompted.motions.cases import MAX_PART_PICTURES
from anymesh.prompted.motions.coupling import coupled, with_leading_parts
from anymesh.prompted.questions.asking import BadAnswerError
from anymesh.prompted.questions.prompting import MotionPick, MotionTable, WhichMotions
from anymesh.types import Joint, JointType, Mimic

QUESTION = WhichMotions((PICTURE,) * 2, (MotionTable(part(), TURNS, (1.0, 1.0)),) * 2, ask_with=True)
SHAPES = {1: (1, 2), 2: (1, 2), 3: (3,), 4: (4,)}


def joint(name: str, kind: JointType = JointType.REVOLUTE, upper: float = 1.5) -> Joint:
    limits = (0.0, upper) if kind in (JointType.REVOLUTE, JointType.PRISMATIC) else None
    return Joint(f"{name}_joint", kind, "base", name, np.zeros(3), np.array([0.0, 0, 1]), limits, 0.9, "built so")


def joined(joints: list[Joint], leads: dict[int, int]) -> tuple[dict[str, Joint], tuple[str, ...]]:
    made, warnings = coupled({k: SHAPES[k] for k in range(1, len(joints) + 1)}, joints, leads)
    return {j.child: j for j in made}, warnings


def test_the_answer_names_the_part_that_each_moves_with() -> None:
    answer = parts({"part": 1, "motion": 1, "with": 0}, {"part": 2, "motion": 2, "with": 1})
    assert QUESTION.parse(answer) == (MotionPick(0), MotionPick(1, leader=0))
    assert "with" in QUESTION.schema()["properties"]["parts"]["items"]["required"]
    with pytest.raises(BadAnswerError, match=r"with of part 2 must be of 0\.\.2, found 3"):
        QUESTION.parse(parts({"part": 1, "motion": 1, "with": 0}, {"part": 2, "motion": 2, "with": 3}))


def test_rows_of_each_call_become_numbers_of_parts() -> None:
    picks = {10 + k: MotionPick(0) for k in range(MAX_PART_PICTURES + 2)}
    last = 10 + MAX_PART_PICTURES + 1
    named = with_leading_parts(picks | {11: MotionPick(0, leader=0), last: MotionPick(0, leader=0)})
    assert (named[11].leader, named[last].leader, named[10].leader) == (10, last - 1, None)


def test_a_part_that_leads_itself_leads_the_others_of_its_shape() -> None:
    made, warnings = joined([joint("left"), joint("right"), joint("drawer")], {1: 1})
    assert made["right"].mimic == Mimic("left_joint", 1.0)
    assert made["left"].mimic is None
    assert made["drawer"].mimic is None
    assert "moves together with left" in made["right"].reason
    assert not warnings


def test_the_ratio_is_that_of_the_ranges_and_the_first_of_two_that_lead_each_other_leads() -> None:
    made, warnings = joined([joint("a"), joint("b"), joint("rack", JointType.PRISMATIC, 0.3), joint("lever")], {3: 4, 4: 3})
    assert made["rack"].mimic == Mimic("lever_joint", 0.3 / 1.5)
    assert made["lever"].mimic is None
    assert not warnings


def test_a_part_without_an_end_or_without_a_motion_is_a_warning() -> None:
    still, wheel = joint("still", JointType.FIXED), joint("wheel", JointType.CONTINUOUS)
    made, warnings = joined([joint("a"), joint("b"), wheel, still], {3: 1, 4: 1})
    assert made["wheel"].mimic == Mimic("a_joint", 1.0)
    assert made["wheel"].limits == (0, 1.5)
    assert made["still"].mimic is None
    assert [w.split(":")[0] for w in warnings] == ["joint wheel_joint", "joint still_joint"]
    assert "still does not move" in warnings[1]
