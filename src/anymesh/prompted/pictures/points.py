"""Numbered candidate points (paper, 3.3): dots, each with its number, over the part in question."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float, UInt8
from PIL import Image, ImageDraw

from anymesh.config import REFERENCE_PX
from anymesh.rendering.marks import beside, draw_leader, draw_plate, mark_color, take

FONT, DOT = 16, 4  # [px] in a picture of 640 px: font size; radius of a dot


def labels_apart(pixels: Float[np.ndarray, "k 2"], min_distance: float) -> bool:
    """Return whether all points are at least `min_distance` [px] apart (`PromptConfig.label_apart`)."""
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
    dot, font = round(DOT * scale), round(FONT * scale)
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
