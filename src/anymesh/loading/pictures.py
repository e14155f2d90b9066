"""Pictures of materials, kept as the bytes of their file."""

from __future__ import annotations

import io
import re
import warnings
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import PurePosixPath

from PIL import Image

from anymesh.loading.folder import SHOWN, Folder
from anymesh.types import Texture

MAX_PIXELS = 16384**2
MIME_TYPES = {"PNG": "image/png", "JPEG": "image/jpeg"}
OBJECT = re.compile(r"\s*<[^>]*>")  # Python's name of a stream in an error, with an address that differs between runs


def picture_file(folder: Folder, uri: str) -> Texture | None:
    """Return the texture in a named file; None, with a warning, if it cannot be read."""
    data = folder.read_or_warn(uri, "texture")
    return None if data is None else picture(folder, data, uri)


def picture(folder: Folder, data: bytes, name: str) -> Texture | None:
    """Return a texture of encoded bytes; None, with a warning, if they are broken.

    PNG and JPEG are kept unchanged, other formats are converted to PNG.
    """
    stem = PurePosixPath(name.replace("\\", "/")).stem
    try:
        with quiet_decoder():
            image = Image.open(io.BytesIO(data))
        if image.width * image.height > MAX_PIXELS:
            raise ValueError(f"{image.width} x {image.height} pixels")
        image.load()
        if image.format in MIME_TYPES:
            return Texture(data, MIME_TYPES[image.format], stem)
        buffer = io.BytesIO()
        image.convert("RGBA" if image.has_transparency_data else "RGB").save(buffer, "PNG")
    except Exception as error:  # decoders raise many types of errors for broken pictures
        warn_unreadable(folder, name, error)
        return None
    return Texture(buffer.getvalue(), "image/png", stem)


def warn_unreadable(folder: Folder, name: str, error: Exception) -> None:
    """Warn of an existing texture that cannot be read."""
    reason = f"{type(error).__name__}: {OBJECT.sub('', str(error))}"[:100]
    folder.warn(f"texture {name[:SHOWN]!r} left out: it cannot be read ({reason})")


@contextmanager
def quiet_decoder() -> Generator[None]:
    """Suppress the decoder's warning about large pictures, which are limited by MAX_PIXELS."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        yield
