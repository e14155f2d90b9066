"""Trajectories keep every joint within its limits, at rest at both ends, on the path."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from anymesh.applications.plan.trajectory import STEP, Curve, rounded, stand, time_curve

FREE = 1e-9


def random_path(seed: int, count: int = 6, joints: int = 3) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-1, 1, (count, joints))


@given(st.integers(0, 10_000), st.integers(2, 9), st.floats(0.1, 3), st.floats(0.2, 9))
def test_every_sample_is_within_the_limits_and_both_ends_are_at_rest(seed, count, speed, push):
    path = random_path(seed, count)
    limits = np.array([speed, 2 * speed, 0.7 * speed]), np.array([push, push, 3 * push])
    timed = time_curve(Curve(path), *limits)
    assert (np.abs(timed.velocity) <= limits[0] + FREE).all()
    assert (np.abs(timed.acceleration) <= limits[1] + FREE).all()
    np.testing.assert_allclose(timed.position[[0, -1]], path[[0, -1]], atol=1e-12)
    assert np.abs(timed.velocity[[0, -1]]).max() < 1e-12
    assert np.abs(timed.acceleration[[0, -1]]).max() < 1e-9


def test_velocity_and_acceleration_are_the_derivatives_of_position():
    timed = time_curve(Curve(random_path(3)), np.full(3, 0.5), np.full(3, 1.0))
    np.testing.assert_allclose(np.gradient(timed.position, STEP, axis=0)[1:-1], timed.velocity[1:-1], atol=2e-3)
    np.testing.assert_allclose(np.gradient(timed.velocity, STEP, axis=0)[1:-1], timed.acceleration[1:-1], atol=2e-2)


def test_a_limit_that_binds_is_used_up():
    timed = time_curve(Curve(random_path(5)), np.full(3, 0.2), np.full(3, 100.0))
    assert np.abs(timed.velocity).max() > 0.9 * 0.2


def test_a_curve_goes_through_its_postures():
    path = random_path(1)
    curve = Curve(path, np.linspace(0, 1, len(path)))
    np.testing.assert_allclose(curve.at(np.linspace(0, 1, len(path))), path, atol=1e-12)


def test_standing_does_not_move():
    timed = stand(np.array([1.0, 2.0]), 0.5)
    assert timed.time[-1] == pytest.approx(0.5)
    assert (timed.position == [1.0, 2.0]).all()
    assert not timed.velocity.any()


def test_corners_are_rounded_only_where_that_is_free():
    path = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    limits = np.ones(2), np.ones(2)

    def on_corner(posture: np.ndarray) -> bool:  # only the path itself is free
        return min(abs(posture[1]), abs(posture[0] - 1)) < 1e-3

    assert len(rounded(path, *limits, lambda posture: True)) == 1
    pieces = rounded(path, *limits, on_corner)
    assert len(pieces) == 2
    assert all(on_corner(posture) for piece in pieces for posture in piece.position)
