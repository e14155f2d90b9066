"""Errors of joints, and how far their points are from where they belong, against values worked out by hand."""

import numpy as np
import pytest
from assets import joint
from hypothesis import given
from hypothesis import strategies as st

from anymesh.evaluation.ground_truth import TrueJoint
from anymesh.evaluation.score import (
    angle_error,
    displacement,
    distance_at,
    line_distance,
    opening_side,
    opens_both_ways,
    point_distance,
    range_iou,
    same_motion,
)
from anymesh.types import Joint, JointType

X, Y, Z = np.eye(3)
number = st.floats(-3, 3)
points = st.tuples(number, number, number).map(np.array)
axes = points.filter(lambda v: np.linalg.norm(v) > 0.1).map(lambda v: v / np.linalg.norm(v))
tilts = st.sampled_from([0.0, 1e-6, 0.3, 0.9, 1.1, 5.0, 40.0, 90.0])
DOOR = np.array([[x, 0, z] for x in (0.0, 0.5, 1.0) for z in (0.0, 1.0)])  # its hinge is Z
REACH = np.abs(DOOR[:, 0]).mean()
numbers = st.tuples(*[st.floats(-2, 2)] * 3).map(np.array)


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


def tilted(degrees: float) -> np.ndarray:
    """X, turned towards Y."""
    return np.array([np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees)), 0])


@pytest.mark.parametrize("degrees", [0, 1e-7, 0.01, 0.5, 0.99])
@pytest.mark.parametrize("sign", [1, -1])
def test_nearly_parallel_hinges_far_apart_are_far_apart(degrees: float, sign: int) -> None:
    crossing_far_away = sign * tilted(degrees)
    assert line_distance(np.zeros(3), X, np.array([0, 0.4, 0]), crossing_far_away) == pytest.approx(0.4, abs=1e-3)


def test_at_the_part_nothing_jumps_where_the_published_figure_does() -> None:
    hinge, center = np.array([0, 0.4, 0]), np.array([0.1, 0.2, 0])
    steps = np.linspace(0, 3, 301)
    published = np.array([line_distance(np.zeros(3), X, hinge, tilted(d), center) for d in steps])
    at_part = np.array([distance_at(center, np.zeros(3), X, hinge, tilted(d)) for d in steps])
    assert np.abs(np.diff(at_part)).max() < 1e-3
    assert at_part == pytest.approx(0.4, abs=0.01)
    assert published[steps < 0.999] == pytest.approx(at_part[steps < 0.999], abs=1e-3)
    assert published[steps > 1.001] == pytest.approx(0, abs=1e-12)  # as the field has it: they cross, if 20 m away


@given(points, axes, points, axes, points, tilts, st.tuples(number, number))
def test_distance_does_not_depend_on_the_points_that_name_the_lines(p, a, q, other, c, degrees, shifts) -> None:
    s, t = shifts
    side = np.cross(a, other)
    if np.linalg.norm(side) < 0.1:
        return
    side, angle = side / np.linalg.norm(side), np.deg2rad(degrees)
    b = np.cos(angle) * a + np.sin(angle) * side
    expected = line_distance(p, a, q, b, c)
    assert line_distance(p + s * a, -a, q + t * b, b, c) == pytest.approx(expected, abs=1e-6)
    assert line_distance(q, b, p, a, c) == pytest.approx(expected, abs=1e-6)


@given(st.tuples(points, axes), st.tuples(points, axes), points, axes, st.floats(-3, 3), st.floats(0.01, 100))
def test_errors_turn_shift_and_scale_with_the_object(line, other, c, axis, angle, scale) -> None:
    (p, a), (q, b) = line, other
    K = np.cross(np.eye(3), axis)
    R = np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K

    def moved(point: np.ndarray) -> np.ndarray:
        return scale * R @ point + (1, 2, 3)

    assert angle_error(R @ a, R @ b) == pytest.approx(angle_error(a, b), abs=1e-6)
    if abs(angle_error(a, b) - 1) > 1e-6:
        ours = line_distance(moved(p), R @ a, moved(q), R @ b, moved(c))
        assert ours == pytest.approx(scale * line_distance(p, a, q, b, c), abs=1e-5 * scale)
    ours = distance_at(moved(c), moved(p), R @ a, moved(q), R @ b)
    assert ours == pytest.approx(scale * distance_at(c, p, a, q, b), abs=1e-6 * scale)


def test_distance_of_a_point_from_a_line() -> None:
    assert point_distance(np.array([3, 4, 9.0]), np.array([0, 0, -2.0]), Z) == pytest.approx(5)


@pytest.mark.parametrize(
    ("limits", "side", "both"),
    [
        ((0.0, 1.0), 1, False),
        ((-1.0, 0.0), -1, False),
        ((-0.4, 1.0), 1, False),
        ((-1.0, 0.6), -1, True),
        ((-1.0, 1.0), 1, True),
        (None, 1, True),
    ],
)
def test_a_joint_opens_where_its_range_is_larger(limits, side: int, both: bool) -> None:
    assert (opening_side(limits), opens_both_ways(limits)) == (side, both)


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
    turning = (JointType.REVOLUTE, JointType.CONTINUOUS, JointType.SCREW)
    assert alike == {(a, b) for a in turning for b in turning if a is not b}
    assert all(same_motion(a, a) for a in JointType)


def true(kind="revolute", axis=Z, limits: tuple[float, float] | None = (0.0, 1.5), **more) -> TrueJoint:
    return TrueJoint(JointType(kind), np.zeros(3), np.asarray(axis, float), limits, child="door", parent="base", **more)


def found(kind="revolute", axis=Z, limits: tuple[float, float] | None = (0.0, 1.5), origin=(0, 0, 0)) -> Joint:
    return joint("j", kind, "base", "door", origin, axis, limits)


def chord(degrees: float) -> float:
    """Of a point at distance 1."""
    return 2 * np.sin(np.deg2rad(degrees) / 2)


def apart(ours: Joint, theirs: TrueJoint) -> float:
    return displacement(DOOR, ours, theirs, 1.0)


def test_the_same_motion_is_nowhere_off() -> None:
    assert apart(found(), true()) == 0
    assert apart(found(origin=(0, 0, 7)), true()) == pytest.approx(0, abs=1e-12)
    assert apart(found(axis=-Z, limits=(-1.5, 0.0)), true()) == pytest.approx(0, abs=1e-12)
    assert apart(found("prismatic", X, (0.0, 0.1)), true("prismatic", X, (0.0, 0.4))) == 0  # half the true travel, for both


def test_a_wrong_opening_side_is_twice_the_angle() -> None:
    wrong = apart(found(axis=-Z), true())
    assert wrong == pytest.approx(REACH * chord(60))
    assert apart(found(limits=(-1.5, 0.0)), true()) == pytest.approx(wrong)
    assert apart(found("prismatic", -X, (0.0, 0.4)), true("prismatic", X, (0.0, 0.4))) == pytest.approx(0.4)


def test_a_hinge_on_the_other_side_shows_though_its_lines_do_not_differ_much() -> None:
    assert apart(found(origin=(0.2, 0, 0)), true()) == pytest.approx(0.2 * chord(30))
    assert apart(found(origin=(1, 0, 0)), true()) == pytest.approx(chord(30))


def test_another_type_moves_as_its_kind_does() -> None:
    turned = chord(30) * np.abs(DOOR[:, 0])  # true: along the chord; found: half its own 0.6 along y
    angle = np.deg2rad(15)
    expected = np.hypot(turned * np.cos(angle) - 0.3, turned * np.sin(angle)).mean()
    assert apart(found("prismatic", Y, (0.0, 0.6)), true()) == pytest.approx(expected)
    assert apart(found("fixed", limits=None), true()) == pytest.approx(REACH * chord(30))  # it stays
    half = apart(found(), true("prismatic", Y, (0.0, 0.6)))
    assert half == pytest.approx(expected)


@pytest.mark.parametrize(
    "theirs", [true(limits=None, range_known=False), true("continuous", limits=None), true(limits=(-1.0, 1.0))]
)
@pytest.mark.parametrize("axis", [Z, -Z])
def test_where_no_side_is_the_opening_one_the_better_counts(theirs: TrueJoint, axis: np.ndarray) -> None:
    assert apart(found(axis=axis), theirs) == pytest.approx(0, abs=1e-12)


def test_a_travel_that_is_not_known_is_told_by_the_size_of_the_part() -> None:
    unknown = true("prismatic", X, None, range_known=False)
    assert displacement(DOOR, found("prismatic", Y, (0.0, 9.0)), unknown, 0.8) == pytest.approx(0.4 * np.sqrt(2))


@given(numbers, numbers.filter(lambda v: np.linalg.norm(v) > 0.1), st.floats(-3, 3), st.floats(0.1, 10))
def test_it_does_not_depend_on_the_frame_and_grows_with_the_object(shift, axis, angle, scale) -> None:
    K = np.cross(np.eye(3), axis / np.linalg.norm(axis))
    R = np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K
    ours, theirs = found(axis=X + Z, origin=(0.3, 0.1, 0)), true()
    there = joint("j", "revolute", "base", "door", scale * R @ ours.origin + shift, R @ ours.axis, ours.limits)
    moved = TrueJoint(theirs.type, shift, R @ theirs.axis, theirs.limits, child="door", parent="base")
    value = displacement(scale * DOOR @ R.T + shift, there, moved, 1.0)
    assert value == pytest.approx(scale * apart(ours, theirs))
