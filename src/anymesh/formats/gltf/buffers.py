"""Numeric data of a glTF 2.0 file: its JSON, buffers and accessors (sections 3.6 and 4.4 of the specification)."""

from __future__ import annotations

import base64
import binascii
import json
import struct
from typing import Any
from urllib.parse import unquote_to_bytes

import numpy as np

from anymesh.entry_points import MESHOPT, resolve
from anymesh.errors import InputError
from anymesh.loading.files import MAX_FACES, Folder

TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
COMPRESSED = ("EXT_meshopt_compression", "KHR_meshopt_compression")
MAX_DECODED = 2**29  # [bytes] of one compressed buffer view
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class DataError(InputError):
    """A part of a glTF file that cannot be read, and without which the rest may be usable."""


def split_glb(name: str, data: bytes) -> tuple[bytes, bytes | None]:
    """Return the JSON and the binary chunk of a GLB. Raise InputError if it is broken."""
    if len(data) < 20:
        raise InputError(f"{name} is truncated: a GLB header has 20 bytes, found {len(data)}")
    _, version, length = struct.unpack_from("<4sII", data)
    if version != 2:
        raise InputError(f"{name}: found glTF version {version}; valid is 2")
    if length > len(data):
        raise InputError(f"{name} is truncated: its header states {length} bytes, found {len(data)}")
    chunks: dict[bytes, bytes] = {}
    at = 12
    while at + 8 <= length:
        size, kind = struct.unpack_from("<I4s", data, at)
        if at + 8 + size > length:
            raise InputError(f"{name} is truncated: a chunk states {size} bytes, found {length - at - 8}")
        chunks.setdefault(kind, data[at + 8 : at + 8 + size])
        at += 8 + size
    if b"JSON" not in chunks:
        raise InputError(f"{name} is broken: found no JSON chunk, with which a GLB begins")
    return chunks[b"JSON"], chunks.get(b"BIN\0")


def parse_json(name: str, data: bytes) -> dict[str, Any]:
    """Return the document. Raise InputError if it cannot be read."""
    try:
        tree = json.loads(data.decode("utf-8-sig"))
    except (ValueError, RecursionError):
        raise InputError(f"{name}: its JSON cannot be read; the file is broken or truncated") from None
    if not isinstance(tree, dict) or not tree.get("meshes"):
        raise InputError(f"{name} holds no mesh; at least one with a triangle is needed")
    version = str(tree.get("asset", {}).get("version", "2.0"))
    if not version.startswith("2"):
        raise InputError(f"{name}: found glTF version {version[:20]}; valid is 2")
    return tree


class Buffers:
    """The buffers of a document, each read on first use, and the arrays in them."""

    def __init__(self, tree: dict[str, Any], binary: bytes | None, folder: Folder) -> None:
        self._name = folder.path.name
        self._tree = tree
        self._binary = binary
        self._folder = folder
        self._read: dict[int, bytes] = {}
        self._decoded: dict[int, bytes] = {}  # of compressed buffer views

    def _buffer(self, number: int) -> bytes:
        if number not in self._read:
            buffer = item(self._tree.get("buffers", []), number)
            uri = buffer.get("uri")
            data = (self._binary or b"") if uri is None else from_uri(uri, self._folder)
            length = buffer["byteLength"]
            if length > len(data):
                raise InputError(f"{self._name} is truncated: buffer {number} states {length} bytes, found {len(data)}")
            self._read[number] = data
        return self._read[number]

    def view(self, index: int) -> bytes:
        """Return the bytes of a buffer view. Raise DataError if it exceeds its buffer, or is compressed and broken."""
        view = item(self._tree["bufferViews"], index)
        packed = next((e for key, e in view.get("extensions", {}).items() if key in COMPRESSED), None)
        if packed is None:
            return self._slice(view)
        if index not in self._decoded:
            if sum(map(len, self._decoded.values())) > MAX_DECODED:
                raise InputError(f"{self._name} decompresses to more than {MAX_DECODED} bytes")
            self._decoded[index] = resolve(MESHOPT)(self._slice(packed), packed)
        return self._decoded[index]

    def _slice(self, view: dict[str, Any]) -> bytes:
        data = self._buffer(view["buffer"])
        start, length = view.get("byteOffset", 0), view["byteLength"]
        if start < 0 or length < 0 or start + length > len(data):
            raise DataError(f"a buffer view ends at byte {start + length}, its buffer at {len(data)}")
        return data[start : start + length]

    def array(self, index: int) -> np.ndarray:
        """Return the (count, width) array of an accessor; normalized integers become floats.

        Raise DataError if it is not valid.
        """
        a = item(self._tree["accessors"], index)
        count, width, dtype = a["count"], WIDTHS[a["type"]], np.dtype(TYPES[a["componentType"]])
        if not isinstance(count, int) or not 0 <= count <= 3 * MAX_FACES:
            raise DataError(f"an accessor states {count} elements; valid are 0 to {3 * MAX_FACES}")
        if "bufferView" in a:
            values = self._strided(a["bufferView"], a.get("byteOffset", 0), count, width, dtype)
        else:
            values = np.zeros((count, width), dtype)
        if "sparse" in a:
            sparse = a["sparse"]
            where, what = sparse["indices"], sparse["values"]
            kind = np.dtype(TYPES[where["componentType"]])
            rows = self._strided(where["bufferView"], where.get("byteOffset", 0), sparse["count"], 1, kind)[:, 0]
            values[rows] = self._strided(what["bufferView"], what.get("byteOffset", 0), sparse["count"], width, dtype)
        return self.normalized(a, values)

    def normalized(self, accessor: dict[str, Any], values: np.ndarray) -> np.ndarray:
        """Return values as floats if the accessor states that its integers are fractions."""
        if accessor.get("normalized") and values.dtype.kind in "iu":
            return np.maximum(values / float(np.iinfo(TYPES[accessor["componentType"]]).max), -1.0)
        return values

    def _strided(self, view: int, start: int, count: int, width: int, dtype: np.dtype) -> np.ndarray:
        data = self.view(view)
        size = width * dtype.itemsize
        stride = self._tree["bufferViews"][view].get("byteStride", size)
        if start < 0 or stride < size or count < 0 or (count and start + stride * (count - 1) + size > len(data)):
            raise DataError(f"an accessor states {count} elements, its view of {len(data)} bytes holds fewer")
        if count == 0:
            return np.zeros((0, width), dtype)
        return np.ndarray((count, width), dtype, data, start, (stride, dtype.itemsize)).copy()


def from_uri(uri: str, folder: Folder) -> bytes:
    """Return the bytes of a data URI or of a file in the folder. Raise InputError if they cannot be read."""
    if not uri.startswith("data:"):
        return folder.read(uri)
    head, _, body = uri.partition(",")
    try:
        return base64.b64decode(body, validate=True) if head.endswith(";base64") else unquote_to_bytes(body)
    except binascii.Error:
        raise InputError(f"{folder.path.name}: found a data URI whose base64 is broken or truncated") from None


def item(items: list, index: int) -> Any:
    """Return the item that a document refers to. Raise IndexError if there is none."""
    if isinstance(index, bool) or not isinstance(index, int) or not 0 <= index < len(items):
        raise IndexError(f"found the index {index}; valid are 0 to {len(items) - 1}")
    return items[index]
