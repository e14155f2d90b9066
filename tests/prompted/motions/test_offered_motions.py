"""Test which motions of a door are shown, by given scores, and evidence near its thresholds."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from assets import box
from known import the_case
from made import EDGE, PLATE, PULL, X, Z, context_of, slide, turn
from scenes import door

from anymesh.articulation.candidate_motions import Candidate, CandidateMotions
from anymesh.articulation.estimate import choose_motion
from anymesh.articulation.evidence import sweep_candidates
from anymesh.prompted.motions import offers
from anymesh.prompted.motions.cases import PartCase
from anymesh.prompted.motions.offers import MotionOffers, MovedPoints, make_offers, scored_motions
from anymesh.prompted.questions.prompting import JointAppearance, KindAnswer
from anymesh.types import JointType
from anymesh.types.motion import RecognizedLabel

ALONG, OUT = JointAppearance.HINGE_ALONG, JointAppearance.SLIDE_OUT


@cache
def door_case() -> PartCase:
    return the_case(door("left"))


def at(x: float, **changes) -> Candidate:
    """Return an upright hinge of the door at x [m]; the door reaches from 0 to 0.6 m."""
    return replace(EDGE, motion=turn(Z, (x, -0.012, 0)), **changes)


SPREAD = [at(x) for x in (0.0, 0.6, 0.3, 0.15, 0.45)]  # all look different
LEVEL = [replace(EDGE, motion=turn(X, (0, -0.012, z))) for z in (0.0, 0.8)]


def offered(
    monkeypatch: pytest.MonkeyPatch, motions: list[Candidate], scores: list[float], kind=ALONG, moves=None, most: int = 7
) -> MotionOffers:
    """Return the offers of candidates with these scores; `part` has no typical motion, so that nothing is added."""
    scored = CandidateMotions(PLATE, tuple(motions), np.array(scores, float))
    monkeypatch.setattr(offers, "scored_motions", lambda _: scored)
    monkeypatch.setattr(offers, "FEW", 0)
    told = RecognizedLabel("part", moves, None, None) if moves else None
    answer = None if kind is None else KindAnswer(kind)
    return make_offers(replace(door_case(), answer=answer, recognized=told), most, 0)


def order(found: MotionOffers, motions: list[Candidate]) -> list[int]:
    return [next(k for k, m in enumerate(motions) if m is c) for c in found.motions]


def test_motions_are_ranked_by_score_with_the_free_ones_first(monkeypatch: pytest.MonkeyPatch) -> None:
    motions = [*SPREAD[:3], replace(SPREAD[3], opening=0.0, role="center")]
    found = offered(monkeypatch, motions, [0.0, 2.0, 1.0, 9.0])
    assert order(found, motions) == [1, 2, 0, 3]
    plain = np.exp([2.0, 1.0, 0.0, 9.0 - 4.0])
    assert found.shares == pytest.approx(tuple(plain / plain.sum()))
    assert found.amounts == pytest.approx((np.pi / 3, np.pi / 3, np.pi / 3, 0.6 * np.pi / 3))


@pytest.mark.parametrize(("lead", "first"), [(1.9, 0), (2.1, 1)])
def test_the_answered_kind_counts_for_two(monkeypatch: pytest.MonkeyPatch, lead: float, first: int) -> None:
    motions = [at(0.0), PULL]
    assert order(offered(monkeypatch, motions, [0.0, lead], ALONG), motions)[0] == first
    recognized = offered(monkeypatch, motions, [0.0, lead + 2], ALONG, JointType.REVOLUTE)
    assert order(recognized, motions)[0] == first  # so does the recognized motion
    assert order(offered(monkeypatch, motions, [lead, 0.0], OUT), motions)[0] == 1 - first


@pytest.mark.parametrize(("lead", "first"), [(1.9, 1), (2.1, 0)])
def test_a_picked_line_ranks_behind_one_of_the_parts_own(monkeypatch: pytest.MonkeyPatch, lead: float, first: int) -> None:
    motions = [at(0.0, role="asked"), at(0.6)]
    found = offered(monkeypatch, motions, [lead, 0.0])
    assert order(found, motions)[0] == first
    assert found.answered == (0 if first == 0 else 1)


@pytest.mark.parametrize(("loss", "shown"), [(7.9, True), (8.1, False)])
def test_much_less_plausible_motions_are_not_shown(monkeypatch, loss: float, shown: bool) -> None:
    found = offered(monkeypatch, SPREAD[:4], [0.0, -0.1, -0.2, -loss])
    assert set(found.shown) == ({0, 1, 2, 3} if shown else {0, 1, 2})


def test_three_free_motions_are_in_the_picture_even_if_implausible(monkeypatch: pytest.MonkeyPatch) -> None:
    found = offered(monkeypatch, SPREAD[:4], [0.0, -20.0, -30.0, -40.0])
    assert sorted(found.shown) == [0, 1, 2]


def test_pictures_have_up_to_a_number_of_motions(monkeypatch: pytest.MonkeyPatch) -> None:
    found = offered(monkeypatch, [*SPREAD, *LEVEL], [0.0] * 7, most=3)
    assert len(found.shown) == 3


def test_only_an_answered_or_central_line_is_shown_if_it_is_blocked(monkeypatch: pytest.MonkeyPatch) -> None:
    stuck = [at(x, opening=0.0, role=role) for x, role in ((0.0, "edge"), (0.6, "asked"), (0.3, "center"), (0.15, "slide"))]
    found = offered(monkeypatch, stuck, [4.0, 3.0, 2.0, 1.0])
    assert {c.role for c in found.motions} == {"asked", "center"}
    assert found.answered is not None
    assert found.motions[found.answered].role == "asked"
    assert found.table(found.shown).blocked == (True, True)


def test_a_blocked_axis_of_the_surfaces_in_contact_is_in_the_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    """As of a hook that is tight on its pin, among many free motions."""
    free = [at(x) for x in np.linspace(0, 0.6, 8)]
    held = replace(EDGE, motion=turn(X, (0, -0.012, 0.4)), opening=0.0, role="surface")
    found = offered(monkeypatch, [*free, held], [*np.linspace(9, 2, 8), -20.0], most=5)
    (place,) = (k for k in found.shown if found.motions[k] is held)
    assert found.table(found.shown).blocked[found.shown.index(place)]


@pytest.mark.parametrize(("off", "count"), [(0.003, 1), (0.03, 2)])
def test_of_lines_that_look_alike_the_likeliest_is_shown(monkeypatch: pytest.MonkeyPatch, off: float, count: int) -> None:
    motions = [at(0.0, role="asked"), at(off)]
    found = offered(monkeypatch, motions, [0.0, 1.0])
    assert len(found.motions) == count
    assert order(found, motions)[0] == 1
    assert found.answered == count - 1  # the likelier line stands for the answered one


def test_of_three_similar_lines_two_are_in_the_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    motions = [at(0.0), at(0.03), at(0.06), at(0.6)]
    assert sorted(offered(monkeypatch, motions, [3.0, 2.9, 2.8, 2.7]).shown) == [0, 1, 3]
    assert sorted(offered(monkeypatch, motions[:2], [3.0, 1.9]).shown) == [0]  # clearly less plausible than the similar one
    assert sorted(offered(monkeypatch, motions[:2], [3.0, 2.1]).shown) == [0, 1]


@pytest.mark.parametrize(("off", "role", "shown"), [(0.02, "edge", True), (0.03, "edge", False), (0.03, "contact", True)])
def test_an_edge_away_from_the_part_is_not_shown(monkeypatch, off: float, role: str, shown: bool) -> None:
    """The diagonal is 1.1 m, and the limit 2 % of it."""
    found = offered(monkeypatch, [at(0.6), at(-off + 0.002, role=role)], [1.0, 0.0])
    assert (1 in found.shown) == shown


def test_lines_are_compared_by_where_they_take_the_part() -> None:
    """A pure rotation about parallel lines differs by a translation of 2 sin(a / 2) times their distance."""
    moved = MovedPoints(door_case().context, [at(0.0), at(0.1), replace(at(0.0), opening_sign=-1), PULL])
    assert moved.apart(0, 1, np.pi / 3)[0] == pytest.approx(0.1)
    assert moved.apart(0, 1, np.pi / 2)[0] == pytest.approx(0.1 * np.sqrt(2))
    assert moved.apart(0, 2, np.pi / 3)[0] > 0.3
    assert moved.apart(0, 3, 1.0) == (np.inf, 0.0)
    assert moved.apart(3, 3, 0.3) == pytest.approx((0, 0.3))


def test_both_directions_of_a_motion_are_scored_only_if_both_are_free() -> None:
    found = scored_motions(replace(door_case(), asked=turn(Z, (0.598, -0.012, 0)))).candidates
    assert [c.role for c in found].count("asked") == 1
    outward = [c for c in found if c.role == "slide" and abs(c.outward) > 0.9]
    assert all(c.is_free for c in outward)
    ways = [c.motion for c in found if c.motion.kind is JointType.REVOLUTE]
    both = [sum(m is other for other in ways) for m in ways]
    assert set(both) <= {1, 2}


@pytest.mark.parametrize(("off", "front"), [(0.028, True), (0.032, False)])
def test_lines_at_one_rim_are_within_one_and_a_half_thicknesses(off: float, front: bool) -> None:
    """The panel is 2 cm thick; hinged 2 cm behind its neighbour's front it hits the neighbour."""
    leaf, other = [box((0, -0.022, 0), (0.6, -0.002, 0.8))], [box((-0.6, -0.022, 0), (-0.001, -0.002, 0.8))]
    context = context_of(leaf, [box((-0.6, 0, 0), (0.6, 0.4, 0.8))], other)
    lines = tuple(replace(EDGE, motion=turn(Z, (0, y, 0)), opening_sign=-1) for y in (-0.002, -0.002 - off))
    scored = CandidateMotions(PLATE, lines, np.array([3.0, 0]))
    chosen = choose_motion(context, scored)[1]
    assert chosen is lines[int(front)]


SHUTTLE = [box((-0.1, -0.01, 0), (0.1, 0.01, 0.1))]


@pytest.mark.parametrize(("gap", "guided"), [(0.015, 0.5), (0.03, 0.0)])
def test_a_guide_is_within_two_percent_of_the_scale(gap: float, guided: float) -> None:
    """The scale is about 1 m."""
    rails = [box((-0.5, -0.03, z), (0.5, 0.03, z + 0.1)) for z in (-0.1 - gap, 0.1 + gap)]
    (c, _) = sweep_candidates(context_of(SHUTTLE, rails), [("slide", slide(X))])
    assert c.guided == guided


@pytest.mark.parametrize(("room", "captured"), [(0.04, False), (0.08, True)])
def test_a_slide_between_stops_moves_by_a_quarter_of_its_size(room: float, captured: bool) -> None:
    """The size of the shuttle is 0.224 m."""
    sides = (-0.13 - room / 2, -0.1 - room / 2), (0.1 + room / 2, 0.2)
    ends = [box((low, -0.05, -0.05), (high, 0.05, 0.15)) for low, high in sides]
    (c, _) = sweep_candidates(context_of(SHUTTLE, ends), [("slide", slide(X))])
    assert c.captured == captured


@pytest.mark.parametrize("overlap", [0.0, 0.003])
def test_a_hinge_is_free_where_the_part_only_leaves_a_post_that_it_overlaps(overlap: float) -> None:
    post = box((-0.1, -0.5, 0), (overlap, 0.5, 0.8))
    context = context_of([box((0, -0.022, 0), (0.6, -0.002, 0.8))], [box((-0.1, 0.0, 0), (0.6, 0.4, 0.8)), post])
    found = max(sweep_candidates(context, [("edge", turn(Z, (0.6, -0.022, 0)))]), key=lambda c: c.outward)
    assert found.is_free


@pytest.mark.parametrize("sunk", [-0.001, 0.008, 0.014])
def test_a_door_that_is_sunk_into_the_wall_at_its_hinge_turns_by_a_right_angle_but_slides_no_deeper(sunk: float) -> None:
    """The door is 3 cm thick; of its diagonal .003 are tolerated, about 3 mm."""
    wall = box((-0.1, -0.7, -0.2), (sunk, 0.3, 1))
    context = context_of([box((0, -0.03, 0), (0.6, 0.0, 0.8))], [wall])
    candidates = sweep_candidates(context, [("edge", turn(Z, (0, -0.03, 0))), ("slide", slide(-X))])
    assert np.degrees(max(c.opening for c in candidates[:2])) > 80  # 73 and 61 if the overlap is not tolerated
    assert candidates[2].opening < 0.01


def test_a_blocked_motion_that_is_likelier_than_every_free_one_is_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    motions = [*SPREAD[:2], replace(SPREAD[2], opening=0.0), replace(SPREAD[3], opening=0.0)]
    found = offered(monkeypatch, motions, [0.0, 1.0, 6.0, 4.5])  # blocked ones lose 4
    assert order(found, motions) == [1, 0, 2]
    assert sorted(found.shown) == [0, 1, 2]


def test_one_motion_of_the_recognized_kind_is_shown_however_unlikely(monkeypatch: pytest.MonkeyPatch) -> None:
    motions = [*SPREAD, PULL]
    few = [
        order(offered(monkeypatch, motions, [5.0, 4, 3, 2, 1, -9], None, moves, 3), motions)
        for moves in (None, JointType.PRISMATIC)
    ]
    shown = [
        offered(monkeypatch, motions, [5.0, 4, 3, 2, 1, -9], None, moves, 3).shown for moves in (None, JointType.PRISMATIC)
    ]
    assert [5 in (rows[k] for k in some) for rows, some in zip(few, shown, strict=True)] == [False, True]


def test_the_push_of_a_button_that_fills_its_hole_is_shown_beside_the_pull() -> None:
    body, button = [box((-0.3, 0, 0), (0.3, 0.4, 0.5))], [box((-0.03, -0.02, 0.2), (0.03, 0.04, 0.26))]
    found = make_offers(replace(the_case({"base": body, "part": button}), answer=None), 14, 0)
    table = found.table(found.shown)
    ways = {float(m.axis[1]): a for m, a in zip(table.motions, table.amounts, strict=True) if m.kind is JointType.PRISMATIC}
    assert ways[1.0] == pytest.approx(0.03)  # half of its height
    assert ways[-1.0] > 0.03
    assert not table.blocked[[m.axis[1] for m in table.motions].index(1.0)]
    push, pull = (next(k for k, c in enumerate(found.motions) if c.opening_motion.axis[1] == way) for way in (1.0, -1.0))
    assert found.shares[push] >= 0.99 * found.shares[pull] * np.exp(-2)
