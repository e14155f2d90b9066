"""The GLB container: typed arrays and images in one binary buffer, described in JSON."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from typing import Any

import numpy as np

FLOAT, UBYTE, USHORT, UINT = 5126, 5121, 5123, 5125
VERTICES, INDICES = 34962, 34963  # bufferView targets
KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
COMPONENTS = {"float32": FLOAT, "uint8": UBYTE, "uint16": USHORT, "uint32": UINT}


class GlbBuffer:
    """Collects accessors and images; equal arrays for the same use are stored once."""

    def __init__(self) -> None:
        self._chunks: list[bytes] = []
        self._length = 0
        self._known: dict[tuple[Any, ...], int] = {}
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def view(self, data: bytes, target: int | None = None) -> int:
        """Add a buffer view of some bytes, starting at a multiple of 4."""
        view: dict[str, Any] = {"buffer": 0, "byteOffset": self._length, "byteLength": len(data)}
        if target is not None:
            view["target"] = target
        padded = data + b"\0" * (-len(data) % 4)
        self._chunks.append(padded)
        self._length += len(padded)
        self.views.append(view)
        return len(self.views) - 1

    def accessor(self, array: np.ndarray, *, target: int | None = None, bounds: bool = False, normalized: bool = False) -> int:
        """Add an accessor of a (n,) or (n, k) array; `bounds` adds its minimum and maximum, as positions and times need."""
        array = np.ascontiguousarray(array)
        data = array.tobytes()
        key = (hashlib.sha256(data).digest(), array.shape, array.dtype.str, target, bounds, normalized)
        if key in self._known:
            return self._known[key]
        columns = array.reshape(len(array), -1)
        accessor: dict[str, Any] = {
            "bufferView": self.view(data, target),
            "componentType": COMPONENTS[array.dtype.name],
            "count": len(array),
            "type": KINDS[columns.shape[1]],
        }
        if bounds:
            accessor |= {"min": columns.min(0).tolist(), "max": columns.max(0).tolist()}
        if normalized:
            accessor["normalized"] = True
        self.accessors.append(accessor)
        self._known[key] = len(self.accessors) - 1
        return self._known[key]

    def encode(self, document: Mapping[str, Any]) -> bytes:
        """Return the GLB file: header, JSON chunk padded with spaces, binary chunk padded with zeros."""
        whole = {
            **document,
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{"byteLength": self._length}],
        }
        text = json.dumps(whole, separators=(",", ":"), allow_nan=False).encode("ascii")
        text += b" " * (-len(text) % 4)
        total = 12 + 8 + len(text) + 8 + self._length
        head = b"glTF" + np.array([2, total, len(text)], "<u4").tobytes() + b"JSON"
        return b"".join([head, text, np.array([self._length], "<u4").tobytes(), b"BIN\0", *self._chunks])
