"""Short texts of values: arrays and bytes are described, not printed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np

SHOWN, LONGEST = 3, 80  # items of a collection and characters of a value that are printed


def brief(value: Any) -> str:
    """Describe a value in at most 80 characters or so: a vector in full, other arrays by shape, bytes by number."""
    match value:
        case np.ndarray(ndim=1, size=size) if size <= SHOWN:
            return f"({', '.join(f'{float(v) + 0.0:.4g}' for v in value)})" if value.dtype.kind in "fiub" else f"{value.dtype}"
        case np.ndarray():
            return f"{value.dtype} {value.shape}"
        case bytes() | bytearray() | memoryview():
            return f"{len(value)} bytes"
        case Mapping() | tuple() | list() | set() | frozenset() if len(value) > SHOWN:
            return f"{len(value)} {type(next(iter(value))).__name__}"
        case Mapping():
            text = f"{{{', '.join(f'{key}: {brief(v)}' for key, v in value.items())}}}"
        case tuple() | list():
            text = f"({', '.join(brief(v) for v in value)})"
        case _:
            text = repr(value)
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 3]}..."


class Brief:
    """Base of dataclasses that hold arrays or bytes: their repr is one line. It stands in the class, so dataclass keeps it."""

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        if "__repr__" not in vars(cls):
            cls.__repr__ = brief_repr


def brief_repr(value: Any) -> str:
    """Return the repr of a dataclass with brief values."""
    return f"{type(value).__name__}({', '.join(f'{f.name}={brief(getattr(value, f.name))}' for f in fields(value) if f.repr)})"
