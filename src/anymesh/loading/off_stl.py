"""OFF: polygons, with colours of vertices (COFF) or of faces. STL, binary and ASCII: triangles, one node per solid.

The normals of an STL add nothing to the winding and are ignored.
"""

from __future__ import annotations

import re
import struct
from typing import Any

import numpy as np

from anymesh.errors import InputError
from anymesh.loading.files import ASCII_STL, Folder, check_count
from anymesh.loading.join import check_geometry, join, rgba, simple_mesh
from anymesh.loading.polygons_ import fans, recut
from anymesh.types import Mesh

TRIANGLE = np.dtype([("normal", "<f4", 3), ("vertices", "<f4", (3, 3)), ("attributes", "<u2")])
NUMBER = rb"[-+]?(?:[\d.]|nan|inf)"  # start of a number; tells a facet from words in a title
SOLID = re.compile(rb"(?mi)^[ \t\v\f]*solid\b([^\n]*?)(?=$|\bfacet\s+normal\s+" + NUMBER + rb")")
FACET, END = re.compile(rb"(?i)\bfacet\b"), re.compile(rb"(?i)\bendsolid\b")
VERTEX = re.compile(rb"(?i)\bvertex" + 3 * (rb"\s+(" + NUMBER + rb"\S*)"))
MAX_TITLE = 200  # characters of a solid's name that are kept


def read_stl(data: bytes, folder: Folder) -> Mesh:
    """Return the triangles in file coordinates. Raise InputError if they are not valid."""
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


def read_off(data: bytes, folder: Folder) -> Mesh:
    """Return the mesh in file coordinates. Raise InputError if it is not valid."""
    name = folder.path.name
    text = data.decode("utf-8", "replace")
    head = re.match(r"\s*(ST)?(C)?(N)?(4)?OFF", text)
    if head is None or head[4] or re.match(r"\s*BINARY", text[head.end() :]):
        raise InputError(f"{name}: found a binary or four-dimensional OFF; valid is OFF text with three coordinates")
    lines = [row for line in text[head.end() :].splitlines() if (row := line.split("#", 1)[0].split())]
    if not lines or len(lines[0]) < 2:
        raise InputError(f"{name} is truncated: found no numbers of vertices and faces, with which an OFF begins")
    points, polygons = int(lines[0][0]), int(lines[0][1])
    check_count(name, "vertices", points, len(lines) - 1)
    check_count(name, "faces", polygons, len(lines) - 1 - points)
    width = 3 + (3 if head[3] else 0)
    table = [row[: width + 4] for row in lines[1 : points + 1]]
    vertices = np.array([row[:3] for row in table], float).reshape(-1, 3)
    color = _colors([row[width:] for row in table]) if head[2] else None
    rows = lines[points + 1 : points + 1 + polygons]
    sizes = np.array([int(row[0]) for row in rows], np.int64)
    if any(len(row) <= size or size < 1 for row, size in zip(rows, sizes, strict=True)):
        raise InputError(f"{name} is truncated or broken: a face has fewer indices than it states")
    corner = np.array([int(i) for row, size in zip(rows, sizes, strict=True) for i in row[1 : size + 1]], np.int64)
    triangles, polygon = fans(sizes)
    check_geometry(name, vertices, corner[triangles])  # the corners can be looked up
    faces = corner[recut(triangles, polygon, sizes, vertices, corner)]
    corners = None if color is None else color[faces]
    if color is None and (color := _colors([row[size + 1 :] for row, size in zip(rows, sizes, strict=True)])) is not None:
        corners = np.repeat(color[polygon][:, None], 3, 1)
    return simple_mesh(name, folder.path.stem, vertices, faces, corner_color=corners)


def _colors(rows: list[list[str]]) -> np.ndarray | None:
    """Return RGBA bytes if every row has 3 or 4 numbers, integers of 0..255 or fractions."""
    width = {len(row) for row in rows}
    if len(width) != 1 or width.isdisjoint({3, 4}):
        return None
    fractions = any("." in value for row in rows for value in row)
    values = np.array(rows, float)
    return rgba(values if fractions else np.clip(values, 0, 255).astype(np.uint8))
