"""Test which masks are kept against segment-anything and its own ONNX export.

    pytest -m slow tests/prompted/masks/test_sam_kept_masks.py

Requirements as in test_sam_reference.py.
"""

import importlib
import warnings

import numpy as np
import pytest
from sam_reference import SIDE, SIZES, logits, picture, small_sam

from anymesh.prompted.masks.sam import AutomaticMasks, automatic_masks
from anymesh.prompted.masks.sam_frame import Frame
from anymesh.prompted.masks.sam_masks import point_grid

pytestmark = pytest.mark.slow


def blobs(reference):
    """A Sam whose decoder draws three rough blobs about each point, each with a score of its own."""
    import torch

    class Echo(torch.nn.Module):
        def forward(self, points, boxes, masks):
            return points[0], None

        def get_dense_pe(self):
            return None

    class Blobs(torch.nn.Module):
        def forward(self, sparse_prompt_embeddings, **_):
            at = sparse_prompt_embeddings.double()  # (n, 1, 2) [px of the square]
            y, x = torch.meshgrid(*[torch.arange(SIDE // 4) * 4 + 2.0] * 2, indexing="ij")
            apart = torch.stack([x, y], -1)[None] - at[:, :, None]
            rough = torch.from_numpy(logits(7, True, 3, SIDE // 4))[None]
            size = torch.tensor([14.0, 22, 30])[None, :, None, None] + 2 * rough
            steep = 1 + torch.sin(at.sum(2))[..., None, None] ** 2  # some are stable, some are not
            masks = steep * (size - apart.norm(dim=-1)[:, None]) / 2
            scores = 0.75 + 0.25 * torch.sin(at[:, 0] @ torch.tensor([[12.9, 78.2, 37.7], [4.1, 1.7, 9.3]]).double())
            return masks.float(), scores.float()

    sam = small_sam(reference)
    sam.prompt_encoder, sam.mask_decoder = Echo(), Blobs()
    return sam


class Wrapped:
    """The reference's own predictor behind our protocol."""

    def __init__(self, predictor):
        self.predictor, self.name, self.frame = predictor, "reference", Frame(SIDE, padded=True)

    def embed(self, image):
        self.predictor.set_image(image)
        return image.shape[:2]

    def predict(self, embedding, points):
        import torch

        at = torch.as_tensor(self.predictor.transform.apply_coords(points, embedding))[:, None]
        with torch.no_grad():
            _, scores, low = self.predictor.predict_torch(at, torch.ones(at.shape[:2], dtype=torch.int), return_logits=True)
        return low.numpy(), scores.numpy()


def kept(reference, sam, image, **settings):
    generator = reference.SamAutomaticMaskGenerator(
        sam,
        points_per_side=settings["points_per_side"],
        pred_iou_thresh=settings["least_score"],
        stability_score_thresh=settings["least_stability"],
        box_nms_thresh=settings.get("nms_iou", 0.7),
        crop_n_layers=settings.get("crop_layers", 0),
        min_mask_region_area=settings.get("smallest_region", 0),
    )
    return generator.generate(image)


def same(found, expected, *, pixels: int, close: float, least: int) -> None:
    assert len(found) == len(expected)
    assert len(found) >= least
    for ours, theirs in zip(found, expected, strict=True):
        x, y, w, h = theirs["bbox"]
        assert np.abs(np.subtract(ours.box, (x, y, x + w, y + h))).max() <= pixels
        assert ours.score == pytest.approx(theirs["predicted_iou"], abs=close)
        assert ours.stability == pytest.approx(theirs["stability_score"], abs=max(close, 2e-3 * pixels))
        assert (ours.mask != theirs["segmentation"]).mean() <= 2e-3 * pixels


@pytest.mark.parametrize("more", [{}, {"crop_layers": 1}, {"smallest_region": 20}], ids=["plain", "crops", "regions"])
@pytest.mark.parametrize(("height", "width"), SIZES[:2])
def test_the_kept_set_on_the_same_logits(reference, height, width, more):
    if "smallest_region" in more:
        pytest.importorskip("cv2")
    sam, image = blobs(reference), picture(height, width)
    settings = {"least_score": 0.88, "least_stability": 0.85, "points_per_side": 12} | more
    expected = kept(reference, sam, image, **settings)
    found = automatic_masks(Wrapped(reference.SamPredictor(sam)), image, settings=AutomaticMasks(**settings))
    same(found, expected, pixels=0, close=1e-6, least=10)


def test_the_references_own_onnx_export_gives_the_same_masks(reference, tmp_path):
    """The small model, exported by segment-anything's SamOnnxModel, through our ONNX adapter."""
    import torch

    from anymesh.prompted.masks.sam_onnx_ import OnnxSam

    sam, image = small_sam(reference), picture(90, 160)
    export(reference, sam, tmp_path, SIDE)
    model = OnnxSam(tmp_path / "encoder.onnx", tmp_path / "decoder.onnx")
    assert model.frame == Frame(SIDE, padded=True)
    wrapped = Wrapped(reference.SamPredictor(sam))
    points = point_grid(4) * [160, 90]
    with torch.no_grad():
        ours, theirs = (m.predict(m.embed(image), points) for m in (model, wrapped))
    np.testing.assert_allclose(ours[0], theirs[0], atol=1e-3 * np.abs(theirs[0]).max())
    np.testing.assert_allclose(ours[1], theirs[1], atol=1e-4)
    # a random model's masks all span the picture, and one would be kept: here all are, and compared one by one
    settings = {"points_per_side": 6, "least_score": 0.0, "least_stability": 0.0, "nms_iou": 1.0}
    found = automatic_masks(model, image, settings=AutomaticMasks(**settings))
    expected = kept(reference, sam, image, **settings)
    assert len(found) == len(expected) == 6 * 6 * 3
    for theirs in expected:  # scores differ in the sixth digit, so the order may
        like = [p for p in found if abs(p.score - theirs["predicted_iou"]) < 1e-4]
        assert min((p.mask != theirs["segmentation"]).mean() for p in like) <= 2e-3


def export(reference, sam, folder, side) -> None:
    import torch

    low = side // 4
    prompts = {
        "image_embeddings": torch.randn(1, sam.prompt_encoder.embed_dim, side // 16, side // 16),
        "point_coords": torch.rand(1, 2, 2) * side,
        "point_labels": torch.tensor([[1.0, -1.0]]),
        "mask_input": torch.zeros(1, 1, low, low),
        "has_mask_input": torch.zeros(1),
        "orig_im_size": torch.tensor([side, side], dtype=torch.float),
    }
    decoder = importlib.import_module("segment_anything.utils.onnx").SamOnnxModel(sam, return_single_mask=False)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        torch.onnx.export(
            decoder,
            tuple(prompts.values()),
            folder / "decoder.onnx",
            input_names=list(prompts),
            output_names=["masks", "iou_predictions", "low_res_masks"],
            dynamic_axes={"point_coords": {1: "points"}, "point_labels": {1: "points"}},
            opset_version=17,
            dynamo=False,
        )
        torch.onnx.export(
            sam.image_encoder,
            (torch.randn(1, 3, side, side),),
            folder / "encoder.onnx",
            input_names=["images"],
            output_names=["embeddings"],
            opset_version=17,
            dynamo=False,
        )
