"""Set-of-mark pictures (Yang et al. 2023; paper, 3.2): regions in translucent colours, each with its number."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8
from PIL import Image, ImageDraw
from scipy import ndimage

from anymesh.rendering.labels import Plate, beside, draw_leader, draw_plate, plate_size, take
from anymesh.rendering.paint import blend, mark_color

LARGE, SMALL = 19, 15  # [px] fonts in a picture of 640 px: where the region has room, and elsewhere
OVERHANG = 0.3  # share of a plate that may stand out of its region
MIDDLE = 0.02  # pull of the region's centroid, so that a number sits in the middle of a long region, not at its end
FOREIGN, HIDDEN = 40.0, 300.0  # [px] cost of covering other marks with a whole plate; of hiding a whole mark


def mark_positions(labels: Int[np.ndarray, "H W"], numbers: Sequence[int] | None = None) -> dict[int, Plate]:
    """A plate for each region, small regions first; no two overlap.

    labels: the region a pixel, -1 none; numbers: the regions that get a plate, all if None. A plate sits at the maximum of
    the distance transform of what is left of its region; where it does not fit, it is beside, its anchor being that maximum.
    """
    areas = {int(n): int(a) for n, a in zip(*np.unique(labels[labels >= 0], return_counts=True), strict=True)}
    wanted = [n for n in areas if numbers is None or n in numbers]
    used = np.zeros(labels.shape, bool)
    boxes = ndimage.find_objects(labels + 1)
    weight = np.concatenate([[0.0], [HIDDEN / areas.get(n, 1) for n in range(len(boxes))]])[labels + 1]
    scale = labels.shape[0] / 640
    plates, waiting = {}, []
    for number in sorted(wanted, key=lambda n: (areas[n], n)):
        anchor, plate = _inside(labels == number, boxes[number], used, number, scale)
        if plate is None:
            waiting.append((number, anchor))
            _keep(used, anchor)
        else:
            plates[number] = plate
            take(used, plate)
    for number, anchor in waiting:  # after the others, as they have the choice where to be
        size = max(SMALL, round(scale * SMALL))
        width, height = plate_size(str(number), size)
        cost = weight + FOREIGN / (width * height) * (labels >= 0)
        plates[number] = beside(str(number), size, anchor, used, cost, gap=6)
        take(used, plates[number])
    return {n: plates[n] for n in wanted}


def _keep(used: Bool[np.ndarray, "H W"], anchor: tuple[int, int]) -> None:
    """Keeps plates off the end of a leader."""
    x, y = anchor
    used[max(y - 3, 0) : y + 4, max(x - 3, 0) : x + 4] = True


def _inside(
    region: Bool[np.ndarray, "H W"], box: tuple[slice, slice], used: Bool[np.ndarray, "H W"], number: int, scale: float
) -> tuple[tuple[int, int], Plate | None]:
    """The middle of a region, and its plate there if it has the room."""
    free = (region & ~used)[box]
    free = free if free.any() else region[box]
    middle = _middle(free)
    x, y = int(middle[0]) + box[1].start, int(middle[1]) + box[0].start
    for size, overhang in ((LARGE, 0.0), (SMALL, OVERHANG)):
        font = max(size, round(scale * size))
        width, height = plate_size(str(number), font)
        x0, y0 = x - width // 2, y - height // 2
        if x0 < 0 or y0 < 0 or x0 + width > region.shape[1] or y0 + height > region.shape[0]:
            continue
        window = (slice(y0, y0 + height), slice(x0, x0 + width))
        if region[window].mean() >= 1 - overhang and not used[window].any():
            return (x, y), Plate(str(number), (x0, y0, x0 + width, y0 + height), (x, y), font)
    return (x, y), None


def _middle(region: Bool[np.ndarray, "h w"]) -> Int[np.ndarray, " 2"]:
    """The pixel x, y furthest from the region's outside."""
    depth: Float[np.ndarray, "h w"] = ndimage.distance_transform_edt(np.pad(region, 1))[1:-1, 1:-1]
    y, x = np.nonzero(region)
    score = depth[y, x] - MIDDLE * np.hypot(y - y.mean(), x - x.mean())
    best = int(score.argmax())
    return np.array([x[best], y[best]])


def draw_marks(
    image: UInt8[np.ndarray, "H W 3"], regions: Int[np.ndarray, "H W"], numbers: Sequence[int] | None = None, *, alpha: float
) -> UInt8[np.ndarray, "H W 3"]:
    """The picture with its regions filled, outlined and numbered by their own numbers.

    regions: the number a pixel, -1 none; numbers: those that are drawn, all if None; alpha: of the fill
    (`GroundingConfig.alpha`). A number has the same colour in every picture.
    """
    plates = mark_positions(regions, numbers)
    for number in plates:
        region = regions == number
        image = blend(image, region, mark_color(number), alpha)
        image = blend(image, _outline(region), mark_color(number), 1.0)
    drawn = Image.fromarray(image)
    draw = ImageDraw.Draw(drawn)
    for number, plate in plates.items():
        if plate.led:
            draw_leader(draw, plate, mark_color(number))
    for number, plate in plates.items():
        draw_plate(draw, plate, mark_color(number))
    return np.asarray(drawn)


def _outline(region: Bool[np.ndarray, "H W"]) -> Bool[np.ndarray, "H W"]:
    """The region's border, inside it; one pixel wide where two would hide what it shows."""
    width = max(1, round(region.shape[0] / 320)) if region.sum() > 400 else 1
    return region & ~ndimage.binary_erosion(region, iterations=width)
