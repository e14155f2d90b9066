"""An answer is one more hypothesis: what cannot move is dropped, what moves is shown, and no two motions look alike."""

from functools import cache

import numpy as np
import pytest
from assets import box
from known import KNOWN, the_case
from scenes import Scene, door

from anymesh.articulation.cases import Case
from anymesh.articulation.limits import opening_motion
from anymesh.articulation.verify import ALIKE, SHOWN_TURN, feasible, fits, is_free, shown_amount, weighed
from anymesh.reasoning.prompting import JointKind
from anymesh.reasoning.questions import Candidate, PartFacts
from anymesh.types import Motion, MotionKind

X, Y, Z = np.eye(3)
MOST = 6
NAMES = ["left", "drawer", "lid", "slider", "wheel"]


def turn(axis: np.ndarray, origin) -> Motion:
    return Motion(MotionKind.TURN, axis, np.asarray(origin, float), "picked")


@cache
def case_of(name: str) -> Case:
    return the_case(blocked_door() if name == "blocked" else KNOWN[name].scene)


@cache
def candidates_of(name: str, asked: Motion | None = None) -> tuple[PartFacts, tuple[Candidate, ...]]:
    return weighed(case_of(name).around, "part", asked)


def shown(name: str, asked: Motion | None, kind: JointKind, most: int = MOST) -> list[Candidate]:
    """The motions that would be shown."""
    return feasible(case_of(name).around, *candidates_of(name, asked), kind, most)[0]


def moved(c: Candidate, case: Case) -> np.ndarray:
    T = opening_motion(c).transform(shown_amount(c, case.around))
    points = case.around.part.samples.points[::20]
    return points @ T[:3, :3].T + T[:3, 3] - points


def apart(a: Candidate, b: Candidate, case: Case) -> float:
    """How differently two motions move a part, as a share of the smaller way."""
    ways = moved(a, case), moved(b, case)
    least = min(float(np.linalg.norm(way, axis=1).mean()) for way in ways)
    return float(np.linalg.norm(ways[0] - ways[1], axis=1).mean()) / least


@pytest.mark.parametrize("name", NAMES)
def test_the_motions_shown_are_free_few_and_look_different(name: str) -> None:
    found = shown(name, None, JointKind.HINGE_ALONG)
    assert 1 <= len(found) <= MOST
    assert all(is_free(c) for c in found)
    for k, c in enumerate(found):
        assert all(apart(c, other, case_of(name)) > 0.9 * ALIKE for other in found[:k])


@pytest.mark.parametrize("kind", JointKind)
@pytest.mark.parametrize("name", NAMES)
def test_the_true_motion_is_among_them_whatever_was_answered(name: str, kind: JointKind) -> None:
    true = KNOWN[name].joint.motion
    assert any(c.motion.kind is true.kind and abs(c.motion.axis @ true.axis) > 0.999 for c in shown(name, None, kind))


def blocked_door() -> Scene:
    """A door beside a wall at its right."""
    scene = door("left")
    return {**scene, "base": [*scene["base"], box((0.602, -0.7, 0), (0.64, 0.4, 0.8))]}


GRIP_SIDE = turn(Z, (0.002, -0.012, 0))  # of the door, whose grip is at its left
FAR_SIDE = turn(Z, (0.598, -0.012, 0))
THROUGH = turn(Z, (0.3, 0.2, 0))  # in the middle of the case: the leaf would be swung through its sides
BEYOND = turn(Z, (0.7, -0.012, 0))
BELOW = turn(X, (0.3, -0.022, 0.002))
TO_THE_RIGHT = Motion(MotionKind.SLIDE, X, np.array([0.3, -0.012, 0.4]), "picked")
UP = Motion(MotionKind.SLIDE, Z, np.zeros(3), "picked")


@pytest.mark.parametrize(
    ("name", "asked", "kind"),
    [("left", THROUGH, JointKind.HINGE_ALONG), ("slider", UP, JointKind.SLIDE_ALONG)],
    ids=["an axis that runs through the walls", "a slide into the rails"],
)
def test_what_cannot_move_is_dropped(name: str, asked: Motion, kind: JointKind) -> None:
    first = candidates_of(name, asked)[1][0]
    assert (first.role, first.motion) == ("asked", asked)
    assert not is_free(first)
    assert "asked" not in {c.role for c in shown(name, asked, kind)}


def test_a_slide_that_is_blocked_one_way_opens_the_other_way() -> None:
    first = candidates_of("blocked", TO_THE_RIGHT)[1][0]
    assert is_free(first)
    assert opening_motion(first).axis == pytest.approx(-X)


def test_a_hinge_on_the_side_of_the_grip_comes_behind_the_other_side() -> None:
    assert is_free(candidates_of("left", GRIP_SIDE)[1][0])
    found = shown("left", GRIP_SIDE, JointKind.HINGE_ALONG)
    upright = [c.motion.origin[0] for c in found if c.motion.kind is MotionKind.TURN and c.vertical > 0.9]
    assert upright[0] == pytest.approx(0.6, abs=0.03)  # away from the grip
    assert min(upright) < 0.02  # what was answered can still be chosen


@pytest.mark.parametrize("most", [2, 3, 6])
@pytest.mark.parametrize("asked", [GRIP_SIDE, FAR_SIDE, BEYOND, BELOW], ids=["grip", "far", "beyond", "below"])
def test_a_free_answer_or_one_that_looks_like_it_stays_among_them(asked: Motion, most: int) -> None:
    first = candidates_of("left", asked)[1][0]
    found = shown("left", asked, JointKind.SLIDE_OUT, most)  # as if the answer went against its own kind
    assert is_free(first)
    assert len(found) <= most
    assert any(apart(first, c, case_of("left")) <= 1.3 * ALIKE for c in found)


def test_an_answer_that_repeats_a_line_of_the_part_takes_its_place_from_no_other() -> None:
    without = shown("left", None, JointKind.HINGE_ALONG)
    repeated = shown("left", without[0].motion, JointKind.HINGE_ALONG)
    assert [c.motion.source for c in repeated] == [c.motion.source for c in without]


def test_what_was_answered_speaks_for_motions_of_its_kind() -> None:
    turns = {kind for kind in JointKind if kind.turns}
    for c in candidates_of("drawer")[1]:
        kinds = {kind for kind in JointKind if kind is not JointKind.FIXED and fits(c, kind)}
        slides = {JointKind.SLIDE_OUT if abs(c.motion.axis @ Y) > 0.7 else JointKind.SLIDE_ALONG}
        assert kinds == (turns if c.motion.kind is MotionKind.TURN else slides)


def test_pictures_show_as_much_of_a_motion_as_is_free_and_no_more_than_is_clear() -> None:
    free, stuck = (candidates_of("left", asked)[1][0] for asked in (FAR_SIDE, THROUGH))
    assert shown_amount(free, case_of("left").around) == pytest.approx(SHOWN_TURN)
    assert shown_amount(stuck, case_of("left").around) == stuck.opening < np.deg2rad(12)
