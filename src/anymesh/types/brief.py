"""Short texts of values: arrays and bytes are described, not printed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np

SHOWN, LONGEST = 3, 80  # items of a collection and characters of a value that are printed


def brief(value: Any) -> str:
    """Describe a value in at most 80 characters or so: a vector in full, other arrays by shape, bytes by number."""
    if isinstance(value, np.ndarray):
        short = value.ndim == 1 and value.size <= SHOWN and value.dtype.kind in "fiub"
        return f"({', '.join(f'{float(v) + 0.0:.4g}' for v in value)})" if short else f"{value.dtype} {value.shape}"
    if isinstance(value, bytes):
        return f"{len(value)} bytes"
    if isinstance(value, (Mapping, tuple, list)):
        if len(value) > SHOWN:
            return f"{len(value)} {type(next(iter(value))).__name__}"
        items = [f"{k}: {brief(v)}" for k, v in value.items()] if isinstance(value, Mapping) else map(brief, value)
        text = f"({', '.join(items)})"
    else:
        text = repr(value)
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 3]}..."


class Brief:
    """Base of dataclasses that hold arrays or bytes: their repr is one line. It stands in the class, so dataclass keeps it."""

    def __init_subclass__(cls) -> None:
        if "__repr__" not in vars(cls):
            cls.__repr__ = Brief.__repr__

    def __repr__(self: Any) -> str:
        return f"{type(self).__name__}({', '.join(f'{f.name}={brief(getattr(self, f.name))}' for f in fields(self) if f.repr)})"
