"""Pictures of materials, kept as the bytes of their file, and the colour space of colours."""

from __future__ import annotations

import io
import warnings
from pathlib import PurePosixPath

from PIL import Image

from anymesh.loading.folder import Folder
from anymesh.types import Texture

LOSS = "the surfaces that use it have no picture"
MOST_PIXELS = 16384**2
KEPT = {"PNG": "image/png", "JPEG": "image/jpeg"}


def picture_file(folder: Folder, uri: str) -> Texture | None:
    """The picture in a file that is named; None, with a warning, where it is missing or broken."""
    data = folder.read_or_warn(uri, LOSS)
    return None if data is None else picture(folder, data, uri)


def picture(folder: Folder, data: bytes, name: str) -> Texture | None:
    """A texture of encoded bytes: PNG and JPEG as they are, others turned into PNG; None, with a warning, where broken."""
    stem = PurePosixPath(name.replace("\\", "/")).stem
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            image = Image.open(io.BytesIO(data))
        if image.width * image.height > MOST_PIXELS:
            raise ValueError(f"{image.width} x {image.height} pixels")
        image.load()
        if image.format in KEPT:
            return Texture(data, KEPT[image.format], stem)
        buffer = io.BytesIO()
        image.convert("RGBA" if image.has_transparency_data else "RGB").save(buffer, "PNG")
    except Exception as error:  # whatever a broken picture makes the decoder raise is one thing to the user
        folder.warn(f"the picture {name!r} cannot be read ({type(error).__name__}: {str(error)[:80]}); {LOSS}")
        return None
    return Texture(buffer.getvalue(), "image/png", stem)
