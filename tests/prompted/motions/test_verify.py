"""Test the motions shown for verification: the answer, the part's own axes and the likeliest others, without duplicates."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from assets import box
from known import KNOWN, scored_once, the_case
from scenes import Scene, door, prism

from anymesh.articulation.candidate_motions import Candidate
from anymesh.prompted.motions.cases import PartCase
from anymesh.prompted.motions.lines import CENTRAL
from anymesh.prompted.motions.offers import (
    BLOCKED_SHOWN_RATIO,
    DUPLICATE_MOTION_RATIO,
    DUPLICATE_OBJECT_RATIO,
    MAX_SHOWN_ANGLE_RAD,
    MAX_SIMILAR,
    OWN,
    MotionOffers,
    fits,
    make_offers,
    shown_amount,
)
from anymesh.prompted.questions.prompting import JointAppearance, KindAnswer
from anymesh.types import JointType, Motion

pytestmark = pytest.mark.usefixtures("computed_once")
X, Y, Z = np.eye(3)
MOST = 7
NAMES = ["left", "drawer", "lid", "slider", "wheel"]


def turn(axis: np.ndarray, origin) -> Motion:
    return Motion(JointType.REVOLUTE, axis, np.asarray(origin, float), "picked")


@cache
def case_of(name: str) -> PartCase:
    return the_case(blocked_door() if name == "blocked" else KNOWN[name].scene)


def candidates_of(name: str, asked: Motion | None = None) -> tuple[Candidate, ...]:
    return scored_once(replace(case_of(name), asked=asked)).candidates


@cache
def offers(
    name: str, asked: Motion | None = None, kind: JointAppearance = JointAppearance.HINGE_ALONG, most: int = MOST
) -> MotionOffers:
    return make_offers(replace(case_of(name), asked=asked, answer=KindAnswer(kind)), most, 0)


def shown(name: str, asked: Motion | None, kind: JointAppearance, most: int = MOST) -> list[Candidate]:
    """Return the motions of the picture, likeliest first."""
    found = offers(name, asked, kind, most)
    return [found.motions[k] for k in sorted(found.shown)]


def moved(c: Candidate, case: PartCase, amount: float) -> np.ndarray:
    T = c.opening_motion.transform(amount)
    points = case.context.part.samples.points[::20]
    return points @ T[:3, :3].T + T[:3, 3] - points


def apart(a: Candidate, b: Candidate, case: PartCase) -> float:
    """Return the distance of a part after two motions by the larger displayed amount, relative to the limit for duplicates."""
    if a.motion.kind is not b.motion.kind:
        return np.inf
    amount = max(shown_amount(a, case), shown_amount(b, case), key=abs)
    ways = moved(a, case, amount), moved(b, case, amount)
    way = min(float(np.linalg.norm(way, axis=1).mean()) for way in ways)
    off = float(np.linalg.norm(ways[0] - ways[1], axis=1).mean())
    return off / min(DUPLICATE_OBJECT_RATIO * case.context.tolerance_length, DUPLICATE_MOTION_RATIO * way)


@pytest.mark.parametrize("name", NAMES)
def test_the_motions_shown_are_few_and_look_different(name: str) -> None:
    found = offers(name)
    assert 1 <= len(found.shown) <= MOST
    for k, c in enumerate(found.motions):
        assert all(apart(c, other, case_of(name)) > 0.8 for other in found.motions[:k])


@pytest.mark.parametrize("name", NAMES)
def test_what_is_blocked_is_shown_only_where_it_was_answered_or_is_an_axis_of_the_parts_own(name: str) -> None:
    found = offers(name)
    stuck = [c for c in found.motions if not c.is_free]
    assert all(c.role in OWN for c in stuck)
    assert found.table(found.shown).blocked == tuple(not found.motions[k].is_free for k in found.shown)


@pytest.mark.parametrize("kind", JointAppearance)
@pytest.mark.parametrize("name", NAMES)
def test_the_true_motion_is_among_them_whatever_was_answered(name: str, kind: JointAppearance) -> None:
    true = KNOWN[name].joint.opening_motion
    assert any(c.motion.kind is true.kind and abs(c.motion.axis @ true.axis) > 0.999 for c in shown(name, None, kind))


@pytest.mark.parametrize("off", [(0, 0.012), (0.01, 0.0), (0.008, -0.008)])
def test_lines_that_look_the_same_are_one_whatever_their_free_range(off: tuple[float, float]) -> None:
    """The hinges are about a centimetre beside the door's own, one of them inside the case and soon blocked."""
    asked = turn(Z, (0.002 + off[0], -0.012 + off[1], 0))
    found = offers("left", asked)
    along = [c for c in shown("left", asked, JointAppearance.HINGE_ALONG) if abs(c.motion.axis @ Z) > 0.99 and c.is_free]
    at_left = [c for c in along if c.motion.origin[0] < 0.1]
    assert 1 <= len(at_left) <= MAX_SIMILAR
    assert found.answered is not None
    assert found.motions[found.answered].role != "asked"  # the door's own edge stands for it


def blocked_door() -> Scene:
    """Return a door with a wall at its right."""
    scene = door("left")
    return {**scene, "base": [*scene["base"], box((0.602, -0.7, 0), (0.64, 0.4, 0.8))]}


HANDLE_SIDE = turn(Z, (0.002, -0.012, 0))  # of the door, whose handle is at its left
FAR_SIDE = turn(Z, (0.598, -0.012, 0))
THROUGH = turn(Z, (0.3, 0.2, 0))  # in the middle of the case: the panel would pass through its sides
BEYOND = turn(Z, (0.7, -0.012, 0))
BELOW = turn(X, (0.3, -0.022, 0.002))
TO_THE_RIGHT = Motion(JointType.PRISMATIC, X, np.array([0.3, -0.012, 0.4]), "picked")
UP = Motion(JointType.PRISMATIC, Z, np.zeros(3), "picked")


@pytest.mark.parametrize(
    ("name", "asked", "kind"),
    [("left", THROUGH, JointAppearance.HINGE_ALONG), ("slider", UP, JointAppearance.SLIDE_ALONG)],
    ids=["an axis that runs through the walls", "a slide into the rails"],
)
def test_an_answer_that_is_blocked_is_shown_and_marked_so(name: str, asked: Motion, kind: JointAppearance) -> None:
    first = candidates_of(name, asked)[0]
    assert (first.role, first.motion) == ("asked", asked)
    assert not first.is_free
    found = offers(name, asked, kind)
    assert found.answered is not None
    assert found.answered in found.shown
    assert found.table((found.answered,)).blocked == (True,)
    visible = np.deg2rad(30) * (asked.kind is JointType.REVOLUTE)
    assert found.table((found.answered,)).amounts[0] > visible


@pytest.mark.parametrize("name", ["wheel", "left"])
def test_the_middle_lines_of_what_turns_into_the_surface_are_in_the_picture(name: str) -> None:
    context, motions = case_of(name).context, shown(name, None, JointAppearance.HINGE_INTO)
    found = [c for c in motions if c.role in CENTRAL]
    through = [c for c in found if np.linalg.norm(np.cross(context.body_obb.center - c.motion.origin, c.motion.axis)) < 0.02]
    assert len(through) >= 1
    assert any(abs(c.motion.axis @ context.opening_direction) > 0.99 for c in found)


def test_the_axis_of_a_pin_on_a_part_that_is_not_round_is_offered() -> None:
    pin = prism(0.02, (-0.03, 0.05), 0.1, 0.1)
    blade = box((0.05, -0.02, 0.05), (0.9, -0.001, 0.15))
    case = the_case({"base": [box((0, 0, 0), (1, 0.2, 0.3)), pin], "blade": [blade]})
    assert [c.source for c in case.circles] == ["axis of a round patch"]
    found = make_offers(replace(case, answer=KindAnswer(JointAppearance.HINGE_INTO)), MOST, 0)
    motions = [found.motions[k] for k in found.shown]
    assert any(abs(c.motion.axis @ Y) > 0.999 and abs(c.motion.origin[0] - 0.1) < 0.002 for c in motions)


@pytest.mark.slow
def test_the_order_in_the_picture_follows_the_seed_and_not_the_likelihood() -> None:
    case = replace(case_of("left"), answer=KindAnswer(JointAppearance.HINGE_ALONG))
    orders = [make_offers(case, MOST, seed).shown for seed in range(8)]
    assert orders[0] == make_offers(case, MOST, 0).shown
    assert len({order[0] for order in orders}) > 2  # the likeliest motion is not always number 1
    assert {frozenset(order) for order in orders} == {frozenset(orders[0])}


def test_a_motion_that_may_go_either_way_is_offered_both_ways() -> None:
    case = the_case({"base": [box((0, 0, 0), (1, 1, 0.1))], "flap": [box((0, 0.48, 0.101), (1, 0.52, 0.6))]})
    found = make_offers(replace(case, answer=KindAnswer(JointAppearance.HINGE_ALONG)), MOST, 0)
    hinges = [c for c in found.motions if abs(c.motion.axis @ X) > 0.9 and c.motion.origin[2] < 0.15]
    assert {c.opening_sign for c in hinges} == {-1, 1}


def test_a_slide_that_is_blocked_one_way_opens_the_other_way() -> None:
    assert (first := candidates_of("blocked", TO_THE_RIGHT)[0]).is_free
    assert first.opening_motion.axis == pytest.approx(-X)


def test_a_hinge_on_the_side_of_the_handle_ranks_below_the_other_side() -> None:
    assert candidates_of("left", HANDLE_SIDE)[0].is_free
    found = shown("left", HANDLE_SIDE, JointAppearance.HINGE_ALONG)
    upright = [c.motion.origin[0] for c in found if c.motion.kind is JointType.REVOLUTE and c.vertical > 0.9]
    assert upright[0] == pytest.approx(0.6, abs=0.03)  # away from the handle
    assert min(upright) < 0.02  # the answered motion can still be chosen


@pytest.mark.parametrize("most", [2, 3, 6])
@pytest.mark.parametrize("asked", [HANDLE_SIDE, FAR_SIDE, BEYOND, BELOW], ids=["handle", "far", "beyond", "below"])
def test_a_free_answer_or_one_that_looks_like_it_stays_among_them(asked: Motion, most: int) -> None:
    first = candidates_of("left", asked)[0]
    found = shown("left", asked, JointAppearance.SLIDE_OUT, most)  # as if the answer contradicted its own kind
    assert first.is_free
    assert len(found) <= most
    assert any(apart(first, c, case_of("left")) <= 1.3 for c in found)


def test_an_answer_that_repeats_a_line_of_the_part_takes_its_place_from_no_other() -> None:
    without = shown("left", None, JointAppearance.HINGE_ALONG)
    repeated = shown("left", without[0].motion, JointAppearance.HINGE_ALONG)
    assert [c.motion.source for c in repeated] == [c.motion.source for c in without]


def test_what_was_answered_speaks_for_motions_of_its_kind() -> None:
    turns = {kind for kind in JointAppearance if kind.is_rotation}
    for c in candidates_of("drawer"):
        kinds = {kind for kind in JointAppearance if kind is not JointAppearance.FIXED and fits(c, kind)}
        slides = {JointAppearance.SLIDE_OUT if abs(c.motion.axis @ Y) > 0.7 else JointAppearance.SLIDE_ALONG}
        assert kinds == (turns if c.motion.kind is JointType.REVOLUTE else slides)


def test_pictures_show_as_much_of_a_motion_as_is_free_and_no_more_than_is_clear() -> None:
    free, stuck = (shown_amount(candidates_of("left", asked)[0], case_of("left")) for asked in (FAR_SIDE, THROUGH))
    assert (free, stuck) == pytest.approx((MAX_SHOWN_ANGLE_RAD, BLOCKED_SHOWN_RATIO * MAX_SHOWN_ANGLE_RAD))


def test_a_button_is_shown_pressed() -> None:
    case = the_case({"base": [box((0, 0, 0), (0.6, 0.4, 0.3))], "key": [box((0.29, -0.006, 0.14), (0.31, 0.001, 0.16))]})
    found = make_offers(replace(case, answer=KindAnswer(JointAppearance.SLIDE_OUT)), MOST, 0)
    into = next(c for c in found.motions if c.motion.kind is JointType.PRISMATIC and c.outward < -0.9)
    table = found.table((found.motions.index(into),))
    assert table.motions[0].transform(table.amounts[0])[:3, 3] @ Y > 0  # into the block
