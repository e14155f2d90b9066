"""Test that motions are rigid, and that cameras project points to the pixels that show them."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from anymesh.types import JointType, Motion, StatedJoint
from anymesh.types.camera import Camera

SEEDS = st.integers(0, 10**6)


def motion(seed: int, kind: JointType) -> Motion:
    rng = np.random.default_rng(seed)
    axis = rng.normal(size=3)
    return Motion(kind, axis / np.linalg.norm(axis), rng.uniform(-2, 2, 3), "test")


@given(SEEDS, st.sampled_from((JointType.REVOLUTE, JointType.PRISMATIC)), st.floats(-4, 4), st.floats(-4, 4))
def test_motions_are_rigid_and_add_up(seed, kind, a, b):
    m = motion(seed, kind)
    T = m.transform(a)
    np.testing.assert_allclose(T[:3, :3] @ T[:3, :3].T, np.eye(3), atol=1e-9)
    assert np.linalg.det(T[:3, :3]) > 0
    np.testing.assert_allclose(T @ m.transform(b), m.transform(a + b), atol=1e-9)
    np.testing.assert_array_equal(m.transforms(np.array([a, b])), [T, m.transform(b)])


@given(SEEDS)
def test_the_distance_of_points_from_the_axis_is_the_radius_of_their_turn(seed):
    turn, points = motion(seed, JointType.REVOLUTE), np.random.default_rng(seed + 1).uniform(-3, 3, (5, 3))
    half = points @ turn.transform(np.pi)[:3, :3].T + turn.transform(np.pi)[:3, 3]
    np.testing.assert_allclose(turn.distance(points), np.linalg.norm(half - points, axis=1) / 2, atol=1e-9)


@given(SEEDS, st.floats(-3, 3))
def test_a_turn_follows_the_right_hand_and_a_slide_the_axis(seed, amount):
    turn, slide = motion(seed, JointType.REVOLUTE), motion(seed, JointType.PRISMATIC)
    np.testing.assert_allclose(turn.transform(amount)[:3, :3], Rotation.from_rotvec(amount * turn.axis).as_matrix(), atol=1e-9)
    on_axis = np.r_[turn.origin + 1.7 * turn.axis, 1]
    np.testing.assert_allclose(turn.transform(amount) @ on_axis, on_axis, atol=1e-9)
    np.testing.assert_allclose(slide.transform(amount) @ on_axis, on_axis + np.r_[amount * slide.axis, 0], atol=1e-9)


@given(SEEDS, st.booleans(), st.sampled_from((JointType.REVOLUTE, JointType.PRISMATIC)), st.floats(0.1, 10))
def test_a_stated_joint_moves_what_its_mesh_holds_in_any_frame(seed, mirrored, kind, size):
    stated = motion(seed, kind)
    joint = StatedJoint(kind, stated.origin, 3 * stated.axis, (-0.5, 1.2), name="lid")
    T = np.eye(4)
    T[:3, :3] = Rotation.random(random_state=seed).as_matrix() * size * np.array([-1 if mirrored else 1, 1, 1])
    T[:3, 3] = (1, 2, 3)
    moved = joint.transformed(T)
    assert moved.limits is not None
    assert moved.opening_motion.transform(moved.limits[1]) @ T == pytest.approx(T @ stated.transform(1.2), abs=1e-9)
    assert moved.opening_motion.transform(moved.limits[0]) @ T == pytest.approx(T @ stated.transform(-0.5), abs=1e-9)


def test_an_axis_is_a_unit_vector():
    with pytest.raises(ValueError, match=r"length 2\.0"):
        Motion(JointType.REVOLUTE, np.array([0, 0, 2.0]), np.zeros(3), "test")


@given(SEEDS, st.floats(0.1, 2.5), st.integers(1, 9), st.integers(1, 9))
def test_what_a_ray_meets_projects_to_the_middle_of_its_pixel(seed, fov, width, height):
    rng = np.random.default_rng(seed)
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = Rotation.random(random_state=seed).as_matrix(), rng.uniform(-9, 9, 3)
    camera = Camera(T, fov, width, height)
    origins, directions = camera.rays()
    depth = rng.uniform(0.1, 50, len(origins))
    pixel, found = camera.project(origins + depth[:, None] * directions)
    np.testing.assert_allclose(found, depth, rtol=1e-6)
    row, column = np.divmod(np.arange(width * height), width)
    np.testing.assert_allclose(pixel, np.c_[column, row] + 0.5, atol=1e-6)
    assert (camera.project(origins - depth[:, None] * directions)[1] < 0).all()


@given(SEEDS)
def test_a_camera_sees_its_target_in_the_middle_and_up_is_up(seed):
    eye, target = np.random.default_rng(seed).uniform(-5, 5, (2, 3))
    eye[0] = target[0] + 1.0  # not straight above it
    camera = Camera.looking_at(eye, target, 0.7, 80, 60)
    R = camera.T_world_camera[:3, :3]
    np.testing.assert_allclose(R.T @ R, np.eye(3), atol=1e-9)
    assert np.linalg.det(R) > 0
    pixel, depth = camera.project(target + np.array([[0, 0, 0], [0, 0, 0.01]]))
    np.testing.assert_allclose(pixel[0], [40, 30], atol=1e-6)
    assert depth[0] == pytest.approx(np.linalg.norm(target - eye))
    assert pixel[1, 1] < 30
    assert pixel[1, 0] == pytest.approx(40, abs=1e-6)
    edge = target + np.tan(0.35) * depth[0] * R[:, 1]
    np.testing.assert_allclose(camera.project(edge[None])[0], [[40, 60]], atol=1e-6)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_camera_may_look_straight_down_and_up(sign):
    camera = Camera.looking_at(np.array([1, 2, 5.0 * sign]), np.array([1, 2, 0.0]), 0.7, 80, 60)
    np.testing.assert_allclose(camera.project(np.array([[1, 2, 0.0]]))[0], [[40, 30]], atol=1e-9)
    assert np.linalg.det(camera.T_world_camera[:3, :3]) == pytest.approx(1)


@pytest.mark.parametrize("wrong", [{"fov": 0.0}, {"fov": np.pi}, {"fov": np.nan}, {"width": 0}, {"height": -1}])
def test_a_camera_needs_a_view_and_a_size(wrong):
    with pytest.raises(ValueError, match=str(next(iter(wrong.values())))):
        replace(Camera(np.eye(4), 0.5, 8, 8), **wrong)
