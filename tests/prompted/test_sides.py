"""Motions are named by the sides of the object, as seen from its front."""

import numpy as np
import pytest

from anymesh.prompted.pictures.sides import UNNAMED, Sides, emptiest_corner, with_compass
from anymesh.types import JointType, Motion
from anymesh.types.camera import Camera

X, Y, Z = np.eye(3)
DOOR = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.06, 0.0) for z in (0.0, 1.0)])
AHEAD = Sides(0.0)  # the front is seen along +y


def turn(axis, origin) -> Motion:
    return Motion(JointType.REVOLUTE, np.asarray(axis, float), np.asarray(origin, float), "test")


def slide(axis) -> Motion:
    return Motion(JointType.PRISMATIC, np.asarray(axis, float), np.zeros(3), "test")


@pytest.mark.parametrize(
    ("motion", "amount", "words"),
    [
        (turn(-Z, (-0.5, 0, 0)), 0.9, "turns about an upright axis at its left, to the front and left"),
        (turn(Z, (0.5, 0, 0)), 0.9, "turns about an upright axis at its right, to the front and right"),
        (turn(X, (0, 0, 0)), 0.6, "turns about a left-right axis at its bottom, to the front"),
        (turn(X, (0, 0.2, 0)), 0.6, "turns beyond its bottom back, down and to the front"),
        (turn(-Y, (0, -0.03, 0.5)), 0.6, "turns about a front-back axis through its middle, in place"),
        (turn(Z, (-1.5, -0.03, 0)), 0.9, "turns about an upright axis beyond its left, to the back and left"),
        (slide(-Y), 0.3, "slides to the front"),
        (slide(-Y), -0.3, "slides to the back"),
        (slide((0.6, 0, 0.8)), 0.3, "slides up and to the right"),
    ],
)
def test_motions_are_named_from_the_front(motion, amount, words):
    assert AHEAD.words(motion, amount, DOOR) == words


@pytest.mark.parametrize(
    ("origin", "words"), [((0, 0.1, 0), "at its back, up and to the back"), ((0, 0, 0), "through its middle, in place")]
)
def test_a_long_lid_goes_up_about_its_back_edge(origin, words):
    lid = np.array([[-0.65, -0.1, -0.01], [0.65, 0.1, 0.01]])
    assert AHEAD.words(turn(-X, origin), 1.2, lid) == f"turns about a left-right axis {words}"


def test_motions_in_the_same_words_are_told_apart():
    near, same, far = (turn(-Z, (x, 0, 0)) for x in (-0.5, -0.5, -0.4))
    first = "turns about an upright axis at its left, to the front and left"
    size = np.linalg.norm(np.ptp(DOOR, axis=0))
    told = AHEAD.all_words((near, same, far), (0.9, 0.9, 0.9), DOOR)
    assert told == (first, "the same as 1", f"{first}, its axis {10 / size:.0f} % of its size further to the right")


def test_motions_the_other_way_are_called_so():
    ways, size = (slide(Y), slide(-Y), slide(X), slide(-X)), np.linalg.norm(np.ptp(DOOR, axis=0))
    told = UNNAMED.all_words(ways, (0.3, 0.1, 0.3, 0.3), DOOR)
    tilted = "slides sideways, tilted by 90 degrees"
    assert told == ("slides sideways", "slides sideways, the opposite way", tilted, "as 3, but the opposite way")
    middle = np.array([0, -0.03, 0.5])
    spins = (turn(Z, middle), turn(-Z, middle), turn(-Z, middle + 0.02 * X))
    first, other, near = UNNAMED.all_words(spins, (1.0, 1.0, 1.0), DOOR)
    assert other == f"{first}, the opposite way"
    assert near == f"{first}, its axis {2 / size:.0f} % of its size further sideways and the opposite way"


def test_the_names_turn_with_the_front_and_do_without_one():
    motion = turn(-Z, (-0.5, 0, 0))
    assert Sides(180.0).words(motion, 0.9, DOOR) == "turns about an upright axis at its right, to the back and right"
    assert UNNAMED.words(motion, 0.9, DOOR) == "turns about an upright axis off its middle, sideways"
    assert UNNAMED.words(slide(Z), 0.2, DOOR) == "slides up"


def test_the_compass_has_an_arrow_up_and_lies_where_nothing_is_covered():
    camera = Camera.looking_at(np.array([1.0, -3, 2]), np.zeros(3), 0.5, 90, 90)
    plain, full = (sides.compass(camera).astype(int) for sides in (UNNAMED, AHEAD))
    green, blue = (lambda c: (c[..., 1] > c[..., 2] + 40).sum()), (lambda c: (c[..., 2] > c[..., 1] + 60).sum())
    assert (green(plain) > 60, blue(plain)) == (True, 0)
    assert min(green(full), blue(full)) > 40
    used = np.zeros((400, 400), bool)
    used[-40:] = True
    assert emptiest_corner(used) == (False, True)
    panel = with_compass(np.zeros((400, 400, 3), np.uint8), plain.astype(np.uint8), (False, True))
    assert not panel[:66].any()  # the place of the words
