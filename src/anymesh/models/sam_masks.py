"""The steps of automatic masks on plain arrays; each does what segment-anything's function of the same purpose does."""

from __future__ import annotations

import math

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy import ndimage

EDGE = 20.0  # [px] a box this near the edge of a crop was cut off by it
AROUND = np.ones((3, 3), bool)  # pixels touch at corners too


def point_grid(per_side: int) -> Float[np.ndarray, "n 2"]:
    """per_side**2 points (x, y) in the middles of the cells of the unit square, row by row."""
    middles = (np.arange(per_side) + 0.5) / per_side
    x, y = np.meshgrid(middles, middles)
    return np.stack([x, y], -1).reshape(-1, 2)


def crop_boxes(height: int, width: int, layers: int, overlap: float) -> list[tuple[int, tuple[int, int, int, int]]]:
    """(layer, (x0, y0, x1, y1)) [px], ends outside: the picture, then for layer i a 2**i x 2**i raster of crops.

    overlap: of the crops of layer 1, as a share of the shorter side; it halves with each layer.
    """
    found = [(0, (0, 0, width, height))]
    for layer in range(1, layers + 1):
        side = 2**layer
        shared = int(overlap * min(height, width) * (2 / side))
        w, h = (math.ceil((shared * (side - 1) + length) / side) for length in (width, height))
        for i in range(side):
            for j in range(side):
                x, y = (w - shared) * i, (h - shared) * j
                found.append((layer, (x, y, min(x + w, width), min(y + h, height))))
    return found


def stability(logits: Float[np.ndarray, "H W"], offset: float) -> float:
    """IoU of the masks at thresholds +offset and -offset; 0 where both are empty."""
    union = np.count_nonzero(logits > -offset)
    return float(np.count_nonzero(logits > offset) / union) if union else 0.0


def mask_box(mask: Bool[np.ndarray, "H W"]) -> tuple[int, int, int, int]:
    """(x0, y0, x1, y1) of the outermost pixels, all four inside the mask; zeros for an empty mask."""
    rows, columns = np.flatnonzero(mask.any(1)), np.flatnonzero(mask.any(0))
    return (int(columns[0]), int(rows[0]), int(columns[-1]), int(rows[-1])) if len(rows) else (0, 0, 0, 0)


def cut_by_crop(box: tuple[int, ...], crop: tuple[int, ...], height: int, width: int) -> bool:
    """Whether a box [px of the picture] ends at an edge of the crop that is no edge of the picture."""
    off_crop = np.abs(np.subtract(box, crop)) <= EDGE
    off_picture = np.abs(np.subtract(box, (0, 0, width, height))) <= EDGE
    return bool((off_crop & ~off_picture).any())


def box_nms(boxes: Float[np.ndarray, "n 4"], scores: Float[np.ndarray, " n"], iou: float) -> Int[np.ndarray, " k"]:
    """Indices of the boxes kept, best first: each removes those after it that overlap it by more than `iou`.

    Ties keep their order. A box's area is (x1 - x0) * (y1 - y0), as in the reference, although its ends are inside.
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
    """Fill holes and drop islands of fewer than `min_pixels` pixels, but the largest; also return whether there were any."""
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
