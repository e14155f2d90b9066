"""PLY: polygons with colours, normals, texture coordinates, and the picture that a comment names."""

from __future__ import annotations

import re

import numpy as np

from anymesh.errors import InputError
from anymesh.loading.folder import Folder
from anymesh.loading.join import rgba, simple_mesh, unit
from anymesh.loading.pictures import picture_file
from anymesh.loading.ply_data import Columns, parse_header, read_elements
from anymesh.loading.polygons import fans, recut
from anymesh.types import Material, Mesh

INDICES = ("vertex_indices", "vertex_index")
UV = (("texture_u", "texture_v"), ("s", "t"), ("u", "v"))


def read_ply(data: bytes, folder: Folder) -> Mesh:
    """Return the mesh in file coordinates.

    Raise InputError if it is not valid.
    """
    name = folder.path.name
    elements, style, comments, body = parse_header(name, data)
    columns = read_elements(name, elements, style, body)
    vertex, face = columns.get("vertex", {}), columns.get("face", {})
    points = _table(vertex, ("x", "y", "z"))
    if points is None:
        raise InputError(f"{name}: found the elements {', '.join(columns) or 'none'}; vertices with x, y and z are needed")
    lists = next((face[key] for key in INDICES if isinstance(face.get(key), tuple)), None)
    if lists is None:
        raise InputError(f"{name}: found {len(points)} points and no faces; at least one triangle is needed")
    indices, counts = lists
    triangles, polygon = fans(counts)
    # ASCII may hold any number
    if not (np.abs(indices, dtype=np.float64) < 2**53).all() or (indices != np.rint(indices)).any():
        raise InputError(f"{name}: found a vertex index that is no whole number; valid are 0 to {len(points) - 1}")
    corner = indices.astype(np.int64)
    simple_mesh(name, folder.path.stem, points, corner[triangles])  # checks that the corners can be looked up
    faces = corner[recut(triangles, polygon, counts, points, corner)]
    normal = _table(vertex, ("nx", "ny", "nz"))
    normal = None if normal is None else unit(normal)
    return simple_mesh(
        name, folder.path.stem, points, faces, _material(folder, comments),
        corner_uv=_uv(vertex, face, faces, triangles),
        corner_color=_color(vertex, face, faces, polygon, style == "ascii"),
        corner_normal=None if normal is None else normal[faces],
    )  # fmt: skip


def _table(columns: Columns, keys: tuple[str, ...]) -> np.ndarray | None:
    """Return columns side by side, as in the file; None if one is missing."""
    values = [v for key in keys if isinstance(v := columns.get(key), np.ndarray)]
    return np.stack(values, 1) if len(values) == len(keys) else None


def _color(vertex: Columns, face: Columns, faces: np.ndarray, polygon: np.ndarray, ascii_: bool) -> np.ndarray | None:
    for columns, rows in ((vertex, faces), (face, np.repeat(polygon[:, None], 3, 1))):
        values = _table(columns, ("red", "green", "blue", "alpha"))
        values = _table(columns, ("red", "green", "blue")) if values is None else values
        if values is not None:
            whole = ascii_ and values.max(initial=0) > 1  # ASCII has no types
            return rgba(np.clip(values, 0, 255).astype(np.uint8) if whole else values)[rows]
    return None


def _uv(vertex: Columns, face: Columns, faces: np.ndarray, triangles: np.ndarray) -> np.ndarray | None:
    lists = face.get("texcoord")
    if isinstance(lists, tuple):
        values, counts = lists
        if len(values) == 2 * (triangles.max() + 1) or (counts % 2 == 0).all():
            pairs = values.reshape(-1, 2)
            return np.nan_to_num(pairs[triangles].astype(np.float32)) if triangles.max() < len(pairs) else None
    tables = (_table(vertex, keys) for keys in UV)
    table = next((t for t in tables if t is not None), None)
    return None if table is None else np.nan_to_num(table.astype(np.float32))[faces]


def _material(folder: Folder, comments: list[str]) -> Material | None:
    """Return the material with the picture that MeshLab and others name in a comment."""
    for comment in comments:
        match = re.match(r"(?i)texturefile\s+(.+?)\s*$", comment)
        if match:
            texture = picture_file(folder, match[1])
            white = (1.0, 1.0, 1.0, 1.0)
            return Material(folder.path.stem, white, textures={"base_color": texture}) if texture else None
    return None
