"""LZFSE compression, used by Record3D for depth, by the package lzfse (MIT, 0.2 MB)."""

from __future__ import annotations

import importlib
from typing import Any

from anymesh.errors import InputError, MissingExtraError


def unpack(data: bytes, name: str) -> bytes:
    """Decompress bytes. Raise InputError if they are damaged, MissingExtraError if the library is not installed."""
    try:
        lzfse: Any = importlib.import_module("lzfse")  # a compiled module without types
    except ImportError:
        raise MissingExtraError(
            "depth of Record3D is compressed with LZFSE; pip install 'articulate-anymesh[scan]' brings what reads it"
        ) from None
    try:
        return lzfse.decompress(data)
    except lzfse.error as error:
        raise InputError(f"{name} is not LZFSE data: {error}") from None


def pack(data: bytes) -> bytes:
    """Compress bytes, for writing recordings."""
    lzfse: Any = importlib.import_module("lzfse")
    return lzfse.compress(data)
