"""SAM and SAM 2 by PyTorch and Hugging Face Transformers, from a folder with config.json and model.safetensors."""

from __future__ import annotations

import importlib
import json
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from jaxtyping import Float, UInt8

from anymesh.errors import MissingExtraError, ModelError, OptionError
from anymesh.prompted.masks.sam_frame import Frame

MODELS = {  # model_type of config.json -> class of Transformers, and whether it pads
    "sam": ("SamModel", True),
    "sam2": ("Sam2Model", False),
    "sam2_video": ("Sam2Model", False),  # used by published SAM 2 weights; the tracker's tensors are ignored
}


@dataclass(frozen=True, eq=False)
class _Embedding:
    features: Any  # one tensor, or for SAM 2 a list of three
    size: tuple[int, int]  # rows and columns of the picture


class TorchSam:
    """A `PromptedSegmenter` from a folder. device: "cpu", "cuda", ...; None uses CUDA if available."""

    def __init__(self, folder: Path, *, name: str = "", device: str | None = None) -> None:
        self.name = name or folder.name
        kind, padded = _kind(folder)
        self._torch, transformers = _library("torch"), _library("transformers")
        self._device = _device(self._torch, device)
        transformers.utils.logging.disable_progress_bar()  # it would interfere with our own progress output
        try:
            model, loading_info = getattr(transformers, kind).from_pretrained(
                folder, local_files_only=True, use_safetensors=True, output_loading_info=True
            )
        except Exception as error:  # Transformers raises many types of errors for a wrong folder
            reason = " ".join(f"{type(error).__name__}: {error}".split())[:300]
            raise ModelError(f"{folder}: Transformers cannot load {kind} ({reason})") from None
        if loading_info["missing_keys"]:  # they would be initialized at random
            missing = sorted(loading_info["missing_keys"])
            raise ModelError(f"{folder}: model.safetensors lacks {len(missing)} tensors of {kind}, among them {missing[:3]}")
        self._model = model.eval().to(self._device)
        self.frame = Frame(int(model.config.prompt_encoder_config.image_size), padded)

    def embed(self, image: UInt8[np.ndarray, "H W 3"]) -> _Embedding:
        """Run the image encoder once."""
        pixels = self._torch.from_numpy(self.frame.normalized(image)).to(self._device)
        with self._torch.inference_mode():
            return _Embedding(self._model.get_image_embeddings(pixels), image.shape[:2])

    def predict(
        self, embedding: _Embedding, points: Float[np.ndarray, "n 2"]
    ) -> tuple[Float[np.ndarray, "n m h w"], Float[np.ndarray, "n m"]]:
        """Run the prompt encoder and the mask decoder for all points at once."""
        at = self.frame.points(points, *embedding.size).astype(np.float32)
        prompts = self._torch.from_numpy(at)[None, :, None].to(self._device)
        labels = self._torch.ones(prompts.shape[:3], dtype=self._torch.int64, device=self._device)
        with self._torch.inference_mode():
            prediction = self._model(
                image_embeddings=embedding.features, input_points=prompts, input_labels=labels, multimask_output=True
            )
        return prediction.pred_masks[0].float().cpu().numpy(), prediction.iou_scores[0].float().cpu().numpy()


def _kind(folder: Path) -> tuple[str, bool]:
    try:
        model_type = json.loads((folder / "config.json").read_text()).get("model_type")
    except (OSError, ValueError, AttributeError) as error:
        raise ModelError(f"{folder}: config.json cannot be read ({error})") from None
    if model_type not in MODELS:
        raise ModelError(f"{folder}: config.json has model_type {model_type!r}; valid are {', '.join(MODELS)}")
    return MODELS[model_type]


def _device(torch: ModuleType, wanted: str | None) -> Any:
    device = wanted or ("cuda" if torch.cuda.is_available() else "cpu")
    try:
        torch.zeros(1, device=device)
    except (RuntimeError, AssertionError) as error:
        raise OptionError(f"device: found {device!r}, which PyTorch cannot use here ({error})"[:300]) from None
    return device


def _library(name: str) -> ModuleType:
    try:  # imported by name, because type checks also run without the library
        return importlib.import_module(name)
    except ImportError as error:
        raise MissingExtraError(
            f"{name} is not installed; install it with `pip install articulate-anymesh[sam-torch]`; "
            "weights in ONNX files need only the extra `sam`"
        ) from error
