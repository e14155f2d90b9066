"""PLY, ASCII and binary of both byte orders.

Polygons and triangle strips with colours, normals, texture coordinates, and the pictures that comments name.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from anymesh.errors import InputError
from anymesh.formats.polygons_ import check_count, fans, recut, usable_polygons, with_points
from anymesh.loading.files import Folder, picture_file
from anymesh.loading.join import rgba, simple_mesh, unit
from anymesh.types import Material, Mesh

TYPES = {
    **dict.fromkeys(("char", "int8"), "i1"), **dict.fromkeys(("uchar", "uint8"), "u1"),
    **dict.fromkeys(("short", "int16"), "i2"), **dict.fromkeys(("ushort", "uint16"), "u2"),
    **dict.fromkeys(("int", "int32"), "i4"), **dict.fromkeys(("uint", "uint32"), "u4"),
    **dict.fromkeys(("float", "float32"), "f4"), **dict.fromkeys(("double", "float64"), "f8"),
}  # fmt: skip
INDICES = ("vertex_indices", "vertex_index", "vertex_indexes")
COLORS = (
    ("red", "green", "blue", "alpha"),
    ("diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"),
    ("r", "g", "b", "a"),
)
UV = (("texture_u", "texture_v"), ("s", "t"), ("u", "v"), ("texture_s", "texture_t"), ("tx", "ty"))
CORNER_UV = ("texcoord", "texcoords", "texture_coordinates", "uv", "t")  # lists of faces
READ = ("vertex", "face", "tristrips")
PICTURE = re.compile(r"(?i)texture\s?file:?\s+(.+?)\s*$")  # in a comment, as MeshLab and others write it
BESIDE = (".png", ".jpg", ".jpeg")  # of a picture that is named like the mesh
WHITE = (1.0, 1.0, 1.0, 1.0)


def read_ply(data: bytes, folder: Folder) -> Mesh:
    """Return the mesh in file coordinates. Raise InputError if it is not valid."""
    name = folder.path.name
    elements, style, comments, body = parse_header(name, data)
    columns = read_elements(elements, style, body, folder)
    vertex, face = columns.get("vertex", {}), columns.get("face", {})
    points = _table(vertex, ("x", "y", "z"))
    if points is None:
        raise InputError(f"{name}: found the elements {', '.join(columns) or 'none'}; vertices with x, y and z are needed")
    others = ", ".join(f"{e.count} {e.name!r}" for e in elements if e.count and e.name not in READ)
    if others:
        folder.warn(f"left out, since only vertices, faces and triangle strips are read: {others}")
    lists = next((face[key] for key in INDICES if isinstance(face.get(key), tuple)), None)
    strips = next((strip for strip in columns.get("tristrips", {}).values() if isinstance(strip, tuple)), None)
    if strips is not None and (lists is None or not len(lists[1])):
        face, lists = {}, _unrolled(*strips)
    elif strips is not None:
        folder.warn("the file has faces and triangle strips; the strips are left out")
    if lists is None:
        more = f", but {others}" if others else ""
        raise InputError(f"{name}: found {len(points)} points and no faces{more}; at least one triangle is needed")
    indices, counts = lists
    # ASCII may hold any number
    if not (np.abs(indices, dtype=np.float64) < 2**53).all() or (indices != np.rint(indices)).any():
        raise InputError(f"{name}: found a vertex index that is no whole number; valid are 0 to {len(points) - 1}")
    corner = indices.astype(np.int64)
    usable = usable_polygons(folder, points, corner, counts, first=0)
    triangles, polygon = fans(counts)
    triangles, polygon = triangles[usable[polygon]], polygon[usable[polygon]]
    simple_mesh(name, folder.path.stem, points, corner[triangles])  # checks that the corners can be looked up
    faces = corner[recut(triangles, polygon, counts, points, corner)]
    normal = _table(vertex, ("nx", "ny", "nz"))
    normal = None if normal is None else unit(normal)
    uv = _uv(vertex, face, faces, triangles)
    mesh = simple_mesh(
        name, folder.path.stem, points, faces,
        corner_uv=uv,
        corner_color=_color(vertex, face, faces, polygon, style == "ascii", folder),
        corner_normal=None if normal is None else normal[faces],
    )  # fmt: skip
    materials, chosen = _materials(folder, comments, face.get("texnumber"), has_uv=uv is not None)
    return replace(
        mesh, materials=materials, face_material=chosen[polygon] if len(chosen) > 1 else np.repeat(chosen, len(faces))
    )


def _table(columns: Columns, keys: tuple[str, ...]) -> np.ndarray | None:
    """Return columns side by side, as in the file; None if one is missing."""
    values = [v for key in keys if isinstance(v := columns.get(key), np.ndarray)]
    return np.stack(values, 1) if len(values) == len(keys) else None


def _unrolled(indices: np.ndarray, counts: np.ndarray) -> Ragged:
    """Return the triangles of strips, which -1 ends, each second one turned."""
    whole = np.insert(indices.astype(np.float64), np.cumsum(counts)[:-1], -1)
    place = np.arange(len(whole))
    start = np.maximum.accumulate(np.where(whole < 0, place + 1, 0))
    rows = np.lib.stride_tricks.sliding_window_view(whole, 3) if len(whole) > 2 else np.zeros((0, 3))
    odd = (place - start)[: len(rows)] % 2 == 1
    rows = np.where(odd[:, None], rows[:, [1, 0, 2]], rows)
    rows = rows[(rows >= 0).all(1) & (rows != np.roll(rows, 1, axis=1)).all(1)]
    return rows.reshape(-1), np.full(len(rows), 3, np.int64)


def _color(
    vertex: Columns, face: Columns, faces: np.ndarray, polygon: np.ndarray, ascii_: bool, folder: Folder
) -> np.ndarray | None:
    """Return colours without alpha, which in a PLY is no opacity: many writers leave it at 0."""
    for columns, rows in ((vertex, faces), (face, np.repeat(polygon[:, None], 3, 1))):
        for keys in COLORS:
            values, alpha = _table(columns, keys[:3]), columns.get(keys[3])
            if values is None:
                continue
            if isinstance(alpha, np.ndarray) and len(alpha) and (np.ptp(alpha) or alpha[0] not in (0, 1, 255)):
                folder.warn("the alpha of the vertex colours is not read as opacity")
            whole = ascii_ and values.max(initial=0) > 1  # ASCII has no types
            return rgba(np.clip(values, 0, 255).astype(np.uint8) if whole else values)[rows]
    return None


def _uv(vertex: Columns, face: Columns, faces: np.ndarray, triangles: np.ndarray) -> np.ndarray | None:
    lists = next((face[key] for key in CORNER_UV if isinstance(face.get(key), tuple)), None)
    if isinstance(lists, tuple):
        values, counts = lists
        if len(values) == 2 * (triangles.max() + 1) or (counts % 2 == 0).all():
            pairs = values.reshape(-1, 2)
            return np.nan_to_num(pairs[triangles].astype(np.float32)) if triangles.max() < len(pairs) else None
    tables = (_table(vertex, keys) for keys in UV)
    table = next((t for t in tables if t is not None), None)
    return None if table is None else np.nan_to_num(table.astype(np.float32))[faces]


def _materials(folder: Folder, comments: list[str], number: Any, *, has_uv: bool) -> tuple[tuple[Material, ...], np.ndarray]:
    """Return one material for each picture that comments name, and the one of each polygon, or of all; -1 for none."""
    uris = [match[1] for comment in comments if (match := PICTURE.match(comment))]
    beside = [folder.path.stem + suffix for suffix in BESIDE if has_uv and folder.find(folder.path.stem + suffix)]
    pictures = [picture_file(folder, uri) for uri in uris or beside[:1]]
    stem = folder.path.stem
    names = [stem] if len(pictures) == 1 else [f"{stem}_{k}" for k in range(len(pictures))]
    made = [Material(name, WHITE, textures={"base_color": p}) for name, p in zip(names, pictures, strict=True) if p is not None]
    rows = np.cumsum([p is not None for p in pictures]) - 1
    rows = np.array([row if p is not None else -1 for row, p in zip(rows, pictures, strict=True)], np.int64)
    if len(pictures) < 2:
        return tuple(made), rows if len(rows) else np.array([-1])
    if not isinstance(number, np.ndarray):
        folder.warn(f"the file names {len(pictures)} pictures, and no face says which (texnumber); all have the first")
        return tuple(made[:1]), rows[:1]
    valid = (number >= 0) & (number < len(rows))
    if not valid.all():
        folder.warn(f"{(~valid).sum()} faces have a texnumber without a picture; valid are 0 to {len(rows) - 1}")
    return tuple(made), np.where(valid, rows[np.where(valid, number, 0).astype(np.int64)], -1)


@dataclass
class Element:
    """One element of the header. properties: name, type, and the type of the count if it is a list."""

    name: str
    count: int
    properties: list[tuple[str, str, str | None]] = field(default_factory=list)


Ragged = tuple[np.ndarray, np.ndarray]  # all numbers of a list property one after another, and the count of each row
Columns = dict[str, np.ndarray | Ragged]


def parse_header(name: str, data: bytes) -> tuple[list[Element], str, list[str], bytes]:
    """Return the elements, the format, the comments, and the bytes after the header.

    Raise InputError if the header is not valid.
    """
    end = data.find(b"end_header")
    newline = data.find(b"\n", end)
    if end < 0 or newline < 0:
        raise InputError(f"{name} is truncated: found no end_header, with which a PLY header ends")
    elements: list[Element] = []
    comments, style = [], ""
    for line in data[:end].decode("utf-8", "replace").splitlines()[1:]:
        match line.split():
            case ["format", kind, *_]:
                style = kind
            case ["comment" | "obj_info", *_]:
                comments.append(line.split(None, 1)[-1])
            case ["element", label, count] if count.isdecimal():
                elements.append(Element(label, int(count)))
            case ["property", "list", count, kind, label] if elements and count in TYPES and kind in TYPES:
                elements[-1].properties.append((label, TYPES[kind], TYPES[count]))
            case ["property", kind, label] if elements and kind in TYPES:
                elements[-1].properties.append((label, TYPES[kind], None))
            case []:
                pass
            case _:
                raise InputError(f"{name}: found {line[:80]!r} in the header; valid are format, comment, element and property")
    if style not in ("ascii", "binary_little_endian", "binary_big_endian"):
        raise InputError(f"{name}: found the format {style!r}; valid are ascii, binary_little_endian, binary_big_endian")
    return elements, style, comments, data[newline + 1 :]


def read_elements(elements: list[Element], style: str, body: bytes, folder: Folder) -> dict[str, Columns]:
    """Return the columns of every element. Raise InputError if the body is shorter than the header states."""
    name = folder.path.name
    if style == "ascii":  # converted to binary with one wide type
        try:
            body = np.array(body.split(), np.float64).tobytes()
        except ValueError:
            body = np.array(with_points(body.decode("latin-1"), folder).split(), np.float64).tobytes()
        for e in elements:
            e.properties = [(label, "f8", count and "f8") for label, _, count in e.properties]
    order = ">" if style == "binary_big_endian" else "<"
    columns, at = {}, 0
    for element in elements:
        least = sum(np.dtype(count or kind).itemsize for _, kind, count in element.properties)
        if element.properties:
            check_count(name, f"elements {element.name!r}", element.count, (len(body) - at) // least)
            columns[element.name], at = _element(name, element, order, body, at)
    return columns


def _element(name: str, element: Element, order: str, body: bytes, at: int) -> tuple[Columns, int]:
    """Return the columns of one element whose bytes start at `at`, and their end."""
    lengths = _lengths(element, order, body, at)
    row = np.dtype(_fields(element, order, lengths))
    if element.count and at + row.itemsize * element.count <= len(body):
        table: Any = np.frombuffer(body, row, element.count, at)
        lists = [label for label, _, count in element.properties if count]
        if all((table[f"{label} count"] == lengths[label]).all() for label in lists):
            columns: Columns = {label: table[label] for label, _, _ in element.properties}
            for label in lists:
                columns[label] = (table[label].reshape(-1), np.full(element.count, lengths[label], np.int64))
            return columns, at + row.itemsize * element.count
    return _rows(name, element, order, body, at)


def _lengths(element: Element, order: str, body: bytes, at: int) -> dict[str, int]:
    """Return the lengths of the lists of the first row."""
    lengths = {}
    for label, kind, count in element.properties:
        if count is not None:
            width = np.dtype(count).itemsize
            stated = np.frombuffer(body[at : at + width], order + count) if at + width <= len(body) else [0]
            lengths[label] = int(stated[0]) if len(stated) and 0 <= stated[0] < 1 << 24 else 0
            at += width + lengths[label] * np.dtype(kind).itemsize
        else:
            at += np.dtype(kind).itemsize
    return lengths


def _fields(element: Element, order: str, lengths: dict[str, int]) -> list[tuple]:
    fields: list[tuple] = []
    for label, kind, count in element.properties:
        if count is not None:
            fields.append((f"{label} count", order + count))
            fields.append((label, order + kind, (lengths[label],)))
        else:
            fields.append((label, order + kind))
    return fields


def _rows(name: str, element: Element, order: str, body: bytes, at: int) -> tuple[Columns, int]:
    """Read row by row, for lists of different lengths."""
    plain: list[tuple[str, np.dtype, np.dtype | None]]
    plain = [
        (label, np.dtype(order + kind), np.dtype(order + count) if count else None) for label, kind, count in element.properties
    ]
    chunks: dict[str, list[bytes]] = {label: [] for label, _, _ in plain}
    counts: dict[str, list[int]] = {label: [] for label, _, _ in plain}
    for row in range(element.count):
        for label, kind, count in plain:
            length = 1.0
            if count is not None:
                length = (
                    float(np.frombuffer(body[at : at + count.itemsize], count)[0]) if at + count.itemsize <= len(body) else -1
                )
                at += count.itemsize
            if not 0 <= length * kind.itemsize <= len(body) - at:  # also false for NaN
                raise InputError(f"{name} is truncated: {element.name!r} {row + 1} of {element.count} is incomplete")
            end = at + int(length) * kind.itemsize
            chunks[label].append(body[at:end])
            counts[label].append(int(length))
            at = end
    columns: Columns = {}
    for label, kind, count in plain:
        values = np.frombuffer(b"".join(chunks[label]), kind)
        columns[label] = values if count is None else (values, np.array(counts[label], np.int64))
    return columns, at
