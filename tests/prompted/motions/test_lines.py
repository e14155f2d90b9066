"""Test candidate points, and the decoding of picks to planes, lines and opening directions."""

import warnings

import numpy as np
import pytest
from assets import box
from hypothesis import given, settings
from hypothesis import strategies as st
from known import KNOWN, the_case
from scenes import drawer
from scipy.spatial import KDTree
from scipy.spatial.distance import pdist
from scipy.spatial.transform import Rotation

from anymesh.geometry.triangle_set import sample_surface
from anymesh.prompted.motions.lines import (
    MAX_POINTS,
    MIN_LABEL_DISTANCE,
    axis_points,
    cluster_points,
    hinge,
    plane_normal,
    prismatic,
    superpoint_centres,
    surface_directions,
    with_more,
)
from anymesh.prompted.motions.offers import opening_slide
from anymesh.types import JointType, Motion
from anymesh.types.camera import Camera

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


def across(scale: float):
    """Return a picture of x and z with this many pixels per metre."""
    return lambda points: points[:, [0, 2]] * scale


def camera(seed: int):
    """Return a random view around the unit cube."""
    rng = np.random.default_rng(seed)
    eye = rng.normal(size=3)
    eye *= rng.uniform(1.5, 6) / np.linalg.norm(eye)
    found = Camera.looking_at(eye, np.zeros(3), np.deg2rad(60), 640, 640)
    return lambda points: found.project(points)[0]


def cloud(seed: int, count: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return rng.uniform(-0.5, 0.5, (count, 3)) * rng.uniform(0.01, 1, 3)


@pytest.fixture(autouse=True, scope="module")
def quick() -> None:
    """Keep numbers as far apart as in full pictures."""


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10**6), st.integers(1, 300))
def test_numbers_keep_apart_and_points_are_middles_of_the_contact(seed: int, count: int) -> None:
    contact, project = cloud(seed, count), camera(seed)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = cluster_points(contact, project)
    assert 1 <= len(found) <= MAX_POINTS
    nearest = KDTree(found).query(contact)[1]
    for k, point in enumerate(found):
        assert point == pytest.approx(contact[nearest == k].mean(0), abs=0.1 * np.ptp(contact))
    assert pdist(project(found)).min(initial=np.inf) >= MIN_LABEL_DISTANCE * (1 - 1e-6)
    assert np.array_equal(found, cluster_points(contact, project))


@pytest.mark.parametrize(("length", "count"), [(34, 1), (36, 2), (69, 2), (71, 3), (141, 5), (5000, 20)])
def test_as_many_points_are_kept_as_have_room(length: float, count: int) -> None:
    """Clusters of a few pixels are evenly spaced along a line, so that another one would be too close."""
    ends = np.linspace(0, 1, count)
    contact = np.concatenate([np.c_[ends, 0 * ends, d + 0 * ends] for d in (-1e-4, 0, 1e-4)])
    found = cluster_points(contact, across(length))
    assert np.sort(found[:, 0]) == pytest.approx(ends)


def test_of_points_behind_one_another_one_is_kept() -> None:
    contact = np.array([[0, 0, 0], [0, 1, 0], [0, 2, 0]], float)
    assert len(cluster_points(contact, across(100))) == 1


def test_the_picture_that_is_shown_decides() -> None:
    contact = cloud(3, 200)
    counts = [len(cluster_points(contact, across(scale))) for scale in (10, 200, 2000)]
    assert counts[0] < counts[1] < counts[2]


def test_many_contacts_are_thinned_and_still_cover_all() -> None:
    contact = np.c_[np.linspace(0, 1, 20_001), np.zeros((20_001, 2))]
    found = cluster_points(contact, across(140))[:, 0]
    assert len(found) >= 3
    assert np.ptp(found) > 0.6


CORNERS, FACES = box((0, 0, 0), (1, 1, 1))
CUBE = CORNERS[FACES]


def centres(colors: np.ndarray | None = None, count: int = 1200) -> np.ndarray:
    samples = sample_surface(CUBE, count, 0)
    return superpoint_centres(samples, np.zeros((count, 3)) if colors is None else colors)


def test_a_box_has_a_superpoint_a_side() -> None:
    found = centres()
    assert len(found) == 6
    middles = np.concatenate([0.5 + 0.5 * np.eye(3), 0.5 - 0.5 * np.eye(3)])
    far, side = KDTree(middles).query(found)
    assert sorted(side) == list(range(6))
    assert far.max() < 0.1


def test_superpoint_centres_are_samples_of_the_surface() -> None:
    assert KDTree(sample_surface(CUBE, 1200, 0).points).query(centres())[0].max() == 0


def test_a_patch_of_another_colour_has_one_of_its_own() -> None:
    points = sample_surface(CUBE, 1200, 0).points
    patch = (points[:, 2] == 1) & (points[:, 0] < 0.5)
    found = centres(np.where(patch[:, None], 1.0, 0.0) * np.ones(3))
    assert len(found) == 7
    assert sum((found[:, 2] == 1) & (found[:, 0] < 0.5)) == 1


@pytest.mark.parametrize("count", [1, 2, 5])
def test_few_samples_have_a_centre_too(count: int) -> None:
    assert len(centres(count=count)) <= count


def test_more_points_are_added_in_their_order_where_they_have_room() -> None:
    first = np.array([[0.0, 0, 0], [1, 0, 0]])
    more = np.array([[0.1, 0, 0.1], [0.5, 0, 0], [0.6, 0, 0.1], [0.5, 0, 0.5]])
    found = with_more(first, more, across(100))
    assert len(found) == 4
    assert np.array_equal(found[2:], more[[1, 3]])  # the others are too close to earlier ones


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6))
def test_the_first_points_take_half_of_the_places_at_most(seed: int) -> None:
    first, more = cloud(seed, 20), cloud(seed + 1, 60)
    found = with_more(first, more, across(10_000))
    assert len(found) <= MAX_POINTS
    ours = KDTree(first).query(found)[0] == 0
    assert ours.sum() == MAX_POINTS // 2


def test_a_ring_of_contact_has_its_middle_as_a_candidate_and_not_a_point_of_the_ring() -> None:
    turn = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    ring = np.c_[np.cos(turn), 0 * turn, np.sin(turn)]
    assert cluster_points(ring, across(20)) == pytest.approx(np.zeros((1, 3)), abs=1e-9)


def test_axes_into_the_surface_are_points_where_they_come_out() -> None:
    context = the_case(KNOWN["wheel"].scene).context
    hub, off = (Motion(JointType.REVOLUTE, Y, np.array([x, 0.3, 0.2]), "hub") for x in (0.0, 0.05))
    along = Motion(JointType.REVOLUTE, np.array([1.0, 0, 0]), np.zeros(3), "along")
    points, axes = axis_points(context, [hub, along, off, hub], across(2000))
    # neither one along the surface, nor a duplicate
    assert points[:, [0, 2]] == pytest.approx(np.array([[0, 0.2], [0.05, 0.2]]))
    assert points[:, 1] == pytest.approx(context.part.bounds[0 if context.opening_direction @ Y < 0 else 1, 1])
    assert np.abs(axes @ Y) == pytest.approx(1)
