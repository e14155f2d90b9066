"""Particulate's measures against values worked out by hand, on a plate that slides or turns on a block."""

from pathlib import Path

import numpy as np
import pytest
from assets import box, cabinet, joint, mesh_of
from hypothesis import given, settings
from hypothesis import strategies as st

from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, TrueJoint
from anymesh.evaluation.particulate_metrics import STATES, THIN, PoseMetrics, as_box, box_giou, box_iou, particulate_metrics
from anymesh.types import Joint, JointType, Motion, Part, Segmentation

X, Y, Z = np.eye(3)
MESH, LABELS = mesh_of([box((0, 0, 0), (1, 1, 0.5)), box((0, 0, 0.5), (1, 1, 0.75))])
PARTS = (Part("base", "base"), Part("plate", "part"))
ALL_ONE = Segmentation(np.zeros_like(LABELS), PARTS[:1])
SLIDE = joint("s", "prismatic", "base", "plate", (0, 0, 0), X, (0.0, 1.0))
REST = np.eye(4)
UNIT = np.array([[0, 0, 0], [1, 1, 1.0]])
sides = st.floats(0.05, 2)


def sample(joints: tuple[Joint, ...] = (SLIDE,), T=None, range_known: bool = True) -> EvalSample:
    """On the block, or on one that T took elsewhere, the truth with it."""
    T = np.eye(4) if T is None else T
    true = tuple(TrueJoint(j.type, j.origin, j.axis, j.limits, range_known, child=j.child, parent=j.parent) for j in joints)
    return EvalSample(GroundTruth("block", Path("x"), PARTS, LABELS, true), MESH.transformed(T), LABELS, T)


def alike(joints: tuple[Joint, ...], segmentation: Segmentation | None = None, truth: EvalSample | None = None) -> PoseMetrics:
    return particulate_metrics(truth or sample(), segmentation or Segmentation(LABELS, PARTS), joints)


def test_the_truth_is_alike_at_every_pose() -> None:
    result = alike((SLIDE,))
    for found in (result.rest, result.posed, result.opened):
        assert found is not None
        assert (found.giou, found.miou, found.chamfer) == pytest.approx((1, 1, 0), abs=1e-9)


def test_half_the_travel() -> None:
    found = alike((joint("s", "prismatic", "base", "plate", (9, 9, 9), X, (0.0, 0.5)),))
    ious = [(1 - s / 2) / (1 + s / 2) for s in np.linspace(0, 1, STATES)]
    assert found.opened is not None
    assert found.posed is not None
    assert (found.rest.giou, found.rest.miou, found.rest.chamfer) == pytest.approx((1, 1, 0))
    assert (found.opened.giou, found.opened.miou) == pytest.approx((2 / 3, 2 / 3))  # the base 1, the plate 1 / 3
    assert (found.posed.giou, found.posed.miou) == pytest.approx(((1 + np.mean(ious)) / 2,) * 2)
    assert 0 < found.posed.chamfer < found.opened.chamfer < 0.5**2  # no point is further than .5 from the other plate


def test_parts_without_partner_count_in_both_directions() -> None:
    found = alike((), ALL_ONE)
    giou, miou = (2 / 3 + (2 / 3 - 1) / 2) / 2, (2 / 3 + 1 / 3) / 2  # of one found part, and of two true ones
    assert (found.rest.giou, found.rest.miou) == pytest.approx((giou, miou))
    assert found.rest.chamfer > MESH.diagonal / 2 / 4  # a half of what the plate costs, that has no partner
    whole = EvalSample(GroundTruth("rock", Path("x"), PARTS[:1], ALL_ONE.face_part, ()), MESH, ALL_ONE.face_part, np.eye(4))
    back = alike((SLIDE,), truth=whole)
    assert (back.rest.giou, back.rest.miou) == pytest.approx((giou, miou))


def test_distances_are_squared_and_taken_both_ways() -> None:
    sheets = [(np.array([[0, 0, z], [1, 0, z], [1, 1, z], [0, 1, z]]), np.array([[0, 1, 2], [0, 2, 3]])) for z in (0.5, 1.0)]
    mesh, piece = mesh_of([box((0, 0, 0), (1, 1, 0.5)), *sheets])
    labels = np.array([0, 1, 0])[piece]  # the upper sheet is the base's, but was taken for the lower one's
    true = TrueJoint(SLIDE.type, np.zeros(3), Z, (0.0, 0.5), child="plate", parent="base")
    truth = EvalSample(GroundTruth("sheets", Path("x"), PARTS, labels, (true,)), mesh, labels, np.eye(4))
    slow = joint("s", "prismatic", "base", "plate", (0, 0, 0), Z, (0.0, 0.1))
    found = particulate_metrics(truth, Segmentation(np.array([0, 1, 1])[piece], PARTS), (slow,)).opened
    plate = (0.4**2 + 0.1**2) / 2 + 0.1**2  # sheets at .6 and 1.1 to the one at 1, and from there to the nearer
    base = 0.5**2 / 5  # a fifth of its true surface is the sheet above the block
    assert found is not None
    assert found.chamfer == pytest.approx((plate + base) / 2, abs=1e-3)


def test_a_plate_that_turns_the_wrong_way_is_unlike_though_its_parts_are_right() -> None:
    up = joint("t", "revolute", "base", "plate", (0, 0, 0.5), -Y, (0.0, np.pi / 2))
    down = joint("t", "revolute", "base", "plate", (0, 0, 0.5), Y, (0.0, np.pi / 2))
    found = alike((down,), truth=sample((up,)))
    assert found.rest.giou == pytest.approx(1)
    assert found.opened is not None
    assert found.posed is not None
    assert found.opened.giou < 0.5  # the base 1, the plate below 0
    assert found.opened.giou < found.posed.giou < 1


def test_names_and_numbers_of_parts_do_not_matter() -> None:
    renamed = Segmentation(1 - LABELS, (Part("a", "x"), Part("b", "x")))
    other = joint("s", "prismatic", "b", "a", (0, 0, 0), X, (0.0, 1.0))
    found = alike((other,), renamed)
    assert found.opened is not None
    assert (found.rest.giou, found.opened.giou) == pytest.approx((1, 1))


def test_size_place_and_quarter_turns_do_not_matter() -> None:
    T = np.array([[0, -7.0, 0, 1], [7, 0, 0, 2], [0, 0, 7, 3], [0, 0, 0, 1]])
    half = joint("s", "prismatic", "base", "plate", (9, 9, 9), X, (0.0, 0.5))
    moved = joint("s", "prismatic", "base", "plate", (9, 9, 9), Y, (0.0, 3.5))
    here, there = alike((half,)), alike((moved,), truth=sample(T=T))
    for a, b in zip((here.rest, here.posed, here.opened), (there.rest, there.posed, there.opened), strict=True):
        assert a is not None
        assert b is not None
        assert (a.giou, a.miou, a.chamfer) == pytest.approx((b.giou, b.miou, b.chamfer), abs=1e-9)


def test_without_known_ranges_there_is_no_motion_to_compare() -> None:
    found = alike((SLIDE,), truth=sample(range_known=False))
    assert (found.posed, found.opened) == (None, None)
    assert found.rest.giou == pytest.approx(1)


def test_what_is_carried_moves_with_what_carries_it() -> None:
    asset = cabinet()
    true = tuple(TrueJoint(j.type, j.origin, j.axis, j.limits, child=j.child, parent=j.parent) for j in asset.joints)
    s = asset.segmentation
    truth = EvalSample(GroundTruth("c", Path("x"), s.parts, s.face_part, true), asset.mesh, s.face_part, np.eye(4))
    loose = [joint("turn", "continuous", "base", "knob", (0.3, -0.04, 0.8), (0, -1, 0), None)]
    found = particulate_metrics(truth, s, (*asset.joints[:2], *loose))  # the knob stays where the drawer leaves it
    assert found.opened is not None
    assert found.rest.giou == pytest.approx(1)
    assert found.opened.giou < (3 + 0) / 4  # the knob is .3 from where it belongs, and .04 long


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
