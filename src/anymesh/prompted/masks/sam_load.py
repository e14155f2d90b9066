"""Loading of the model given by `--proposer sam:...`."""

from __future__ import annotations

from collections.abc import Mapping

from anymesh.prompted.masks.sam import PromptedSegmenter
from anymesh.prompted.masks.sam_hub_ import Hub
from anymesh.prompted.masks.sam_onnx_ import OnnxSam
from anymesh.prompted.masks.sam_torch_ import TorchSam
from anymesh.prompted.masks.weights import resolve


def load_sam(
    spec: str, *, sha256: Mapping[str, str] | None = None, device: str | None = None, hub: Hub | None = None
) -> PromptedSegmenter:
    """Load `sam:NAME`, `sam:FOLDER` or `sam:HUB_ID@COMMIT`; see `weights.resolve` for valid names and for errors.

    device: for PyTorch weights only, "cpu" or "cuda"; None uses CUDA if available.
    """
    weights = resolve(spec, sha256=sha256, hub=hub)
    if weights.onnx:
        return OnnxSam(*weights.onnx, name=weights.name)
    return TorchSam(weights.folder, name=weights.name, device=device)
