"""Pictures of materials whose channels come from several files, as glTF's layout needs them in one."""

from __future__ import annotations

import io
from dataclasses import dataclass

import numpy as np
from PIL import Image

from anymesh.loading.files import quiet_decoder
from anymesh.types import Texture

CHANNELS = "rgba"


@dataclass(frozen=True)
class Channel:
    """One channel of a picture: r, g, b or a (inverted if `inverted`); grey pictures have the same in r, g and b."""

    texture: Texture
    channel: str = "r"
    inverted: bool = False


def merged(base: Texture | None, **channels: Channel | None) -> Texture:
    """Return a picture with some channels of others, in the size of the largest; what none gives is 255.

    base: gives the channels that are not named. A picture that already is the result is returned unchanged.
    """
    parts = {name: c for name, c in channels.items() if c is not None}
    only = {c.texture.data: c.texture for c in parts.values()} | ({} if base is None else {base.data: base})
    if len(only) == 1 and all(c.channel == name and not c.inverted for name, c in parts.items()):
        return next(iter(only.values()))
    images = {data: _opened(data) for data in only}
    size = max((image.size for image in images.values()), key=lambda s: s[0] * s[1])
    planes = {data: np.asarray(image if image.size == size else image.resize(size)) for data, image in images.items()}
    result = np.full((size[1], size[0], 4), 255, np.uint8) if base is None else planes[base.data].copy()
    for name, c in parts.items():
        plane = planes[c.texture.data][:, :, CHANNELS.index(c.channel)]
        result[:, :, CHANNELS.index(name)] = 255 - plane if c.inverted else plane
    buffer = io.BytesIO()
    Image.fromarray(result if "a" in parts or base is not None else result[:, :, :3]).save(buffer, "PNG")
    return Texture(buffer.getvalue(), "image/png", "_".join(dict.fromkeys(t.name for t in only.values() if t.name)))


def has_alpha(texture: Texture) -> bool:
    """Return whether a picture is see-through anywhere."""
    return bool((np.asarray(_opened(texture.data))[..., 3] < 255).any())


def is_normal_map(texture: Texture) -> bool:
    """Return whether a picture shows directions rather than heights: mostly light blue."""
    red, green, blue = np.asarray(_opened(texture.data).resize((64, 64)))[..., :3].reshape(-1, 3).mean(0)
    return bool(blue > 180 and abs(red - 128) < 40 and abs(green - 128) < 40)


def _opened(data: bytes) -> Image.Image:
    with quiet_decoder():
        return Image.open(io.BytesIO(data)).convert("RGBA")
