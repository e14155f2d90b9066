"""Limits of each service for one request, and downscaling of pictures to fit them.

Checked on 2026-11-21 against the services' pages on image input. If the models of a service differ, the row holds the lowest
limit. If a service downscales pictures itself, the row holds the resulting side, since larger pictures only cost traffic.
"""

from __future__ import annotations

import base64
import io
import logging
from dataclasses import dataclass

from PIL import Image

from anymesh.errors import ModelError
from anymesh.prompted.models.vision import Request
from anymesh.types.exchange import Picture

log = logging.getLogger("anymesh")
MEGABYTE = 1_000_000


@dataclass(frozen=True)
class RequestLimits:
    """picture [bytes], side [px], pictures [count], request [bytes, with pictures in base64]."""

    picture: int
    side: int
    pictures: int
    request: int


LIMITS = {
    "openai": RequestLimits(20 * MEGABYTE, 2048, 500, 50 * MEGABYTE),
    "openai-responses": RequestLimits(20 * MEGABYTE, 2048, 500, 50 * MEGABYTE),
    "anthropic": RequestLimits(5 * MEGABYTE, 2000, 100, 32 * MEGABYTE),  # 8000 px, but 2000 px from 21 pictures on
    "google": RequestLimits(7 * MEGABYTE, 3072, 900, 20 * MEGABYTE),
    # an assumption: every server has its own limits
    "openai-compatible": RequestLimits(20 * MEGABYTE, 2048, 100, 50 * MEGABYTE),
}


def fit(request: Request, provider: str) -> tuple[Picture, ...]:
    """Return the request's pictures, downscaled where needed. Raise ModelError if they are too many or too large in total."""
    limits = LIMITS[provider]
    if len(request.pictures) > limits.pictures:
        raise ModelError(
            f"{request.kind}: {len(request.pictures)} pictures in one request, {provider} takes at most {limits.pictures}"
        )
    pictures = tuple(_shrunk(picture, limits) for picture in request.pictures)
    words = len(request.system) + len(request.text) + sum(len(p.caption) for p in pictures)
    size = 4 * words + sum(4 * (len(p.png) + 2) // 3 for p in pictures)  # a character may take four bytes
    if size > limits.request:
        raise ModelError(
            f"{request.kind}: a request of {size / MEGABYTE:.1f} MB, {provider} takes {limits.request / MEGABYTE:.0f} MB"
        )
    return pictures


def _shrunk(picture: Picture, limits: RequestLimits) -> Picture:
    width, height = picture.size
    # Sizes are compared in base64: services differ in what they count, and this is the stricter choice.
    scale = min(1.0, limits.side / max(width, height), (limits.picture / _encoded(picture.png)) ** 0.5)
    small = picture
    while scale < 1:
        small = _resized(picture, max(1, int(width * scale)), max(1, int(height * scale)))
        if _encoded(small.png) <= limits.picture:
            log.info("a picture of %dx%d px is sent as %dx%d px", width, height, *small.size)
            break
        scale *= 0.8  # the size of a PNG is only known after compression
    return small


def _resized(picture: Picture, width: int, height: int) -> Picture:
    buffer = io.BytesIO()
    with Image.open(io.BytesIO(picture.png)) as image:
        colours = image if image.mode in ("L", "RGB", "RGBA") else image.convert("RGBA")
        colours.resize((width, height), Image.Resampling.LANCZOS).save(buffer, "PNG", optimize=True)
    return Picture(buffer.getvalue(), picture.caption)


def _encoded(png: bytes) -> int:
    return len(base64.b64encode(png))
