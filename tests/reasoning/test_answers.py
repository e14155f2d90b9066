"""The embedded answerer: what each piece of evidence does to its answer, and that answers are checked."""

from dataclasses import replace

import numpy as np
import pytest

from anymesh.reasoning.geometry import GeometryAnswerer
from anymesh.reasoning.questions import Candidate, MotionAnswer, MotionQuestion, PartFacts
from anymesh.types import Handle, JointType, Motion, MotionKind, Sweep

WHO = GeometryAnswerer()
X, Y, Z = np.eye(3)
PLATE = PartFacts(
    "p",
    "part",
    (0.6, 0.4, 0.02),
    0.05,
    0.3,
    0.1,
    -Y,
    1.0,
    0.0,
    size=0.7,
    diagonal=1.0,
    horizontal=False,
    handle=None,
    touches_ends=False,
    tall=-0.6,
    height=0.5,
    seated=0.0,
    free_rim=0.0,
    lid=0.0,
)


def candidate(role: str, kind: MotionKind, axis, **changes) -> Candidate:
    free = np.pi if kind is MotionKind.TURN else 0.5
    sweep = Sweep(free, 0.0, True, False)
    made = Candidate(
        Motion(kind, axis, np.zeros(3), f"a {role}"), sweep, role, 1, free, 0.0, support=0.0, sibling=0.0, handle_side=0.0,
        guided=0.0, depth=0.0, vertical=float(abs(axis[2])), above=0.0, captured=False, outward=1.0,
    )  # fmt: skip
    return replace(made, **changes)


EDGE = candidate("edge", MotionKind.TURN, Z, support=1.0)
FAR_EDGE = replace(EDGE, motion=Motion(MotionKind.TURN, Z, X, "the other edge"))
PULL = candidate("slide", MotionKind.SLIDE, Y)
ROUND = candidate("round", MotionKind.TURN, Y, closing=np.pi)


def asked(part: PartFacts, *candidates: Candidate) -> MotionAnswer:
    answer = WHO.which_motion(MotionQuestion(part, candidates))
    assert sorted(answer.ranking) == list(range(len(candidates)))
    return answer


@pytest.mark.parametrize("flip", [1, -1])
def test_the_hinge_is_opposite_the_handle(flip: int) -> None:
    part = replace(PLATE, handle=Handle((0.9, 0.0), 1, 0.2))
    sides = (replace(EDGE, handle_side=0.9 * flip), replace(FAR_EDGE, handle_side=-0.9 * flip))
    answer = asked(part, *sides)
    assert answer.type is JointType.REVOLUTE
    assert answer.ranking[0] == (0 if flip > 0 else 1)
    assert "opposite the handle" in answer.reason


def test_a_deep_guided_box_slides() -> None:
    box = replace(PLATE, thinness=0.8, buried=0.9)
    answer = asked(box, EDGE, replace(PULL, guided=0.75, depth=1.0))
    assert (answer.type, answer.ranking[0]) == (JointType.PRISMATIC, 1)


def test_what_turns_endlessly_is_continuous_and_what_is_stopped_is_not() -> None:
    disc = replace(PLATE, roundness=1.0)
    assert asked(disc, ROUND, EDGE).type is JointType.CONTINUOUS
    assert asked(disc, replace(ROUND, closing=1.0)).type is JointType.REVOLUTE
    assert asked(PLATE, ROUND, EDGE).ranking[0] == 1  # it is not round


def test_what_cannot_move_is_fixed() -> None:
    stuck = [replace(c, opening=0.0, closing=0.0, support=0.0) for c in (EDGE, PULL)]
    assert asked(PLATE, *stuck).type is JointType.FIXED


@pytest.mark.parametrize(("label", "kind"), [("drawer", JointType.PRISMATIC), ("door", JointType.REVOLUTE)])
def test_a_known_word_decides_where_geometry_does_not(label: str, kind: JointType) -> None:
    assert asked(replace(PLATE, label=label), EDGE, replace(PULL, guided=0.75, depth=0.3)).type is kind


@pytest.mark.parametrize(("confidence", "reason"), [(1.1, "so"), (-0.1, "so"), (0.5, ""), (float("nan"), "so")])
def test_an_answer_is_checked(confidence: float, reason: str) -> None:
    with pytest.raises(ValueError, match=r"confidence in 0\.\.1 and a reason"):
        MotionAnswer((0,), JointType.FIXED, confidence, reason)


def test_copies_move_in_one_manner() -> None:
    flap = replace(EDGE, motion=Motion(MotionKind.TURN, X, np.zeros(3), "its upper edge"), vertical=0.0, above=1.0)
    slightly = replace(EDGE, support=0.85)
    alone = asked(PLATE, flap, slightly)
    sure = replace(PLATE, handle=Handle((0.9, 0.0), 1, 0.2))
    twin = MotionQuestion(sure, (replace(flap, handle_side=0.0), replace(EDGE, handle_side=0.9)))
    with_twin = WHO.which_motion(MotionQuestion(PLATE, (flap, slightly), (twin,)))
    assert with_twin.ranking[0] == 1
    assert with_twin.confidence > alone.confidence or alone.ranking[0] == 0
