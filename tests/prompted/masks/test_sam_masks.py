"""The steps of automatic masks: facts that hold for any masks."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from anymesh.prompted.masks.sam_frame import Frame, bilinear
from anymesh.prompted.masks.sam_masks import (
    box_nms,
    crop_boxes,
    cut_by_crop,
    mask_box,
    point_grid,
    stability,
    without_small_regions,
)


def random_boxes(seed: int, count: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    low = rng.integers(0, 80, (count, 2))
    return np.c_[low, low + rng.integers(0, 60, (count, 2))].astype(float), rng.permutation(count) / count


def iou(a, b) -> float:
    sides = np.minimum(a[2:], b[2:]) - np.maximum(a[:2], b[:2])
    shared = max(sides[0], 0) * max(sides[1], 0)
    union = (a[2] - a[0]) * (a[3] - a[1]) + (b[2] - b[0]) * (b[3] - b[1]) - shared
    return shared / union if union else 0.0


def test_of_identical_boxes_the_best_is_kept():
    boxes = np.tile([3.0, 4, 20, 30], (5, 1))
    assert box_nms(boxes, np.array([0.1, 0.9, 0.3, 0.9, 0.2]), 0.7).tolist() == [1]
    assert box_nms(boxes[:0], np.zeros(0), 0.7).tolist() == []


@given(st.integers(0, 10**6), st.integers(1, 40), st.sampled_from([0.0, 0.3, 0.7, 1.0]))
@settings(max_examples=60, deadline=None)
def test_suppression_keeps_what_overlaps_nothing_better_that_is_kept(seed, count, most):
    boxes, scores = random_boxes(seed, count)
    kept = box_nms(boxes, scores, most).tolist()
    assert (np.diff(scores[kept]) <= 0).all()
    for k in range(count):
        covered = any(iou(boxes[k], boxes[j]) > most for j in kept if scores[j] > scores[k])
        assert (k in kept) != covered


@given(st.integers(0, 10**6))
@settings(max_examples=30, deadline=None)
def test_suppression_does_not_depend_on_the_order(seed):
    boxes, scores = random_boxes(seed, 30)
    shuffle = np.random.default_rng(seed + 1).permutation(30)
    again = shuffle[box_nms(boxes[shuffle], scores[shuffle], 0.5)]
    assert again.tolist() == box_nms(boxes, scores, 0.5).tolist()


def test_an_overlap_of_exactly_the_threshold_is_kept():
    for n in range(1, 12):  # shared 63, union 90 and the like: 0.7 * 90 is not 63 in floating point
        boxes = np.array([[0, 0, 10 * n, 9], [0, 0, 7 * n, 9]], float)
        assert len(box_nms(boxes, np.array([1.0, 0.5]), 0.7)) == 2


def test_suppression_agrees_with_onnx_runtime():
    runtime = pytest.importorskip("onnxruntime")
    onnx = pytest.importorskip("onnx")
    from onnx import TensorProto, helper

    inputs = [
        helper.make_tensor_value_info("boxes", TensorProto.FLOAT, [1, "n", 4]),
        helper.make_tensor_value_info("scores", TensorProto.FLOAT, [1, 1, "n"]),
        helper.make_tensor_value_info("most", TensorProto.INT64, [1]),
        helper.make_tensor_value_info("iou", TensorProto.FLOAT, [1]),
    ]
    output = helper.make_tensor_value_info("kept", TensorProto.INT64, ["k", 3])
    graph = helper.make_graph(
        [helper.make_node("NonMaxSuppression", ["boxes", "scores", "most", "iou"], ["kept"])], "nms", inputs, [output]
    )
    model = onnx.helper.make_model(graph, opset_imports=[helper.make_opsetid("", 11)], ir_version=9)
    session = runtime.InferenceSession(model.SerializeToString(), providers=["CPUExecutionProvider"])
    for seed in range(20):
        boxes, scores = random_boxes(seed, 200)
        feeds = {"boxes": boxes[None], "scores": scores[None, None], "iou": np.array([0.55])}
        feeds = {k: v.astype(np.float32) for k, v in feeds.items()} | {"most": np.array([200])}
        assert session.run(None, feeds)[0][:, 2].tolist() == box_nms(boxes, scores, 0.55).tolist()


def test_a_hard_edge_is_stable_and_a_soft_one_is_not():
    disc = np.hypot(*np.mgrid[-20:21, -20:21]) < 12
    assert stability(np.where(disc, 9.0, -9.0), 1.0) == 1
    slope = 10 - np.hypot(*np.mgrid[-20:21, -20:21])
    assert stability(slope, 1.0) == pytest.approx((9 / 11) ** 2, abs=0.05)
    assert stability(np.full((4, 4), -9.0), 1.0) == 0


@given(st.tuples(st.integers(0, 30), st.integers(0, 20)), st.tuples(st.integers(0, 9), st.integers(0, 9)))
def test_the_box_of_a_rectangle_is_its_corners(start, size):
    (x, y), (w, h) = start, size
    mask = np.zeros((40, 60), bool)
    mask[y : y + h + 1, x : x + w + 1] = True
    assert mask_box(mask) == (x, y, x + w, y + h)


def test_an_empty_mask_has_an_empty_box():
    assert mask_box(np.zeros((5, 6), bool)) == (0, 0, 0, 0)


@pytest.mark.parametrize("per_side", [1, 2, 7, 32])
def test_the_grid_is_centred_and_even(per_side):
    grid = point_grid(per_side)
    assert grid.shape == (per_side**2, 2)
    np.testing.assert_allclose(grid + grid[::-1], 1)
    np.testing.assert_allclose(np.diff(grid[:per_side, 0]), 1 / per_side)


def test_crops_cover_the_picture_and_overlap():
    crops = crop_boxes(300, 500, 2, 0.3)
    assert [layer for layer, _ in crops] == [0] + [1] * 4 + [2] * 16
    for layer in (0, 1, 2):
        covered = np.zeros((300, 500), int)
        for _, (x0, y0, x1, y1) in [c for c in crops if c[0] == layer]:
            assert 0 <= x0 < x1 <= 500
            assert 0 <= y0 < y1 <= 300
            covered[y0:y1, x0:x1] += 1
        assert covered.min() >= 1
        assert covered.max() == (1 if layer == 0 else 4)


def test_a_box_that_its_crop_cut_off_is_told_from_one_at_the_pictures_edge():
    assert cut_by_crop((100, 30, 249, 90), (0, 0, 250, 150), 300, 500)
    assert not cut_by_crop((0, 0, 200, 90), (0, 0, 250, 150), 300, 500)
    assert not cut_by_crop((0, 0, 499, 299), (0, 0, 500, 300), 300, 500)


def test_small_islands_go_small_holes_fill_and_the_largest_island_stays():
    mask = np.zeros((40, 40), bool)
    mask[5:25, 5:25] = True
    mask[10:12, 10:12] = False
    mask[30:32, 30:32] = True
    cleaned, changed = without_small_regions(mask, 10)
    assert changed
    expected = np.zeros((40, 40), bool)
    expected[5:25, 5:25] = True
    np.testing.assert_array_equal(cleaned, expected)
    again, changed = without_small_regions(cleaned, 10)
    assert not changed
    np.testing.assert_array_equal(again, cleaned)
    np.testing.assert_array_equal(without_small_regions(mask, 1000)[0][5:25, 5:25], True)


SIZES = [(90, 160), (160, 90), (128, 128), (1, 200), (33, 47), (700, 500)]


@pytest.mark.parametrize("padded", [True, False])
@pytest.mark.parametrize(("height", "width"), SIZES)
def test_a_disc_in_the_logits_lands_on_its_pixels(height, width, padded):
    """The padding of a picture that is not square is removed, within a pixel of the finer of the two rasters."""
    frame, low = Frame(256, padded), 128
    center, radius = np.array([0.6 * width, 0.4 * height]), 0.2 * min(height, width)
    rows, columns = frame.inner(height, width)
    pixel = (np.stack(np.meshgrid(np.arange(low), np.arange(low)), -1) + 0.5) * frame.side / low  # in the square
    in_picture = pixel * [width / columns, height / rows]
    logits = radius - np.linalg.norm(in_picture - center, axis=-1)
    full = frame.upscaler((low, low), height, width)(logits)
    assert full.shape == (height, width)
    middle = np.stack(np.meshgrid(np.arange(width), np.arange(height)), -1) + 0.5
    expected = radius - np.linalg.norm(middle - center, axis=-1)
    coarse = max(1.0, 2 * max(height / rows, width / columns))  # [px] a pixel of the logits, in the picture
    assert not ((full > 0) != (expected > 0))[np.abs(expected) > coarse].any()
    np.testing.assert_allclose(frame.points(center[None], height, width)[0], center * [columns / width, rows / height])


def test_resizing_keeps_constants_and_is_nothing_at_the_same_size():
    np.testing.assert_allclose(bilinear(17, 40).sum(1), 1, rtol=1e-6)
    np.testing.assert_allclose(bilinear(23, 23).toarray(), np.eye(23))
    np.testing.assert_allclose(bilinear(8, 16) @ np.arange(8.0), np.clip(np.arange(16) / 2 - 0.25, 0, 7), rtol=1e-6)


def test_the_square_is_normalised_and_its_padding_is_zero():
    image = np.full((50, 100, 3), (124, 116, 104), np.uint8)
    square = Frame(64, padded=True).normalized(image)
    assert square.shape == (1, 3, 64, 64)
    assert np.abs(square).max() < 0.02
    assert (square[:, :, 32:] == 0).all()
    bright = Frame(64, padded=False).normalized(np.full((50, 100, 3), 255, np.uint8))
    np.testing.assert_allclose(bright[0, :, 63, 63], [2.2489, 2.4286, 2.64], atol=1e-3)
