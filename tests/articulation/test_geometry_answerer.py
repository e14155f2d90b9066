"""Test the geometry answerer: its answers from scores and labels, and their validation."""

from dataclasses import replace

import numpy as np
import pytest

from anymesh.articulation.geometry_answerer import CALIBRATION_SLOPE, OFFSET, GeometryAnswerer, same_joints, share_of_best
from anymesh.articulation.motion_question import Candidate, MotionAnswer, MotionQuestion, PartFacts
from anymesh.scoring.two_steps import MAX_CONFIDENCE, confidence_of
from anymesh.types import JointType, Motion, Sweep

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
    two_pivot=False,
    tall=-0.6,
    height=0.5,
    back_contact=0.0,
    free_rim=0.0,
    covers_opening=0.0,
)


def candidate(role: str, kind: JointType, axis, **changes) -> Candidate:
    free = np.pi if kind is JointType.REVOLUTE else 0.5
    sweep = Sweep(free, 0.0, True, False)
    made = Candidate(
        Motion(kind, axis, np.zeros(3), f"a {role}"), sweep, role, 1, free, 0.0, hinge_support=0.0, sibling=0.0,
        handle_side=0.0, guided=0.0, depth=0.0, vertical=float(abs(axis[2])), above=0.0, captured=False, outward=1.0,
    )  # fmt: skip
    return replace(made, **changes)


EDGE = candidate("edge", JointType.REVOLUTE, Z, hinge_support=1.0)
FAR_EDGE = replace(EDGE, motion=Motion(JointType.REVOLUTE, Z, X, "the other edge"))
PULL = candidate("slide", JointType.PRISMATIC, Y)
ROUND = candidate("round", JointType.REVOLUTE, Y, closing=np.pi)


def asked(part: PartFacts, candidates: list[Candidate], scores: list[float]) -> MotionAnswer:
    answer = WHO.which_motion(MotionQuestion(part, tuple(candidates), np.array(scores), ("some feature 1",) * len(scores)))
    assert sorted(answer.ranking) == list(range(len(candidates)))
    return answer


def test_motions_are_ranked_by_score_and_the_reason_names_what_decided() -> None:
    answer = asked(PLATE, [PULL, replace(EDGE, handle_side=0.9)], [-1.0, 2.0])
    assert answer.ranking == (1, 0)
    assert answer.type is JointType.REVOLUTE
    assert "opposite the handle" in answer.reason
    assert "some feature 1" in answer.reason


def question(*candidates: Candidate) -> MotionQuestion:
    return MotionQuestion(PLATE, candidates, np.zeros(len(candidates)), ("",) * len(candidates))


def test_motions_are_the_same_joint_about_one_line_to_one_side() -> None:
    near = replace(EDGE, motion=Motion(JointType.REVOLUTE, Z, 0.01 * X, "nearly the same edge"))
    against = replace(EDGE, opening_sign=-EDGE.opening_sign)
    slid = replace(PULL, motion=Motion(JointType.PRISMATIC, Y, X, "elsewhere"))  # the origin of a slide is irrelevant
    assert same_joints(question(EDGE, FAR_EDGE, near, against), 0).tolist() == [True, False, True, False]
    assert same_joints(question(PULL, slid, EDGE), 0).tolist() == [True, True, False]
    # free both ways, so it has no side
    assert same_joints(question(ROUND, replace(ROUND, opening_sign=-1)), 0).tolist() == [True, True]


def test_the_confidence_grows_with_the_share_of_the_best_motion() -> None:
    assert share_of_best(np.zeros(4), np.array([True, True, False, False])) == pytest.approx(0.5)
    told = [asked(PLATE, [EDGE, FAR_EDGE], [lead, 0.0]).confidence for lead in (0.0, 0.5, 1.0, 3.0, 40.0)]
    assert told == sorted(told)
    assert told[0] == pytest.approx(confidence_of(0.0, CALIBRATION_SLOPE, OFFSET))
    assert told[3] == pytest.approx(confidence_of(3.0, CALIBRATION_SLOPE, OFFSET))
    assert told[-1] == MAX_CONFIDENCE


def test_what_turns_endlessly_is_continuous_and_what_is_stopped_is_not() -> None:
    assert asked(PLATE, [ROUND], [0.0]).type is JointType.CONTINUOUS
    assert asked(PLATE, [replace(ROUND, closing=1.0)], [0.0]).type is JointType.REVOLUTE
    assert asked(PLATE, [replace(EDGE, closing=np.pi)], [0.0]).type is JointType.REVOLUTE  # a gate


def test_what_cannot_move_is_fixed() -> None:
    stuck = [replace(c, opening=0.0, closing=0.0) for c in (EDGE, PULL)]
    assert asked(PLATE, stuck, [0.0, 1.0]).type is JointType.FIXED


@pytest.mark.parametrize(("label", "kind"), [("drawer", JointType.PRISMATIC), ("door", JointType.REVOLUTE)])
@pytest.mark.parametrize("scores", [[0.5, -0.5], [-0.5, 0.5]])
def test_a_known_label_decides_where_the_scores_are_close(label: str, kind: JointType, scores: list[float]) -> None:
    assert asked(replace(PLATE, label=label), [EDGE, PULL], scores).type is kind


@pytest.mark.parametrize(("confidence", "reason"), [(1.1, "so"), (-0.1, "so"), (0.5, ""), (float("nan"), "so")])
def test_an_answer_is_checked(confidence: float, reason: str) -> None:
    with pytest.raises(ValueError, match=r"confidence in 0\.\.1 and a reason"):
        MotionAnswer((0,), JointType.FIXED, confidence, reason)
