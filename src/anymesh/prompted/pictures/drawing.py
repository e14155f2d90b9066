"""Numbered marks (Yang et al. 2023), points and arrows drawn into pictures (paper, 3.2 and 3.3)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8
from PIL import Image, ImageDraw
from scipy import ndimage

from anymesh.config import REFERENCE_PX
from anymesh.prompted.pictures.plates import Plate, beside, draw_leader, draw_plate, mark_color, plate_size, take
from anymesh.prompted.pictures.views import visible_pixels
from anymesh.rendering.marks import blend, draw_arrow, rim
from anymesh.rendering.render import View
from anymesh.types.camera import Camera

ARROW_FONT, ARROW_WIDTH = 20, 2.0  # [px] font size in a picture of 640 px; line width of an arrow, in the unit of `draw_arrow`
MIN_VISIBLE_SHARE = 0.25  # minimum share of the part's pixels in its best view; views with fewer are not chosen
POINT_FONT, DOT = 16, 4  # [px] in a picture of 640 px: font size; radius of a dot
LARGE_FONT, SMALL_FONT = 19, 15  # [px] font sizes in a picture of 640 px: for regions with enough space, and for the others
MAX_OVERHANG = 0.3  # share of a plate that may extend beyond its region
MIDDLE_WEIGHT = 0.02  # weight of the distance to the region's centroid, which keeps a number near the middle of a long region
HIGHLIGHT = (30, 110, 245)  # colour of the part in question; furniture is seldom blue
FOREIGN_COST, HIDDEN_COST = 40.0, 300.0  # [px] cost of covering other marks with a whole plate; of hiding a whole mark


def highlight(
    image: UInt8[np.ndarray, "H W 3"], mask: Bool[np.ndarray, "H W"], *, alpha: float = 0.3
) -> UInt8[np.ndarray, "H W 3"]:
    """Return a copy with a part tinted and outlined. The outline lies outside the part, so that small parts stay visible."""
    width = max(2, round(image.shape[0] / 240))
    tinted = blend(image, mask, HIGHLIGHT, alpha)
    outer = rim(mask, width + 1)
    return blend(blend(tinted, outer, (255, 255, 255), 1.0), rim(mask, width), HIGHLIGHT, 1.0)


def clearest_view(
    views: Sequence[View],
    center: Float[np.ndarray, " 3"],
    directions: Float[np.ndarray, "k 3"],
    face_part: Int[np.ndarray, " F"],
    part: int,
) -> int:
    """Return the index of the view in which arrows from `center` are most distinct.

    Only views that show enough of the part (`MIN_VISIBLE_SHARE`) are considered. See `distinctness` for the score.
    """
    seen = np.array([visible_pixels(v, face_part, part) for v in views])
    score = [distinctness(v.camera, center, directions) for v in views]
    return int(np.argmax(np.where(seen >= MIN_VISIBLE_SHARE * seen.max(), score, -1.0)))


def distinctness(camera: Camera, center: Float[np.ndarray, " 3"], directions: Float[np.ndarray, "k 3"]) -> float:
    """Multiply the smallest angle [rad] between projected arrows by the smallest projected share of their length (0..pi)."""
    ray = center - camera.T_world_camera[:3, 3]
    ray = ray / np.linalg.norm(ray)
    flat = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    flat = flat - np.outer(flat @ ray, ray)
    length = np.linalg.norm(flat, axis=1)
    unit = flat / np.maximum(length, 1e-9)[:, None]
    angle = np.arccos(np.clip(unit @ unit.T, -1, 1))[np.triu_indices(len(unit), 1)]
    return float(length.min() * angle.min(initial=np.pi))


def draw_arrows(
    image: UInt8[np.ndarray, "H W 3"],
    camera: Camera,
    center: Float[np.ndarray, " 3"],
    directions: Float[np.ndarray, "k 3"],
    numbers: Sequence[int],
    length: float,
) -> UInt8[np.ndarray, "H W 3"]:
    """Draw arrows of one length [m] from `center` along unit directions, each with its number at its tip."""
    height, width = image.shape[:2]
    scale = max(1.0, height / REFERENCE_PX)
    start = camera.project(center[None])[0][0]
    tips = camera.project(center + length * directions)[0]
    drawn = Image.fromarray(image)
    draw = ImageDraw.Draw(drawn)
    used = np.zeros((height, width), bool)
    for tip, number in zip(tips, numbers, strict=True):
        draw_arrow(draw, np.stack([start, tip]), mark_color(number), ARROW_WIDTH * scale)
        t = np.linspace(0, 1, 400)[:, None]
        columns, rows = np.round(start + t * (tip - start)).astype(int).T
        inside = (rows >= 0) & (columns >= 0) & (rows < height) & (columns < width)
        used[rows[inside], columns[inside]] = True
    x, y = (int(v) for v in start)
    draw.ellipse([x - 5, y - 5, x + 5, y + 5], fill=(0, 0, 0), outline=(255, 255, 255))
    for tip, number in zip(tips, numbers, strict=True):
        beyond = tip + ARROW_FONT * scale * (tip - start) / max(float(np.linalg.norm(tip - start)), 1.0)
        x, y = (int(v) for v in np.clip(beyond, 0, [width - 1, height - 1]))
        plate = beside(str(number), round(ARROW_FONT * scale), (x, y), used, np.zeros(used.shape), gap=0)
        take(used, plate)
        if plate.led:
            draw_leader(draw, plate, mark_color(number))
        draw_plate(draw, plate, mark_color(number))
    return np.asarray(drawn)


def labels_apart(pixels: Float[np.ndarray, "k d"], min_distance: float) -> bool:
    """Return whether all points are at least `min_distance` [px] apart. pixels: x and y of each picture that shows them."""
    gaps = np.linalg.norm(pixels[:, None] - pixels[None], axis=2)
    return bool((gaps[np.triu_indices(len(pixels), 1)] >= min_distance).all())


def draw_points(
    image: UInt8[np.ndarray, "H W 3"],
    pixels: Float[np.ndarray, "k 2"],
    numbers: Sequence[int],
    hidden: Bool[np.ndarray, " k"] | None = None,
) -> UInt8[np.ndarray, "H W 3"]:
    """Draw a dot at each pixel and its number beside it; no plate covers a dot or another plate.

    hidden: points that are drawn as hollow dots. Points outside the picture are not drawn.
    """
    hollow = {n for n, h in zip(numbers, hidden, strict=True) if h} if hidden is not None else set()
    height, width = image.shape[:2]
    scale = max(1.0, height / REFERENCE_PX)
    dot, font = round(DOT * scale), round(POINT_FONT * scale)
    inside = np.all((pixels >= 0) & (pixels < [width, height]), axis=1)
    spots = [(int(p[0]), int(p[1]), n) for p, n, keep in zip(pixels, numbers, inside, strict=True) if keep]
    used = np.zeros((height, width), bool)
    for x, y, _ in spots:
        used[max(y - dot - 2, 0) : y + dot + 3, max(x - dot - 2, 0) : x + dot + 3] = True
    plates = {}
    for x, y, number in spots:
        plates[number] = beside(str(number), font, (x, y), used, np.zeros(used.shape), gap=dot + 3)
        take(used, plates[number])
    drawn = Image.fromarray(image)
    draw = ImageDraw.Draw(drawn)
    for number, plate in plates.items():
        draw_leader(draw, plate, mark_color(number))
    for x, y, number in spots:
        draw.ellipse([x - dot - 1, y - dot - 1, x + dot + 1, y + dot + 1], fill=(255, 255, 255))
        if number in hollow:
            draw.ellipse([x - dot, y - dot, x + dot, y + dot], outline=mark_color(number), width=max(2, dot // 2))
        else:
            draw.ellipse([x - dot, y - dot, x + dot, y + dot], fill=mark_color(number), outline=(0, 0, 0))
    for number, plate in plates.items():
        draw_plate(draw, plate, mark_color(number))
    return np.asarray(drawn)


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
    weight = np.concatenate([[0.0], [HIDDEN_COST / areas.get(n, 1) for n in range(len(boxes))]])[labels + 1]
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
        size = max(SMALL_FONT, round(scale * SMALL_FONT))
        width, height = plate_size(str(number), size)
        cost = weight + FOREIGN_COST / (width * height) * (labels >= 0)
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
    for size, overhang in ((LARGE_FONT, 0.0), (SMALL_FONT, MAX_OVERHANG)):
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
    score = depth[y, x] - MIDDLE_WEIGHT * np.hypot(y - y.mean(), x - x.mean())
    best = int(score.argmax())
    return np.array([x[best], y[best]])


def draw_marks(
    image: UInt8[np.ndarray, "H W 3"], regions: Int[np.ndarray, "H W"], numbers: Sequence[int] | None = None, *, alpha: float
) -> UInt8[np.ndarray, "H W 3"]:
    """Fill, outline and number the regions of the picture.

    regions: region number per pixel, -1 for none; numbers: the regions to draw, all if None; alpha: opacity of the fill
    (`mark_questions.MARK_OPACITY`). A number has the same colour in every picture.
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
