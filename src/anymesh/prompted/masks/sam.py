"""Mask proposals for a picture by a SAM model, prompted with a grid of points.

This is the procedure of SamAutomaticMaskGenerator (segment-anything 1.0), in numpy, for any model behind `PromptedSegmenter`.
Masks are filtered, and duplicates are suppressed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import numpy as np
from jaxtyping import Bool, Float, UInt8

from anymesh.errors import OptionError
from anymesh.prompted.masks.sam_frame import Frame
from anymesh.prompted.masks.sam_masks import (
    box_nms,
    crop_boxes,
    cut_by_crop,
    mask_box,
    point_grid,
    stability,
    without_small_regions,
)


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
    points_per_batch: int = 64
    min_score: float = 0.88  # predicted IoU; 0 disables this filter
    min_stability: float = 0.95  # IoU of the masks at both thresholds; 0 disables this filter
    stability_offset: float = 1.0  # [logit]
    nms_iou: float = 0.7  # IoU of two boxes above which they count as the same mask
    crop_layers: int = 0  # layer i repeats the prediction on 2**i x 2**i crops
    crop_overlap: float = 512 / 1500  # share of the shorter side
    crop_points_divisor: int = 1  # divides points_per_side, for each layer
    smallest_region: int = 0  # [px] smaller islands are removed and smaller holes filled; 0 disables this

    def __post_init__(self) -> None:
        whole = {"points_per_side": 1, "points_per_batch": 1, "crop_layers": 0, "crop_points_divisor": 1, "smallest_region": 0}
        for name, least in whole.items():
            if getattr(self, name) < least:
                raise OptionError(f"{name}: found {getattr(self, name)}; valid are integers from {least} up")
        if not 0 <= self.nms_iou <= 1 or not 0 <= self.crop_overlap < 1 or self.stability_offset < 0:
            raise OptionError(
                f"nms_iou, crop_overlap, stability_offset: found {self.nms_iou}, {self.crop_overlap}, "
                f"{self.stability_offset}; valid are 0..1, 0 up to but not 1, and 0 up"
            )


@dataclass(frozen=True, eq=False)
class ProposedMask:
    """mask: (H, W); score: IoU predicted by the model; box: (x0, y0, x1, y1) of its outermost pixels [px]."""

    mask: Bool[np.ndarray, "H W"]
    score: float
    stability: float
    box: tuple[int, int, int, int]


@dataclass(frozen=True, eq=False)
class _Candidate:
    # packed mask within its crop, since about a thousand candidates are held until the suppression
    bits: UInt8[np.ndarray, " k"]
    crop: tuple[int, int, int, int]
    box: tuple[int, int, int, int]  # [px of the picture]
    score: float
    stability: float

    @property
    def crop_area(self) -> int:
        return (self.crop[2] - self.crop[0]) * (self.crop[3] - self.crop[1])

    def proposed(self, height: int, width: int) -> ProposedMask:
        x0, y0, x1, y1 = self.crop
        mask = np.zeros((height, width), bool)
        mask[y0:y1, x0:x1] = np.unpackbits(self.bits, count=self.crop_area).reshape(y1 - y0, x1 - x0)
        return ProposedMask(mask, self.score, self.stability, self.box)


def automatic_masks(
    model: PromptedSegmenter, image: UInt8[np.ndarray, "H W 3"], *, settings: AutomaticMasks | None = None
) -> list[ProposedMask]:
    """Compute all masks of a picture (sRGB colours or normals as colours), best first.

    Raise OptionError for invalid settings.
    """
    settings = settings or AutomaticMasks()
    height, width = image.shape[:2]
    candidates: list[_Candidate] = []
    crops = crop_boxes(height, width, settings.crop_layers, settings.crop_overlap)
    for layer, crop in crops:
        points = point_grid(max(1, settings.points_per_side // settings.crop_points_divisor**layer))
        here = list(_of_crop(model, image, crop, points, settings))
        candidates += _suppressed(here, [c.score for c in here], settings.nms_iou)
    if len(crops) > 1:  # prefer masks of smaller crops, which have more detail
        candidates = _suppressed(candidates, [1 / c.crop_area for c in candidates], settings.nms_iou)
    proposals = [c.proposed(height, width) for c in candidates]
    return _cleaned(proposals, settings) if settings.smallest_region else proposals


def _of_crop(
    model: PromptedSegmenter,
    image: UInt8[np.ndarray, "H W 3"],
    crop: tuple[int, int, int, int],
    grid: Float[np.ndarray, "n 2"],
    settings: AutomaticMasks,
) -> Iterator[_Candidate]:
    x0, y0, x1, y1 = crop
    size = (y1 - y0, x1 - x0)
    embedding = model.embed(np.ascontiguousarray(image[y0:y1, x0:x1]))
    points = grid * size[::-1]
    for start in range(0, len(points), settings.points_per_batch):
        logits, scores = model.predict(embedding, points[start : start + settings.points_per_batch])
        upscale = model.frame.upscaler(logits.shape[-2:], *size)
        for k, m in np.argwhere((scores > settings.min_score) | (settings.min_score <= 0)):
            full = upscale(logits[k, m])  # only masks that pass the score filter are upscaled, one at a time
            stable = stability(full, settings.stability_offset)
            if stable < settings.min_stability:
                continue
            mask = full > 0
            a, b, c, d = mask_box(mask)
            box = (a + x0, b + y0, c + x0, d + y0)
            if not cut_by_crop(box, crop, *image.shape[:2]):
                yield _Candidate(np.packbits(mask), crop, box, float(scores[k, m]), stable)


def _suppressed(candidates: list[_Candidate], priority: list[float], iou: float) -> list[_Candidate]:
    boxes = np.array([c.box for c in candidates], float).reshape(-1, 4)
    return [candidates[k] for k in box_nms(boxes, np.array(priority, float), iou)]


def _cleaned(proposals: list[ProposedMask], settings: AutomaticMasks) -> list[ProposedMask]:
    """Remove small islands and holes, and the duplicates that result; unchanged masks take precedence."""
    cleaned = []
    for proposal in proposals:
        mask, changed = without_small_regions(proposal.mask, settings.smallest_region)
        cleaned.append((ProposedMask(mask, proposal.score, proposal.stability, mask_box(mask)), 0.0 if changed else 1.0))
    boxes = np.array([p.box for p, _ in cleaned], float).reshape(-1, 4)
    keep = box_nms(boxes, np.array([unchanged for _, unchanged in cleaned]), settings.nms_iou)
    return [cleaned[k][0] for k in keep]
