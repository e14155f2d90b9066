"""SAM in ONNX files, end to end on small models that the test writes."""

import sys

import numpy as np
import pytest

pytest.importorskip("onnx")
pytest.importorskip("onnxruntime")

from sam_graphs import RADII, SIDE, decoder, encoder, pair

from anymesh.errors import MissingExtraError, ModelError
from anymesh.prompted.grounding.sam import AutomaticMasks, Frame, PromptedSegmenter, automatic_masks
from anymesh.prompted.grounding.sam_onnx_ import OnnxSam, load_sam

KINDS = ["sam", "sam2", "hf-sam", "hf-sam2"]
HEIGHT, WIDTH = 90, 160
POINTS = np.array([[40.0, 30], [100, 70], [10, 10]])


def picture(seed=0):
    return np.random.default_rng(seed).integers(0, 255, (HEIGHT, WIDTH, 3), dtype=np.uint8)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("batch", [1, "n"])
def test_a_disc_is_where_the_point_is(kind, batch, tmp_path):
    model = OnnxSam(*pair(tmp_path, kind, batch=batch))
    assert isinstance(model, PromptedSegmenter)
    assert model.frame == Frame(SIDE, padded=kind in ("sam", "hf-sam"))
    logits, scores = model.predict(model.embed(picture()), POINTS)
    assert logits.shape == (3, 3, SIDE // 4, SIDE // 4)
    np.testing.assert_allclose(scores, [[0.9, 0.95, 0.85]] * 3)
    upscale = model.frame.upscaler(logits.shape[-2:], HEIGHT, WIDTH)
    rows, columns = model.frame.inner(HEIGHT, WIDTH)
    inside = upscale(logits[1, 0]) > 0
    y, x = np.nonzero(inside)
    half = 0.5 * np.array([WIDTH / columns, HEIGHT / rows])  # the model's point is the middle of its pixel
    np.testing.assert_allclose([x.mean() + 0.5, y.mean() + 0.5], POINTS[1] + half, atol=0.7)
    area = np.pi * RADII[0] ** 2 * 16 * (HEIGHT / rows) * (WIDTH / columns)
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
    assert all(p.mask.shape == (HEIGHT, WIDTH) and p.mask.any() for p in found)


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
