"""Test the reference answerer on each kind of question: marks, points, arrows and motions."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from asked import X, Y, Z, part
from scripted import ScriptedModel

from anymesh.prompted.answerers.reference import Reference, ReferenceAnswerer
from anymesh.prompted.answerers.vlm_answerer import VlmAnswerer
from anymesh.prompted.questions.grounding import MarkedPart, MarksAnswer, WhichMarks, WhichViews
from anymesh.prompted.questions.prompting import (
    ArrowTable,
    JointAppearance,
    KindAnswer,
    MotionPick,
    MotionTable,
    PartShown,
    PointTable,
    WhichArrows,
    WhichKinds,
    WhichMotions,
    WhichPoints,
)
from anymesh.prompted.questions.recognition import Recognize
from anymesh.prompted.questions.saved_question import answer_object
from anymesh.types import JointType, KnownJoint, Motion
from anymesh.types.motion import RecognizedLabel
from anymesh.types.questions import Question, VisualAnswerer

HINGE = KnownJoint(JointType.REVOLUTE, np.zeros(3), Z, (0.0, 1.5))
SLIDE = KnownJoint(JointType.PRISMATIC, np.zeros(3), -2 * Y, (0.0, 0.3))
SPIN = KnownJoint(JointType.CONTINUOUS, np.array([0.2, 0, 0.2]), Y, None)
FIXED = KnownJoint(JointType.FIXED, np.zeros(3), np.zeros(3), None)
# Ten faces per part: the base, two doors, a drawer, a knob on the panel of the second door, that panel.
LABELS = ("base", "door", "door", "drawer", "knob", "panel")
KNOWN = Reference(
    "cabinet",
    2.0,
    np.repeat(np.arange(6), 10),
    np.ones(60),
    LABELS,
    (0, 0, 0, 0, 5, 2),
    (None, HINGE, HINGE, SLIDE, SPIN, FIXED),
)
BASE, DOOR, OTHER, DRAWER, KNOB, PANEL = (10 * k for k in range(6))  # the first face of each


def ask(question: Question[Any], known: Reference = KNOWN) -> Any:
    """Return the answer, after checking that its JSON form parses to the same."""
    reference = ReferenceAnswerer("oracle", lambda: known)
    answer = reference.ask(question)
    reader = VlmAnswerer(ScriptedModel([answer_object(question, answer)]), reference)
    assert reader.ask(question) == answer
    assert reader.warnings == ()
    return answer


def pixels(*runs: tuple[int, int]) -> np.ndarray:
    """Return a picture of 20 x 20 that shows each face for a number of pixels, and nothing elsewhere."""
    row = np.concatenate([np.full(count, face) for face, count in runs])
    return np.concatenate([row, np.full(400 - len(row), -1)]).reshape(20, 20)


def shown(first: int, label: str = "part", **changes: Any) -> PartShown:
    return part(label, range(first, first + 10), **changes)


def test_it_is_made_when_it_is_first_asked() -> None:
    made = []
    answerer = ReferenceAnswerer("oracle", lambda: made.append(1) or KNOWN)
    assert isinstance(answerer, VisualAnswerer)
    assert made == []
    for _ in range(2):
        answerer.ask(Recognize(()))
    assert made == [1]


def test_it_names_each_kind_of_part_that_moves_once() -> None:
    found = ask(Recognize(()))
    assert (found.category, found.size) == ("cabinet", 2.0)
    assert found.labels == (
        RecognizedLabel("door", JointType.REVOLUTE, "base", (0.0, 1.5)),
        RecognizedLabel("drawer", JointType.PRISMATIC, "base", (0.0, 0.3)),
        RecognizedLabel("knob", JointType.CONTINUOUS, "door", None),  # the panel between does not move
    )


def test_parts_of_one_label_that_move_differently_are_told_apart() -> None:
    found = ask(Recognize(()), replace(KNOWN, labels=("base", "door", "door", "door", "part", "panel")))
    assert [r.label for r in found.labels] == ["hinged door", "sliding door", "spinning part"]


def test_limits_go_with_the_way_that_opens() -> None:
    turned = KnownJoint(JointType.REVOLUTE, np.zeros(3), Z, (-1.5, 0.1))
    found = ask(Recognize(()), replace(KNOWN, joints=(None, turned, *KNOWN.joints[2:])))
    assert found.labels[0].limits == (-0.1, 1.5)
    assert turned.opening_motion.axis == pytest.approx(-Z)


def test_a_label_is_in_the_views_that_show_enough_of_one_such_part() -> None:
    little = pixels((BASE, 100), (DOOR, 25), (OTHER, 25), (DRAWER, 40))  # the doors: 25 pixels each
    much = pixels((OTHER, 50), (KNOB, 39))
    found = ask(WhichViews((), ("door", "drawer", "knob"), (little, much)))
    assert found == {"door": (1,), "drawer": (0,), "knob": ()}


REGION = pixels((1, 100), (2, 50), (3, 50), (4, 30), (5, 30))
FACE = pixels((DOOR, 100), (OTHER, 26), (BASE, 24), (DOOR, 25), (KNOB, 25), (DRAWER, 30), (KNOB, 30))


def marks(consistent: bool, labels=("door", "drawer")) -> tuple[MarkedPart, ...]:
    mirrored = np.where(REGION >= 0, 6 - REGION, -1)  # numbered backwards in a second view if marks are not consistent
    return ask(WhichMarks((), labels, consistent, (REGION, REGION if consistent else mirrored), (FACE, FACE))).parts


def test_a_mark_belongs_to_the_part_that_has_most_of_it() -> None:
    assert marks(True) == (
        MarkedPart("door", 1, None, (1,)),
        MarkedPart("door", 2, None, (2,)),  # 26 of 50 pixels; mark 3 is half a door and belongs to none
        MarkedPart("drawer", 1, None, (4,)),  # knobs were not asked for
    )


def test_a_mark_of_two_parts_is_to_be_split_where_it_can_be() -> None:
    face = pixels((DOOR, 100), (DOOR, 10), (BASE, 140))
    region = pixels((1, 100), (2, 150))
    for splittable, split in ((False, ()), (True, ())):
        question = WhichMarks((), ("door",), True, (region,), (face,), None, (), splittable)
        # ten pixels are below the threshold
        assert ask(question) == MarksAnswer((MarkedPart("door", 1, None, (1,)),), split=split)
    question = WhichMarks((), ("door",), True, (region,), (pixels((DOOR, 160), (BASE, 90)),), None, (), True)
    assert ask(question) == MarksAnswer((MarkedPart("door", 1, None, (1,)),), split=(2,))


def test_marks_are_told_by_view_where_each_has_its_own() -> None:
    assert [(p.label, p.instance, p.view, p.marks) for p in marks(False)] == [
        ("door", 1, 0, (1,)), ("door", 1, 1, (5,)), ("door", 2, 0, (2,)), ("door", 2, 1, (4,)),
        ("drawer", 1, 0, (4,)), ("drawer", 1, 1, (2,)),
    ]  # fmt: skip


EDGE = np.linspace(0, 1, 9)[:, None] * Z
KINDS = {
    "points all along the hinge": (DOOR, {"contact": EDGE}, KindAnswer(JointAppearance.HINGE_ALONG)),
    "one end of the hinge": (DOOR, {"contact": EDGE[:2], "normal": Z}, KindAnswer(JointAppearance.HINGE_INTO)),
    "contact elsewhere": (DOOR, {"contact": EDGE + X}, KindAnswer(JointAppearance.HINGE_HIDDEN)),
    "endless": (KNOB, {"contact": EDGE + X, "normal": Y}, KindAnswer(JointAppearance.HINGE_INTO, True)),
    "out": (DRAWER, {}, KindAnswer(JointAppearance.SLIDE_OUT)),
    "along": (DRAWER, {"outward": Z}, KindAnswer(JointAppearance.SLIDE_ALONG)),
    "fixed": (PANEL, {}, KindAnswer(JointAppearance.FIXED)),
    "base": (BASE, {}, KindAnswer(JointAppearance.FIXED)),
}


@pytest.mark.parametrize("case", KINDS)
def test_the_kind_of_joint_is_what_can_be_seen_of_it(case: str) -> None:
    first, changes, expected = KINDS[case]
    assert ask(WhichKinds((), (shown(first, **changes),))) == (expected,)


CORNERS = np.array([[1, 0, 0], [0, 0, 0.1], [1, 0, 1], [0, 0, 1], [0, 0.1, 0.6]], float)


def test_points_are_those_whose_line_is_the_hinge() -> None:
    assert ask(WhichPoints((), (PointTable(shown(DOOR), CORNERS, JointAppearance.HINGE_ALONG),))) == ((1, 3),)


def test_one_point_is_the_one_nearest_to_the_axis() -> None:
    assert ask(WhichPoints((), (PointTable(shown(KNOB), CORNERS, JointAppearance.HINGE_INTO),))) == ((1,),)


def test_a_single_point_with_the_normal_beats_a_line_that_is_worse() -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0]], float)
    hidden = PointTable(shown(DOOR, normal=Z), points, JointAppearance.HINGE_HIDDEN)
    assert ask(WhichPoints((), (hidden,))) == ((0,),)


def test_the_arrow_is_the_way_that_opens() -> None:
    assert ask(WhichArrows((), (ArrowTable(shown(DRAWER), np.stack([X, -X, Y, -Y])),))) == (3,)


def test_what_is_fixed_is_answered_as_well_as_can_be() -> None:
    assert ask(WhichArrows((), (ArrowTable(shown(PANEL), np.stack([X, -X])),))) == (0,)
    assert ask(WhichPoints((), (PointTable(shown(PANEL), CORNERS, JointAppearance.HINGE_ALONG),))) == ((0, 1),)
    assert ask(WhichMotions((), (MotionTable(shown(PANEL), (HINGE.opening_motion,), (1.0,)),))) == (MotionPick(None),)


def turn(axis: np.ndarray, origin=(0.0, 0, 0)) -> Motion:
    return Motion(JointType.REVOLUTE, axis, np.asarray(origin, float), "built so")


MOTIONS = {
    "the joint's own": ((turn(X), turn(Z)), 1),
    "nearly the joint's own": ((turn(X), turn(Z, (0.05, 0, 0))), 1),
    "none but backwards": ((turn(X), turn(-Z)), None),
    "none about the other side": ((turn(Z, (1, 0, 0)),), None),
    "none but a slide": ((Motion(JointType.PRISMATIC, Y, np.zeros(3), "built so"),), None),
    "the nearest of two": ((turn(Z, (0.05, 0, 0)), turn(Z, (0.02, 0, 0))), 1),
}


@pytest.mark.parametrize("case", MOTIONS)
def test_the_motion_is_the_one_that_takes_the_part_where_it_belongs(case: str) -> None:
    motions, expected = MOTIONS[case]
    assert ask(WhichMotions((), (MotionTable(shown(DOOR), motions, (1.0,) * len(motions)),))) == (MotionPick(expected),)


def test_what_turns_endlessly_turns_both_ways() -> None:
    back = turn(-Y, (0.2, 0, 0.2))
    assert ask(WhichMotions((), (MotionTable(shown(KNOB), (back,), (1.0,)),))) == (MotionPick(0),)


def test_a_label_whose_parts_hang_on_each_other_is_its_own_parent() -> None:
    lamp = replace(KNOWN, labels=("base", "arm", "arm", "drawer", "knob", "panel"), parents=(0, 0, 1, 0, 2, 0))
    assert [(r.label, r.parent) for r in ask(Recognize(()), lamp).labels] == [
        ("arm", "arm"), ("drawer", "base"), ("knob", "arm"),
    ]  # fmt: skip
