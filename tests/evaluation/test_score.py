"""An asset against the truth: the truth is perfect, nothing is worth nothing, and each fault is told as itself."""

import itertools
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from assets import cabinet
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, TrueJoint
from anymesh.evaluation.score import ObjectScore, failed, match_parts, part_ious, score
from anymesh.types import Asset, Joint, JointType, Part, Segmentation

ASSET = cabinet()
SHRUNK_AND_TURNED = np.array([[0, -0.01, 0, 1], [0.01, 0, 0, 2], [0, 0, 0.01, 3], [0, 0, 0, 1]])
tables = st.tuples(st.integers(1, 5), st.integers(1, 5)).flatmap(
    lambda shape: arrays(float, shape, elements=st.floats(0, 1).map(lambda v: round(v, 3)))
)


def truth_of(asset: Asset, T_asset_source: np.ndarray) -> GroundTruth:
    """The asset as the truth in the coordinates of a file that T takes to the asset frame."""
    T = np.linalg.inv(T_asset_source)
    scale = float(np.cbrt(np.linalg.det(T)))

    def one(j: Joint) -> TrueJoint:
        limits = None if j.limits is None else (j.limits[0], j.limits[1])
        if limits is not None and j.type is JointType.PRISMATIC:
            limits = (limits[0] * scale, limits[1] * scale)
        axis = T[:3, :3] @ j.axis / scale
        return TrueJoint(j.type, T[:3, :3] @ j.origin + T[:3, 3], axis, limits, child=j.child, parent=j.parent)

    s = asset.segmentation
    return GroundTruth(asset.name, Path("mesh.glb"), s.parts, s.face_part, tuple(map(one, asset.joints)))


def scored(joints=ASSET.joints, segmentation=ASSET.segmentation, T=None, truth=None) -> ObjectScore:
    T = np.eye(4) if T is None else T
    truth = truth_of(ASSET, T) if truth is None else truth
    return score(EvalSample(truth, ASSET.mesh, ASSET.segmentation.face_part, T), segmentation, tuple(joints))


def changed(child: str, **changes) -> ObjectScore:
    return scored(replace(j, **changes) if j.child == child else j for j in ASSET.joints)


def of(result: ObjectScore, part: str):
    return next(j for j in result.joints if j.part == part)


@pytest.mark.parametrize("T", [np.eye(4), SHRUNK_AND_TURNED], ids=["same frame", "other frame and unit"])
def test_the_truth_against_itself_is_perfect(T) -> None:
    result = scored(T=T)
    assert (result.predicted, result.true, result.matched, result.f1) == (3, 3, 3, 1.0)
    for j in result.joints:
        assert j.type_found is j.type_true
        assert (j.iou, j.angle, j.range_iou) == pytest.approx((1, 0, 1), abs=1e-9)
        assert j.parent_right
    assert [j.opens_right for j in result.joints] == [True, True, None]  # an endless joint opens nowhere
    assert [j.line_distance for j in result.joints] == [pytest.approx(0, abs=1e-9), None, pytest.approx(0, abs=1e-9)]
    assert [j.displacement for j in result.joints] == pytest.approx([0, 0, 0], abs=1e-9)
    assert [j.confidence for j in result.joints] == [0.9] * 3
    assert [j.found for j in result.joints] == ["door", "drawer", "knob"]
    assert (result.part_miou, result.tree_right) == (pytest.approx(1), True)
    for alike in (result.rest, result.posed, result.opened):
        assert alike is not None
        assert (alike.giou, alike.miou, alike.chamfer) == pytest.approx((1, 1, 0), abs=1e-9)


def test_nothing_found_is_worth_nothing() -> None:
    nothing = Segmentation(np.zeros(len(ASSET.mesh.faces), int), (Part("base", "base"),))
    result = scored((), nothing)
    assert (result.predicted, result.true, result.matched, result.f1) == (0, 3, 0, 0.0)
    assert all(j.iou == 0 and j.type_found is None and j.angle is None and j.range_iou is None for j in result.joints)
    assert (result.part_miou, result.tree_right) == (0, False)


def test_a_crash_is_worth_nothing() -> None:
    lost = failed(truth_of(ASSET, np.eye(4)))
    assert (lost.predicted, lost.true, lost.matched, lost.f1, lost.part_miou, lost.tree_right) == (0, 3, 0, 0.0, 0.0, False)
    assert [(j.part, j.type_true) for j in lost.joints] == [(j.child, j.type) for j in ASSET.joints]
    assert all(j.iou == 0 and j.type_found is None and j.displacement is None and not j.type_right for j in lost.joints)
    assert (lost.rest, lost.posed, lost.executable) == (None, None, None)


def test_nothing_to_find_and_nothing_found_is_right() -> None:
    assert ObjectScore("rock", (), 0, 0, 0).f1 == 1
    assert ObjectScore("rock", (), 1, 0, 0).f1 == 0


def test_swapped_types_are_told_and_their_ranges_worth_nothing() -> None:
    drawer = of(changed("drawer", type=JointType.REVOLUTE, limits=(0.0, 0.3)), "drawer")
    door = of(changed("door", type=JointType.PRISMATIC, limits=(0.0, 1.9)), "door")
    for found in (drawer, door):
        assert found.type_found is not found.type_true
        assert (found.range_iou, found.opens_right, found.line_distance) == (0.0, False, None)
        assert found.iou == 1


def test_a_turned_over_axis_keeps_its_angle_but_opens_wrongly() -> None:
    found = of(changed("door", axis=np.array([0, 0, -1.0])), "door")
    assert (found.angle, found.opens_right, found.range_iou) == (pytest.approx(0, abs=1e-9), False, 0.0)
    mended = of(changed("door", axis=np.array([0, 0, -1.0]), limits=(-1.9, 0.0)), "door")
    assert (mended.opens_right, mended.range_iou) == (True, pytest.approx(1))


def test_a_shifted_hinge_is_off_by_its_shift_and_a_shifted_slide_is_not() -> None:
    shift = np.array([0.03, 0.04, 0.5])  # .5 along the hinge does not count
    found = of(changed("door", origin=np.array([0.6, 0, 0.3]) + shift), "door")
    assert found.line_distance == found.at_part == pytest.approx(2 * 0.05 / ASSET.mesh.diagonal)
    assert of(changed("drawer", origin=np.array([9.0, 9, 9])), "drawer").line_distance is None


def test_a_wrong_parent_and_half_a_range_are_told() -> None:
    assert of(changed("knob", parent="door"), "knob").parent_right is False
    assert of(changed("drawer", limits=(0.0, 0.15)), "drawer").range_iou == pytest.approx(0.5)


def test_names_and_numbers_of_predicted_parts_do_not_matter() -> None:
    order = [0, 3, 1, 2]
    parts = tuple(Part(f"p{k}", "part") for k in range(4))
    number = np.argsort(order)
    names = {ASSET.segmentation.parts[k].name: parts[number[k]].name for k in range(4)}
    joints = [replace(j, parent=names[j.parent], child=names[j.child]) for j in ASSET.joints]
    result = scored(joints, Segmentation(number[ASSET.segmentation.face_part], parts))
    assert result.joints == scored().joints


def test_a_tree_is_right_when_each_part_is_there_once_and_hangs_where_it_should() -> None:
    assert changed("door", axis=np.array([1.0, 0, 0])).tree_right  # of motions it tells nothing
    assert not changed("knob", parent="base").tree_right
    face_part = ASSET.segmentation.face_part.copy()
    face_part[:2] = 4  # a piece of the case is a part of its own
    more = Segmentation(face_part, (*ASSET.segmentation.parts, Part("panel", "part")))
    panel = replace(ASSET.joints[0], name="p", child="panel")
    assert not scored((*ASSET.joints, panel), more).tree_right


def test_what_hangs_on_a_part_that_was_not_found_has_no_right_parent() -> None:
    kept = np.where(ASSET.segmentation.face_part == 2, 0, ASSET.segmentation.face_part)
    kept[kept == 3] = 2
    parts = tuple(ASSET.segmentation.parts[k] for k in (0, 1, 3))
    joints = [replace(j, parent="base") for j in ASSET.joints if j.child != "drawer"]
    result = scored(joints, Segmentation(kept, parts))
    assert of(result, "drawer").type_found is None
    assert of(result, "knob").parent_right is False
    assert result.part_miou == pytest.approx(2 / 3)
    assert not result.tree_right


def test_sizes_are_of_the_true_part() -> None:
    size = np.linalg.norm([0.59, 0.02, 0.575])
    for result in (scored(), scored(()), scored(T=SHRUNK_AND_TURNED)):
        assert of(result, "door").part_size == pytest.approx(2 * size / ASSET.mesh.diagonal)


def test_the_origin_is_where_the_joint_says_and_the_line_is_not() -> None:
    tilted = np.array([0, np.sin(0.1), np.cos(0.1)])
    low = of(changed("door", axis=tilted), "door")
    high = of(changed("door", axis=tilted, origin=np.array([0.6, 0, 0.3]) + 2 * tilted), "door")
    assert low.origin == pytest.approx(0, abs=1e-9)
    assert high.origin == pytest.approx(2 * 2 * np.sin(0.1) / ASSET.mesh.diagonal)
    assert low.line_distance == pytest.approx(high.line_distance, abs=1e-9)


def test_where_the_range_is_not_known_neither_side_nor_range_counts() -> None:
    truth = truth_of(ASSET, np.eye(4))
    unknown = replace(truth, joints=tuple(replace(j, limits=None, range_known=False) for j in truth.joints))
    turned = [replace(j, axis=-j.axis) for j in ASSET.joints]
    for joints in (ASSET.joints, turned):
        result = scored(joints, truth=unknown)
        for j in result.joints:
            assert (j.opens_right, j.range_iou, j.range_known) == (None, None, False)
            assert (j.angle, j.displacement) == pytest.approx((0, 0), abs=1e-9)
        assert (result.posed, result.opened) == (None, None)
        assert result.rest is not None
        assert result.tree_right


def test_a_truth_that_opens_against_its_axis_opens_there() -> None:
    truth = truth_of(ASSET, np.eye(4))
    turned = tuple(j if j.limits is None else replace(j, axis=-j.axis, limits=(-j.limits[1], 0.0)) for j in truth.joints)
    for j in scored(truth=replace(truth, joints=turned)).joints[:2]:
        assert (j.opens_right, j.range_iou, j.displacement) == (True, pytest.approx(1), pytest.approx(0, abs=1e-9))


def test_opening_both_ways_is_right_either_way() -> None:
    truth = truth_of(ASSET, np.eye(4))
    swing = replace(truth, joints=tuple(replace(j, limits=(-1.0, 1.5)) if j.child == "door" else j for j in truth.joints))
    for limits in ((0.0, 1.5), (-1.5, 0.0)):
        joints = [replace(j, limits=limits) if j.child == "door" else j for j in ASSET.joints]
        found = of(scored(joints, truth=swing), "door")
        assert (found.opens_right, found.displacement) == (True, pytest.approx(0, abs=1e-9))


def test_overlap_is_weighed_by_area() -> None:
    predicted, true = np.array([0, 1, 1, 2]), np.array([0, 1, 2, 2])
    ious = part_ious(predicted, true, np.array([5.0, 3.0, 1.0, 1.0]))
    assert ious == pytest.approx(np.array([[1, 0, 0], [0, 3 / 4, 1 / 5], [0, 0, 1 / 2]]))


@given(tables)
def test_matching_is_one_to_one_and_no_other_is_better(ious) -> None:
    pairs = match_parts(ious)
    rows, columns, values = zip(*pairs, strict=True) if pairs else ((), (), ())
    assert len(set(rows)) == len(rows)
    assert len(set(columns)) == len(columns)
    assert 0 not in rows  # the bases are not matched
    assert 0 not in columns
    assert list(values) == [ious[r, c] for r, c in zip(rows, columns, strict=True)]
    assert all(v > 0 for v in values)
    inner = ious[1:, 1:] if ious.shape[0] <= ious.shape[1] else ious[1:, 1:].T
    best = max(sum(inner[i, j] for i, j in enumerate(p)) for p in itertools.permutations(range(inner.shape[1]), len(inner)))
    assert sum(values) == pytest.approx(best)


def test_greed_is_not_enough() -> None:
    ious = np.zeros((3, 3))
    ious[1:, 1:] = [[0.9, 0.8], [0.8, 0.1]]
    assert [(r, c) for r, c, _ in match_parts(ious)] == [(1, 2), (2, 1)]
