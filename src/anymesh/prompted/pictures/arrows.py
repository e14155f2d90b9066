"""Numbered arrows along directions in space, and the choice of the view in which they differ most (paper, 3.3)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float, Int, UInt8
from PIL import Image, ImageDraw

from anymesh.config import REFERENCE_PX
from anymesh.rendering.marks import beside, draw_arrow, draw_leader, draw_plate, mark_color, take
from anymesh.rendering.render import View
from anymesh.rendering.viewpoints import visible_pixels
from anymesh.types.camera import Camera

FONT, WIDTH = 20, 2.0  # [px] font size in a picture of 640 px; line width of an arrow, in the unit of `draw_arrow`
VISIBLE = 0.25  # minimum share of the part's pixels in its best view; views with fewer are not chosen


def clearest_view(
    views: Sequence[View],
    center: Float[np.ndarray, " 3"],
    directions: Float[np.ndarray, "k 3"],
    face_part: Int[np.ndarray, " F"],
    part: int,
) -> int:
    """Return the index of the view in which arrows from `center` are most distinct.

    Only views that show enough of the part (`VISIBLE`) are considered. See `distinctness` for the score.
    """
    seen = np.array([visible_pixels(v, face_part, part) for v in views])
    score = [distinctness(v.camera, center, directions) for v in views]
    return int(np.argmax(np.where(seen >= VISIBLE * seen.max(), score, -1.0)))


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
        draw_arrow(draw, np.stack([start, tip]), mark_color(number), WIDTH * scale)
        t = np.linspace(0, 1, 400)[:, None]
        columns, rows = np.round(start + t * (tip - start)).astype(int).T
        inside = (rows >= 0) & (columns >= 0) & (rows < height) & (columns < width)
        used[rows[inside], columns[inside]] = True
    x, y = (int(v) for v in start)
    draw.ellipse([x - 5, y - 5, x + 5, y + 5], fill=(0, 0, 0), outline=(255, 255, 255))
    for tip, number in zip(tips, numbers, strict=True):
        beyond = tip + FONT * scale * (tip - start) / max(float(np.linalg.norm(tip - start)), 1.0)
        x, y = (int(v) for v in np.clip(beyond, 0, [width - 1, height - 1]))
        plate = beside(str(number), round(FONT * scale), (x, y), used, np.zeros(used.shape), gap=0)
        take(used, plate)
        if plate.led:
            draw_leader(draw, plate, mark_color(number))
        draw_plate(draw, plate, mark_color(number))
    return np.asarray(drawn)
