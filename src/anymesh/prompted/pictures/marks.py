"""Set-of-mark pictures (Yang et al. 2023; paper, 3.2): regions in translucent colours, each with its number."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8
from PIL import Image, ImageDraw
from scipy import ndimage

from anymesh.config import REFERENCE_PX
from anymesh.rendering.marks import Plate, beside, blend, draw_leader, draw_plate, mark_color, plate_size, take

LARGE, SMALL = 19, 15  # [px] font sizes in a picture of 640 px: for regions with enough space, and for the others
OVERHANG = 0.3  # share of a plate that may extend beyond its region
MIDDLE = 0.02  # weight of the distance to the region's centroid, which keeps a number near the middle of a long region
FOREIGN, HIDDEN = 40.0, 300.0  # [px] cost of covering other marks with a whole plate; of hiding a whole mark


def mark_positions(labels: Int[np.ndarray, "H W"], numbers: Sequence[int] | None = None) -> dict[int, Plate]:
    """Place a plate for each region without overlap, small regions first.

    labels: region index per pixel, -1 for none; numbers: the regions that get a plate, all if None.
    A plate is placed at the maximum of the distance transform of its region's free pixels. If it does not fit, it is placed
    beside the region, and that maximum is its anchor.
    """
    areas = {int(n): int(a) for n, a in zip(*np.unique(labels[labels >= 0], return_counts=True), strict=True)}
    wanted = [n for n in areas if numbers is None or n in numbers]
    used = np.zeros(labels.shape, bool)
    boxes = ndimage.find_objects(labels + 1)
    weight = np.concatenate([[0.0], [HIDDEN / areas.get(n, 1) for n in range(len(boxes))]])[labels + 1]
    scale = labels.shape[0] / REFERENCE_PX
    plates, waiting = {}, []
    for number in sorted(wanted, key=lambda n: (areas[n], n)):
        anchor, plate = _inside(labels, boxes[number], used, number, scale)
        if plate is None:
            waiting.append((number, anchor))
            _keep(used, anchor)
        else:
            plates[number] = plate
            take(used, plate)
    for number, anchor in waiting:  # last, because their position can vary
        size = max(SMALL, round(scale * SMALL))
        width, height = plate_size(str(number), size)
        cost = weight + FOREIGN / (width * height) * (labels >= 0)
        plates[number] = beside(str(number), size, anchor, used, cost, gap=6)
        take(used, plates[number])
    return {n: plates[n] for n in wanted}


def _keep(used: Bool[np.ndarray, "H W"], anchor: tuple[int, int]) -> None:
    """Mark the pixels around the end of a leader as used, in place."""
    x, y = anchor
    used[max(y - 3, 0) : y + 4, max(x - 3, 0) : x + 4] = True


def _inside(
    labels: Int[np.ndarray, "H W"], box: tuple[slice, slice], used: Bool[np.ndarray, "H W"], number: int, scale: float
) -> tuple[tuple[int, int], Plate | None]:
    """Return the middle of a region, and its plate there if it fits."""
    region = labels[box] == number
    free = region & ~used[box]
    free = free if free.any() else region
    middle = _middle(free)
    x, y = int(middle[0]) + box[1].start, int(middle[1]) + box[0].start
    for size, overhang in ((LARGE, 0.0), (SMALL, OVERHANG)):
        font = max(size, round(scale * size))
        width, height = plate_size(str(number), font)
        x0, y0 = x - width // 2, y - height // 2
        if x0 < 0 or y0 < 0 or x0 + width > labels.shape[1] or y0 + height > labels.shape[0]:
            continue
        window = (slice(y0, y0 + height), slice(x0, x0 + width))
        if (labels[window] == number).mean() >= 1 - overhang and not used[window].any():
            return (x, y), Plate(str(number), (x0, y0, x0 + width, y0 + height), (x, y), font)
    return (x, y), None


def _middle(region: Bool[np.ndarray, "h w"]) -> Int[np.ndarray, " 2"]:
    """Return the pixel x, y furthest from the region's border."""
    depth: Float[np.ndarray, "h w"] = ndimage.distance_transform_edt(np.pad(region, 1))[1:-1, 1:-1]
    y, x = np.nonzero(region)
    score = depth[y, x] - MIDDLE * np.hypot(y - y.mean(), x - x.mean())
    best = int(score.argmax())
    return np.array([x[best], y[best]])


def draw_marks(
    image: UInt8[np.ndarray, "H W 3"], regions: Int[np.ndarray, "H W"], numbers: Sequence[int] | None = None, *, alpha: float
) -> UInt8[np.ndarray, "H W 3"]:
    """Fill, outline and number the regions of the picture.

    regions: region number per pixel, -1 for none; numbers: the regions to draw, all if None; alpha: opacity of the fill
    (`GroundingConfig.alpha`). A number has the same colour in every picture.
    """
    plates = mark_positions(regions, numbers)
    boxes, image = ndimage.find_objects(regions + 1), image.copy()
    for number in plates:
        box, color = boxes[number], mark_color(number)
        region = regions[box] == number
        filled = blend(image[box], region, color, alpha)
        image[box] = blend(filled, _outline(region, regions.shape[0]), color, 1.0)
    drawn = Image.fromarray(image)
    draw = ImageDraw.Draw(drawn)
    for number, plate in plates.items():
        if plate.led:
            draw_leader(draw, plate, mark_color(number))
    for number, plate in plates.items():
        draw_plate(draw, plate, mark_color(number))
    return np.asarray(drawn)


def _outline(region: Bool[np.ndarray, "h w"], height: int) -> Bool[np.ndarray, "h w"]:
    """Return the inner border of a region within its box; small regions get one of one pixel, so that they are not hidden.

    height: of the picture [px].
    """
    width = max(1, round(height / 320)) if region.sum() > 400 else 1
    return region & ~ndimage.binary_erosion(region, iterations=width)
