"""Encoding of pixels as PNG."""

from __future__ import annotations

import io

import numpy as np
from jaxtyping import UInt8
from PIL import Image

from anymesh.types.exchange import Picture


def encode(image: UInt8[np.ndarray, "H W 3"], caption: str = "") -> Picture:
    """Encode the image as PNG; equal pixels give equal bytes."""
    buffer = io.BytesIO()
    Image.fromarray(image).save(buffer, "PNG", optimize=False)
    return Picture(buffer.getvalue(), caption)
