"""Test the ranking of motions, the validation of answers, and the label of a part from its motion."""

from dataclasses import replace

import numpy as np
import pytest
from assets import box, mesh_of
from made import EDGE, FAR_EDGE, PLATE, PULL, ROUND, X, Y, Z

from anymesh.articulation.candidate_motions import Candidate, CandidateMotions, MotionChoice, PartFacts, SlideDirection
from anymesh.articulation.estimate import choose_motion, part_motions
from anymesh.articulation.rank_motions import (
    label_of,
    motion_scores,
    rank_motions,
    reason,
    same_joints,
    share_of_best,
    shipped_classifier,
)
from anymesh.scoring.classifier import MAX_CONFIDENCE
from anymesh.segmentation.divide import object_shape
from anymesh.types import JointType, Motion, Part, Segmentation, Sweep


def asked(part: PartFacts, candidates: list[Candidate], scores: list[float]) -> MotionChoice:
    answer = rank_motions(CandidateMotions(part, tuple(candidates), np.array(scores)))
    assert sorted(answer.ranking) == list(range(len(candidates)))
    return answer


def test_motions_are_ranked_by_score_and_the_reason_describes_the_best() -> None:
    answer = asked(PLATE, [PULL, replace(EDGE, handle_side=0.9)], [-1.0, 2.0])
    assert answer.ranking == (1, 0)
    assert answer.type is JointType.REVOLUTE
    assert "opposite its handle" in answer.reason


def same_as_first(*candidates: Candidate) -> np.ndarray:
    return same_joints(PLATE, candidates, 0)


def question(*candidates: Candidate) -> CandidateMotions:
    return CandidateMotions(PLATE, candidates, np.zeros(len(candidates)))


def test_motions_are_the_same_joint_about_one_line_to_one_side() -> None:
    near = replace(EDGE, motion=Motion(JointType.REVOLUTE, Z, 0.01 * X, "nearly the same edge"))
    against = replace(EDGE, opening_sign=-EDGE.opening_sign)
    slid = replace(PULL, motion=Motion(JointType.PRISMATIC, Y, X, "elsewhere"))  # the origin of a slide is irrelevant
    assert same_as_first(EDGE, FAR_EDGE, near, against).tolist() == [True, False, True, False]
    assert same_as_first(PULL, slid, EDGE).tolist() == [True, True, False]
    # free both ways, so it has no side
    assert same_as_first(ROUND, replace(ROUND, opening_sign=-1)).tolist() == [True, True]


def test_the_confidence_grows_with_the_share_of_the_best_motion() -> None:
    assert share_of_best(np.zeros(4), np.array([True, True, False, False])) == pytest.approx(0.5)
    told = [asked(PLATE, [EDGE, FAR_EDGE], [lead, 0.0]).confidence for lead in (0.0, 0.5, 1.0, 3.0, 40.0)]
    assert told == sorted(told)
    assert told[0] == pytest.approx(shipped_classifier().confidence(0.0))
    assert told[3] == pytest.approx(shipped_classifier().confidence(3.0))
    assert told[-1] == MAX_CONFIDENCE


def test_what_turns_endlessly_is_continuous_and_what_is_stopped_is_not() -> None:
    assert asked(PLATE, [ROUND], [0.0]).type is JointType.CONTINUOUS
    assert asked(PLATE, [replace(ROUND, closing=1.0)], [0.0]).type is JointType.REVOLUTE
    assert asked(PLATE, [replace(EDGE, closing=np.pi)], [0.0]).type is JointType.REVOLUTE  # a gate


@pytest.mark.parametrize(("offset", "first"), [(1e-3, 1), (0.5, 0)])
def test_an_endless_rotation_is_about_the_axis_of_the_round_outline_that_is_the_same_line(offset: float, first: int) -> None:
    line = replace(ROUND, role="center", motion=replace(ROUND.motion, origin=ROUND.motion.origin + offset * X))
    answer = asked(PLATE, [line, ROUND, PULL], [1.0, -1.0, 0.0])
    assert answer.ranking[0] == first
    assert answer.type is (JointType.CONTINUOUS if first else JointType.REVOLUTE)
    stopped = asked(PLATE, [replace(line, closing=1.0), ROUND], [1.0, 0.0])
    assert (stopped.ranking[0], stopped.type) == (0, JointType.REVOLUTE)


@pytest.mark.parametrize("scores", [[0.0, 1e-9], [1e-9, 0.0]])
@pytest.mark.parametrize("first", [1, -1])
def test_an_endless_rotation_has_its_axis_as_proposed(scores: list[float], first: int) -> None:
    """Wheels on one axle turn alike: noise in the scores of the two directions does not decide."""
    both = [replace(ROUND, opening_sign=first), replace(ROUND, opening_sign=-first)]
    assert both[asked(PLATE, both, scores).ranking[0]].opening_sign == 1


def test_a_label_that_may_be_made_from_the_motion_adds_no_confidence() -> None:
    without = asked(PLATE, [EDGE, PULL], [1.0, 0.0])
    labelled = asked(replace(PLATE, label="door"), [EDGE, PULL], [1.0, 0.0])
    against = asked(replace(PLATE, label="drawer"), [EDGE, PULL], [1.0, 0.0])
    assert (labelled.type, labelled.confidence) == (without.type, without.confidence)
    assert against.type is JointType.PRISMATIC
    assert against.confidence < 0.5


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
        MotionChoice((0,), JointType.FIXED, confidence, reason)


@pytest.mark.parametrize(
    ("c", "words"),
    [
        (PULL, "slides 50 cm out of the case, guided on no side"),
        (
            replace(PULL, guided=0.75, outward=-1.0, sweep=Sweep(0.02, 0.5, False, True)),
            "slides 2.0 cm into the case, guided on three sides",
        ),
        (replace(PULL, outward=0.7), "slides 50 cm along the surface, guided on no side"),
        (replace(PULL, outward=-0.7), "slides 50 cm along the surface, guided on no side"),
        (replace(ROUND, opening=1.0), "turns from -180 to 57 degrees about the axis of its round outline"),
        (ROUND, "turns endlessly about the axis of its round outline"),
        (replace(EDGE, closing=0.5, hinge_support=0.5), "swings from -29 to 180 degrees about the edge"),
        (replace(EDGE, handle_side=0.9), "swings from 0 to 180 degrees about the edge, opposite its handle, held all along it"),
    ],
)
def test_a_motion_is_described_by_its_kind_its_range_and_what_holds_it(c: Candidate, words: str) -> None:
    assert reason(c) == words


@pytest.mark.parametrize(
    ("label", "kind", "least"),
    [("drawer", JointType.PRISMATIC, 1.9), ("door", JointType.REVOLUTE, 1.4)],
)
def test_a_label_raises_the_score_of_its_typical_motion_alone(label: str, kind: JointType, least: float) -> None:
    free = question(EDGE, PULL, ROUND)
    plain = motion_scores(free)
    assert plain.tolist() == [0, 0, 0]
    gain = motion_scores(replace(free, part=replace(PLATE, label=label))) - plain
    typical = [JointType.REVOLUTE, JointType.PRISMATIC].index(kind)
    assert gain[typical] > least
    assert (np.delete(gain, typical) < -1).all()


def test_a_blocked_motion_scores_lower_than_a_free_one_that_is_less_likely() -> None:
    stuck = replace(EDGE, opening=0.0)
    assert asked(PLATE, [stuck, PULL], [3.5, 0.0]).ranking == (1, 0)
    assert asked(PLATE, [stuck, PULL], [4.5, 0.0]).ranking == (0, 1)


@pytest.mark.parametrize(("off", "same"), [(0.06, True), (0.08, False)])
def test_lines_are_one_to_a_user_within_a_tenth_of_the_part(off: float, same: bool) -> None:
    """The part's diagonal is 0.7 m."""
    beside = replace(EDGE, motion=Motion(JointType.REVOLUTE, Z, off * X + 5 * Z, "beside"))
    assert same_as_first(EDGE, beside).tolist() == [True, same]


@pytest.mark.parametrize(
    ("c", "direction"),
    [
        (replace(PULL, outward=0.71), SlideDirection.OUTWARDS),
        (replace(PULL, outward=0.69), SlideDirection.ALONG_SURFACE),
        (replace(PULL, outward=-0.69), SlideDirection.ALONG_SURFACE),
        (replace(PULL, outward=-0.71), SlideDirection.INWARDS),
        (EDGE, None),
    ],
)
def test_a_slide_is_outwards_within_45_degrees_of_the_opening_direction(c, direction: SlideDirection | None) -> None:
    assert c.slide_direction is direction


@pytest.mark.parametrize(("degrees", "same"), [(13.0, True), (15.0, False)])
def test_directions_are_one_to_a_user_within_fourteen_degrees(degrees: float, same: bool) -> None:
    a = np.deg2rad(degrees)
    aside = replace(PULL, motion=Motion(JointType.PRISMATIC, np.cos(a) * Y + np.sin(a) * X, np.zeros(3), "aside"))
    assert same_as_first(PULL, aside).tolist() == [True, same]


@pytest.mark.parametrize(
    ("c", "free"),
    [
        (replace(PULL, opening=0.008), True),
        (replace(PULL, opening=0.007), False),
        (replace(PULL, opening=0.0, closing=0.009), True),  # a button in a filled hole
        (replace(EDGE, opening=float(np.deg2rad(13))), True),
        (replace(EDGE, opening=float(np.deg2rad(11))), False),
        (replace(EDGE, opening=0.0, closing=3.0), False),
        (replace(ROUND, opening=0.0, closing=3.0), True),
    ],
)
def test_a_motion_is_free_if_it_opens_or_presses_far_enough(c: Candidate, free: bool) -> None:
    assert c.is_free == free


@pytest.mark.parametrize(("opening", "closing", "endless"), [(3.1, 3.1, True), (3.1, 2.9, False), (2.9, 3.1, False)])
def test_a_rotation_is_endless_if_it_is_free_both_ways(opening: float, closing: float, endless: bool) -> None:
    assert replace(EDGE, opening=opening, closing=closing).is_endless == endless
    assert not replace(PULL, opening=opening, closing=closing).is_endless


def chest(stop: bool) -> list:
    """Return a case with one drawer and its handle, and optionally a bar in front that stops it."""
    walls = [box((0, 0, 0), (0.6, 0.4, 0.02)), box((0, 0, 0.28), (0.6, 0.4, 0.3)), box((0.02, 0.38, 0.02), (0.58, 0.4, 0.28))]
    walls += [box((x, 0, 0.02), (x + 0.02, 0.4, 0.28)) for x in (0, 0.58)]
    front = [box((0.025, 0, 0.025), (0.575, 0.02, 0.275)), box((0.2, -0.03, 0.14), (0.4, 0, 0.15))]
    tray = [box((0.03, 0.02, 0.03), (0.57, 0.35, 0.04)), box((0.03, 0.34, 0.04), (0.57, 0.35, 0.2))]
    bar = [box((0, -0.005, 0.2), (0.6, -0.004, 0.3)), box((0, -0.004, 0.285), (0.6, 0, 0.295))]
    return [*walls, *front, *tray, *(bar if stop else [])]


def label(solids: list, moving: list[int]) -> str:
    """Return the label of one part of an object."""
    mesh, number = mesh_of(solids)
    segmentation = Segmentation(np.isin(number, moving).astype(np.int64), (Part("base", "base"), Part("it", "part")))
    whole = object_shape(mesh, 0, labels=segmentation.face_part)
    _, _, context, question = next(iter(part_motions(whole, segmentation)))
    return label_of(context, choose_motion(context, question)[1])


@pytest.mark.parametrize(("stop", "expected"), [(False, "drawer"), (True, "")])
def test_a_drawer_comes_out_or_is_none(stop: bool, expected: str) -> None:
    assert label(chest(stop), [5, 6, 7, 8]) == expected


def test_a_plate_on_top_is_a_lid() -> None:
    walls = [box((0, 0, 0), (1, 0.6, 0.02)), box((0, 0, 0.02), (1, 0.02, 0.4)), box((0, 0.58, 0.02), (1, 0.6, 0.4))]
    walls += [box((x, 0.02, 0.02), (x + 0.02, 0.58, 0.4)) for x in (0, 0.98)]
    assert label([*walls, box((0, 0, 0.402), (1, 0.6, 0.42))], [5]) == "lid"
