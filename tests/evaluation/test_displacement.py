"""How far points are from where they belong, against values worked out by hand."""

import numpy as np
import pytest
from assets import joint
from hypothesis import given
from hypothesis import strategies as st

from anymesh.evaluation.displacement import displacement
from anymesh.evaluation.ground_truth import TrueJoint
from anymesh.types import Joint, JointType

X, Y, Z = np.eye(3)
DOOR = np.array([[x, 0, z] for x in (0.0, 0.5, 1.0) for z in (0.0, 1.0)])  # its hinge is Z
REACH = np.abs(DOOR[:, 0]).mean()


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


numbers = st.tuples(*[st.floats(-2, 2)] * 3).map(np.array)


@given(numbers, numbers.filter(lambda v: np.linalg.norm(v) > 0.1), st.floats(-3, 3), st.floats(0.1, 10))
def test_it_does_not_depend_on_the_frame_and_grows_with_the_object(shift, axis, angle, scale) -> None:
    K = np.cross(np.eye(3), axis / np.linalg.norm(axis))
    R = np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K
    ours, theirs = found(axis=X + Z, origin=(0.3, 0.1, 0)), true()
    there = joint("j", "revolute", "base", "door", scale * R @ ours.origin + shift, R @ ours.axis, ours.limits)
    moved = TrueJoint(theirs.type, shift, R @ theirs.axis, theirs.limits, child="door", parent="base")
    value = displacement(scale * DOOR @ R.T + shift, there, moved, 1.0)
    assert value == pytest.approx(scale * apart(ours, theirs))
