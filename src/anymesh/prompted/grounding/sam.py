"""Mask proposals for a picture by a SAM model, prompted with a grid of points.

This is the procedure of SamAutomaticMaskGenerator (segment-anything 1.0) without its optional crops, in numpy, for any model
behind `PromptedSegmenter`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8
from PIL import Image
from scipy.sparse import csr_array

from anymesh.types import Brief

POINTS_PER_BATCH = 64
STABILITY_OFFSET = 1.0  # [logit] distance of both thresholds from 0
MEAN = np.array([123.675, 116.28, 103.53], np.float32)  # of ImageNet's RGB, 0..255; every SAM and SAM 2 uses these
STD = np.array([58.395, 57.12, 57.375], np.float32)


@dataclass(frozen=True)
class Frame:
    """Square input of a model, with its side [px].

    padded: the longer side fills the square, the rest on the right and below is padding (SAM, MobileSAM). Otherwise the
    picture is stretched to the square (SAM 2). Sources: ResizeLongestSide and postprocess_masks of segment-anything,
    SAM2Transforms of sam2.
    """

    side: int
    padded: bool

    def inner(self, height: int, width: int) -> tuple[int, int]:
        """Return the rows and columns of the square that the picture fills [px]."""
        if not self.padded:
            return self.side, self.side
        scale = self.side / max(height, width)
        return max(1, int(height * scale + 0.5)), max(1, int(width * scale + 0.5))

    def resize(self, image: UInt8[np.ndarray, "H W 3"]) -> UInt8[np.ndarray, "h w 3"]:
        """Resize the picture to its size in the square, without the padding."""
        rows, columns = self.inner(*image.shape[:2])
        return np.asarray(Image.fromarray(image).resize((columns, rows), Image.Resampling.BILINEAR))

    def normalized(self, image: UInt8[np.ndarray, "H W 3"]) -> Float[np.ndarray, "1 3 side side"]:
        """Return the whole square as the network's input: mean 0 and standard deviation 1 over ImageNet, padding 0."""
        small = self.resize(image)
        square = np.zeros((1, 3, self.side, self.side), np.float32)
        square[0, :, : small.shape[0], : small.shape[1]] = ((small - MEAN) / STD).transpose(2, 0, 1)
        return square

    def points(self, points: Float[np.ndarray, "n 2"], height: int, width: int) -> Float[np.ndarray, "n 2"]:
        """Map (x, y) in the picture [px] to (x, y) in the square [px]."""
        rows, columns = self.inner(height, width)
        return points * np.array([columns / width, rows / height])

    def upscaler(self, low: tuple[int, int], height: int, width: int) -> Upscaler:
        """Return the upscaler of logits of shape `low`, which cover the whole square, to the picture's pixels."""
        rows, columns = self.inner(height, width)
        return Upscaler(self._along(low[0], rows, height), self._along(low[1], columns, width))

    def _along(self, low: int, inner: int, full: int) -> csr_array:
        if not self.padded:
            return bilinear(low, full)
        # The reference resizes to the square, crops the padding, and resizes again; both are linear, hence one matrix.
        return bilinear(inner, full) @ bilinear(low, self.side)[:inner]


@dataclass(frozen=True, eq=False)
class Upscaler:
    """Resizing as two sparse matrices: vertical (H, h), horizontal (W, w)."""

    vertical: csr_array
    horizontal: csr_array

    def __call__(self, logits: Float[np.ndarray, "h w"]) -> Float[np.ndarray, "H W"]:
        rows = self.vertical @ logits.astype(np.float32, copy=False)
        return (self.horizontal @ rows.T).T


def bilinear(source: int, target: int) -> csr_array:
    """Return the (target, source) matrix of bilinear resizing of one side.

    Pixel centres are at halves, without smoothing (torch: align_corners=False).
    """
    at = np.clip((np.arange(target) + 0.5) * source / target - 0.5, 0, source - 1)
    low = np.floor(at).astype(int)
    columns = np.r_[low, np.minimum(low + 1, source - 1)]
    weights = np.r_[1 - (at - low), at - low].astype(np.float32)
    return csr_array((weights, (np.tile(np.arange(target), 2), columns)), (target, source))


@runtime_checkable
class PromptedSegmenter(Protocol):
    """Protocol of a model that predicts masks from points in a picture. `frame` maps pictures to its input."""

    name: str
    frame: Frame

    def embed(self, image: UInt8[np.ndarray, "H W 3"]) -> Any:
        """Compute the model's embedding of the picture, which only its own `predict` can read."""
        ...

    def predict(
        self, embedding: Any, points: Float[np.ndarray, "n 2"]
    ) -> tuple[Float[np.ndarray, "n m h w"], Float[np.ndarray, "n m"]]:
        """Predict m masks per point (x, y) [px of the picture].

        Return the masks' logits over the model's whole square input, at any resolution, positive inside; and the IoU predicted
        by the model for each mask.
        """
        ...


@dataclass(frozen=True)
class AutomaticMasks:
    """Settings of `automatic_masks`; the defaults are those of the reference, chosen for ViT-H."""

    points_per_side: int = 32
    min_score: float = 0.88  # predicted IoU; 0 disables this filter
    min_stability: float = 0.95  # IoU of the masks at both thresholds; 0 disables this filter
    nms_iou: float = 0.7  # IoU of two boxes above which they count as the same mask


@dataclass(frozen=True, eq=False)
class ProposedMask(Brief):
    """bits: packed mask, since about a thousand are held until the suppression; score: IoU predicted by the model.

    box: (x0, y0, x1, y1) of the outermost pixels [px].
    """

    bits: UInt8[np.ndarray, " k"]
    shape: tuple[int, int]
    score: float
    stability: float
    box: tuple[int, int, int, int]

    @property
    def mask(self) -> Bool[np.ndarray, "H W"]:
        """Return the mask."""
        height, width = self.shape
        return np.unpackbits(self.bits, count=height * width).reshape(height, width).astype(bool)


def automatic_masks(
    model: PromptedSegmenter, image: UInt8[np.ndarray, "H W 3"], *, settings: AutomaticMasks | None = None
) -> list[ProposedMask]:
    """Compute all masks of a picture (sRGB colours or normals as colours), best first."""
    settings = settings or AutomaticMasks()
    proposals = list(_stable_masks(model, image, settings))
    boxes = np.array([p.box for p in proposals], float).reshape(-1, 4)
    return [proposals[k] for k in box_nms(boxes, np.array([p.score for p in proposals], float), settings.nms_iou)]


def _stable_masks(model: PromptedSegmenter, image: np.ndarray, settings: AutomaticMasks) -> Iterator[ProposedMask]:
    """Predict masks at a grid of points; yield those that pass the filters."""
    height, width = image.shape[:2]
    embedding = model.embed(image)
    points = point_grid(settings.points_per_side) * (width, height)
    for start in range(0, len(points), POINTS_PER_BATCH):
        logits, scores = model.predict(embedding, points[start : start + POINTS_PER_BATCH])
        upscale = model.frame.upscaler(logits.shape[-2:], height, width)
        for k, m in np.argwhere((scores > settings.min_score) | (settings.min_score <= 0)):
            full = upscale(logits[k, m])  # only masks that pass the score filter are upscaled, one at a time
            stable = stability(full, STABILITY_OFFSET)
            if stable >= settings.min_stability:
                mask = full > 0
                yield ProposedMask(np.packbits(mask), mask.shape, float(scores[k, m]), stable, mask_box(mask))


def point_grid(per_side: int) -> Float[np.ndarray, "n 2"]:
    """Return per_side**2 points (x, y) at the cell centres of the unit square, row by row."""
    middles = (np.arange(per_side) + 0.5) / per_side
    x, y = np.meshgrid(middles, middles)
    return np.stack([x, y], -1).reshape(-1, 2)


def stability(logits: Float[np.ndarray, "H W"], offset: float) -> float:
    """Compute the IoU of the masks at thresholds +offset and -offset; 0 if both are empty."""
    union = np.count_nonzero(logits > -offset)
    return float(np.count_nonzero(logits > offset) / union) if union else 0.0


def mask_box(mask: Bool[np.ndarray, "H W"]) -> tuple[int, int, int, int]:
    """Return (x0, y0, x1, y1) of the outermost pixels, all inclusive; zeros for an empty mask."""
    rows, columns = np.flatnonzero(mask.any(1)), np.flatnonzero(mask.any(0))
    return (int(columns[0]), int(rows[0]), int(columns[-1]), int(rows[-1])) if len(rows) else (0, 0, 0, 0)


def box_nms(boxes: Float[np.ndarray, "n 4"], scores: Float[np.ndarray, " n"], iou: float) -> Int[np.ndarray, " k"]:
    """Return the indices of the remaining boxes, best first; each suppresses later boxes that overlap it by more than `iou`.

    Ties keep their order. A box's area is (x1 - x0) * (y1 - y0), as in the reference, although its ends are inclusive.
    """
    order = np.argsort(-scores, kind="stable")
    low, high = boxes[order, :2].astype(float), boxes[order, 2:].astype(float)
    area = (high - low).prod(1)
    alive = np.ones(len(order), bool)
    for k in range(len(order)):
        if alive[k]:
            rest = slice(k + 1, None)
            sides = np.minimum(high[k], high[rest]) - np.maximum(low[k], low[rest])
            shared = np.clip(sides, 0, None).prod(1)
            union = area[k] + area[rest] - shared
            alive[rest] &= np.divide(shared, union, out=np.zeros_like(union), where=union > 0) <= iou
    return order[alive]
