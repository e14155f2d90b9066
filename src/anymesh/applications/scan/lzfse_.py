"""LZFSE, in which Record3D keeps depth, by the package lzfse (MIT, 0.2 MB)."""

from __future__ import annotations

from anymesh.errors import InputError, MissingExtraError


def unpack(data: bytes, name: str) -> bytes:
    """The uncompressed bytes. InputError where they are damaged, MissingExtraError without the library."""
    try:
        import lzfse  # ty: ignore[import-not-found]
    except ImportError:
        raise MissingExtraError(
            "depth of Record3D is compressed with LZFSE; pip install 'articulate-anymesh[scan]' brings what reads it"
        ) from None
    try:
        return lzfse.decompress(data)
    except lzfse.error as error:
        raise InputError(f"{name} is no LZFSE data: {error}") from None


def pack(data: bytes) -> bytes:
    """Compressed bytes, for recordings that are written."""
    import lzfse  # ty: ignore[import-not-found]

    return lzfse.compress(data)
