"""OBJ: polygons with normals and texture coordinates per corner, and colours per vertex.

Each object is a node, or each group where groups tell apart what is in one object, or where there are no objects.
"""

from __future__ import annotations

import itertools
import math
import operator
import re
from array import array
from collections import Counter

import numpy as np

from anymesh.errors import InputError
from anymesh.formats.mtl import SOLE, MtlMaterial, read_mtl
from anymesh.formats.polygons_ import fans, recut, usable_polygons, with_points
from anymesh.loading.files import SHOWN, Folder
from anymesh.loading.join import check_geometry, rgba, unique_names, unit
from anymesh.loading.references import meanings, readable
from anymesh.types import Mesh, Node

MIN_NUMBERS = {"v": 3, "vt": 1, "vn": 3, "f": 1}  # numbers or corners of a line
FEW = 16  # lines of one kind, below which each is read on its own
USUAL_CORNERS = [  # of polygons, as nearly all files have them, and what their numbers are: 0 vertex, 1 texture, 2 normal
    (re.compile(rf"(?:{form.replace('n', '[0-9]{1,15}+')} ++)*+"), fields)
    for form, fields in (("n", [0]), ("n/n", [0, 1]), ("n//n", [0, 2]), ("n/n/n", [0, 1, 2]))
]
SWITCHES = {"o": 0, "g": 1, "usemtl": 2}
NAMED = {"l": "lines", "p": "points", "curv": "curves", "curv2": "curves", "surf": "free-form surfaces"}
NO_MATERIAL = ("", "None", "(null)")  # as exporters write it
MAX_NAMED = 8  # kinds of lines in a warning
COMMENT = re.compile(r"(?<![.,])#")  # 1.#IND is a number that is not finite
MAX_INDEX = 1 << 60
BROKEN = -2  # index of a texture coordinate or normal that does not exist

Label = tuple[str, str, str]  # object, group, material of a polygon


class _Lines:
    """The lines of the file by their content, in order. corners: three indices each, from 0, -1 for none."""

    def __init__(self) -> None:
        self.v: list[list[float]] = []
        self.vt: list[list[float]] = []
        self.vn: list[list[float]] = []
        self.corners = array("q")
        self.sizes: list[int] = []
        self.labels: list[Label] = []
        self.libraries: list[str] = []
        self.painted: list[str] = []  # colours of vertices in hexadecimal digits, which ZBrush writes in comments
        self.smooth = False
        self.others: Counter[str] = Counter()  # lines that are not read, by their first word
        self.broken: list[str] = []

    def table(self, key: str) -> list[list[float]] | None:
        """Return the rows of numbers that a line of this kind adds to; None for other lines."""
        return {"v": self.v, "vt": self.vt, "vn": self.vn}.get(key)


def read_obj(data: bytes, folder: Folder) -> Mesh:
    """Return the mesh in file coordinates, its faces in the order of the file. Raise InputError if it is not valid."""
    name = folder.path.name
    lines = _read(folder, data.decode("utf-8-sig", "surrogateescape"))
    _warn_of_others(folder, lines)
    vertices = np.array([row[:3] for row in lines.v], np.float64).reshape(-1, 3)
    corners = np.frombuffer(lines.corners, np.int64).reshape(-1, 3)
    counts = np.array(lines.sizes, np.int64)
    usable = usable_polygons(folder, vertices, corners[:, 0], counts, first=1)
    labels = [label for label, good in zip(lines.labels, usable, strict=True) if good]
    corners, counts = corners[np.repeat(usable, counts)], counts[usable]
    triangles, polygon = fans(counts)
    try:
        check_geometry(name, vertices, corners[triangles][:, :, 0], first=1)
    except InputError as error:
        raise (InputError(f"{error}; {lines.broken[0]}") if lines.broken else error) from None
    rows = corners[recut(triangles, polygon, counts, vertices, corners[:, 0])]  # (F, 3, 3): vertex, texture, normal per corner
    faces = rows[:, :, 0]
    vertices[~np.isfinite(vertices)] = 0.0  # vertices of no face
    node, nodes = _nodes(labels, corners[:, 0], counts, folder.path.stem)
    looks, look = _looks(folder, lines.libraries, [label[2] for label in labels])
    uv = _looked_up(folder, "texture coordinate", np.array([(*t[:2], 0.0)[:2] for t in lines.vt]), rows[:, :, 1])
    uv, more = _placed(uv, looks, look[polygon])
    normal = unit(np.array([row[:3] for row in lines.vn])) if lines.vn else None
    return Mesh(
        vertices,
        faces,
        node[polygon],
        tuple(Node(n, n) for n in unique_names(nodes)),
        look[polygon],
        tuple(look.material for look in looks),
        corner_uv=uv,
        corner_color=_color(lines, faces),
        corner_normal=None if normal is None else _looked_up(folder, "normal", normal, rows[:, :, 2]),
        corner_more_uv=more,
    )


def _read(folder: Folder, text: str) -> _Lines:
    lines, here, number = _Lines(), ["", "", ""], 0
    split = text.replace("\r\n", "\n").replace("\r", "\n").replace("\\\n", " ").split("\n")
    words = (line.strip().replace("\t", " ").partition(" ") for line in split)
    for key, run in itertools.groupby(words, operator.itemgetter(0)):
        rests = [rest for _, _, rest in run]
        if len(rests) < FEW or not _read_alike(lines, key, rests, here):
            for at, rest in enumerate(rests, number):
                try:
                    _read_line(lines, key, rest, here, folder)
                except ValueError as error:
                    line = readable(split[at].strip()[:60])
                    lines.broken.append(f"line {at + 1} is broken or truncated: {line!r}: {error}")
        number += len(rests)
    return lines


def _read_line(lines: _Lines, key: str, rest: str, here: list[str], folder: Folder) -> None:
    """Read a line. here: object, group and material of the next polygon. Raise ValueError if it is broken."""
    if (table := lines.table(key)) is not None:
        table.append([math.nan] * 3)
        table[-1] = _row(rest, MIN_NUMBERS[key], folder)
    elif key == "f":
        corners = [_corner(word, lines) for word in rest.split("#", 1)[0].split()]
        lines.corners.extend(itertools.chain.from_iterable(corners))
        lines.sizes.append(len(corners))
        lines.labels.append((here[0], here[1], here[2]))
    elif key in SWITCHES:
        here[SWITCHES[key]] = rest.strip()
    elif key == "mtllib":
        lines.libraries.append(rest.strip())
    elif key == "#MRGB":
        lines.painted += [rest[k + 2 : k + 8] for k in range(0, len(rest.strip()), 8)]
    elif key == "s":
        lines.smooth = lines.smooth or rest.strip() not in ("off", "0")
    elif key and not key.startswith("#"):
        lines.others[key] += 1


def _read_alike(lines: _Lines, key: str, rests: list[str], here: list[str]) -> bool:
    """Read successive lines of the same kind at once, ten times as fast as one by one; return False if one is unusual."""
    table, sizes = lines.table(key), {len(rest.split()) for rest in rests}
    if (table is None and key != "f") or len(sizes) != 1 or min(sizes) < MIN_NUMBERS[key]:
        return False
    (size,), text = sizes, " ".join(rests) + " "
    fields = next((fields for pattern, fields in USUAL_CORNERS if pattern.fullmatch(text)), ()) if table is None else ()
    if table is None and not fields:
        return False
    try:
        numbers = list(map(float if table is not None else int, text.replace("/", " ").split()))
    except ValueError:  # a comment, or commas in numbers
        return False
    if table is not None:
        table += np.array(numbers).reshape(len(rests), -1).tolist()
        return True
    corners = np.full((len(rests) * size, 3), -1)
    corners[:, fields] = np.array(numbers).reshape(len(corners), -1) - 1
    lines.corners.frombytes(corners.tobytes())
    lines.sizes += [size] * len(rests)
    lines.labels += [(here[0], here[1], here[2])] * len(rests)
    return True


def _warn_of_others(folder: Folder, lines: _Lines) -> None:
    if lines.broken:
        more = f" (and {len(lines.broken) - 1} more lines)" if len(lines.broken) > 1 else ""
        folder.warn(f"left out: {lines.broken[0]}{more}")
    named = [f"{count} {NAMED.get(key) or repr(readable(key[:12]))}" for key, count in lines.others.most_common(MAX_NAMED)]
    if named:
        more = ", ..." if len(lines.others) > MAX_NAMED else ""
        folder.warn(f"left out, since only polygons are read: {', '.join(named)}{more}")
    if lines.smooth and not lines.vn:
        folder.warn("smoothing groups are not read, and the file has no normals; its faces are shaded flat")


def _row(text: str, least: int, folder: Folder) -> list[float]:
    if "#" in text:
        text = COMMENT.split(text, maxsplit=1)[0]
    try:
        row = [float(x) for x in text.split()]
    except ValueError:
        row = [float(x) for x in with_points(text, folder).split()]
    if len(row) < least:
        raise ValueError(f"{len(row)} numbers, at least {least} are needed")
    return row


def _corner(word: str, lines: _Lines) -> tuple[int, int, int]:
    """Return the indices of `v/vt/vn`, from 0; negative ones count back from the line on which they appear."""
    indices = []
    for part, table in zip([*word.split("/"), "", ""][:3], (lines.v, lines.vt, lines.vn), strict=True):
        number = min(int(part), MAX_INDEX) if part else 0
        indices.append(number - 1 if number >= 0 else len(table) + number if -number <= len(table) else BROKEN)
    return indices[0], indices[1], indices[2]


def _numbered(keys: list) -> tuple[np.ndarray, list]:
    """Return the number of each key, and the keys in order of first appearance."""
    order: dict = {}
    numbers = np.array([order.setdefault(key, len(order)) for key in keys], np.int64)
    return numbers, list(order)


def _nodes(labels: list[Label], vertex: np.ndarray, counts: np.ndarray, stem: str) -> tuple[np.ndarray, list[str]]:
    """Return the node of each polygon, and the names of the nodes. vertex: of all corners; counts: corners of each polygon."""
    if any(label[0] for label in labels):
        divided = _divided(labels, vertex, counts)
        number, order = _numbered([(o, g if o in divided else "") for o, g, _ in labels])
    else:
        number, order = _numbered([label[:2] for label in labels])
    return number, [readable(g or o or stem) for o, g in order]


def _divided(labels: list[Label], vertex: np.ndarray, counts: np.ndarray) -> set[str]:
    """Return the objects whose groups are parts: several that share no vertex and are not one for each material, named so."""
    number, pairs = _numbered([label[:2] for label in labels])
    owner = np.repeat(number, counts)
    low, high = np.full(vertex.max() + 1, len(pairs)), np.full(vertex.max() + 1, -1)
    np.minimum.at(low, vertex, owner)
    np.maximum.at(high, vertex, owner)
    shared = {pairs[k][0] for k in np.unique([low[low < high], high[low < high]])}
    groups: dict[str, list[tuple[str, str]]] = {}
    for o, g, material in dict.fromkeys(labels):
        groups.setdefault(o, []).append((g, material))

    def by_material(group: list[tuple[str, str]]) -> bool:
        once = len(group) == len({g for g, _ in group}) == len({m for _, m in group})
        return once and all(m and m.casefold() in g.casefold() for g, m in group)

    return {o for o, some in groups.items() if o not in shared and len({g for g, _ in some}) > 1 and not by_material(some)}


def _looks(folder: Folder, libraries: list[str], names: list[str]) -> tuple[list[MtlMaterial], np.ndarray]:
    """Return the materials that are used, and the number of each polygon's, -1 for none."""
    number, order = _numbered(names)
    wanted = [key for key in order if key not in NO_MATERIAL]
    materials = _materials(folder, libraries) if libraries or wanted else {}
    keys = [_key(key, materials) for key in order]
    known = list(dict.fromkeys(key for key in keys if key in materials))
    missing = [key for key in wanted if _key(key, materials) not in materials]
    if missing and (materials or not libraries):
        more = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
        own = f"put its library {readable(folder.path.stem)}.mtl beside the mesh"
        told = "in no material library that the file names" if libraries else own
        folder.warn(f"material {readable(missing[0])[:SHOWN]!r}{more}: {told}; such faces have none")
    numbers = np.array([known.index(key) if key in materials else -1 for key in keys], np.int64)
    return [materials[key] for key in known], numbers[number]


def _key(name: str, materials: dict[str, MtlMaterial]) -> str:
    """Return the name, or the only one of a material that differs in case or encoding."""
    if name in materials or not name:
        return name
    alike = [key for key in materials if meanings(key) & meanings(name)]
    return alike[0] if len(alike) == 1 else name


def _materials(folder: Folder, libraries: list[str]) -> dict[str, MtlMaterial]:
    """Return the materials of all libraries; instead of one that is missing or not named, of the one named like the mesh."""
    materials: dict[str, MtlMaterial] = {}
    own = f"{folder.path.stem}.mtl"
    several = (line.split() if folder.find(line) is None and len(line.split()) > 1 else [line] for line in libraries)
    for uri in dict.fromkeys(uri for uris in several for uri in uris) or [own]:
        file, beside = folder.find(uri), folder.find(own)
        if file is None and beside is not None:
            folder.warn(f"material library {readable(uri)[:SHOWN]!r} is missing; {own} is read instead")
            uri, file = own, beside
        data = folder.read_or_warn(uri, "material library") if libraries or file is not None else None
        materials |= {} if data is None or file is None else read_mtl(data, folder.beside(file))
    return materials


def _placed(uv: np.ndarray | None, looks: list[MtlMaterial], look: np.ndarray) -> tuple[np.ndarray | None, np.ndarray | None]:
    """Return corner_uv and corner_more_uv, scaled and moved as the pictures of each face's material are."""
    if uv is None or all(made.sets == (SOLE,) for made in looks):
        return uv, None
    width = max(len(made.sets) for made in looks)
    sets = np.tile(uv, (1, 1, width))
    for k, made in enumerate(looks):
        for j, (scale, offset) in enumerate(made.sets):
            sets[look == k, :, 2 * j : 2 * j + 2] = uv[look == k] * np.array(scale) + offset
    return np.ascontiguousarray(sets[..., :2]), np.ascontiguousarray(sets[..., 2:]) if width > 1 else None


def _looked_up(folder: Folder, what: str, table: np.ndarray, rows: np.ndarray) -> np.ndarray | None:
    """Return values per corner, zero for corners without; None if no corner has one."""
    if not len(table) or (rows == -1).all():
        return None
    wrong = (rows < -1) | (rows >= len(table))
    if wrong.any():
        folder.warn(f"{wrong.sum()} corners have a {what} that does not exist (valid are 1 to {len(table)}); they get none")
    values = np.where((wrong | (rows < 0))[..., None], 0.0, table[np.where(wrong, -1, rows)])
    return np.nan_to_num(values).astype(np.float32)


def _color(lines: _Lines, faces: np.ndarray) -> np.ndarray | None:
    """Return the colours after the coordinates or in comments, white for vertices without; None if there are none."""
    if len(lines.painted) == len(lines.v):
        try:
            return rgba(np.array([list(bytes.fromhex(c)) for c in lines.painted], np.uint8).reshape(-1, 3))[faces]
        except ValueError:  # another comment
            return None
    if all(len(row) < 6 for row in lines.v):
        return None
    values = np.array([row[3:6] if len(row) >= 6 else [math.nan] * 3 for row in lines.v])
    return rgba(values if np.nan_to_num(values).max(initial=0) <= 1 else values / 255)[faces]
