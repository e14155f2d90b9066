"""OFF: polygons, with normals, colours and texture coordinates of vertices, or colours of faces.

STL, binary and ASCII: triangles, one node per solid, with the colours of VisCAM and SolidView, or of Materialise Magics. The
normals of an STL add nothing to the winding and are ignored.
"""

from __future__ import annotations

import re
import struct
from dataclasses import replace
from typing import Any

import numpy as np

from anymesh.errors import InputError
from anymesh.formats.polygons_ import check_count, fans, recut, usable_polygons, with_points
from anymesh.loading.files import ASCII_STL, Folder
from anymesh.loading.join import check_geometry, join, rgba, simple_mesh, unit
from anymesh.types import Material, Mesh
from anymesh.types.mesh import to_linear

TRIANGLE = np.dtype([("normal", "<f4", 3), ("vertices", "<f4", (3, 3)), ("attributes", "<u2")])
NUMBER = rb"[-+]?(?:[\d.]|nan|inf)"  # start of a number; tells a facet from words in a title
SOLID = re.compile(rb"(?mi)^[ \t\v\f]*solid\b([^\n]*?)(?=$|\bfacet\s+normal\s+" + NUMBER + rb")")
FACET, END = re.compile(rb"(?i)\bfacet\b"), re.compile(rb"(?i)\bendsolid\b")
VERTEX = re.compile(rb"(?i)\bvertex" + 3 * (rb"\s+(" + NUMBER + rb"\S*)"))
MAX_TITLE = 200  # characters of a solid's name that are kept
MAGICS = re.compile(rb"(?s)COLOR=(.{4})")  # in the header: RGBA of the whole object
PAINTED, SHIFTS = 1 << 15, (10, 5, 0)  # of the attribute: the flag, and the places of red, green and blue, 5 bits each
NO_COLOR = b"\x7f\x7f\x7f"  # of the header that MeshLab writes for every mesh
MOST_COLORS = 64  # materials of a mesh; more colours are a picture of the surface
GREY = 218  # of faces without a colour beside others: that of a surface without material


def read_stl(data: bytes, folder: Folder) -> Mesh:
    """Return the triangles in file coordinates. Raise InputError if they are not valid."""
    if not ASCII_STL.match(data) or _is_complete(data):
        return _binary(folder, data)
    data = data.removeprefix(b"\xef\xbb\xbf").replace(b"\r", b"\n")  # some exporters end lines with a carriage return alone
    starts = [m.start() for m in SOLID.finditer(data)]
    parts = [data[a:b] for a, b in zip(starts, [*starts[1:], len(data)], strict=True)]
    return join([_solid(folder, part) for part in parts if b"facet" in part.lower()])


def _is_complete(data: bytes) -> bool:
    """Return whether the data are as long as a binary STL states, whose header may be text."""
    return len(data) >= 84 and len(data) == 84 + TRIANGLE.itemsize * struct.unpack_from("<I", data, 80)[0]


def _binary(folder: Folder, data: bytes) -> Mesh:
    name = folder.path.name
    if len(data) < 84:
        raise InputError(
            f"{name} is truncated or no STL: a binary one has at least 84 bytes, found {len(data)}; an ASCII one has facets"
        )
    count = struct.unpack_from("<I", data, 80)[0]
    check_count(name, "triangles", count, (len(data) - 84) // TRIANGLE.itemsize)
    table: Any = np.frombuffer(data, TRIANGLE, count, 84)
    vertices = table["vertices"].reshape(-1, 3)
    usable = usable_polygons(folder, vertices, np.arange(len(vertices)), np.full(count, 3), first=1)
    colors = _facet_colors(folder, data[:80], table["attributes"])
    faces = np.arange(len(vertices)).reshape(-1, 3)[usable]
    return _colored(simple_mesh(name, _stem(name), vertices, faces), None if colors is None else colors[usable])


def _colored(mesh: Mesh, colors: np.ndarray | None) -> Mesh:
    """Return a mesh with a material per colour, as every format that is written can hold; colours of corners if there are many.

    colors: (F, 4) of facets, sRGB.
    """
    if colors is None:
        return mesh
    distinct, number = np.unique(colors, axis=0, return_inverse=True)
    if len(distinct) > MOST_COLORS:
        return replace(mesh, corner_color=np.repeat(colors[:, None], 3, 1))
    looks = tuple(Material(f"color_{bytes(c[:3]).hex()}", (*to_linear(c[:3] / 255).tolist(), 1.0)) for c in distinct)
    return replace(mesh, materials=looks, face_material=number.reshape(-1))


def _facet_colors(folder: Folder, header: bytes, attributes: np.ndarray) -> np.ndarray | None:
    """Return the colours of facets; None if there are none.

    VisCAM and SolidView: blue is lowest, and the highest bit means that there is a colour. Magics, told by the header: red is
    lowest, and the highest bit means that the facet has the colour of the header; so it has if all attributes are zero.
    """
    magics, flag = MAGICS.search(header), attributes & PAINTED > 0
    if flag.all() and len(np.unique(attributes)) > 1:  # colours of which none would count
        magics = None
    painted = flag if magics is None else ~flag & attributes.any()
    shifts = SHIFTS if magics is None else SHIFTS[::-1]
    if magics and magics[1].startswith(NO_COLOR) and not attributes.any():
        return None
    if magics is None and not flag.any():
        if (number := np.count_nonzero(attributes)) and len(np.unique(attributes)) > 1:
            folder.warn(
                f"{number} facets have attributes that are no colours (their highest bit is not set); they are left out"
            )
        return None
    base = np.full(3, GREY, np.uint8) if magics is None else np.frombuffer(magics[1], np.uint8)[:3]
    levels = np.stack([attributes >> shift & 31 for shift in shifts], 1)
    return rgba(np.where(painted[:, None], np.rint(levels * 255 / 31), base).astype(np.uint8))


def _solid(folder: Folder, text: bytes) -> Mesh:
    name = folder.path.name
    label = SOLID.match(text)
    title, body = (label[1].strip().decode("utf-8", "replace")[:MAX_TITLE], text[label.end() :]) if label else ("", text)
    end = END.search(body)
    if end is None:
        raise InputError(f"{name} is truncated: the solid {title!r} has no endsolid, with which an ASCII STL ends")
    body = body[: end.start()]
    rows, facets = VERTEX.findall(body), len(FACET.findall(body))
    if len(rows) != 3 * facets:
        raise InputError(f"{name} is broken: found {facets} facets with {len(rows)} vertices; valid are 3 each")
    try:
        vertices = np.array(rows, float).reshape(-1, 3)
    except ValueError:
        words = with_points(b" ".join(word for row in rows for word in row).decode("latin-1"), folder).split()
        vertices = np.array(words, float).reshape(-1, 3)
    usable = usable_polygons(folder, vertices, np.arange(len(rows)), np.full(facets, 3), first=1)
    return simple_mesh(name, title or _stem(name), vertices, np.arange(len(rows)).reshape(-1, 3)[usable])


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
    if "," in text:
        text = with_points(text, folder)
    lines = [row for line in text[head.end() :].splitlines() if (row := line.split("#", 1)[0].split())]
    if not lines or len(lines[0]) < 2:
        raise InputError(f"{name} is truncated: found no numbers of vertices and faces, with which an OFF begins")
    points, polygons = int(lines[0][0]), int(lines[0][1])
    check_count(name, "vertices", points, len(lines) - 1)
    check_count(name, "faces", polygons, len(lines) - 1 - points)
    width, after = 6 if head[3] else 3, 2 if head[1] else 0  # numbers before and after the colour
    table = lines[1 : points + 1]
    vertices = np.array([row[:3] for row in table], float).reshape(-1, 3)
    color = _colors([row[width : len(row) - after][:4] for row in table], folder) if head[2] else None
    normal = unit(np.array([row[3:6] for row in table], float)) if head[3] else None
    uv = np.array([row[-2:] for row in table], np.float32) if after else None
    rows = lines[points + 1 : points + 1 + polygons]
    sizes = np.array([int(row[0]) for row in rows], np.int64)
    if any(len(row) <= size or size < 1 for row, size in zip(rows, sizes, strict=True)):
        raise InputError(f"{name} is truncated or broken: a face has fewer indices than it states")
    corner = np.array([int(i) for row, size in zip(rows, sizes, strict=True) for i in row[1 : size + 1]], np.int64)
    usable = usable_polygons(folder, vertices, corner, sizes, first=0)
    triangles, polygon = fans(sizes)
    triangles, polygon = triangles[usable[polygon]], polygon[usable[polygon]]
    check_geometry(name, vertices, corner[triangles])  # the corners can be looked up
    faces = corner[recut(triangles, polygon, sizes, vertices, corner)]
    corners = None if color is None else color[faces]
    of_faces = None if head[2] else _colors([row[size + 1 :] for row, size in zip(rows, sizes, strict=True)], folder)
    if of_faces is not None:
        corners = np.repeat(of_faces[polygon][:, None], 3, 1)
    return simple_mesh(
        name, folder.path.stem, vertices, faces,
        corner_color=corners,
        corner_normal=None if normal is None else normal[faces],
        corner_uv=None if uv is None else np.nan_to_num(uv)[faces],
    )  # fmt: skip


def _colors(rows: list[list[str]], folder: Folder) -> np.ndarray | None:
    """Return RGBA bytes if every row has 3 or 4 numbers, integers of 0..255 or fractions."""
    width = {len(row) for row in rows}
    if len(width) != 1 or width.isdisjoint({3, 4}):
        if width != {0}:
            folder.warn("colours are left out: valid are 3 or 4 numbers for all vertices or for all faces")
        return None
    fractions = any("." in value for row in rows for value in row)
    values = np.array(rows, float)
    return rgba(values if fractions else np.clip(values, 0, 255).astype(np.uint8))
