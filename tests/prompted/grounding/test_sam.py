"""Automatic masks of a fake model that returns the discs of its picture, and facts about single steps."""

import sys
from dataclasses import dataclass, field

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sam_graphs import RADII, SIDE, decoder, encoder, pair

from anymesh.errors import MissingExtraError, ModelError
from anymesh.prompted.grounding import sam
from anymesh.prompted.grounding.sam import (
    AutomaticMasks,
    Frame,
    PromptedSegmenter,
    automatic_masks,
    bilinear,
    box_nms,
    mask_box,
    point_grid,
    stability,
)
from anymesh.prompted.grounding.sam_onnx_ import OnnxSam, load_sam

DISCS = np.array([[40.0, 50, 18], [110, 30, 14], [100, 95, 25], [30, 110, 10]])  # x, y, radius [px]
HEIGHT, WIDTH = 130, 150


def disc_picture() -> np.ndarray:
    """Each disc has its own red; the rest is black."""
    x, y = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    image = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
    for k, (cx, cy, r) in enumerate(DISCS):
        image[np.hypot(x - cx, y - cy) < r] = (10 * (k + 1), 0, 0)
    return image


@dataclass
class Discs:
    """Answers with the pixels of the colour under the point: sharp, softly, and badly; scores differ a little by point."""

    frame: Frame = field(default_factory=lambda: Frame(256, padded=True))
    name: str = "discs"
    embedded: int = 0

    def embed(self, image):
        """(reds over the square, zero in its padding; the picture)."""
        self.embedded += 1
        height, width = image.shape[:2]
        rows, columns = self.frame.inner(height, width)
        middle = np.arange(self.frame.side // 2) * 2 + 1.0  # the logits are half as fine as the square
        y, x = (middle * height / rows).astype(int), (middle * width / columns).astype(int)
        red = np.pad(image[..., 0].astype(int), ((0, self.frame.side), (0, self.frame.side)))
        return red[np.minimum(y, height)][:, np.minimum(x, width)], image

    def predict(self, embedding, points):
        square, image = embedding
        red = image[points[:, 1].astype(int), points[:, 0].astype(int), 0].astype(int)
        sharp = np.where((square == red[:, None, None]) & (red > 0)[:, None, None], 20.0, -20.0)
        best = np.where(red > 0, 0.99 - 1e-5 * (points @ [1, WIDTH]) / 2, 0.2)
        scores = np.stack([best, np.full(len(red), 0.999), np.full(len(red), 0.5)], 1)
        return np.stack([sharp, sharp * 0.01, sharp], 1), scores


@pytest.mark.parametrize("frame", [Frame(256, True), Frame(256, False)])
def test_every_disc_is_found_once(frame):
    model = Discs(frame)
    assert isinstance(model, PromptedSegmenter)
    image = disc_picture()
    found = automatic_masks(model, image, settings=AutomaticMasks(points_per_side=16))
    assert len(found) == len(DISCS)
    assert [p.score for p in found] == sorted((p.score for p in found), reverse=True)
    for k in range(len(DISCS)):
        truth = image[..., 0] == 10 * (k + 1)
        overlap = max((p.mask & truth).sum() / (p.mask | truth).sum() for p in found)
        assert overlap > 0.93
    for p in found:
        y, x = np.nonzero(p.mask)
        assert p.box == (x.min(), y.min(), x.max(), y.max())
        assert p.stability >= 0.95


def test_batches_and_the_order_of_points_change_nothing(monkeypatch):
    image = disc_picture()
    first = automatic_masks(Discs(), image, settings=AutomaticMasks(points_per_side=12))
    grid = sam.point_grid
    monkeypatch.setattr(sam, "POINTS_PER_BATCH", 5)
    monkeypatch.setattr(sam, "point_grid", lambda n: np.random.default_rng(3).permutation(grid(n)))
    again = automatic_masks(Discs(), image, settings=AutomaticMasks(points_per_side=12))
    assert [(p.box, p.score, p.stability) for p in first] == [(p.box, p.score, p.stability) for p in again]
    for a, b in zip(first, again, strict=True):
        np.testing.assert_array_equal(a.mask, b.mask)


def test_thresholds_of_zero_keep_all():
    image = disc_picture()
    everything = AutomaticMasks(points_per_side=4, min_score=0.0, min_stability=0.0, nms_iou=1.0)
    assert len(automatic_masks(Discs(), image, settings=everything)) == 4 * 4 * 3


def test_nothing_found_is_no_error():
    assert automatic_masks(Discs(), np.zeros((20, 30, 3), np.uint8)) == []


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


pytest.importorskip("onnx")
pytest.importorskip("onnxruntime")


KINDS = ["sam", "sam2", "hf-sam", "hf-sam2"]
ROWS, COLUMNS = 90, 160
POINTS = np.array([[40.0, 30], [100, 70], [10, 10]])


def picture(seed=0):
    return np.random.default_rng(seed).integers(0, 255, (ROWS, COLUMNS, 3), dtype=np.uint8)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("batch", [1, "n"])
def test_a_disc_is_where_the_point_is(kind, batch, tmp_path):
    model = OnnxSam(*pair(tmp_path, kind, batch=batch))
    assert isinstance(model, PromptedSegmenter)
    assert model.frame == Frame(SIDE, padded=kind in ("sam", "hf-sam"))
    logits, scores = model.predict(model.embed(picture()), POINTS)
    assert logits.shape == (3, 3, SIDE // 4, SIDE // 4)
    np.testing.assert_allclose(scores, [[0.9, 0.95, 0.85]] * 3)
    upscale = model.frame.upscaler(logits.shape[-2:], ROWS, COLUMNS)
    rows, columns = model.frame.inner(ROWS, COLUMNS)
    inside = upscale(logits[1, 0]) > 0
    y, x = np.nonzero(inside)
    half = 0.5 * np.array([COLUMNS / columns, ROWS / rows])  # the model's point is the middle of its pixel
    np.testing.assert_allclose([x.mean() + 0.5, y.mean() + 0.5], POINTS[1] + half, atol=0.7)
    area = np.pi * RADII[0] ** 2 * 16 * (ROWS / rows) * (COLUMNS / columns)
    assert inside.sum() == pytest.approx(area, rel=0.1)


@pytest.mark.parametrize("kind", KINDS)
def test_automatic_masks_end_to_end(kind, tmp_path):
    model = load_sam(f"sam:{pair(tmp_path, kind)[0].parent}")
    settings = AutomaticMasks(points_per_side=5, min_stability=0.5)
    found = automatic_masks(model, picture(), settings=settings)
    again = automatic_masks(model, picture(), settings=settings)
    assert len(found) >= 20
    assert {round(p.score, 2) for p in found} <= {0.9, 0.95}
    assert all((a.mask == b.mask).all() for a, b in zip(found, again, strict=True))
    assert all(p.mask.shape == (ROWS, COLUMNS) and p.mask.any() for p in found)


def test_the_answer_depends_on_the_picture(tmp_path):
    model = OnnxSam(*pair(tmp_path, "sam"))
    one, other = (model.predict(model.embed(picture(seed)), POINTS)[0] for seed in (0, 1))
    assert np.abs(one - other).max() > 1e-3


def test_normalising_inside_the_graph_or_outside_is_the_same(tmp_path):
    outside = OnnxSam(*pair(tmp_path / "a", "sam"))
    inside = OnnxSam(*pair(tmp_path / "b", "sam", inside=True))
    a, b = (m.predict(m.embed(picture()), POINTS)[0] for m in (outside, inside))
    np.testing.assert_allclose(a, b, atol=1e-4)


def test_raw_pixels_as_bytes(tmp_path):
    model = OnnxSam(*pair(tmp_path / "a", "sam", inside=True, pixels="uint8"))
    same = OnnxSam(*pair(tmp_path / "b", "sam", inside=True))
    np.testing.assert_array_equal(*(m.predict(m.embed(picture()), POINTS)[0] for m in (model, same)))


@pytest.mark.parametrize("kind", ["sam", "hf-sam2"])
def test_of_four_masks_the_first_is_left_out(kind, tmp_path):
    three = OnnxSam(*pair(tmp_path / "a", kind))
    four = OnnxSam(*pair(tmp_path / "b", kind, masks=4))
    logits, scores = four.predict(four.embed(picture()), POINTS)
    assert logits.shape[1] == 3
    np.testing.assert_allclose(scores, three.predict(three.embed(picture()), POINTS)[1])


def test_a_batch_that_is_declared_but_wrong_is_found_out(tmp_path):
    good = OnnxSam(*pair(tmp_path / "a", "sam2", batch="n"))
    bad = OnnxSam(*pair(tmp_path / "b", "sam2", batch="n", broken=True))
    a, b = (m.predict(m.embed(picture()), POINTS)[0] for m in (good, bad))
    np.testing.assert_allclose(a, b, atol=1e-5)


def test_files_that_are_no_pair_are_told(tmp_path):
    made, _ = pair(tmp_path, "sam")
    sam2 = decoder(tmp_path / "other_decoder.onnx", "sam2")
    with pytest.raises(ModelError, match=r"the decoder takes \['has_mask_input', 'high_res_feats_0'.*valid is.*SAM 2: "):
        OnnxSam(made, sam2)
    with pytest.raises(ModelError, match="not a pair"):
        OnnxSam(sam2, made)
    with pytest.raises(ModelError, match="not a pair"):
        OnnxSam(encoder(tmp_path / "e.onnx", outputs=("image_embed", "high_res_feats_0")), sam2)
    (tmp_path / "empty.onnx").write_bytes(b"nothing")
    with pytest.raises(ModelError, match=r"empty.onnx cannot be loaded"):
        OnnxSam(tmp_path / "empty.onnx", sam2)


def test_without_onnx_runtime_the_extra_is_named(monkeypatch, tmp_path):
    files = pair(tmp_path, "sam")
    monkeypatch.setitem(sys.modules, "onnxruntime", None)
    with pytest.raises(MissingExtraError, match=r"\[sam\]"):
        OnnxSam(*files)
