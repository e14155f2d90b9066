"""Pixels to the bytes of a PNG file."""

from __future__ import annotations

import io

import numpy as np
from jaxtyping import UInt8
from PIL import Image

from anymesh.types.exchange import Picture


def encode(image: UInt8[np.ndarray, "H W 3"], caption: str = "") -> Picture:
    """The picture as PNG bytes, the same for the same pixels."""
    buffer = io.BytesIO()
    Image.fromarray(image).save(buffer, "PNG", optimize=False)
    return Picture(buffer.getvalue(), caption)
