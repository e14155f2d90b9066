"""Test that answers are evidence in one score with the geometry, weighted by how well they agree."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from known import the_case
from made import EDGE, FAR_EDGE, PLATE, PULL, ROUND
from scenes import door

from anymesh.prompted.models.reliability import RELIABILITIES, SHARES
from anymesh.prompted.motions.cases import PartCase
from anymesh.prompted.motions.offers import MotionOffers
from anymesh.prompted.motions.verify import (
    FIXED_SHARE,
    PartAnswers,
    ShownPick,
    answered_confidence,
    posteriors,
)
from anymesh.prompted.questions.prompting import JointAppearance, KindAnswer
from anymesh.types import JointType
from anymesh.types.motion import RecognizedLabel

ALONG, OUT, FIXED = JointAppearance.HINGE_ALONG, JointAppearance.SLIDE_OUT, JointAppearance.FIXED
MOTIONS = (EDGE, FAR_EDGE, PULL, ROUND)
ALONG_SURFACE = replace(PULL, outward=0.6)
EDGE_ROW, FAR_ROW, PULL_ROW, ROUND_ROW, OTHER, NO_MOTION = range(6)
EVEN = (0.25, 0.25, 0.25, 0.25)


@cache
def door_case() -> PartCase:
    return the_case(door("left"))


def answers(
    kind: JointAppearance | None = ALONG,
    *picked: int | None,
    shares: tuple[float, ...] = EVEN,
    answered: int | None = None,
    moves: JointType | None = None,
) -> PartAnswers:
    recognized = RecognizedLabel("part", moves, None, None) if moves else None
    case = replace(door_case(), answer=kind and KindAnswer(kind), recognized=recognized)
    offers = MotionOffers(case, PLATE, MOTIONS, shares, (1.0,) * 4, (0, 1, 2, 3), answered)
    return PartAnswers(offers, tuple(ShownPick((0, 1, 2, 3), p) for p in picked))


def probability(part: PartAnswers) -> np.ndarray:
    return posteriors({1: part})[1]


def test_probabilities_and_shares_sum_to_one() -> None:
    assert sum(SHARES) == pytest.approx(1)
    assert list(RELIABILITIES) == sorted(RELIABILITIES, reverse=True)
    for part in (answers(), answers(OUT, 2), answers(FIXED, None, moves=JointType.REVOLUTE)):
        assert probability(part).sum() == pytest.approx(1)
        assert np.exp(part.prior()).sum() == pytest.approx(1)
        assert np.exp(part.prior()[NO_MOTION]) == pytest.approx(FIXED_SHARE)


@pytest.mark.parametrize("reliability", RELIABILITIES)
def test_the_probabilities_of_all_lines_sum_to_one_for_each_true_motion_of_the_kind(reliability: float) -> None:
    turning = (EDGE_ROW, FAR_ROW, ROUND_ROW)
    rows = [
        (answers(ALONG, answered=k).likelihood(reliability) - answers(ALONG).likelihood(reliability)).sum(0) for k in turning
    ]
    np.testing.assert_allclose(np.exp(rows).sum(0), 1)
    np.testing.assert_allclose(np.exp(rows)[:, [PULL_ROW, OTHER, NO_MOTION]], 1 / 3)  # of another kind than answered


@pytest.mark.parametrize("reliability", RELIABILITIES)
def test_the_probabilities_of_all_picks_sum_to_one_for_each_true_motion(reliability: float) -> None:
    rows = [answers(None, picked).likelihood(reliability).sum(0) for picked in (None, 0, 1, 2, 3)]
    np.testing.assert_allclose(np.exp(rows).sum(0), 1)


def test_a_probe_says_how_much_an_answer_counts() -> None:
    part, random = answers(ALONG, FAR_ROW, moves=JointType.REVOLUTE), [("kinds", 1, 4, 0.25), ("recognize", 0, 3, 0.0)]
    found = [posteriors({1: part}, probed)[1][FAR_ROW] for probed in ((), (("motions", 4, 4, 0.1),), (("motions", 0, 4, 0.1),))]
    assert found[2] < 0.8 < 0.9 < found[0] < found[1]
    assert posteriors({1: part}, (*random, ("motions", 0, 4, 0.1)))[1][FAR_ROW] < 0.5
    assert posteriors({1: part}, (("marks", 0, 7, 0.0),))[1] == pytest.approx(probability(part))  # says nothing about motions


def test_a_pick_decides_among_motions_that_geometry_holds_for_equal() -> None:
    assert probability(answers(ALONG, FAR_ROW)).argmax() == FAR_ROW
    assert probability(answers(ALONG, FAR_ROW))[FAR_ROW] > 0.9
    twice = probability(answers(ALONG, FAR_ROW, FAR_ROW))
    assert twice[FAR_ROW] > probability(answers(ALONG, FAR_ROW))[FAR_ROW]


def test_geometry_decides_among_motions_of_the_answered_kind_if_nothing_was_picked() -> None:
    shares = (0.1, 0.2, 0.6, 0.1)
    assert probability(answers(ALONG, shares=shares)).argmax() == FAR_ROW
    assert probability(answers(OUT, shares=shares)).argmax() == PULL_ROW


def test_what_does_not_move_needs_more_than_one_answer_against_what_is_recognized() -> None:
    assert probability(answers(FIXED)).argmax() == NO_MOTION
    part = answers(FIXED)
    part = replace(part, offers=replace(part.offers, motions=(EDGE, FAR_EDGE, ALONG_SURFACE, ROUND)))
    prior, fixed = part.prior(), part.likelihood(0.9).sum(0)
    assert (fixed[:NO_MOTION] == fixed[0]).all()  # the answer tells no motion from another, also none along the surface
    assert fixed[NO_MOTION] > fixed[0]
    assert len(prior) == len(fixed) == len(MOTIONS) + 2
    moving = probability(answers(FIXED, EDGE_ROW, moves=JointType.REVOLUTE))
    assert moving.argmax() == EDGE_ROW
    assert probability(answers(FIXED, None, moves=JointType.REVOLUTE)).argmax() == NO_MOTION


def test_one_pick_against_all_else_does_not_decide() -> None:
    """Geometry, the kind, the line and the recognized motion are for the edge."""
    sure = {"shares": (0.97, 0.01, 0.01, 0.01), "answered": EDGE_ROW, "moves": JointType.REVOLUTE}
    assert probability(answers(ALONG, PULL_ROW, **sure)).argmax() == EDGE_ROW  # type: ignore[arg-type]
    repeated = probability(answers(ALONG, PULL_ROW, PULL_ROW, PULL_ROW, **sure))  # type: ignore[arg-type]
    assert repeated[PULL_ROW] > probability(answers(ALONG, PULL_ROW, **sure))[PULL_ROW]  # type: ignore[arg-type]


def test_answers_that_contradict_geometry_elsewhere_count_less() -> None:
    good = answers(ALONG, EDGE_ROW, shares=(0.97, 0.01, 0.01, 0.01), answered=EDGE_ROW, moves=JointType.REVOLUTE)
    bad = answers(OUT, FAR_ROW, shares=(0.97, 0.01, 0.01, 0.01), moves=JointType.PRISMATIC)
    asked = answers(ALONG, FAR_ROW)
    with_good, with_bad = posteriors({1: asked, 2: good, 3: good})[1], posteriors({1: asked, 2: bad, 3: bad})[1]
    assert with_good[FAR_ROW] > probability(asked)[FAR_ROW] > with_bad[FAR_ROW]


def test_the_way_out_is_found_by_geometry_and_no_answer() -> None:
    np.testing.assert_allclose(probability(answers(OUT, answered=PULL_ROW)), probability(answers(OUT)))
    assert probability(answers(ALONG, answered=FAR_ROW))[FAR_ROW] > probability(answers(ALONG))[FAR_ROW]


def test_the_only_motion_of_the_answered_kind_is_not_less_likely_for_its_line() -> None:
    part = answers(OUT)
    slides = replace(part.offers, motions=(EDGE, ALONG_SURFACE), shares=(0.5, 0.5), shown=(0, 1))
    case = replace(slides.case, answer=KindAnswer(JointAppearance.SLIDE_ALONG))
    with_line = probability(PartAnswers(replace(slides, case=case, answered=1)))
    assert with_line[1] >= probability(PartAnswers(replace(slides, case=case)))[1]


def test_what_is_not_recognized_may_be_a_motion_that_was_not_offered() -> None:
    none = probability(answers(OUT, None, None))
    assert none[OTHER] > none[NO_MOTION]
    assert none[:OTHER].sum() < probability(answers(OUT))[:OTHER].sum()


def test_the_confidence_in_an_answer_that_is_not_compared_with_others() -> None:
    unknown = answered_confidence(None, line=True)
    assert answered_confidence(True, line=True) > unknown > answered_confidence(False, line=True)
    assert answered_confidence(None, line=False) > unknown
    assert answered_confidence(None, line=True, free=False) == pytest.approx(unknown / 2)
