"""Small encoder and decoder pairs as ONNX files, in the interfaces that SAM exports have.

The encoder averages random projections of blocks. The decoder draws three discs about the point that it is asked for,
and stirs in a little of the embedding: what it says is known, and depends on the picture.
"""

from pathlib import Path

import numpy as np

SIDE = 128
LOW = SIDE // 4
RADII = np.array([4.0, 7.0, 10.0], np.float32)  # [px of the low resolution]
SCORES = np.array([0.9, 0.95, 0.85], np.float32)
CHANNELS = 4


def save(path: Path, nodes, inputs, outputs, constants) -> Path:
    from onnx import checker, helper, numpy_helper, save_model

    stored = [numpy_helper.from_array(np.asarray(value), name) for name, value in constants.items()]
    graph = helper.make_graph(nodes, path.stem, inputs, outputs, stored)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=9)
    checker.check_model(model)
    save_model(model, path)
    return path


def value(name, shape, kind="float"):
    from onnx import TensorProto, helper

    kinds = {"float": TensorProto.FLOAT, "uint8": TensorProto.UINT8, "int64": TensorProto.INT64, "half": TensorProto.FLOAT16}
    return helper.make_tensor_value_info(name, kinds[kind], shape)


def node(kind, inputs, outputs, **attributes):
    from onnx import helper

    return helper.make_node(kind, inputs.split(), outputs.split(), **attributes)


def encoder(path: Path, *, outputs=("image_embeddings",), inside=False, pixels="float", seed=0) -> Path:
    """inside: takes the resized picture (H, W, 3) and normalises and pads it in the graph."""
    rng = np.random.default_rng(seed)
    constants = {"W": rng.normal(0, 0.02, (CHANNELS, 3, 16, 16)).astype(np.float32)}
    nodes, name, shape, square = [], "image", [1, 3, SIDE, SIDE], "image"
    if inside:
        name, shape, square = "input_image", ["h", "w", 3], "square"
        mean = np.array([123.675, 116.28, 103.53], np.float32)
        std = np.array([58.395, 57.12, 57.375], np.float32)
        constants |= {"mean": mean, "std": std, "top": np.zeros(3, np.int64), "side": np.array([SIDE, SIDE, 3])}
        constants |= {"first": np.array([0])}
        nodes = [
            node("Cast", "input_image", "pixels", to=1),
            node("Sub", "pixels mean", "centred"),
            node("Div", "centred std", "normal"),
            node("Shape", "normal", "size"),
            node("Sub", "side size", "missing"),
            node("Concat", "top missing", "pads", axis=0),
            node("Pad", "normal pads", "padded"),
            node("Transpose", "padded", "chw", perm=[2, 0, 1]),
            node("Unsqueeze", "chw first", "square"),
        ]
    nodes.append(node("Conv", f"{square} W", outputs[0], strides=[16, 16]))
    nodes += [node("Identity", outputs[0], other) for other in outputs[1:]]
    out = [value(o, [1, CHANNELS, SIDE // 16, SIDE // 16]) for o in outputs]
    return save(path, nodes, [value(name, shape, pixels)], out, constants)


def _decoder_nodes(feature: str, prompts: str, broken: bool) -> list:
    """Return the nodes that compute `logits` and `all_scores`: a disc around each prompt's first point."""
    return [
        node("Slice", f"{prompts} zero one axis", "first"),  # the prompt's first point
        node("Reshape", "first as_one", "at"),
        node("Slice", "at zero one zero", "only"),
        node("Sub", "at only", "apart"),
        node("Sub" if broken else "Identity", "at apart" if broken else "at", "asked"),
        node("Add", "asked half", "middle"),  # as SAM's prompt encoder: a point is the middle of its pixel
        node("Div", "middle four", "low"),
        node("Sub", "pixels low", "away"),
        node("Mul", "away away", "square"),
        node("ReduceSum", "square last", "d2", keepdims=0),
        node("Unsqueeze", "d2 one", "d2m"),
        node("Sub", "r2 d2m", "disc"),
        node("Conv", f"{feature} mix", "stirred"),
        node("Resize", "stirred none ones", "stir", mode="nearest"),
        node("Add", "disc stir", "logits"),
        node("Shape", "d2", "d2shape"),
        node("Slice", "d2shape zero one", "n"),
        node("Concat", "n one", "repeat", axis=0),
        node("Tile", "scores repeat", "all_scores"),
    ]


def decoder(path: Path, kind: str, *, batch: int | str = 1, masks: int = 3, broken=False, seed=1) -> Path:
    """kind: sam, sam2, hf-sam or hf-sam2. broken: answers the first prompt for all. masks: 4 puts a useless one in front."""
    rng = np.random.default_rng(seed)
    radii, scores = RADII, SCORES
    if masks == 4:
        radii, scores = np.r_[np.float32(30), radii], np.r_[np.float32(0.99), scores]
    y, x = np.mgrid[:LOW, :LOW].astype(np.float32) + 0.5
    constants = {
        "pixels": np.stack([x, y], -1)[None],  # (1, LOW, LOW, 2)
        "four": np.float32(4),
        "half": np.float32(0.5),
        "r2": (radii**2)[None, :, None, None],
        "scores": scores[None],
        "mix": rng.normal(0, 0.3, (len(radii), CHANNELS, 1, 1)).astype(np.float32),
        "ones": np.array([1, 1, 4, 4], np.float32),
        "last": np.array([-1]),
        "as_one": np.array([-1, 1, 1, 2]),
        "zero": np.array([0]),
        "one": np.array([1]),
    }
    features, prompts, extra, out = {
        "sam": (["image_embeddings"], "point_coords", True, ("low_res_masks", "iou_predictions")),
        "sam2": (["image_embed", "high_res_feats_0", "high_res_feats_1"], "point_coords", False, ("masks", "iou_predictions")),
        "hf-sam": (["image_embeddings", "image_positional_embeddings"], "input_points", False, ("pred_masks", "iou_scores")),
        "hf-sam2": ([f"image_embeddings.{k}" for k in range(3)], "input_points", False, ("pred_masks", "iou_scores")),
    }[kind]
    hub = prompts == "input_points"
    points = 2 if kind == "sam" else 1
    inputs = [value(f, [1, CHANNELS, SIDE // 16, SIDE // 16]) for f in features]
    inputs.append(value(prompts, [1, batch, points, 2] if hub else [batch, points, 2]))
    if hub:
        inputs.append(value("input_labels", [1, batch, points], "int64"))
        inputs += [value("input_boxes", [1, "boxes", 4])] if kind == "hf-sam2" else []
    else:
        inputs += [value("point_labels", [batch, points]), value("mask_input", [batch, 1, LOW, LOW])]
        inputs += [value("has_mask_input", [1])] + ([value("orig_im_size", [2])] if extra else [])
    nodes = _decoder_nodes(features[0], prompts, broken)
    constants |= {"axis": np.array([2 if hub else 1]), "none": np.zeros(0, np.float32)}
    shaped = [node("Unsqueeze", "logits zero", out[0]), node("Unsqueeze", "all_scores zero", out[1])]
    flat = [node("Identity", "logits", out[0]), node("Identity", "all_scores", out[1])]
    outputs = [value(out[0], ["one"] * hub + ["n", "m", "h", "w"]), value(out[1], ["one"] * hub + ["n", "m"])]
    if kind == "sam":  # the export also resizes in the graph, for the shape that it was traced with: of no use
        nodes.append(node("Neg", "logits", "masks"))
        outputs.append(value("masks", ["n", "m", "H", "W"]))
    return save(path, nodes + (shaped if hub else flat), inputs, outputs, constants)


def pair(folder: Path, kind: str, *, inside=False, pixels="float", **options) -> tuple[Path, Path]:
    folder.mkdir(parents=True, exist_ok=True)
    outputs = {
        "sam": ("image_embeddings",),
        "sam2": ("image_embed", "high_res_feats_0", "high_res_feats_1"),
        "hf-sam": ("image_embeddings", "image_positional_embeddings"),
        "hf-sam2": tuple(f"image_embeddings.{k}" for k in range(3)),
    }[kind]
    made = encoder(folder / "tiny_encoder.onnx", outputs=outputs, inside=inside, pixels=pixels)
    return made, decoder(folder / "tiny_decoder.onnx", kind, **options)
