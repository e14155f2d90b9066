"""3MF: the build items of a package of XML files, with components, materials, colours and pictures."""

from __future__ import annotations

import posixpath
import xml.etree.ElementTree as ET
from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.errors import InputError
from anymesh.formats.credits import credits_in
from anymesh.formats.packages import unpack
from anymesh.loading.files import MAX_FACES, FileMesh, Folder, picture
from anymesh.loading.join import join, rgba
from anymesh.types import Brief, Material, Mesh, Node, Texture
from anymesh.types.mesh import CLAMP, MIRROR, REPEAT, to_linear

UNITS = {"micron": 1e-6, "millimeter": 1e-3, "centimeter": 1e-2, "inch": 0.0254, "foot": 0.3048, "meter": 1.0}
WRAP = {"wrap": REPEAT, "mirror": MIRROR, "clamp": CLAMP, "none": CLAMP}
GROUPS = ("basematerials", "colorgroup", "texture2dgroup")
MAX_DEPTH, MAX_PLACED = 32, 100_000
LEFT_OUT = {
    "compositematerials": "mixtures of materials", "multiproperties": "properties in several layers",
    "beamlattice": "beam lattices", "slicestack": "stacks of slices", "volumedata": "volumes", "levelset": "volumes",
    "displacementmesh": "displaced meshes",
}  # fmt: skip


def read_3mf(folder: Folder, work: Path) -> FileMesh:
    """Return what a 3MF file builds, in its own coordinates (Z up), with its unit. work: an empty folder.

    Raise InputError if it is not valid.
    """
    unpack(folder.path.name, folder.path, work)
    package = ThreeMf(folder, work)
    return FileMesh(package.read(), "z", package.unit)


@dataclass(frozen=True, eq=False)
class Group(Brief):
    """Properties that triangles refer to: a material each, or colours (n, 4) 0..1, or texture coordinates (n, 2)."""

    materials: tuple[Material, ...] = ()
    colors: np.ndarray | None = None
    uv: np.ndarray | None = None


def plain(element: ET.Element) -> str:
    """Return the name of an element without its namespace."""
    return element.tag.rsplit("}", 1)[-1]


def attribute(element: ET.Element, name: str) -> str | None:
    """Return an attribute in any namespace."""
    return next((v for k, v in element.items() if k.rsplit("}", 1)[-1] == name), None)


class ThreeMf:
    """Reads one package."""

    def __init__(self, folder: Folder, root: Path) -> None:
        self._folder, self._root = folder, root
        self._documents: dict[str, ET.Element] = {}
        self._objects: dict[str, dict[str, ET.Element]] = {}
        self._groups: dict[tuple[str, str], Group | None] = {}
        self._meshes: dict[tuple[str, str], Mesh | None] = {}
        self._left_out: Counter[str] = Counter()
        self._faces = 0
        self._first = self._main_part()
        told = {str(e.get("name")): e.text for e in self._document(self._first).iter() if plain(e) == "metadata"}
        folder.credits = credits_in("metadata", told)
        self.unit = UNITS.get(self._document(self._first).get("unit", "millimeter"), 1e-3)

    def read(self) -> Mesh:
        """Return what is built. Raise InputError if there is nothing, or too much."""
        name, placed = self._folder.path.name, list[Mesh]()
        build = [e for e in self._document(self._first) if plain(e) == "build"]
        items = [item for b in build for item in b if plain(item) == "item"]
        for item in items:
            path = self._place(attribute(item, "path"), self._first)
            placed += self._place_object(path, item.get("objectid", ""), _transform(item), (), 0)
            if len(placed) > MAX_PLACED:
                raise InputError(f"{name} places more than {MAX_PLACED} objects; at most that are read")
        kinds = [plain(element) for document in self._documents.values() for element in document.iter()]
        self._left_out.update(LEFT_OUT[kind] for kind in kinds if kind in LEFT_OUT)
        for what, count in self._left_out.items():
            self._folder.warn(f"left out: {count} {what}")
        if not placed:
            reasons = f" ({'; '.join(self._folder.warnings)})" if self._folder.warnings else ""
            raise InputError(f"{name}: found no triangles in its build; at least one is needed{reasons}")
        return join(placed)

    def _main_part(self) -> str:
        relations = self._root / "_rels" / ".rels"
        if relations.is_file():
            for relation in self._parsed("_rels/.rels"):
                if relation.get("Type", "").endswith("/3dmodel"):
                    return relation.get("Target", "").lstrip("/")
        parts = sorted(p.relative_to(self._root).as_posix() for p in self._root.rglob("*.model"))
        if not parts:
            raise InputError(f"{self._folder.path.name}: found no 3D model in the archive; is it a 3MF file?")
        return parts[0]

    def _parsed(self, part: str) -> ET.Element:
        name, file = self._folder.path.name, (self._root / part).resolve()
        if not file.is_relative_to(self._root) or not file.is_file():
            raise InputError(f"{name} refers to {part[:100]!r}, which is not in the archive")
        data = file.read_bytes()
        if b"<!DOCTYPE" in data or b"<!ENTITY" in data:
            raise InputError(f"{name} declares a document type; a 3MF file needs none, and it is not read")
        try:
            return ET.fromstring(data)
        except (ET.ParseError, ValueError, LookupError) as error:
            raise InputError(f"{name}: its XML is broken or truncated ({error})") from None

    def _document(self, part: str) -> ET.Element:
        if part not in self._documents:
            self._documents[part] = self._parsed(part)
            self._objects[part] = {e.get("id", ""): e for e in self._documents[part].iter() if plain(e) == "object"}
        return self._documents[part]

    def _place(self, path: str | None, here: str) -> str:
        return here if path is None else posixpath.normpath(path.lstrip("/"))

    def _place_object(
        self, part: str, number: str, T: Float[np.ndarray, "4 4"], above: tuple[str, ...], depth: int
    ) -> list[Mesh]:
        """Return the meshes of an object and its components at their places. above: names down to it."""
        self._document(part)
        element = self._objects[part].get(number)
        if element is None or depth > MAX_DEPTH:
            self._left_out["components without an object" if element is None else "components that are nested too deep"] += 1
            return []
        if element.get("type", "model") not in ("model", "surface", "other"):
            self._left_out[f"objects of the type {element.get('type')}"] += 1
            return []
        label = element.get("name") or f"object_{number}"
        chain = (*above, label)
        placed: list[Mesh] = []
        mesh = self._mesh(part, number, element)
        if mesh is not None:
            self._faces += len(mesh.faces)
            if self._faces > MAX_FACES:
                raise InputError(f"{self._folder.path.name} has more than {MAX_FACES} faces; at most that are handled")
            node = Node(label, label, path=chain if above else ())
            placed.append(replace(mesh.transformed(T), nodes=(node,)))
        for component in (c for e in element if plain(e) == "components" for c in e):
            place = self._place(attribute(component, "path"), part)
            placed += self._place_object(place, component.get("objectid", ""), T @ _transform(component), chain, depth + 1)
            if len(placed) > MAX_PLACED:
                raise InputError(f"{self._folder.path.name} places more than {MAX_PLACED} objects; at most that are read")
        return placed

    def _mesh(self, part: str, number: str, element: ET.Element) -> Mesh | None:
        key = (part, number)
        if key not in self._meshes:
            mesh = next((e for e in element if plain(e) == "mesh"), None)
            self._meshes[key] = None if mesh is None else self._read_mesh(part, element, mesh)
        return self._meshes[key]

    def _read_mesh(self, part: str, owner: ET.Element, mesh: ET.Element) -> Mesh | None:
        vertices = np.array([[_number(v, k) for k in "xyz"] for e in mesh if plain(e) == "vertices" for v in e]).reshape(-1, 3)
        rows = [t for e in mesh if plain(e) == "triangles" for t in e]
        faces = np.array([[_index(t, k) for k in ("v1", "v2", "v3")] for t in rows], np.int64).reshape(-1, 3)
        good = np.asarray(((faces >= 0) & (faces < len(vertices))).all(1))
        finite = np.asarray(np.isfinite(vertices).all(1))
        good[good] &= finite[faces[good]].all(1)
        if not good.all():
            self._left_out["triangles that refer to no vertex"] += int((~good).sum())
        if not good.any():
            return None
        rows = [row for row, keep in zip(rows, good, strict=True) if keep]
        vertices = np.where(finite[:, None], vertices, 0.0)
        face_material, materials, colors, uv = self._properties(part, owner, rows)
        return Mesh(
            vertices, faces[good], np.zeros(len(rows), np.int64), (Node("object"),), face_material, tuple(materials), uv, colors
        )

    def _properties(self, part: str, owner: ET.Element, rows: list[ET.Element]) -> tuple[np.ndarray, list[Material], Any, Any]:
        """Return the material of each triangle, the materials, and the colours and texture coordinates of its corners."""
        face_material = np.full(len(rows), -1, np.int64)
        colors, uv = np.full((len(rows), 3, 4), 255, np.uint8), np.zeros((len(rows), 3, 2), np.float32)
        materials: list[Material] = []
        has_colors = has_uv = False
        for k, row in enumerate(rows):
            own = row.get("pid")
            pid, default = own or owner.get("pid"), owner.get("pindex", "0")
            group = None if pid is None else self._group(part, pid)
            if group is None:
                continue
            first = row.get("p1") or (default if own is None else "0")
            index = [int(p) if p and p.isdecimal() else 0 for p in (first, row.get("p2") or first, row.get("p3") or first)]
            if group.colors is not None and max(index) < len(group.colors):
                colors[k], has_colors = rgba(group.colors[index]), True
            if group.uv is not None and max(index) < len(group.uv):
                uv[k], has_uv = group.uv[index], True
            number = index[0] if group.uv is None else 0
            if number < len(group.materials):
                material = group.materials[number]
                if material not in materials:
                    materials.append(material)
                face_material[k] = materials.index(material)
        return face_material, materials, colors if has_colors else None, uv if has_uv else None

    def _group(self, part: str, number: str) -> Group | None:
        key = (part, number)
        if key not in self._groups:
            named = {e.get("id"): e for e in self._documents[part].iter() if plain(e) in GROUPS}
            element = named.get(number)
            self._groups[key] = None if element is None else self._read_group(part, element)
        return self._groups[key]

    def _read_group(self, part: str, element: ET.Element) -> Group:
        match plain(element):
            case "basematerials":
                return Group(tuple(_material(e) for e in element if plain(e) == "base"))
            case "colorgroup":
                return Group(colors=np.array([_color(e.get("color")) for e in element if plain(e) == "color"]).reshape(-1, 4))
        pairs = [[_number(e, "u"), _number(e, "v")] for e in element if plain(e) == "tex2coord"]
        texture = self._texture(part, element.get("texid", ""))
        material = Material("texture", (1.0, 1.0, 1.0, 1.0), textures={} if texture is None else {"base_color": texture})
        return Group((material,), uv=np.nan_to_num(np.array(pairs, np.float32)).reshape(-1, 2))

    def _texture(self, part: str, number: str) -> Texture | None:
        textures = {e.get("id"): e for e in self._documents[part].iter() if plain(e) == "texture2d"}
        element = textures.get(number)
        path = "" if element is None else element.get("path", "").lstrip("/")
        file = (self._root / path).resolve()
        if element is None or not path or not file.is_relative_to(self._root) or not file.is_file():
            self._folder.warn(f"texture {path[:100]!r} left out: it is not in the archive")
            return None
        image = picture(self._folder, file.read_bytes(), path)
        wrap = [WRAP.get(element.get(k, "wrap"), REPEAT) for k in ("tilestyleu", "tilestylev")]
        return None if image is None else replace(image, wrap=(wrap[0], wrap[1]))


def _material(element: ET.Element) -> Material:
    red, green, blue, alpha = _color(element.get("displaycolor"))
    linear = [float(c) for c in to_linear([red, green, blue])]
    mode = "BLEND" if alpha < 1 else "OPAQUE"
    return Material(element.get("name") or "material", (linear[0], linear[1], linear[2], alpha), alpha_mode=mode)


def _color(text: str | None) -> tuple[float, float, float, float]:
    """Return red, green, blue and alpha 0..1 of #RRGGBB or #RRGGBBAA; grey for anything else."""
    digits = (text or "").strip().lstrip("#")
    try:
        numbers = [int(digits[k : k + 2], 16) / 255 for k in range(0, len(digits), 2)] if len(digits) in (6, 8) else []
    except ValueError:
        numbers = []
    red, green, blue, alpha = (*numbers, 1.0)[:4] if numbers else (0.7, 0.7, 0.7, 1.0)
    return red, green, blue, alpha


def _number(element: ET.Element, name: str) -> float:
    try:
        return float(element.get(name, "nan"))
    except ValueError:
        return float("nan")


def _index(element: ET.Element, name: str) -> int:
    text = element.get(name, "")
    return int(text) if text.isdecimal() and len(text) < 12 else -1


def _transform(element: ET.Element) -> Float[np.ndarray, "4 4"]:
    """Return the transform of an item or component; the file lists the rows that multiply a row vector."""
    T, words = np.eye(4), (element.get("transform") or "").split()
    if len(words) == 12:
        try:
            rows = np.array([float(w) for w in words]).reshape(4, 3)
        except ValueError:
            return T
        if np.isfinite(rows).all():
            T[:3] = rows.T
    return T
