"""Overlap of boxes against values worked out by hand."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from anymesh.evaluation.boxes import THIN, as_box, box_giou, box_iou
from anymesh.types import JointType, Motion

REST = np.eye(4)
UNIT = np.array([[0, 0, 0], [1, 1, 1.0]])


def shifted(x: float, y: float = 0, z: float = 0) -> np.ndarray:
    T = np.eye(4)
    T[:3, 3] = x, y, z
    return T


def turned(degrees: float, origin=(0.5, 0.5, 0.5)) -> np.ndarray:
    return Motion(JointType.REVOLUTE, np.array([0, 0, 1.0]), np.array(origin, float), "test").transform(np.deg2rad(degrees))


def test_axis_aligned_boxes() -> None:
    assert box_iou(UNIT, UNIT) == 1
    assert box_iou(UNIT, UNIT + np.array([0.5, 0, 0])) == pytest.approx(1 / 3)
    assert box_iou(UNIT, UNIT + np.array([2, 0, 0])) == 0


@pytest.mark.parametrize(
    ("T", "expected"),
    [
        (REST, 1),
        (shifted(0.5), 1 / 3),  # no air in the box round both
        (shifted(1), 0),
        (shifted(3), -0.5),  # two of four
        (shifted(1, 1), -0.5),
        (shifted(999), -0.998),
    ],
)
def test_generalized_iou(T: np.ndarray, expected: float) -> None:
    assert box_giou(UNIT, T, UNIT, REST) == pytest.approx(expected)
    assert box_giou(UNIT, REST, UNIT, T) == pytest.approx(expected)


def test_boxes_that_are_turned_against_each_other() -> None:
    octagon = 2 * (np.sqrt(2) - 1)  # of a square and itself turned by 45 degrees
    iou, hull = octagon / (2 - octagon), 2.0
    expected = iou - (hull - (2 - octagon)) / hull
    assert box_giou(UNIT, turned(45), UNIT, REST) == pytest.approx(expected, abs=0.01)
    assert box_giou(UNIT, turned(90), UNIT, REST) == pytest.approx(1, abs=0.01)


def test_boxes_that_have_parted_are_unlike() -> None:
    door = np.array([[0, 0, 0], [1, 0.05, 1.0]])
    assert box_giou(door, turned(90, (0, 0, 0)), door, turned(-90, (0, 0, 0))) < 0


def test_a_sheet_is_like_itself() -> None:
    sheet = as_box(np.array([[0, 0, 0], [1, 1, 0.0]]))
    assert sheet[1, 2] - sheet[0, 2] == pytest.approx(THIN)
    assert box_iou(sheet, sheet) == 1
    assert box_giou(sheet, turned(30), sheet, turned(30)) == pytest.approx(1)


sides = st.floats(0.05, 2)


@settings(max_examples=50)
@given(st.tuples(*[sides] * 6).map(np.array), st.floats(-180, 180), st.tuples(*[st.floats(-2, 2)] * 3))
def test_it_is_symmetric_bounded_and_the_same_in_every_frame(size, degrees, shift) -> None:
    a, b = np.array([np.zeros(3), size[:3]]), np.array([np.zeros(3), size[3:]])
    A = shifted(*shift) @ turned(degrees)
    value = box_giou(a, A, b, REST)
    assert -1 <= value <= 1
    assert box_giou(b, REST, a, A) == pytest.approx(value, abs=1e-9)
    frame = turned(33, (1, 2, 3)) @ shifted(4, 5, 6)
    assert box_giou(a, frame @ A, b, frame) == pytest.approx(value, abs=0.02)
    assert box_giou(a, A, a, A) == pytest.approx(1)
