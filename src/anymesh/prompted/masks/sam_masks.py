"""Steps of the automatic mask generation on plain arrays; each corresponds to a function of segment-anything."""

from __future__ import annotations

import math

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy import ndimage

EDGE = 20.0  # [px] distance from a crop's edge within which a box counts as cut off by it
AROUND = np.ones((3, 3), bool)  # 8-connectivity


def point_grid(per_side: int) -> Float[np.ndarray, "n 2"]:
    """Return per_side**2 points (x, y) at the cell centres of the unit square, row by row."""
    middles = (np.arange(per_side) + 0.5) / per_side
    x, y = np.meshgrid(middles, middles)
    return np.stack([x, y], -1).reshape(-1, 2)


def crop_boxes(height: int, width: int, layers: int, overlap: float) -> list[tuple[int, tuple[int, int, int, int]]]:
    """Return (layer, (x0, y0, x1, y1)) [px], ends exclusive: the picture, then for layer i a grid of 2**i x 2**i crops.

    overlap: of the crops of layer 1, as a share of the shorter side; it halves with each layer.
    """
    crops = [(0, (0, 0, width, height))]
    for layer in range(1, layers + 1):
        side = 2**layer
        shared = int(overlap * min(height, width) * (2 / side))
        w, h = (math.ceil((shared * (side - 1) + length) / side) for length in (width, height))
        for i in range(side):
            for j in range(side):
                x, y = (w - shared) * i, (h - shared) * j
                crops.append((layer, (x, y, min(x + w, width), min(y + h, height))))
    return crops


def stability(logits: Float[np.ndarray, "H W"], offset: float) -> float:
    """Compute the IoU of the masks at thresholds +offset and -offset; 0 if both are empty."""
    union = np.count_nonzero(logits > -offset)
    return float(np.count_nonzero(logits > offset) / union) if union else 0.0


def mask_box(mask: Bool[np.ndarray, "H W"]) -> tuple[int, int, int, int]:
    """Return (x0, y0, x1, y1) of the outermost pixels, all inclusive; zeros for an empty mask."""
    rows, columns = np.flatnonzero(mask.any(1)), np.flatnonzero(mask.any(0))
    return (int(columns[0]), int(rows[0]), int(columns[-1]), int(rows[-1])) if len(rows) else (0, 0, 0, 0)


def cut_by_crop(box: tuple[int, ...], crop: tuple[int, ...], height: int, width: int) -> bool:
    """Return whether a box [px of the picture] ends at an edge of the crop that is not an edge of the picture."""
    off_crop = np.abs(np.subtract(box, crop)) <= EDGE
    off_picture = np.abs(np.subtract(box, (0, 0, width, height))) <= EDGE
    return bool((off_crop & ~off_picture).any())


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


def without_small_regions(mask: Bool[np.ndarray, "H W"], min_pixels: int) -> tuple[Bool[np.ndarray, "H W"], bool]:
    """Fill holes and remove islands of fewer than `min_pixels` pixels, except the largest island.

    Also return whether there were any.
    """
    holes, sizes = _regions(~mask)
    small_holes = sizes < min_pixels
    filled = mask | np.isin(holes, 1 + np.flatnonzero(small_holes))
    islands, sizes = _regions(filled)
    small = sizes < min_pixels
    any_small = bool(small_holes.any() or small.any())
    if len(sizes) and small.all():
        small[np.argmax(sizes)] = False
    return filled & ~np.isin(islands, 1 + np.flatnonzero(small)), any_small


def _regions(mask: Bool[np.ndarray, "H W"]) -> tuple[Int[np.ndarray, "H W"], Int[np.ndarray, " k"]]:
    labels, count = ndimage.label(mask, AROUND)
    return labels, np.bincount(labels.ravel(), minlength=count + 1)[1:]
