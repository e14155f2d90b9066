"""Test the equivariance of oriented boxes and round outlines."""

import numpy as np
import pytest
import trimesh
from assets import box
from hypothesis import given, settings
from hypothesis import strategies as st
from rigid import apply, move, shape_of
from scipy.spatial.transform import Rotation

from anymesh.geometry.boxes import box_in_frame, dominant_normals, fit_box, within
from anymesh.geometry.circles import fit_circle, outline_about, roundest
from anymesh.types.triangles import corner_bounds, cross, meet_box

SIZE = np.array([0.3, 2.0, 0.9])
SORTED = np.array([2.0, 0.9, 0.3]) / 2
SCALES = (1e-3, 1.0, 40.0)


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("seed", range(5))
def test_a_turned_box_is_found_exactly(seed, scale):
    T = move(seed)
    T[:3] *= scale
    found = shape_of(box(-SIZE / 2, SIZE / 2), T=T).box
    np.testing.assert_allclose(found.half, SORTED * scale, rtol=1e-6)
    np.testing.assert_allclose(found.center, T[:3, 3], atol=1e-6 * scale)
    np.testing.assert_allclose(np.abs(found.axes @ T[:3, :3] / scale), np.eye(3)[[1, 2, 0]], atol=1e-6)
    np.testing.assert_allclose(found.diagonal, np.linalg.norm(SIZE) * scale)


@given(st.integers(0, 10**6))
@settings(max_examples=40, deadline=None)
def test_any_box_is_tight_sorted_right_handed_and_invertible(seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(30, 3)) * rng.uniform(0.01, 2, 3)
    normals = rng.normal(size=(30, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    for found in (fit_box(points, normals, rng.random(30)), box_in_frame(points, move(seed)[:3, :3])):
        np.testing.assert_allclose(found.axes @ found.axes.T, np.eye(3), atol=1e-9)
        assert np.linalg.det(found.axes) > 0
        assert (np.diff(found.half) <= 1e-12).all()
        local = found.local(points)
        np.testing.assert_allclose(local.max(0), found.half, atol=1e-9)
        np.testing.assert_allclose(local.min(0), -found.half, atol=1e-9)
        np.testing.assert_allclose(found.world(local), points, atol=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_frames_tried_one_at_a_time_give_the_same_box(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(seed)
    points, normals = rng.normal(size=(40, 3)) @ np.diag(rng.uniform(0.1, 2, 3)), rng.normal(size=(40, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    together = fit_box(points, normals, np.ones(40))
    monkeypatch.setattr("anymesh.geometry.boxes.BLOCK", 1)
    one_by_one = fit_box(points, normals, np.ones(40))
    for name in ("center", "axes", "half"):
        np.testing.assert_array_equal(getattr(together, name), getattr(one_by_one, name))


def test_the_fitted_box_is_never_much_larger_than_the_upright_one():
    for seed in range(10):
        ball = trimesh.creation.icosphere(subdivisions=1)
        points = apply(move(seed), ball.vertices * [1, 0.6, 0.2])
        found = fit_box(points, ball.face_normals, ball.area_faces)
        assert found.half.prod() <= np.ptp(points, axis=0).prod() / 8 * 1.01


@pytest.mark.parametrize(("degrees", "own"), [(0.3, False), (10.0, True)])
def test_the_upright_frame_is_kept_unless_another_is_clearly_tighter(degrees, own):
    T = np.eye(4)
    T[:3, :3] = Rotation.from_rotvec([0, 0, np.deg2rad(degrees)]).as_matrix()
    found = shape_of(box((-1, -0.8, -0.6), (1, 0.8, 0.6)), T=T).box
    np.testing.assert_allclose(found.axes, T[:3, :3].T if own else np.eye(3), atol=1e-9)


def test_a_flat_plate_has_a_flat_box():
    corners = np.array([[0.0, 0, 0], [4, 0, 0], [4, 1, 0], [0, 1, 0]])
    T = move(11)
    found = fit_box(apply(T, corners), T[None, :3, 2], np.ones(1))
    np.testing.assert_allclose(found.half, [2, 0.5, 0], atol=1e-9)


def test_dominant_normals_are_sign_free_and_heaviest_first():
    T = move(4)
    normals = np.repeat(T[:3, :3].T, [2, 6, 4], axis=0)
    signs = np.r_[1, -1, 1, -1, 1, -1, 1, -1, np.ones(4)][:, None]  # the heaviest only if both signs count
    found = dominant_normals(normals * signs, np.ones(12))
    np.testing.assert_allclose(np.abs(found @ T[:3, :3]), np.eye(3)[[1, 2, 0]], atol=1e-9)
    heavier = dominant_normals(normals, np.r_[9, np.ones(11)], count=1)
    np.testing.assert_allclose(np.abs(heavier @ T[:3, 0]), [1], atol=1e-9)
    assert dominant_normals(normals, np.zeros(12)).shape == (0, 3)
    slopes = np.array([[0.49, -1, 0], [0.51, -1, 0]])  # on both sides of the threshold for the sign
    slopes /= np.linalg.norm(slopes, axis=1, keepdims=True)
    np.testing.assert_allclose(np.abs(dominant_normals(slopes, np.ones(2))[0] @ [-2, -1, 0]), 0, atol=1e-3)


@given(
    st.tuples(st.floats(-50, 50), st.floats(-50, 50)), st.floats(0.1, 20), st.floats(1.0, 2 * np.pi), st.floats(0, 2 * np.pi)
)
def test_a_circle_is_found_from_any_arc(center, radius, length, start):
    t = start + np.linspace(0, length, 25)
    found, r = fit_circle(np.array(center) + radius * np.c_[np.cos(t), np.sin(t)])
    np.testing.assert_allclose(found, center, atol=1e-5 * radius)
    np.testing.assert_allclose(r, radius, rtol=1e-5)


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("seed", range(4))
def test_a_wheel_is_round_about_its_axle_only(seed, scale):
    T = move(seed)
    T[:3] *= scale
    axes = T[:3, :3].T / scale
    wheel = trimesh.creation.cylinder(radius=0.8, height=0.3, sections=72)
    found = roundest(apply(T, wheel.vertices), axes)
    np.testing.assert_allclose(np.abs(found.axis), np.abs(axes[2]))
    np.testing.assert_allclose(found.center, T[:3, 3], atol=1e-6 * scale)
    np.testing.assert_allclose([found.radius, found.height], np.array([0.8, 0.3]) * scale, rtol=1e-3)
    assert found.roundness == 1
    assert outline_about(apply(T, wheel.vertices), axes[0]).roundness < 0.5


def test_a_dent_in_the_rim_and_points_within_it_do_not_move_the_center() -> None:
    t = np.linspace(0, 2 * np.pi, 144, endpoint=False)
    rim = np.c_[np.cos(t), np.sin(t), np.zeros(144)]
    rim[:12] *= 0.8  # three of 36 directions
    within = np.random.default_rng(0).uniform(-0.5, 0.5, (500, 3)) * [1, 1, 0]
    found = outline_about(np.concatenate([within, rim, within]), np.array([0.0, 0, 1]))
    np.testing.assert_allclose(found.center, 0, atol=1e-9)
    assert (found.radius, found.roundness) == (pytest.approx(1), pytest.approx(33 / 36))


def test_a_wheel_with_a_handle_keeps_its_center_and_a_square_is_not_round():
    t = np.linspace(0, 2 * np.pi, 144, endpoint=False)
    rim = np.c_[np.cos(t), np.sin(t), np.zeros(144)]
    grip = np.array([[1.1, 0.02, 0], [1.1, -0.02, 0]])
    found = outline_about(np.array([3, 4, 5]) + np.concatenate([rim, grip]), np.array([0.0, 0, 1]))
    np.testing.assert_allclose(found.center, [3, 4, 5], atol=0.01)
    assert 0.9 < found.roundness < 1
    square = rim / np.abs(rim).max(1, keepdims=True)
    assert outline_about(square, np.array([0.0, 0, 1])).roundness < 0.6


def test_within_tells_what_lies_in_a_box_borders_included():
    points = np.random.default_rng(0).integers(-3, 4, (200, 3)).astype(float)
    low, high = np.array([-1.0, -2.0, 0.0]), np.array([2.0, 2.0, 3.0])
    np.testing.assert_array_equal(within(points, low, high), ((points >= low) & (points <= high)).all(1))
    assert within(points[:0], low, high).shape == (0,)


@pytest.mark.parametrize("seed", range(5))
def test_boxes_of_triangles_meet_a_box_unless_they_are_apart_along_some_axis(seed: int) -> None:
    triangles, (low, high) = np.random.default_rng(seed).normal(size=(60, 3, 3)), (np.full(3, -0.2), np.full(3, 0.3))
    lowest, highest = corner_bounds(triangles)
    np.testing.assert_array_equal(lowest, triangles.min(1))
    np.testing.assert_array_equal(highest, triangles.max(1))
    apart = ((triangles.min(1) > high) | (triangles.max(1) < low)).any(1)
    assert 0 < apart.sum() < 60
    np.testing.assert_array_equal(meet_box(triangles, low, high), ~apart)
    touching = np.array([[[0.3, 0, 0], [0.4, 0, 0], [0.4, 0.1, 0]]])
    assert meet_box(touching, low, high).tolist() == [True]


def test_the_cross_product_is_that_of_numpy():
    for a, b in np.random.default_rng(0).normal(size=(20, 2, 3)):
        np.testing.assert_array_equal(cross(a, b), np.cross(a, b))
