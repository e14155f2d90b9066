"""Errors of joints against values worked out by hand."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from anymesh.evaluation.metrics import angle_error, distance_at, line_distance, range_iou, same_motion
from anymesh.types import JointType

X, Y, Z = np.eye(3)
number = st.floats(-3, 3)
points = st.tuples(number, number, number).map(np.array)
axes = points.filter(lambda v: np.linalg.norm(v) > 0.1).map(lambda v: v / np.linalg.norm(v))


@pytest.mark.parametrize("degrees", [0, 1e-5, 1, 30, 60, 90])
@pytest.mark.parametrize("sign", [1, -1])
def test_angle_is_told_whatever_the_sign(degrees: float, sign: int) -> None:
    a = np.deg2rad(degrees)
    assert angle_error(Z, sign * np.array([np.sin(a), 0, np.cos(a)])) == pytest.approx(degrees, abs=1e-9)


def test_an_angle_beyond_a_right_one_counts_from_the_other_end() -> None:
    a = np.deg2rad(120)
    assert angle_error(X, np.array([np.cos(a), np.sin(a), 0])) == pytest.approx(60)


def test_distance_of_lines() -> None:
    assert line_distance(np.zeros(3), X, np.array([5, 7, 2.0]), Y) == pytest.approx(2)  # skew: only z is between them
    assert line_distance(np.zeros(3), X, np.array([5, 3, 4.0]), -X) == pytest.approx(5)  # parallel: 3, 4, 5
    assert line_distance(np.zeros(3), X, np.array([5, 0, 0.0]), Y) == pytest.approx(0)  # they cross


def test_nearly_parallel_hinges_far_apart_are_far_apart() -> None:
    a = np.deg2rad(0.5)
    crossing_far_away = np.array([np.cos(a), np.sin(a), 0])
    assert line_distance(np.zeros(3), X, np.array([0, 0.4, 0]), crossing_far_away) == pytest.approx(0.4)


@given(points, axes, points, axes, number, number)
def test_distance_does_not_depend_on_the_points_that_name_the_lines(p, a, q, b, s, t) -> None:
    if np.linalg.norm(np.cross(a, b)) < 0.1:
        return
    expected = line_distance(p, a, q, b)
    assert line_distance(p + s * a, -a, q + t * b, b) == pytest.approx(expected, abs=1e-6)
    assert line_distance(q, b, p, a) == pytest.approx(expected, abs=1e-6)


def test_an_axis_that_only_crosses_the_true_one_is_seen_at_the_part() -> None:
    center = np.array([0.3, 0, 2.0])
    assert line_distance(np.zeros(3), X, np.zeros(3), Z) == pytest.approx(0)
    assert distance_at(center, np.zeros(3), X, np.zeros(3), Z) == pytest.approx(2)
    assert distance_at(center, np.array([0, 0.1, 9]), -Z, np.array([0, 0, -5.0]), Z) == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("a", "b", "expected"),
    [
        ((0.0, 1.0), (0.0, 1.0), 1),
        ((0.0, 1.0), (0.0, 2.0), 0.5),
        ((-1.0, 1.0), (0.0, 3.0), 0.25),
        ((0.0, 1.0), (-1.0, 0.0), 0),
        ((0.0, 1.0), (2.0, 3.0), 0),
        (None, None, 1),
        (None, (0.0, 1.0), 0),
        ((0.0, 1.0), None, 0),
    ],
)
def test_overlap_of_ranges(a, b, expected: float) -> None:
    assert range_iou(a, b) == pytest.approx(expected)


def test_only_turning_types_move_alike() -> None:
    alike = {(a, b) for a in JointType for b in JointType if a is not b and same_motion(a, b)}
    assert alike == {(JointType.REVOLUTE, JointType.CONTINUOUS), (JointType.CONTINUOUS, JointType.REVOLUTE)}
    assert all(same_motion(a, a) for a in JointType)
