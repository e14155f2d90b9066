"""segment-anything as a reference, with a small random model."""

import importlib
import sys
import types

import numpy as np
import pytest

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
