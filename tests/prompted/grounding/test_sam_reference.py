"""Our automatic masks against segment-anything's own, on the same logits and on the same small random model.

    pip install torch==2.13.0 segment-anything onnx onnxruntime && pytest -m slow tests/prompted/grounding

segment-anything takes box suppression from torchvision. Where that does not load (its wheels want the CUDA build of
torch) ONNX Runtime's NonMaxSuppression stands in: not ours either.
"""

import importlib
import sys
import types
import warnings

import numpy as np
import pytest

from anymesh.prompted.grounding.sam import AutomaticMasks, Frame, automatic_masks, mask_box, point_grid, stability
from anymesh.prompted.grounding.sam_onnx_ import OnnxSam

pytestmark = pytest.mark.slow
SIDE = 128
SIZES = [(90, 160), (160, 90), (128, 128), (301, 77)]


def stand_in() -> dict[str, types.ModuleType]:
    """torchvision's three functions that segment-anything uses."""
    import torch
    from onnx import TensorProto, helper
    from PIL import Image

    runtime = pytest.importorskip("onnxruntime")
    kinds = {"boxes": TensorProto.FLOAT, "scores": TensorProto.FLOAT, "most": TensorProto.INT64, "iou": TensorProto.FLOAT}
    shapes = {"boxes": [1, "n", 4], "scores": [1, 1, "n"], "most": [1], "iou": [1]}
    graph = helper.make_graph(
        [helper.make_node("NonMaxSuppression", list(kinds), ["kept"])],
        "nms",
        [helper.make_tensor_value_info(name, kinds[name], shapes[name]) for name in kinds],
        [helper.make_tensor_value_info("kept", TensorProto.INT64, ["k", 3])],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 11)], ir_version=9)
    session = runtime.InferenceSession(model.SerializeToString(), providers=["CPUExecutionProvider"])

    def batched_nms(boxes, scores, _, iou_threshold):
        feeds = {"boxes": boxes.numpy()[None], "scores": scores.numpy()[None, None], "iou": np.array([iou_threshold])}
        feeds = {name: value.astype(np.float32) for name, value in feeds.items()}
        return torch.from_numpy(session.run(None, feeds | {"most": np.array([len(boxes)])})[0][:, 2].copy())

    boxes, functional = types.ModuleType("torchvision.ops.boxes"), types.ModuleType("torchvision.transforms.functional")
    boxes.batched_nms = batched_nms
    boxes.box_area = lambda b: (b[:, 2] - b[:, 0]) * (b[:, 3] - b[:, 1])
    functional.to_pil_image = Image.fromarray
    functional.resize = lambda image, size: image.resize(size[::-1], Image.Resampling.BILINEAR)
    names = ["torchvision", "torchvision.ops", "torchvision.transforms"]
    return {n: types.ModuleType(n) for n in names} | {boxes.__name__: boxes, functional.__name__: functional}


@pytest.fixture(scope="module")
def reference():
    pytest.importorskip("torch")
    pytest.importorskip("onnx")
    try:
        importlib.import_module("torchvision")
        return pytest.importorskip("segment_anything")
    except Exception:
        for name in [n for n in sys.modules if n.split(".")[0] == "torchvision"]:
            del sys.modules[name]
    modules = stand_in()
    sys.modules |= modules
    try:
        return pytest.importorskip("segment_anything")
    finally:  # Transformers looks for torchvision too
        for name in modules:
            del sys.modules[name]


def logits(seed: int, smooth: bool, count: int = 6, low: int = 32) -> np.ndarray:
    from scipy.ndimage import gaussian_filter

    noise = np.random.default_rng(seed).normal(0, 1, (count, low, low))
    if smooth:
        noise = gaussian_filter(noise, (0, 3, 3))
        noise *= 8 / np.abs(noise).max()
    return noise.astype(np.float32)


def small_sam(reference, seed=0):
    import torch

    modeling = reference.modeling
    torch.manual_seed(seed)
    encoder = modeling.ImageEncoderViT(
        img_size=SIDE,
        embed_dim=32,
        depth=2,
        num_heads=2,
        out_chans=32,
        window_size=4,
        global_attn_indexes=(1,),
        use_rel_pos=True,
    )
    grid = (SIDE // 16, SIDE // 16)
    prompts = modeling.PromptEncoder(embed_dim=32, image_embedding_size=grid, input_image_size=(SIDE, SIDE), mask_in_chans=4)
    transformer = modeling.TwoWayTransformer(depth=2, embedding_dim=32, mlp_dim=64, num_heads=2)
    decoder = modeling.MaskDecoder(transformer_dim=32, transformer=transformer, num_multimask_outputs=3, iou_head_hidden_dim=32)
    sam = modeling.Sam(encoder, prompts, decoder).eval()
    with torch.no_grad():  # at random small weights all masks are alike; larger ones give shapes with edges
        for mlp in decoder.output_hypernetworks_mlps:
            mlp.layers[-1].weight *= 40
        decoder.iou_prediction_head.layers[-1].weight *= 4
        prompts.pe_layer.positional_encoding_gaussian_matrix *= 2
    return sam


def picture(height, width, seed=0):
    from scipy.ndimage import gaussian_filter

    noise = gaussian_filter(np.random.default_rng(seed).normal(0, 1, (height, width, 3)), (8, 8, 0))
    return np.clip(128 + 90 * noise / np.abs(noise).max(), 0, 255).astype(np.uint8)


@pytest.mark.parametrize("smooth", [False, True])
def test_stability_and_boxes(reference, smooth):
    import torch

    amg = reference.utils.amg
    for seed in range(20):
        found = logits(seed, smooth)
        expected = amg.calculate_stability_score(torch.from_numpy(found), 0.0, 1.0).numpy()
        np.testing.assert_allclose([stability(one, 1.0) for one in found], expected, rtol=1e-6)
        boxes = amg.batched_mask_to_box(torch.from_numpy(found > 2)).numpy()
        assert [mask_box(one > 2) for one in found] == [tuple(box) for box in boxes.tolist()]


@pytest.mark.parametrize(("height", "width"), SIZES)
def test_grids_and_the_frame(reference, height, width):
    amg = reference.utils.amg
    transform = reference.utils.transforms.ResizeLongestSide(SIDE)
    np.testing.assert_allclose(point_grid(7), amg.build_point_grid(7), atol=1e-12)
    frame, points = Frame(SIDE, padded=True), np.random.default_rng(0).uniform(0, 70, (9, 2))
    np.testing.assert_allclose(frame.points(points, height, width), transform.apply_coords(points, (height, width)), atol=1e-9)
    np.testing.assert_array_equal(frame.resize(picture(height, width)), transform.apply_image(picture(height, width)))


@pytest.mark.parametrize("smooth", [False, True])
@pytest.mark.parametrize(("height", "width"), SIZES)
def test_upscaling_and_padding_removal(reference, height, width, smooth, record_property):
    import torch
    from torch.nn import functional

    sam, frame = small_sam(reference), Frame(SIDE, padded=True)
    low = logits(1, smooth)
    expected = sam.postprocess_masks(torch.from_numpy(low)[None], frame.inner(height, width), (height, width))[0].numpy()
    found = np.stack([frame.upscaler(low.shape[-2:], height, width)(one) for one in low])
    record_property("largest difference", float(np.abs(found - expected).max()))
    np.testing.assert_allclose(found, expected, atol=2e-5)
    # SAM 2 stretches: one resize, from the low resolution to the picture
    expected = functional.interpolate(torch.from_numpy(low)[None], (height, width), mode="bilinear")[0].numpy()
    stretched = Frame(SIDE, padded=False).upscaler(low.shape[-2:], height, width)
    np.testing.assert_allclose(np.stack([stretched(one) for one in low]), expected, atol=2e-5)


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
        pred_iou_thresh=settings["min_score"],
        stability_score_thresh=settings["min_stability"],
        box_nms_thresh=settings.get("nms_iou", 0.7),
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


@pytest.mark.parametrize(("height", "width"), SIZES[:2])
def test_the_kept_set_on_the_same_logits(reference, height, width):
    sam, image = blobs(reference), picture(height, width)
    settings = {"min_score": 0.88, "min_stability": 0.85, "points_per_side": 12}
    expected = kept(reference, sam, image, **settings)
    found = automatic_masks(Wrapped(reference.SamPredictor(sam)), image, settings=AutomaticMasks(**settings))
    same(found, expected, pixels=0, close=1e-6, least=10)


def test_the_references_own_onnx_export_gives_the_same_masks(reference, tmp_path):
    """The small model, exported by segment-anything's SamOnnxModel, through our ONNX adapter."""
    import torch

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
    settings = {"points_per_side": 6, "min_score": 0.0, "min_stability": 0.0, "nms_iou": 1.0}
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
