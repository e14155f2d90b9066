"""OFF: polygons, with colours of vertices (COFF) or of faces."""

from __future__ import annotations

import re

import numpy as np

from anymesh.errors import InputError
from anymesh.loading.checks import check_count
from anymesh.loading.folder import Folder
from anymesh.loading.join import rgba, simple_mesh
from anymesh.loading.polygons import fans, recut
from anymesh.types import Mesh


def read_off(data: bytes, folder: Folder) -> Mesh:
    """Return the mesh in file coordinates.

    Raise InputError if it is not valid.
    """
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
    simple_mesh(name, folder.path.stem, vertices, corner[triangles])  # checks that the corners can be looked up
    faces = corner[recut(triangles, polygon, sizes, vertices, corner)]
    mesh = simple_mesh(name, folder.path.stem, vertices, faces)
    if color is None:
        color = _colors([row[size + 1 :] for row, size in zip(rows, sizes, strict=True)])
        corners = None if color is None else np.repeat(color[polygon][:, None], 3, 1)
    else:
        corners = color[faces]
    return mesh if corners is None else simple_mesh(name, folder.path.stem, vertices, faces, corner_color=corners)


def _colors(rows: list[list[str]]) -> np.ndarray | None:
    """Return RGBA bytes if every row has 3 or 4 numbers, integers of 0..255 or fractions."""
    width = {len(row) for row in rows}
    if len(width) != 1 or width.isdisjoint({3, 4}):
        return None
    fractions = any("." in value for row in rows for value in row)
    values = np.array(rows, float)
    return rgba(values if fractions else np.clip(values, 0, 255).astype(np.uint8))
