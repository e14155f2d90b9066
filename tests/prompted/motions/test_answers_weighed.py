"""Test what is made of answers: calls, confidence, contradictions, the choice of motions, and parents, by small cases."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cache

import numpy as np
import pytest
from assets import box, mesh_of
from known import QUICK, the_case
from made import EDGE, FAR_EDGE, PLATE, PULL, ROUND, Z, candidate, turn
from scenes import door

from anymesh.articulation.candidate_motions import Candidate
from anymesh.prompted.motions.cases import PartCase, contradictions
from anymesh.prompted.motions.offers import MotionOffers, _crowding, _picture, fits, moves_as, nearest_motion
from anymesh.prompted.motions.verify import MotionQuestioner, ShownPick, _of_copy, ask_motions
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.prompted.questions.prompting import JointAppearance, KindAnswer, MotionPick, PartFit, WhichMotions
from anymesh.types import Exchange, Joint, JointType
from anymesh.types.motion import RecognizedLabel

ALONG, OUT, FIXED = JointAppearance.HINGE_ALONG, JointAppearance.SLIDE_OUT, JointAppearance.FIXED
CUBE = mesh_of([box((0, 0, 0), (1, 1, 1))])[0]


@cache
def door_case() -> PartCase:
    return the_case(door("left"))


def case(number: int = 1, kind: JointAppearance = ALONG, moves: JointType | None = None) -> PartCase:
    told = RecognizedLabel("part", moves, None, None) if moves else None
    return replace(door_case(), number=number, name=f"p{number}", answer=KindAnswer(kind), recognized=told)


def joint(kind: JointType) -> Joint:
    limits = None if kind in (JointType.CONTINUOUS, JointType.FIXED) else (0.0, 1.0)
    return Joint("j", kind, "base", "p1", np.zeros(3), Z, limits, 0.9, "so")


@pytest.mark.parametrize(
    ("kind", "moves", "joint_type", "agree"),
    [
        (ALONG, JointType.REVOLUTE, JointType.REVOLUTE, True),
        (ALONG, JointType.CONTINUOUS, JointType.CONTINUOUS, True),
        (ALONG, JointType.PRISMATIC, JointType.REVOLUTE, False),
        (OUT, JointType.PRISMATIC, JointType.PRISMATIC, True),
        (OUT, JointType.REVOLUTE, JointType.PRISMATIC, False),
        (OUT, None, JointType.PRISMATIC, True),
        (OUT, None, JointType.REVOLUTE, False),
        (FIXED, None, JointType.FIXED, True),
        (FIXED, JointType.REVOLUTE, JointType.FIXED, False),
    ],
)
def test_answers_that_contradict_each_other_give_a_warning(kind, moves, joint_type, agree: bool) -> None:
    found = contradictions([case(1, kind, moves)], [joint(joint_type)])
    assert len(found) == (not agree)
    for warning in found:
        assert warning.startswith(
            "joint j: " + ("it was answered to move so: " if moves is None else "the answers contradict each other (")
        )
        assert kind.value.replace("_", " ") in warning
        assert (f"recognized as {moves}, then " in warning) == (moves is not None)


@pytest.mark.parametrize(
    ("c", "kinds"),
    [
        (EDGE, {ALONG, JointAppearance.HINGE_INTO, JointAppearance.HINGE_HIDDEN}),
        (PULL, {OUT}),
        (replace(PULL, outward=-0.8), {OUT}),
        (replace(PULL, outward=0.6), {JointAppearance.SLIDE_ALONG}),
        (replace(PULL, outward=-0.6), {JointAppearance.SLIDE_ALONG}),
    ],
)
def test_a_motion_is_of_the_kind_that_it_looks_like(c: Candidate, kinds: set[JointAppearance]) -> None:
    assert {kind for kind in JointAppearance if fits(c, kind)} == kinds
    slides = c is not EDGE
    assert [moves_as(c, kind) for kind in (JointType.PRISMATIC, JointType.REVOLUTE, JointType.CONTINUOUS)] == [
        slides, not slides, not slides,
    ]  # fmt: skip


def test_of_similar_motions_two_good_ones_are_in_the_first_picture() -> None:
    assert _crowding([0, 0, 0, 3], [5.0, 4.5, 4.4, 1.0]) == [False, False, True, False]
    assert _crowding([0, 0, 0], [5.0, 3.9, 4.5]) == [False, True, False]  # worse than the best by more than 1
    assert _crowding([0, 1, 0, 1], [1.0, 1.0, 1.0, 1.0]) == [False] * 4


def test_a_picture_has_the_answer_three_central_axes_the_likeliest_others_and_as_many_more_as_make_seven() -> None:
    middle = candidate("center", JointType.REVOLUTE, Z)
    motions, likely = [EDGE, PULL, middle, middle, middle, middle, FAR_EDGE], [True, True, False, False, False, False, True]
    assert _picture(case(), motions, likely, 6, 6) == [6, 2, 3, 4, 0, 1]
    assert _picture(case(), motions, likely, 3, 7) == [3, 2, 4, 0, 1, 6, 5]
    assert _picture(case(kind=OUT), motions, likely, None, 7) == [1, 0, 6, 2, 3, 4, 5]
    assert _picture(replace(case(), answer=None), motions, likely, None, 7)[:3] == [2, 3, 4]  # of a kind that is not known
    slides = RecognizedLabel("part", JointType.PRISMATIC, None, None)
    assert _picture(replace(case(), answer=None, recognized=slides), motions, likely, None, 7)[:3] == [1, 0, 6]


@dataclass
class Picks:
    """Answerer that picks given motions in order, one per call, by their index in the offers; None is no motion."""

    picks: list[int | None]
    offers: MotionOffers
    fit: PartFit
    asked: list[WhichMotions] = field(default_factory=list)
    name: str = "picks"
    exchanges: tuple[Exchange, ...] = ()
    warnings: tuple[str, ...] = ()

    def ask(self, question: WhichMotions) -> tuple[MotionPick, ...]:
        self.asked.append(question)
        shown, pick = self.shown[-1], self.picks[len(self.asked) - 1]
        return (MotionPick(None if pick is None else shown.index(pick), self.fit),)

    @property
    def shown(self) -> list[tuple[int, ...]]:
        """Return the motions of each call, as indices of the offers."""
        motions = [(c.opening_motion.axis.tolist(), c.motion.source) for c in self.offers.motions]
        return [tuple(motions.index((m.axis.tolist(), m.source)) for m in q.tables[0].motions) for q in self.asked]


def chosen(monkeypatch: pytest.MonkeyPatch, offers: MotionOffers, *picks: int | None, fit: PartFit = PartFit.RIGHT):
    """Return the choice among offers by given picks, and the motions of each picture that was shown."""
    who = Picks(list(picks), offers, fit)
    monkeypatch.setattr("anymesh.prompted.motions.verify.make_offers", lambda *_: offers)
    asking = MotionQuestioner(VisualPrompts(CUBE, QUICK), np.array([0, 1] * 6), who, "object", ask_fit=True)
    (found,) = ask_motions([offers.case], asking, QUICK).chosen().values()
    assert [q.ask_fit for q in who.asked] == [True, False, False][: len(who.asked)]
    assert all(q.tables[0].moving.tolist() == [1, 3, 5, 7, 9, 11] for q in who.asked)
    return found, who.shown


def offered(kind: JointAppearance = ALONG, answered: int | None = None, moves: JointType | None = None) -> MotionOffers:
    motions = (EDGE, FAR_EDGE, PULL, replace(ROUND, opening=0.0, closing=0.0))
    return MotionOffers(case(1, kind, moves), PLATE, motions, (0.6, 0.2, 0.15, 0.05), (1.0,) * 4, (1, 0, 2), answered)


def test_a_picked_motion_is_chosen_and_agreeing_answers_make_it_sure(monkeypatch: pytest.MonkeyPatch) -> None:
    found, asked = chosen(monkeypatch, offered(answered=1, moves=JointType.REVOLUTE), 1)
    assert (found.best, found.moves, found.fit, asked) == (FAR_EDGE, True, PartFit.RIGHT, [(1, 0, 2)])
    assert found.reason.startswith("chosen among 3 motions: swings from 0 to 180 degrees about the other edge")
    assert found.warning == ""
    assert found.confidence > 0.95
    alone, _ = chosen(monkeypatch, offered(), 1)
    assert alone.best is FAR_EDGE
    assert alone.confidence < found.confidence


def test_a_pick_of_another_kind_than_answered_needs_the_geometry(monkeypatch: pytest.MonkeyPatch) -> None:
    likely = replace(offered(), shares=(0.1, 0.1, 0.7, 0.1))
    found, _ = chosen(monkeypatch, likely, 2, fit=PartFit.TOO_MUCH)
    assert (found.best, found.fit) == (PULL, PartFit.TOO_MUCH)
    assert "though hinge along edge was answered" in found.reason
    assert found.confidence < 0.95
    overruled, _ = chosen(monkeypatch, offered(answered=1, moves=JointType.REVOLUTE), 2)
    assert overruled.best is FAR_EDGE  # as its kind, its line and the recognized motion were answered
    assert overruled.reason.startswith("the likeliest of 3 motions: ")
    assert overruled.warning.startswith("the answer 'slides ")
    assert "' was not used: 'swings from 0 to 180 degrees about the other edge" in overruled.warning


def test_without_a_right_motion_the_likeliest_of_the_answered_kind_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    nothing, asked = chosen(monkeypatch, offered(OUT), None)
    assert (nothing.best, asked) == (PULL, [(1, 0, 2)])
    assert nothing.reason.startswith("none recognized of 3 motions")
    assert nothing.confidence < 0.6
    still, _ = chosen(monkeypatch, offered(FIXED, moves=JointType.REVOLUTE), None)
    assert (still.moves, still.reason) == (False, "answered: it does not move")


SURELY = (0.9998, 1e-4, 5e-5, 5e-5)  # shares that leave no doubt where the recognized motion agrees


@pytest.mark.parametrize(("again", "best"), [(2, EDGE), (1, EDGE), (None, EDGE)])
def test_a_pick_against_geometry_and_recognition_must_be_repeated(monkeypatch, again: int | None, best: Candidate) -> None:
    found, asked = chosen(monkeypatch, replace(offered(moves=JointType.REVOLUTE), shares=SURELY), 2, again)
    assert asked == [(1, 0, 2), (2, 0, 1)]  # in another order
    assert found.best is best
    assert "asked twice" in found.reason
    assert "' was not used: 'swings " in found.warning
    assert "is likelier by geometry and the other answers (" in found.warning


def test_a_joint_that_geometry_and_recognition_agree_on_is_not_asked_about(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("anymesh.prompted.models.reliability.RELIABILITIES", (0.999,))
    monkeypatch.setattr("anymesh.prompted.models.reliability.SHARES", (1.0,))
    monkeypatch.setattr("test_answers_weighed.QUICK", replace(QUICK, ask="unsure"))
    told = replace(offered(moves=JointType.REVOLUTE), shares=SURELY)
    found, asked = chosen(monkeypatch, replace(told, case=replace(told.case, answer=None)))
    assert (found.best, asked) == (EDGE, [])
    assert found.reason.startswith("not asked, as geometry and recognition agree: ")
    against = offered(moves=JointType.PRISMATIC)
    assert chosen(monkeypatch, replace(against, shares=SURELY), 2)[1] == [(1, 0, 2)]


def test_a_copy_makes_the_motion_of_the_part_that_was_asked_about_moved_or_mirrored() -> None:
    one = offered()
    assert _of_copy(one, one, ShownPick(one.shown, 2)) == ShownPick((0, 1, 2), 2)
    assert _of_copy(one, one, ShownPick(one.shown, None)).picked is None
    assert nearest_motion(one, PULL.opening_motion) == 2
    assert nearest_motion(replace(one, motions=one.motions[:2], amounts=(1.0, 1.0)), PULL.opening_motion) is None


@pytest.mark.parametrize("same", [replace(EDGE, opening_sign=-1), replace(EDGE, motion=turn(Z, (0.06, 0, 0)))])
def test_a_pick_of_the_agreed_line_is_not_repeated_whichever_side_opens(monkeypatch, same: Candidate) -> None:
    offers = offered(answered=0)
    found, asked = chosen(monkeypatch, replace(offers, motions=(EDGE, same, *offers.motions[2:])), 1)
    assert (found.best, asked) == (same, [(1, 0, 2)])
    assert "asked twice" not in found.reason
