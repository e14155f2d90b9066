"""Colours and masks over pictures."""

from __future__ import annotations

import colorsys

import numpy as np
from jaxtyping import Bool, UInt8
from scipy import ndimage

HIGHLIGHT = (30, 110, 245)  # colour of the part in question; furniture is seldom blue
# saturation, value; 21 numbers later, similar hues recur
TONES = ((0.9, 0.9), (0.95, 0.6), (0.5, 1.0), (0.75, 0.75), (1.0, 0.45))
Color = tuple[int, int, int]


def mark_color(number: int) -> Color:
    """Return the colour of a number.

    Hues follow the golden ratio in five tones, so that consecutive numbers differ most.
    """
    saturation, value = TONES[number % len(TONES)]
    r, g, b = colorsys.hsv_to_rgb(number * 0.6180339887 % 1.0, saturation, value)
    return round(255 * r), round(255 * g), round(255 * b)


def contrast(color: Color) -> Color:
    """Return black or white, whichever is more legible on the colour."""
    return (0, 0, 0) if 0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2] > 140 else (255, 255, 255)


def blend(
    image: UInt8[np.ndarray, "H W 3"], mask: Bool[np.ndarray, "H W"], color: Color, alpha: float
) -> UInt8[np.ndarray, "H W 3"]:
    """Return a copy with a colour blended over the mask. alpha: 0 leaves it unchanged, 1 is opaque."""
    mixed, chosen = image.copy(), np.flatnonzero(mask)
    pixels = mixed.reshape(-1, 3)
    pixels[chosen] = np.round((1 - alpha) * pixels[chosen] + alpha * np.array(color))
    return mixed


def lighten(image: UInt8[np.ndarray, "*n 3"], share: float) -> UInt8[np.ndarray, "*n 3"]:
    """Blend the image towards white; a share of 1 is white."""
    return np.round(255 - (1 - share) * (255 - image.astype(float))).astype(np.uint8)


def rim(mask: Bool[np.ndarray, "H W"], width: int) -> Bool[np.ndarray, "H W"]:
    """Return the pixels just outside a mask, up to `width` [px] from it."""
    return ndimage.binary_dilation(mask, np.ones((3, 3), bool), iterations=width) & ~mask if mask.any() else mask


def highlight(
    image: UInt8[np.ndarray, "H W 3"], mask: Bool[np.ndarray, "H W"], *, alpha: float = 0.3
) -> UInt8[np.ndarray, "H W 3"]:
    """Return a copy with a part tinted and outlined. The outline lies outside the part, so that small parts stay visible."""
    width = max(2, round(image.shape[0] / 240))
    tinted = blend(image, mask, HIGHLIGHT, alpha)
    outer = rim(mask, width + 1)
    return blend(blend(tinted, outer, (255, 255, 255), 1.0), rim(mask, width), HIGHLIGHT, 1.0)
