"""SAM, MobileSAM and SAM 2 as two ONNX files, by ONNX Runtime: an image encoder and a prompt decoder.

Four common exports are distinguished by the names of the decoder's inputs (`EXPORTS`). The encoder's input depends on its
dimensions:
for (1, 3, S, S), float, it is the square, normalised and padded here; for (H, W, 3), it is the resized picture, 0..255, since
such graphs normalise and pad themselves.
"""

from __future__ import annotations

import importlib
import logging
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float, UInt8

from anymesh.errors import MissingExtraError, ModelError, pip_install
from anymesh.prompted.grounding.sam import MEAN, Frame, PromptedSegmenter
from anymesh.prompted.grounding.sam_weights_ import Hub, resolve
from anymesh.types import Brief

log = logging.getLogger("anymesh")
TYPES = {
    "tensor(float)": np.float32,
    "tensor(float16)": np.float16,
    "tensor(uint8)": np.uint8,
    "tensor(int64)": np.int64,
    "tensor(int32)": np.int32,
}
SIDE = 1024  # [px] input side of every published model, used if the graph leaves it open
LOW = 4  # ratio of the square's side to that of the decoder's mask input
SAME = 1e-2  # [logit] tolerance between the results of a batch and of single prompts
POINTS = ("point_coords", "point_labels", "mask_input", "has_mask_input")


@dataclass(frozen=True)
class Export:
    """One way to split a SAM model into two graphs. features: the encoder's outputs that the decoder takes."""

    title: str
    features: tuple[str, ...]
    prompts: tuple[str, ...]
    masks: str
    scores: str
    padded: bool
    end_point: bool = False  # the graph expects a final point labelled -1, "no box follows"

    @property
    def inputs(self) -> set[str]:
        return {*self.features, *self.prompts}


EXPORTS = (
    # low_res_masks, not masks: those are resized in the graph to the picture shape that was used for the export
    Export("SAM", ("image_embeddings",), (*POINTS, "orig_im_size"), "low_res_masks", "iou_predictions", True, end_point=True),
    Export("SAM 2", ("image_embed", "high_res_feats_0", "high_res_feats_1"), POINTS, "masks", "iou_predictions", False),
    Export(
        "SAM by Transformers",
        ("image_embeddings", "image_positional_embeddings"),
        ("input_points", "input_labels"),
        "pred_masks",
        "iou_scores",
        True,
    ),
    Export(
        "SAM 2 by Transformers",
        ("image_embeddings.0", "image_embeddings.1", "image_embeddings.2"),
        ("input_points", "input_labels", "input_boxes"),
        "pred_masks",
        "iou_scores",
        False,
    ),
)


@dataclass(frozen=True, eq=False)
class _Embedding(Brief):
    features: dict[str, np.ndarray]
    size: tuple[int, int]  # rows and columns of the picture


def load_sam(spec: str, *, hub: Hub | None = None) -> PromptedSegmenter:
    """Load `sam:NAME`, `sam:FOLDER` or `sam:HUB_ID@COMMIT`; see `sam_weights_.resolve` for valid names and for errors."""
    weights = resolve(spec, hub=hub)
    return OnnxSam(weights.encoder, weights.decoder, name=weights.name)


class OnnxSam:
    """A `PromptedSegmenter` of two ONNX files. Raise ModelError if they are not such a pair."""

    def __init__(self, encoder: Path, decoder: Path, *, name: str = "") -> None:
        self.name = name or encoder.parent.name
        self._encoder, self._decoder = _session(encoder), _session(decoder)
        self._export = _export(self._encoder, self._decoder, encoder, decoder)
        self._declared = {i.name: i for i in self._decoder.get_inputs()}
        self._pixels = self._encoder.get_inputs()[0]
        self.frame = Frame(self._side(), self._export.padded)
        prompts = self._declared[self._export.prompts[0]].shape
        self._batched = not isinstance(prompts[-3], int)  # (n, points, 2) or (1, n, points, 2)
        self._tried = False

    def embed(self, image: UInt8[np.ndarray, "H W 3"]) -> _Embedding:
        """Run the encoder once."""
        if len(self._pixels.shape) == 4:
            pixels = self.frame.normalized(image)
        else:
            pixels = self.frame.resize(image)
            if all(isinstance(n, int) for n in self._pixels.shape):
                square = np.full(self._pixels.shape, np.round(MEAN), np.uint8)
                square[: pixels.shape[0], : pixels.shape[1]] = pixels
                pixels = square
        outputs = _run(self._encoder, None, {self._pixels.name: pixels.astype(TYPES[self._pixels.type])})
        named = dict(zip([o.name for o in self._encoder.get_outputs()], outputs, strict=True))
        if len(self._export.features) == 1:  # exporters name the only output in different ways
            named = {self._export.features[0]: outputs[0]}
        return _Embedding({name: named[name] for name in self._export.features}, image.shape[:2])

    def predict(
        self, embedding: _Embedding, points: Float[np.ndarray, "n 2"]
    ) -> tuple[Float[np.ndarray, "n m h w"], Float[np.ndarray, "n m"]]:
        """Run the decoder: once for all points if its graph takes several prompts, else once per point."""
        at = self.frame.points(points, *embedding.size)
        if self._batched and not self._tried and len(at) > 1:
            self._tried, self._batched = True, self._batch_holds(embedding, at[:2])
        if self._batched:
            return self._ask(embedding, at)
        answers = [self._ask(embedding, at[k : k + 1]) for k in range(len(at))]
        return np.concatenate([masks for masks, _ in answers]), np.concatenate([scores for _, scores in answers])

    def _batch_holds(self, embedding: _Embedding, at: Float[np.ndarray, "2 2"]) -> bool:
        """Return whether two prompts in one batch give the same result as one by one; some exports declare batches and fail."""
        single = np.concatenate([self._ask(embedding, at[k : k + 1])[0] for k in range(2)])
        try:
            both = self._ask(embedding, at)[0]
        except ModelError:
            both = single[:1]
        holds = both.shape == single.shape and bool(np.allclose(both, single, atol=SAME))
        if not holds:
            log.info("%s: its decoder takes one prompt at a time", self.name)
        return holds

    def _ask(
        self, embedding: _Embedding, at: Float[np.ndarray, "n 2"]
    ) -> tuple[Float[np.ndarray, "n m h w"], Float[np.ndarray, "n m"]]:
        feeds = embedding.features | {name: self._prompt(name, at) for name in self._export.prompts}
        typed = {name: value.astype(TYPES[self._declared[name].type], copy=False) for name, value in feeds.items()}
        masks, scores = _run(self._decoder, [self._export.masks, self._export.scores], typed)
        scores = scores.reshape(len(at), -1).astype(np.float32, copy=False)
        masks = masks.reshape(*scores.shape, *masks.shape[-2:]).astype(np.float32, copy=False)
        # The first of four masks is for several prompts per object; the reference omits it here.
        return (masks[:, 1:], scores[:, 1:]) if scores.shape[1] == 4 else (masks, scores)

    def _prompt(self, name: str, at: Float[np.ndarray, "n 2"]) -> np.ndarray:
        count = len(at)
        end = self._export.end_point
        match name:
            case "point_coords" | "input_points":
                coords = np.concatenate([at[:, None], np.zeros((count, 1, 2))], 1) if end else at[:, None]
                return coords if name == "point_coords" else coords[None]
            case "point_labels":
                return np.tile([1, -1] if end else [1], (count, 1))
            case "input_labels":
                return np.ones((1, count, 1))
            case "input_boxes":
                return np.zeros((1, 0, 4))
            case "mask_input":
                low = self.frame.side // LOW
                return np.zeros((count, 1, low, low))
            case "has_mask_input":
                return np.zeros(1)
            case _:  # orig_im_size, of masks that are not read: small, because the graph computes them anyway
                return np.array([self.frame.side // LOW] * 2)

    def _side(self) -> int:
        fixed = [n for n in self._pixels.shape if isinstance(n, int) and n > 3]
        low = self._declared["mask_input"].shape[-1] if "mask_input" in self._declared else None
        return fixed[-1] if fixed else LOW * low if isinstance(low, int) else SIDE


def _session(path: Path) -> Any:
    try:  # imported by name, because type checks also run without the library
        runtime = importlib.import_module("onnxruntime")
    except ImportError as error:
        raise MissingExtraError(f"ONNX Runtime is missing; install it with {pip_install('sam')}") from error
    wanted = ("CUDAExecutionProvider", "CPUExecutionProvider")
    providers = [p for p in wanted if p in runtime.get_available_providers()]
    try:
        return runtime.InferenceSession(str(path), providers=providers)
    except Exception as error:  # ONNX Runtime's own exceptions share no base
        raise ModelError(f"{path.name} cannot be loaded by ONNX Runtime ({_brief(error)})") from None


def _run(session: Any, outputs: list[str] | None, feeds: dict[str, np.ndarray]) -> list[np.ndarray]:
    try:
        return session.run(outputs, feeds)
    except Exception as error:
        raise ModelError(f"ONNX Runtime could not run the model ({_brief(error)})") from None


def _brief(error: Exception) -> str:
    return " ".join(f"{type(error).__name__}: {error}".split())[:200]


def _export(encoder: Any, decoder: Any, encoder_path: Path, decoder_path: Path) -> Export:
    inputs = {i.name for i in decoder.get_inputs()}
    outputs = {o.name for o in decoder.get_outputs()}
    made = {o.name for o in encoder.get_outputs()}
    pixels = encoder.get_inputs()
    sees = len(pixels) == 1 and pixels[0].type in TYPES and len(pixels[0].shape) in (3, 4)
    for export in EXPORTS:
        fed = set(export.features) <= made or len(export.features) == len(made) == 1
        if sees and fed and inputs == export.inputs and {export.masks, export.scores} <= outputs:
            return export
    valid = "; ".join(f"{e.title}: {sorted(e.inputs)} -> {e.masks}, {e.scores}" for e in EXPORTS)
    shown = [f"{p.name} {p.type} {p.shape}" for p in pixels]
    raise ModelError(
        f"{encoder_path.name} and {decoder_path.name} are not a pair of a SAM encoder and decoder: the encoder takes {shown} "
        f"and gives {sorted(made)}, the decoder takes {sorted(inputs)} and gives {sorted(outputs)}; valid is one picture "
        f"(1, 3, S, S) or (H, W, 3), and decoders of {valid}"
    )
