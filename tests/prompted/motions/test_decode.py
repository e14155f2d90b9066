"""Test the decoding of picks: planes among outliers, lines through their points, and the opening direction of a drawer."""

import numpy as np
import pytest
from assets import box
from hypothesis import given, settings
from hypothesis import strategies as st
from known import KNOWN, the_case
from scenes import drawer
from scipy.spatial.transform import Rotation

from anymesh.prompted.motions.joints import opening_slide
from anymesh.prompted.motions.lines import hinge, plane_normal, prismatic, surface_directions
from anymesh.types import JointType

X, Y, Z = np.eye(3)
seeds = st.integers(0, 10**6)


def between(a: np.ndarray, b: np.ndarray) -> float:
    """Return the angle between two lines [deg]."""
    return float(np.degrees(np.arcsin(min(1.0, float(np.linalg.norm(np.cross(a, b)))))))


@settings(max_examples=20, deadline=None)
@given(seeds)
def test_a_plane_is_found_among_noise_and_outliers(seed: int) -> None:
    rng = np.random.default_rng(seed)
    turn = Rotation.random(random_state=seed)
    flat = np.c_[rng.uniform(-1, 1, (140, 2)), rng.normal(0, 0.001, 140)]
    points = turn.apply(np.concatenate([flat, rng.uniform(-1, 1, (60, 3))])) + rng.normal(size=3)
    found = plane_normal(points, 0.003, 0)
    assert np.linalg.norm(found) == pytest.approx(1)
    assert between(found, turn.apply(Z)) < 1


def test_the_same_points_and_seed_give_the_same_normal() -> None:
    points = np.random.default_rng(0).normal(size=(50, 3))
    assert np.array_equal(plane_normal(points, 0.01, 3), plane_normal(points, 0.01, 3))


@pytest.mark.parametrize("points", [np.zeros((1, 3)), np.zeros((9, 3)), X[None] * [[0], [1]], X * np.arange(5.0)[:, None]])
def test_points_in_no_plane_of_their_own_have_a_normal_all_the_same(points: np.ndarray) -> None:
    found = plane_normal(points, 0.001, 0)
    assert np.linalg.norm(found) == pytest.approx(1)
    assert (points - points[0]) @ found == pytest.approx(0, abs=1e-12)


@settings(max_examples=30, deadline=None)
@given(seeds, st.integers(2, 6))
def test_a_hinge_goes_through_its_points_wherever_they_are_taken(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    turn, shift = Rotation.random(random_state=seed), rng.normal(size=3)
    along = np.sort(rng.uniform(-1, 1, count)) * 3
    picked = shift + along[:, None] * turn.apply(Z)
    found = hinge(picked, X)
    assert found.kind is JointType.REVOLUTE
    assert between(found.axis, turn.apply(Z)) < 1e-4
    assert np.cross(picked - found.origin, found.axis) == pytest.approx(0, abs=1e-6)
    assert str(count) in found.source


@given(seeds)
def test_a_hinge_turns_and_moves_with_its_points(seed: int) -> None:
    rng = np.random.default_rng(seed)
    picked, turn, shift = rng.normal(size=(4, 3)) * [0.1, 0.1, 1], Rotation.random(random_state=seed), rng.normal(size=3)
    here, there = hinge(picked, X), hinge(turn.apply(picked) + shift, X)
    assert between(there.axis, turn.apply(here.axis)) < 1e-4
    assert there.origin == pytest.approx(turn.apply(here.origin) + shift)
    shuffled = hinge(picked[::-1], X)
    assert between(shuffled.axis, here.axis) < 1e-4


def test_one_point_turns_about_the_normal_through_it() -> None:
    found = hinge(np.array([[1.0, 2, 3]]), 5 * Y)
    assert found.kind is JointType.REVOLUTE
    assert found.axis == pytest.approx(Y)
    assert found.origin == pytest.approx([1, 2, 3])


def test_a_slide_goes_along_its_direction() -> None:
    case = the_case(KNOWN["slider"].scene)
    found = prismatic(-3 * X, case.context, "asked")
    assert (found.kind, found.source) == (JointType.PRISMATIC, "asked")
    assert found.axis == pytest.approx(-X)


def test_arrows_lie_in_the_surface_and_point_both_ways() -> None:
    case = the_case(KNOWN["slider"].scene)
    found = surface_directions(case.context)
    assert found @ case.context.opening_direction == pytest.approx(0, abs=1e-9)
    assert found @ found.T == pytest.approx(np.array([[1, -1, 0, 0], [-1, 1, 0, 0], [0, 0, 1, -1], [0, 0, -1, 1]]), abs=1e-9)
    assert max(found @ X) == pytest.approx(1)  # the direction of its rails is among them


def test_the_plane_normal_of_an_open_drawer_leads_sideways_and_the_free_way_out_does_not() -> None:
    """The paper's rule alone fails on real drawers, since only the box's sides and floor are near the case."""
    case = the_case(KNOWN["open drawer"].scene)
    assert between(case.shown.normal, Y) > 60
    found = opening_slide(case)
    assert between(found.axis, Y) < 2
    assert found.axis @ case.context.opening_direction > 0.99


@pytest.mark.parametrize("degrees", [0.0, -20.0])
@pytest.mark.parametrize("depth", [0.2, 0.35])
def test_the_way_out_of_a_shut_drawer_is_its_own_even_when_it_is_tilted(depth: float, degrees: float) -> None:
    a = np.deg2rad(degrees)
    found = opening_slide(the_case(drawer(depth, degrees)))
    assert found.axis == pytest.approx([0, -np.cos(a), -np.sin(a)], abs=0.03)


@pytest.mark.parametrize("size", [3.0, 0.2])
def test_the_connecting_area_of_a_small_part_is_as_large_whatever_it_sits_on(size: float) -> None:
    """On a large block samples are far apart, so that there may be none next to the plate."""
    plate = box((-0.06, -0.02, 0.06), (0.06, -0.002, 0.14))
    case = the_case({"base": [box((-size / 2, 0, 0), (size / 2, size, size))], "plate": [plate]})
    on_part = case.shown.contact[case.shown.contact[:, 1] < -1e-9]
    assert len(on_part) > 500
    assert on_part[:, 1].min() >= -2 * 0.005 * case.context.tolerance_length  # its back and the edge of its rim
    assert np.ptp(on_part[:, [0, 2]], axis=0) == pytest.approx([0.12, 0.08], rel=0.05)
    assert between(case.shown.normal, Y) < 1


def test_parts_far_apart_have_a_connecting_area_too() -> None:
    case = the_case({"base": [box((0, 0, 0), (1, 1, 1))], "moon": [box((3, 0.4, 0.4), (3.2, 0.6, 0.6))]})
    assert case.shown.contact[:, 0].min() <= 3.0  # at least its near side
    assert case.shown.contact[:, 0].max() >= 3.0
