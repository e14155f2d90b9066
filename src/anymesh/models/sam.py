"""Mask proposals of a picture by a SAM model: a grid of points is asked, the masks that hold are kept once.

The procedure of SamAutomaticMaskGenerator (segment-anything 1.0), in numpy, for any model behind `PromptedSegmenter`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import numpy as np
from jaxtyping import Bool, Float, UInt8

from anymesh.errors import OptionError
from anymesh.models.sam_frame import Frame
from anymesh.models.sam_masks import (
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
    """A model that turns a point in a picture into masks. `frame` says how it sees the picture."""

    name: str
    frame: Frame

    def embed(self, image: UInt8[np.ndarray, "H W 3"]) -> Any:
        """What the model knows of the picture; only its own `predict` reads it."""
        ...

    def predict(
        self, embedding: Any, points: Float[np.ndarray, "n 2"]
    ) -> tuple[Float[np.ndarray, "n m h w"], Float[np.ndarray, "n m"]]:
        """For each point (x, y) [px of the picture]: logits of m masks over the model's whole square input, at any
        resolution, above 0 inside; and the IoU that the model expects of each."""
        ...


@dataclass(frozen=True)
class AutomaticMasks:
    """Settings of `automatic_masks`; the defaults are the reference's, chosen for ViT-H."""

    points_per_side: int = 32
    points_per_batch: int = 64
    min_score: float = 0.88  # expected IoU; 0 switches this filter off
    min_stability: float = 0.95  # IoU of the masks at both thresholds; 0 switches this filter off
    stability_offset: float = 1.0  # [logit]
    nms_iou: float = 0.7  # of two boxes, above which they are the same mask
    crop_layers: int = 0  # layer i asks again on 2**i x 2**i crops
    crop_overlap: float = 512 / 1500  # of the shorter side
    crop_points_divisor: int = 1  # of points_per_side, for each layer
    smallest_region: int = 0  # [px] smaller islands are dropped and smaller holes filled; 0 leaves all

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
    """mask: (H, W); score: the IoU that the model expects; box: (x0, y0, x1, y1) of its outermost pixels [px]."""

    mask: Bool[np.ndarray, "H W"]
    score: float
    stability: float
    box: tuple[int, int, int, int]


@dataclass(frozen=True, eq=False)
class _Candidate:
    bits: UInt8[np.ndarray, " k"]  # the mask within its crop, packed: a thousand of them may wait for the suppression
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
    """All masks of a picture (sRGB colours or normals as colours), best first. OptionError for settings that cannot be."""
    settings = settings or AutomaticMasks()
    height, width = image.shape[:2]
    found: list[_Candidate] = []
    crops = crop_boxes(height, width, settings.crop_layers, settings.crop_overlap)
    for layer, crop in crops:
        points = point_grid(max(1, settings.points_per_side // settings.crop_points_divisor**layer))
        here = list(_of_crop(model, image, crop, points, settings))
        found += _suppressed(here, [c.score for c in here], settings.nms_iou)
    if len(crops) > 1:  # a smaller crop saw the mask in more detail
        found = _suppressed(found, [1 / c.crop_area for c in found], settings.nms_iou)
    proposals = [c.proposed(height, width) for c in found]
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
            full = upscale(logits[k, m])  # only masks that the score keeps are ever made large, one at a time
            stable = stability(full, settings.stability_offset)
            if stable < settings.min_stability:
                continue
            mask = full > 0
            a, b, c, d = mask_box(mask)
            box = (a + x0, b + y0, c + x0, d + y0)
            if not cut_by_crop(box, crop, *image.shape[:2]):
                yield _Candidate(np.packbits(mask), crop, box, float(scores[k, m]), stable)


def _suppressed(found: list[_Candidate], priority: list[float], iou: float) -> list[_Candidate]:
    boxes = np.array([c.box for c in found], float).reshape(-1, 4)
    return [found[k] for k in box_nms(boxes, np.array(priority, float), iou)]


def _cleaned(found: list[ProposedMask], settings: AutomaticMasks) -> list[ProposedMask]:
    """Without small islands and holes, and without duplicates that this made; masks that needed no change win."""
    cleaned = []
    for proposal in found:
        mask, changed = without_small_regions(proposal.mask, settings.smallest_region)
        cleaned.append((ProposedMask(mask, proposal.score, proposal.stability, mask_box(mask)), 0.0 if changed else 1.0))
    boxes = np.array([p.box for p, _ in cleaned], float).reshape(-1, 4)
    keep = box_nms(boxes, np.array([unchanged for _, unchanged in cleaned]), settings.nms_iou)
    return [cleaned[k][0] for k in keep]
