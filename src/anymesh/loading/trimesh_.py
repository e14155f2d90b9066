"""COLLADA by trimesh and pycollada: the placed geometries of the scene, without the file's up axis and unit."""

from __future__ import annotations

import io
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import numpy as np

from anymesh.errors import InputError
from anymesh.loading.files import Folder, picture_file, quiet_decoder
from anymesh.loading.join import join, rgba, simple_mesh, unit
from anymesh.types import Material, Mesh, Texture
from anymesh.types.mesh import to_linear

INTEGER, WITH_COMMA = rb"[+-]?\d+", rb"[+-]?\d+,\d+(?:[eE][+-]?\d+)?"
NUMBERS_WITH_COMMAS = re.compile(
    rb"(?:>|\bmeter\s*=\s*[\"'])\s*(?:%(int)b\s+)*%(comma)b(?:\s+(?:%(comma)b|%(int)b))*\s*[<\"']"
    % {b"int": INTEGER, b"comma": WITH_COMMA}
)
ENCODINGS = ("utf-8", "us-ascii", "ascii", "iso-8859-1", "iso-8859-15", "windows-1252")  # supersets of ASCII


def read_dae(data: bytes, folder: Folder) -> Mesh:
    """Return the scene in file coordinates. Raise InputError if it is not valid."""
    name = folder.path.name
    root, original, data = parse_dae(name, data), data, with_decimal_points(data)
    if data != original:
        folder.warn("found decimal commas, which are taken for points")
    _check_positions(name, root)
    textures = {uri: picture_file(folder, uri) for uri in dict.fromkeys(_pictures(root))}
    placed = []
    readable = _Readable({k: t.data for k, t in textures.items() if t is not None})
    for node, geometry, T in _geometries(data, root, folder, readable):
        if not np.isfinite(T).all():
            raise InputError(f"{name}: node {node!r} has a transform that is not finite")
        placed.append(_mesh(f"{name}, node {node!r}", node, geometry).transformed(T))
    if not placed:
        raise InputError(f"{name}: found no triangles in its scene; at least one is needed{_because(folder)}")
    return join(placed)


def _because(folder: Folder) -> str:
    return f" ({'; '.join(folder.warnings)})" if folder.warnings else ""


def parse_dae(name: str, data: bytes) -> ET.Element:
    """Return the document. Raise InputError if it cannot be read."""
    declared = re.match(rb"""(?:\xef\xbb\xbf)?\s*<\?xml[^>]*?encoding\s*=\s*["']([^"']*)""", data)
    encoding = declared[1].decode("ascii", "replace").lower() if declared else "utf-8"
    if b"\0" in data or encoding not in ENCODINGS:  # other encodings could hide a document type in other bytes
        content = f"a zero byte at {data.index(0)}" if b"\0" in data else f"the encoding {encoding[:40]}"
        raise InputError(f"{name}: found {content}; valid is text in {', '.join(ENCODINGS)}")
    if b"<!DOCTYPE" in data or b"<!ENTITY" in data:
        raise InputError(f"{name} declares a document type; a COLLADA file needs none, and it is not read")
    try:
        return ET.fromstring(with_decimal_points(data))
    except (ET.ParseError, ValueError, LookupError) as error:
        raise InputError(f"{name}: its XML is broken or truncated ({error})") from None


def with_decimal_points(data: bytes) -> bytes:
    """Return a document with points for the decimal commas that exporters write in some countries' settings.

    Only the unit, and texts that are nothing but such numbers and integers, separated by spaces, are changed.
    """
    return NUMBERS_WITH_COMMAS.sub(lambda match: match[0].replace(b",", b"."), data)


def _check_positions(name: str, root: ET.Element) -> None:
    """Raise InputError for positions that are not finite.

    pycollada reads NaN as 0, which is acceptable for normals but would move a corner.
    """
    wanted = {n.get("source", "")[1:] for n in root.iter() if n.get("semantic") == "POSITION"}
    for source in (n for n in root.iter() if n.tag.endswith("}source") and n.get("id") in wanted):
        words = " ".join(n.text or "" for n in source.iter() if n.tag.endswith("}float_array")).lower()
        if re.search(r"nan|inf|#", words):
            raise InputError(f"{name}: found a vertex that is not finite (NaN or infinite); valid are finite coordinates")


def _pictures(root: ET.Element) -> Iterator[str]:
    for image in (n for n in root.iter() if n.tag.endswith("}image")):
        for node in image.iter():
            text = (node.text or "").strip()
            if text and node.tag.rsplit("}", 1)[-1] in ("init_from", "ref"):
                yield text


class _Readable:
    """Resolver of the readable textures for trimesh."""

    def __init__(self, textures: dict[str, bytes]) -> None:
        self._textures = textures

    def get(self, name: str) -> bytes:
        """Return the bytes of a texture. Raise KeyError if it is left out, which trimesh ignores."""
        return self._textures[name.strip()]

    __getitem__ = get


Geometries = list[tuple[str, dict[str, Any], np.ndarray]]  # node, geometry and transform of each geometry in the scene


def _geometries(data: bytes, root: ET.Element, folder: Folder, textures: _Readable) -> Geometries:
    """Return the geometries of the scene. Of a file that is broken in part, those that can be read, with a warning."""
    try:
        return _scene(data, textures, ignore_broken=False)
    except Exception as error:  # pycollada is strict, often about irrelevant faults
        kind = f"{type(error).__name__}: "
        cause = kind + str(error).removeprefix(kind)[:100]  # pycollada's errors name their own type
    whole, plain = _scene(data, textures, ignore_broken=True), []
    with suppress(Exception):  # what can be read with materials need not be readable without
        plain = _scene(_without_materials(root), textures, ignore_broken=True)
    if _triangles(plain) > _triangles(whole):  # pycollada drops a geometry whose material it cannot read
        folder.warn(f"some of the file is broken, and its materials are left out ({cause})")
        return plain
    folder.warn(f"some of the file is broken and left out ({cause})")
    return whole


def _scene(data: bytes, textures: _Readable, ignore_broken: bool) -> Geometries:
    from trimesh.exchange.load import mesh_loaders

    read: Any = mesh_loaders["dae"]
    with quiet_decoder():
        scene = read(file_obj=io.BytesIO(data), resolver=textures, ignore_broken=ignore_broken)
    shapes, graph = scene["geometry"], scene["graph"]
    placed = [(str(e["frame_to"]), shapes[e["geometry"]], np.asarray(e["matrix"], np.float64)) for e in graph]
    return [shape for shape in placed if len(shape[1]["faces"])]


def _triangles(scene: Geometries) -> int:
    return sum(len(geometry["faces"]) for _, geometry, _ in scene)


def _without_materials(root: ET.Element) -> bytes:
    """Return the document without effects, materials and pictures; the root loses them."""
    materials = ("library_effects", "library_materials", "library_images", "bind_material")
    for parent in list(root.iter()):
        for child in [c for c in parent if c.tag.rsplit("}", 1)[-1] in materials]:
            parent.remove(child)
    return ET.tostring(root, "utf-8", xml_declaration=True)


def _mesh(where: str, node: str, geometry: dict[str, Any]) -> Mesh:
    faces = np.asarray(geometry["faces"], np.int64)
    count = len(geometry["vertices"])
    visual, color, normal = geometry.get("visual"), geometry.get("vertex_colors"), geometry.get("vertex_normals")
    uv = getattr(visual, "uv", None)
    normal = None if normal is None or len(normal) != count else unit(normal)
    return simple_mesh(
        where, node, geometry["vertices"], faces, None if visual is None else _material(visual.material),
        corner_uv=None if uv is None or len(uv) != count else np.nan_to_num(np.asarray(uv, np.float32))[faces],
        corner_color=None if color is None or len(color) != count else rgba(color)[faces],
        corner_normal=None if normal is None else normal[faces],
    )  # fmt: skip


def _material(material: Any) -> Material:
    """Convert a material; COLLADA's colours are sRGB and are converted to linear."""
    r, g, b, alpha = np.r_[_channels(material.baseColorFactor), 1.0, 1.0, 1.0, 1.0][:4]
    named = {"base_color": material.baseColorTexture, "normal": material.normalTexture, "emissive": material.emissiveTexture}
    textures = {slot: _texture(image) for slot, image in named.items()}
    roughness = material.roughnessFactor
    return Material(
        name=str(material.name),
        base_color=(*to_linear((r, g, b)).tolist(), float(alpha)),
        emissive=tuple(to_linear(np.r_[_channels(material.emissiveFactor), 0.0, 0.0, 0.0][:3]).tolist()),
        roughness=1.0 if roughness is None or not np.isfinite(roughness) else float(roughness),
        double_sided=False,
        alpha_mode="BLEND" if alpha < 1 else "OPAQUE",
        textures={slot: t for slot, t in textures.items() if t is not None},
    )


def _channels(values: Any) -> np.ndarray:
    if values is None:
        return np.zeros(0)
    v = np.asarray(values).reshape(-1)
    return v / 255.0 if v.dtype.kind in "iu" else v.astype(np.float64)


def _texture(image: Any) -> Texture | None:
    """Return an opened picture as PNG."""
    if image is None:
        return None
    buffer = io.BytesIO()
    image.save(buffer, "PNG")
    return Texture(buffer.getvalue(), "image/png")
