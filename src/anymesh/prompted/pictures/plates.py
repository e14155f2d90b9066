"""Numbers on plates, placed in pictures without overlap."""

from __future__ import annotations

import colorsys
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from PIL import ImageDraw

from anymesh.rendering.marks import Color, font

# saturation, value; 21 numbers later, similar hues recur
TONES = ((0.9, 0.9), (0.95, 0.6), (0.5, 1.0), (0.75, 0.75), (1.0, 0.45))
PAD = 3  # [px] padding of a plate around its text
STEP = 3  # [px] spacing of the grid of positions that are tried
TRIES = 400  # number of positions tried for a leader that crosses no plate
BLOCKED = 1e6  # cost of a pixel that must not be covered: above all distances, yet sums over a picture stay exact


def mark_color(number: int) -> Color:
    """Return the colour of a number. Hues follow the golden ratio in five tones, so that consecutive numbers differ most."""
    saturation, value = TONES[number % len(TONES)]
    r, g, b = colorsys.hsv_to_rgb(number * 0.6180339887 % 1.0, saturation, value)
    return round(255 * r), round(255 * g), round(255 * b)


def contrast(color: Color) -> Color:
    """Return black or white, whichever is more legible on the colour."""
    return (0, 0, 0) if 0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2] > 140 else (255, 255, 255)


@dataclass(frozen=True)
class Plate:
    """A number on a plate. box: x0, y0, x1, y1 [px], x1 and y1 exclusive; anchor: the pixel x, y that it labels."""

    text: str
    box: tuple[int, int, int, int]
    anchor: tuple[int, int]
    size: int  # font size [px]

    @property
    def led(self) -> bool:
        """Whether a leader connects the plate to its anchor, which then lies outside the plate."""
        (x0, y0, x1, y1), (x, y) = self.box, self.anchor
        return not (x0 <= x < x1 and y0 <= y < y1)

    @property
    def end(self) -> tuple[int, int]:
        """The point of the plate nearest to the anchor."""
        (x0, y0, x1, y1), (x, y) = self.box, self.anchor
        return min(max(x, x0), x1 - 1), min(max(y, y0), y1 - 1)


def plate_size(text: str, size: int) -> tuple[int, int]:
    """Return width and height of a plate [px]; the height does not depend on the digits."""
    left, _, right, _ = font(size).getbbox(text)
    return round(right - left) + 2 * PAD, round(0.74 * size) + 2 * PAD


def draw_leader(draw: ImageDraw.ImageDraw, plate: Plate, color: Color) -> None:
    """Draw the line from a plate to its anchor, with a white rim. Draw leaders before plates, since they may cross."""
    x, y = plate.anchor
    line, dark = [plate.anchor, plate.end], tuple(c // 2 for c in color)
    draw.line(line, fill=(255, 255, 255), width=4)
    draw.line(line, fill=dark, width=2)
    draw.ellipse([x - 2, y - 2, x + 2, y + 2], fill=dark)


def draw_plate(draw: ImageDraw.ImageDraw, plate: Plate, color: Color) -> None:
    """Draw the number in black or white on its plate."""
    x0, y0, x1, y1 = plate.box
    draw.rectangle([x0, y0, x1 - 1, y1 - 1], fill=color, outline=contrast(color))
    middle = ((x0 + x1 - 1) / 2, y1 - PAD)
    draw.text(middle, plate.text, fill=contrast(color), font=font(plate.size), anchor="ms")


def window_sums(weights: Float[np.ndarray, "H W"], width: int, height: int) -> Float[np.ndarray, "h w"]:
    """Compute the sums over all windows of a size; entry [y, x] belongs to the window whose top left pixel is there."""
    total = np.zeros((weights.shape[0] + 1, weights.shape[1] + 1))
    total[1:, 1:] = weights.cumsum(0).cumsum(1)
    h, w = max(weights.shape[0] - height + 1, 0), max(weights.shape[1] - width + 1, 0)
    return total[height:, width:] - total[:h, width:] - total[height:, :w] + total[:h, :w]


def beside(
    text: str, size: int, anchor: tuple[int, int], used: Bool[np.ndarray, "H W"], cost: Float[np.ndarray, "H W"], gap: int
) -> Plate:
    """Place the plate nearest to its anchor that covers no used pixel and whose leader crosses none.

    cost: of each covered pixel, as a distance [px]; gap: minimum distance between plate and anchor [px].
    If there is no such position, the leader may cross plates. If every position covers used pixels, as few as possible are
    covered.
    """
    width, height = plate_size(text, size)
    sums = window_sums(cost + BLOCKED * used, width, height)[::STEP, ::STEP]
    x0, y0 = STEP * np.arange(sums.shape[1])[None], STEP * np.arange(sums.shape[0])[:, None]
    dx = np.maximum(np.maximum(x0 - anchor[0], anchor[0] - (x0 + width - 1)), 0)
    dy = np.maximum(np.maximum(y0 - anchor[1], anchor[1] - (y0 + height - 1)), 0)
    near = np.hypot(dx, dy)
    centering = np.hypot(x0 + width / 2 - anchor[0], y0 + height / 2 - anchor[1])
    # Among positions at the same distance, prefer the one whose centre is nearest to the anchor.
    total = sums + near + 0.05 * centering + BLOCKED * (near < gap)
    order = np.argsort(total, axis=None, kind="stable")
    free = int((total < BLOCKED / 2).sum())
    for k in order[: min(free, TRIES)]:
        plate = _plate_at(text, size, anchor, divmod(int(k), sums.shape[1]), (width, height))
        if not _crosses(plate, used):
            return plate
    return _plate_at(text, size, anchor, divmod(int(order[0]), sums.shape[1]), (width, height))


def _plate_at(text: str, size: int, anchor: tuple[int, int], cell: tuple[int, int], extent: tuple[int, int]) -> Plate:
    y, x = STEP * cell[0], STEP * cell[1]
    return Plate(text, (x, y, x + extent[0], y + extent[1]), anchor, size)


def line_pixels(plate: Plate) -> tuple[np.ndarray, np.ndarray]:
    """Return rows and columns of the leader's pixels, for indexing."""
    (x0, y0), (x1, y1) = plate.anchor, plate.end
    t = np.linspace(0, 1, 2 * max(abs(x1 - x0), abs(y1 - y0)) + 1)
    return np.round(y0 + t * (y1 - y0)).astype(int), np.round(x0 + t * (x1 - x0)).astype(int)


def _crosses(plate: Plate, used: Bool[np.ndarray, "H W"]) -> bool:
    rows, columns = line_pixels(plate)
    # Used pixels next to the anchor belong to the anchor's own dot.
    far = np.hypot(rows - plate.anchor[1], columns - plate.anchor[0]) > 9
    return bool(used[rows[far], columns[far]].any())


def broken(words: str, width: int, size: int) -> list[str]:
    """Break words into lines after each comma, and where they would be wider than `width` [px]."""
    lines: list[str] = []
    for piece in words.split(", ") if words else ():
        lines.append("")
        for word in piece.split():
            longer = f"{lines[-1]} {word}".strip()
            fits = not lines[-1] or plate_size(longer, size)[0] <= width
            lines = [*lines[:-1], longer] if fits else [*lines, word]
    return lines


def take(used: Bool[np.ndarray, "H W"], plate: Plate) -> None:
    """Mark the pixels of a plate and its leader as used, in place."""
    x0, y0, x1, y1 = plate.box
    used[max(y0 - 1, 0) : y1 + 1, max(x0 - 1, 0) : x1 + 1] = True  # one pixel of space between plates
    if plate.led:
        used[line_pixels(plate)] = True
