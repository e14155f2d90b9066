"""What each service takes in one request, and pictures made to fit.

Checked on 2026-11-21 against the services' pages on image input. Where models of one service differ, the row holds the
least; where a service shrinks a picture by itself, the row holds the side to which it does, since more is only traffic.
"""

from __future__ import annotations

import base64
import io
import logging
from dataclasses import dataclass

from PIL import Image

from anymesh.errors import ModelError
from anymesh.models.vision import Request
from anymesh.types.exchange import Picture

log = logging.getLogger("anymesh")
MEGABYTE = 1_000_000


@dataclass(frozen=True)
class RequestLimits:
    """picture [bytes], side [px], pictures [count], request [bytes, pictures in base64]."""

    picture: int
    side: int
    pictures: int
    request: int


LIMITS = {
    "openai": RequestLimits(20 * MEGABYTE, 2048, 500, 50 * MEGABYTE),
    "openai-responses": RequestLimits(20 * MEGABYTE, 2048, 500, 50 * MEGABYTE),
    "anthropic": RequestLimits(5 * MEGABYTE, 2000, 100, 32 * MEGABYTE),  # 8000 px, but 2000 px from 21 pictures on
    "google": RequestLimits(7 * MEGABYTE, 3072, 900, 20 * MEGABYTE),
    "openai-compatible": RequestLimits(20 * MEGABYTE, 2048, 100, 50 * MEGABYTE),  # a guess: every server has its own
}


def fit(request: Request, provider: str) -> tuple[Picture, ...]:
    """The request's pictures, those that are too large made smaller. Raises ModelError when they are too many."""
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
    # The bytes count in base64: the services differ in how they count, and this is the stricter way.
    scale = min(1.0, limits.side / max(width, height), (limits.picture / _encoded(picture.png)) ** 0.5)
    small = picture
    while scale < 1:
        small = _resized(picture, max(1, int(width * scale)), max(1, int(height * scale)))
        if _encoded(small.png) <= limits.picture:
            log.info("a picture of %dx%d px is sent as %dx%d px", width, height, *small.size)
            break
        scale *= 0.8  # how well a PNG packs is only known afterwards
    return small


def _resized(picture: Picture, width: int, height: int) -> Picture:
    buffer = io.BytesIO()
    with Image.open(io.BytesIO(picture.png)) as image:
        colours = image if image.mode in ("L", "RGB", "RGBA") else image.convert("RGBA")
        colours.resize((width, height), Image.Resampling.LANCZOS).save(buffer, "PNG", optimize=True)
    return Picture(buffer.getvalue(), picture.caption)


def _encoded(png: bytes) -> int:
    return len(base64.b64encode(png))
