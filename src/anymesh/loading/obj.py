"""OBJ: polygons with normals and texture coordinates per corner.

Each object is a node, or each group if there are no objects. Colours of material libraries (MTL) are sRGB by convention and
are converted to linear.
"""

from __future__ import annotations

import math

import numpy as np

from anymesh.errors import InputError
from anymesh.loading.files import Folder, picture_file
from anymesh.loading.join import check_geometry, rgba, unique_names, unit
from anymesh.loading.polygons_ import fans, recut
from anymesh.types import Material, Mesh, Node, Texture
from anymesh.types.mesh import to_linear

SLOTS = {"map_kd": "base_color", "norm": "normal", "map_ke": "emissive"}
VALUES = {"-mm": 2, "-o": 3, "-s": 3, "-t": 3}  # options of a picture with more than one value
FLAGS = {"-blendu", "-blendv", "-boost", "-bm", "-cc", "-clamp", "-imfchan", "-texres", "-type", "-colorspace"}
BLACK = 0.02


class _Lines:
    """The lines of the file by their content, in order. corners: three indices each, from 0, -1 for none."""

    def __init__(self) -> None:
        self.v: list[list[float]] = []
        self.vt: list[list[float]] = []
        self.vn: list[list[float]] = []
        self.corners: list[tuple[int, int, int]] = []
        self.sizes: list[int] = []
        self.labels: list[tuple[str, str, str]] = []  # object, group, material of each polygon
        self.libraries: list[str] = []


def read_obj(data: bytes, folder: Folder) -> Mesh:
    """Return the mesh in file coordinates, its faces in the order of the file. Raise InputError if it is not valid."""
    name = folder.path.name
    lines = _read(name, data.decode("utf-8-sig", "replace"))
    vertices = np.array([row[:3] for row in lines.v], np.float64).reshape(-1, 3)
    corners = np.array(lines.corners, np.int64).reshape(-1, 3)
    counts = np.array(lines.sizes, np.int64)
    triangles, polygon = fans(counts)
    check_geometry(name, vertices, corners[triangles][:, :, 0], first=1)
    rows = corners[recut(triangles, polygon, counts, vertices, corners[:, 0])]  # (F, 3, 3): vertex, texture, normal per corner
    faces = rows[:, :, 0]
    vertices[~np.isfinite(vertices)] = 0.0  # vertices of no face
    labels = [lines.labels[k] for k in polygon]
    objects = any(label[0] for label in labels)
    face_node, nodes = _numbered([(label[0] if objects else label[1]) or folder.path.stem for label in labels])
    materials = _materials(folder, lines.libraries)
    used, order = _numbered([label[2] for label in labels])
    known = [key for key in order if key in materials]
    if materials and (missing := [key for key in order if key and key not in materials]):
        more = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
        folder.warn(f"material {missing[0]!r}{more}: in no material library that the file names; such faces have none")
    number = np.array([known.index(key) if key in materials else -1 for key in order], np.int64)
    normal = unit(np.array(lines.vn).reshape(-1, 3)) if lines.vn else None
    return Mesh(
        vertices,
        faces,
        face_node,
        tuple(Node(n, n) for n in unique_names(nodes)),
        number[used],
        tuple(materials[key] for key in known),
        corner_uv=_looked_up(name, "texture coordinate", np.array([(*t[:2], 0.0)[:2] for t in lines.vt]), rows[:, :, 1]),
        corner_color=_color(lines.v, faces),
        corner_normal=None if normal is None else _looked_up(name, "normal", normal, rows[:, :, 2]),
    )


def _read(name: str, text: str) -> _Lines:
    lines = _Lines()
    here = ["", "", ""]
    switches = {"o": 0, "g": 1, "usemtl": 2}
    tables = {"v": lines.v, "vt": lines.vt, "vn": lines.vn}
    least = {"v": 3, "vt": 1, "vn": 3}
    for number, line in enumerate(text.replace("\r\n", "\n").replace("\r", "\n").replace("\\\n", " ").split("\n"), 1):
        key, _, rest = line.strip().replace("\t", " ").partition(" ")
        try:
            if key in tables:
                row = [float(x) for x in rest.split("#", 1)[0].split()]
                if len(row) < least[key]:
                    raise ValueError(f"{len(row)} numbers, at least {least[key]} are needed")
                tables[key].append(row)
            elif key == "f":
                corners = [_corner(word, lines) for word in rest.split("#", 1)[0].split()]
                lines.corners += corners
                lines.sizes.append(len(corners))
                lines.labels.append((here[0], here[1], here[2]))
            elif key in switches:
                here[switches[key]] = rest.strip()
            elif key == "mtllib":
                lines.libraries.append(rest.strip())
        except ValueError as error:
            raise InputError(f"{name}: line {number} is broken or truncated: {line.strip()[:60]!r}: {error}") from None
    return lines


def _corner(word: str, lines: _Lines) -> tuple[int, int, int]:
    """Return the indices of `v/vt/vn`, from 0; negative ones count back from the line on which they appear."""
    parts = [*word.split("/"), "", ""][:3]
    indices = []
    for part, table in zip(parts, (lines.v, lines.vt, lines.vn), strict=True):
        number = int(part) if part else 0
        if number > 0:
            indices.append(number - 1)
        elif number == 0 and part == "" and indices:
            indices.append(-1)
        elif number == 0 or -number > len(table):
            raise ValueError(f"found the index {part or 'none'}; valid are 1 to {len(table)} and -1 to {-len(table)}")
        else:
            indices.append(len(table) + number)
    return indices[0], indices[1], indices[2]


def _numbered(keys: list[str]) -> tuple[np.ndarray, list[str]]:
    """Return the number of each key, and the keys in order of first appearance."""
    order: dict[str, int] = {}
    numbers = np.array([order.setdefault(key, len(order)) for key in keys], np.int64)
    return numbers, list(order)


def _materials(folder: Folder, libraries: list[str]) -> dict[str, Material]:
    materials: dict[str, Material] = {}
    for line in dict.fromkeys(libraries):
        several = line.split() if folder.find(line) is None and len(line.split()) > 1 else [line]
        for uri in several:
            data = folder.read_or_warn(uri, "material library")
            file = folder.find(uri)
            materials |= {} if data is None or file is None else read_mtl(data, folder.beside(file))
    return materials


def _looked_up(name: str, what: str, table: np.ndarray, rows: np.ndarray) -> np.ndarray | None:
    """Return values per corner, zero for corners without; None if no corner has one."""
    if not len(table) or (rows < 0).all():
        return None
    if rows.max() >= len(table):
        raise InputError(f"{name}: a face refers to {what} {rows.max() + 1}; valid are 1 to {len(table)}")
    return np.nan_to_num(np.where((rows < 0)[..., None], 0.0, table[rows])).astype(np.float32)


def _color(v: list[list[float]], faces: np.ndarray) -> np.ndarray | None:
    """Return the colours after the coordinates, if all vertices have them."""
    if any(len(row) < 6 for row in v):
        return None
    values = np.array([row[3:6] for row in v])
    return rgba(values if np.nan_to_num(values).max(initial=0) <= 1 else values / 255)[faces]


def read_mtl(data: bytes, folder: Folder) -> dict[str, Material]:
    """Return materials by name. A texture that cannot be read gives a warning."""
    materials: dict[str, dict[str, str]] = {}
    current: dict[str, str] = {}
    for line in data.decode("utf-8-sig", "replace").splitlines():
        key, _, rest = line.strip().replace("\t", " ").partition(" ")
        if key.lower() == "newmtl":
            current = materials.setdefault(rest.strip(), {})
        elif rest and not key.startswith("#"):
            current[key.lower()] = rest.strip()
    return {name: _material(name, fields, folder) for name, fields in materials.items()}


def _material(name: str, fields: dict[str, str], folder: Folder) -> Material:
    textures: dict[str, Texture] = {}
    for key, value in fields.items():
        if key in SLOTS:
            texture = picture_file(folder, _picture_name(value))
            if texture is not None:
                textures[SLOTS[key]] = texture
    color = _numbers(fields.get("kd", ""))
    if "base_color" in textures and (len(color) < 3 or max(color[:3]) < BLACK):
        color = [1.0, 1.0, 1.0]  # a picture multiplied by black would be black
    alpha = _numbers(fields.get("d", "").replace("-halo", ""))
    alpha = alpha or [1 - t for t in _numbers(fields.get("tr", ""))] or [1.0]
    opacity = min(max(alpha[0], 0.0), 1.0)
    glow = _numbers(fields.get("ke", ""))
    plain = Material()
    r, g, b = to_linear(color[:3]).tolist() if len(color) >= 3 else plain.base_color[:3]
    return Material(
        name or plain.name,
        (r, g, b, opacity),
        metallic=_fraction(fields, "pm", plain.metallic),
        roughness=_fraction(fields, "pr", plain.roughness),
        emissive=tuple(to_linear(glow[:3]).tolist()) if len(glow) >= 3 else plain.emissive,
        alpha_mode="BLEND" if opacity < 1 else "OPAQUE",
        textures=textures,
    )


def _picture_name(value: str) -> str:
    """Return the file name, which may contain spaces, after its options."""
    words = value.split(" ")
    while len(words) > 1 and (words[0].lower() in VALUES or words[0].lower() in FLAGS):
        most = VALUES.get(words[0].lower(), 1)
        words = words[1:]
        taken = 0
        while len(words) > 1 and taken < most and (most == 1 or _numbers(words[0])):
            words, taken = words[1:], taken + 1
    return " ".join(words)


def _numbers(text: str) -> list[float]:
    """Return the numbers at the start of a text."""
    numbers = []
    for word in text.split():
        try:
            value = float(word)
        except ValueError:
            break
        numbers.append(value if math.isfinite(value) else 0.0)
    return numbers


def _fraction(fields: dict[str, str], key: str, default: float) -> float:
    value = _numbers(fields.get(key, ""))
    return min(max(value[0], 0.0), 1.0) if value else default
