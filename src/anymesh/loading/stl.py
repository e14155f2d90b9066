"""STL, binary and ASCII: triangles, one node per solid; its normals add nothing to the winding and are ignored."""

from __future__ import annotations

import re
import struct
from typing import Any

import numpy as np

from anymesh.errors import InputError
from anymesh.loading.checks import ASCII_STL, check_count
from anymesh.loading.folder import Folder
from anymesh.loading.join import join, simple_mesh
from anymesh.types import Mesh

TRIANGLE = np.dtype([("normal", "<f4", 3), ("vertices", "<f4", (3, 3)), ("attributes", "<u2")])
NUMBER = rb"[-+]?(?:[\d.]|nan|inf)"  # start of a number; tells a facet from words in a title
SOLID = re.compile(rb"(?mi)^[ \t\v\f]*solid\b([^\n]*?)(?=$|\bfacet\s+normal\s+" + NUMBER + rb")")
FACET, END = re.compile(rb"(?i)\bfacet\b"), re.compile(rb"(?i)\bendsolid\b")
VERTEX = re.compile(rb"(?i)\bvertex" + 3 * (rb"\s+(" + NUMBER + rb"\S*)"))
MAX_TITLE = 200  # characters of a solid's name that are kept


def read_stl(data: bytes, folder: Folder) -> Mesh:
    """Return the triangles in file coordinates.

    Raise InputError if they are not valid.
    """
    name = folder.path.name
    if not ASCII_STL.match(data) or _is_complete(data):
        return _binary(name, data)
    data = data.removeprefix(b"\xef\xbb\xbf").replace(b"\r", b"\n")  # some exporters end lines with a carriage return alone
    starts = [m.start() for m in SOLID.finditer(data)]
    parts = [data[a:b] for a, b in zip(starts, [*starts[1:], len(data)], strict=True)]
    return join([_solid(name, part) for part in parts if b"facet" in part.lower()])


def _is_complete(data: bytes) -> bool:
    """Return whether the data are as long as a binary STL states, whose header may be text."""
    return len(data) >= 84 and len(data) == 84 + TRIANGLE.itemsize * struct.unpack_from("<I", data, 80)[0]


def _binary(name: str, data: bytes) -> Mesh:
    if len(data) < 84:
        raise InputError(
            f"{name} is truncated or no STL: a binary one has at least 84 bytes, found {len(data)}; an ASCII one has facets"
        )
    count = struct.unpack_from("<I", data, 80)[0]
    check_count(name, "triangles", count, (len(data) - 84) // TRIANGLE.itemsize)
    table: Any = np.frombuffer(data, TRIANGLE, count, 84)
    vertices = table["vertices"].reshape(-1, 3)
    return simple_mesh(name, _stem(name), vertices, np.arange(len(vertices)))


def _solid(name: str, text: bytes) -> Mesh:
    label = SOLID.match(text)
    title, body = (label[1].strip().decode("utf-8", "replace")[:MAX_TITLE], text[label.end() :]) if label else ("", text)
    end = END.search(body)
    if end is None:
        raise InputError(f"{name} is truncated: the solid {title!r} has no endsolid, with which an ASCII STL ends")
    body = body[: end.start()]
    rows, facets = VERTEX.findall(body), len(FACET.findall(body))
    if len(rows) != 3 * facets:
        raise InputError(f"{name} is broken: found {facets} facets with {len(rows)} vertices; valid are 3 each")
    return simple_mesh(name, title or _stem(name), np.array(rows, float).reshape(-1, 3), np.arange(len(rows)))


def _stem(name: str) -> str:
    """Return a file's name without its ending."""
    return name.rsplit(".", 1)[0]
