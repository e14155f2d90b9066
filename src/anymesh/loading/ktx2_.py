"""KTX 2 pictures, which glTF names by KHR_texture_basisu, decoded by Basis Universal."""

from __future__ import annotations

from PIL import Image

from anymesh.errors import MissingExtraError, pip_install


def open_ktx2(data: bytes, most: int) -> Image.Image:
    """Return the largest level of a KTX 2 file of at most `most` pixels.

    Raise MissingExtraError without the decoder, ValueError or an error of its own if the file is broken or too large.
    """
    try:
        import opengl_basisu
    except ImportError as error:
        raise MissingExtraError(f"KTX 2: {pip_install('ktx2')}") from error
    texture = opengl_basisu.open(data)
    if texture.width * texture.height > most:
        raise ValueError(f"{texture.width} x {texture.height} pixels")
    pixels = texture.transcode("rgba8").data
    return Image.fromarray(pixels if texture.has_alpha else pixels[..., :3])
