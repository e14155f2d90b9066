"""What a file says about itself, checked on its raw bytes before any library reads it."""

from __future__ import annotations

import json
import re
import struct
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from anymesh.errors import InputError

FORMATS = (".glb", ".gltf", ".obj", ".ply", ".stl", ".off", ".dae")
MOST_FACES = 20_000_000
MOST_BYTES = 4 * 1024**3
UNREADABLE = ("KHR_draco_mesh_compression", "EXT_meshopt_compression")
URL = re.compile(r"^[a-zA-Z][a-zA-Z0-9+.-]+:")


@dataclass(frozen=True)
class Reference:
    """Another file that a mesh file names. needed: the mesh cannot be read without it."""

    uri: str
    needed: bool


def check_file(path: Path) -> bytes:
    """The bytes of the file, once they are plausible for its format. Raises InputError."""
    if not path.exists():
        raise InputError(f"found no file {path}")
    if not path.is_file():
        raise InputError(f"{path} is no file; a mesh file is expected ({', '.join(FORMATS)})")
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        raise InputError(f"{path.name}: found the format {suffix or '(none)'}; valid are {', '.join(FORMATS)}")
    size = path.stat().st_size
    if size == 0:
        raise InputError(f"{path.name} is empty (0 bytes)")
    if size > MOST_BYTES:
        raise InputError(f"{path.name} has {size} bytes; at most {MOST_BYTES} are read")
    data = path.read_bytes()
    _check_content(path.name, suffix, data)
    return data


def _check_content(name: str, suffix: str, data: bytes) -> None:
    head = data[:512].lstrip()
    match suffix:
        case ".glb":
            ok = data[:4] == b"glTF"
        case ".gltf":
            ok = head.startswith((b"{", b"\xef\xbb\xbf{"))
        case ".ply":
            ok = data[:3] == b"ply"
        case ".off":
            ok = bool(re.match(rb"^(ST)?(C)?(N)?(4)?OFF", head)) or head[:1].isdigit()
        case ".dae":
            ok = b"<COLLADA" in data[:4096]
        case ".stl":
            ok = _plausible_stl(name, data)
        case _:
            ok = b"\0" not in data[:4096] and re.search(rb"(?m)^\s*(v|f|o|g|mtllib|#)\s", data[:65536]) is not None
    if not ok:
        raise InputError(f"{name}: the content is no {suffix[1:].upper()} file; is the extension right?")


def _plausible_stl(name: str, data: bytes) -> bool:
    if data[:5].lower() == b"solid" and b"facet" in data[:4096]:
        if b"endsolid" not in data[-4096:]:
            raise InputError(f"{name} is truncated: an ASCII STL ends with endsolid")
        return True
    if len(data) < 84:
        return False
    count = struct.unpack_from("<I", data, 80)[0]
    expected = 84 + 50 * count
    if len(data) < expected and (b"\0" in data[:512] or count < MOST_FACES):
        raise InputError(f"{name} is truncated: its header tells {count} triangles ({expected} bytes), found {len(data)}")
    return len(data) >= expected and count > 0


def gltf_json(name: str, data: bytes) -> dict[str, Any]:
    """The JSON of a GLB or glTF file, its structure checked. Raises InputError."""
    if data[:4] == b"glTF":
        if len(data) < 20:
            raise InputError(f"{name} is truncated: {len(data)} bytes")
        _, version, length = struct.unpack_from("<4sII", data)
        if version != 2:
            raise InputError(f"{name}: found glTF version {version}; valid is 2")
        chunk, kind = struct.unpack_from("<I4s", data, 12)
        if length > len(data) or 20 + chunk > len(data) or kind != b"JSON":
            raise InputError(f"{name} is truncated: its header tells {length} bytes, found {len(data)}")
        data = data[20 : 20 + chunk]
    try:
        tree = json.loads(data.decode("utf-8-sig"))
    except (UnicodeDecodeError, json.JSONDecodeError, RecursionError):
        raise InputError(f"{name}: its JSON cannot be read; the file is broken or truncated") from None
    if not isinstance(tree, dict) or not tree.get("meshes"):
        raise InputError(f"{name} holds no mesh")
    packed = [e for e in tree.get("extensionsRequired", []) if e in UNREADABLE]
    if packed:
        raise InputError(f"{name} is compressed with {packed[0]}, which is not read; export it without compression")
    _check_accessors(name, tree)
    return tree


def _check_accessors(name: str, tree: dict[str, Any]) -> None:
    """Counts that the buffers cannot hold would take memory before they fail."""
    total = sum(int(b.get("byteLength", 0)) for b in tree.get("buffers", []) if isinstance(b, dict))
    for accessor in tree.get("accessors", []):
        count = accessor.get("count", 0)
        if not isinstance(count, int) or count < 0 or ("bufferView" in accessor and count > total):
            raise InputError(f"{name}: an accessor tells {count} elements, its buffers hold {total} bytes")
        if "bufferView" not in accessor and count > MOST_FACES * 3:
            raise InputError(f"{name}: an accessor without data tells {count} elements")


def references(path: Path, data: bytes) -> list[Reference]:
    """The other files that a mesh file names, and those that its materials name."""
    match path.suffix.lower():
        case ".glb" | ".gltf":
            tree = gltf_json(path.name, data)
            found = [Reference(b["uri"], True) for b in tree.get("buffers", []) if b.get("uri")]
            found += [Reference(i["uri"], False) for i in tree.get("images", []) if i.get("uri")]
            return [r for r in found if not r.uri.startswith("data:")]
        case ".obj":
            return list(_obj_references(path, data))
        case ".dae":
            return _dae_references(path.name, data)
        case _:
            return []


def _obj_references(path: Path, data: bytes) -> Iterator[Reference]:
    for line in re.findall(rb"(?m)^\s*mtllib\s+(.+?)\s*$", data):
        uri = line.decode("utf-8", "replace")
        yield Reference(uri, False)
        library = _inside(path, uri)
        if library is not None and library.is_file():
            for image in re.findall(rb"(?mi)^\s*(?:map_\w+|bump|norm|disp|refl)\s+(.+?)\s*$", library.read_bytes()):
                yield Reference(image.decode("utf-8", "replace").split()[-1], False)


def _dae_references(name: str, data: bytes) -> list[Reference]:
    if b"<!DOCTYPE" in data or b"<!ENTITY" in data:
        raise InputError(f"{name} declares a document type; a COLLADA file needs none, and it is not read")
    try:
        tree = ET.fromstring(data)
    except ET.ParseError as error:
        raise InputError(f"{name}: its XML is broken or truncated (line {error.position[0]})") from None
    found = []
    for node in tree.iter():
        if node.tag.endswith("}init_from"):
            text = (node.text or "".join(c.text or "" for c in node)).strip()
            if text and "/" not in text[:0] and ("." in text or "/" in text):
                found.append(Reference(text, False))
    return found


def check_references(path: Path, found: list[Reference]) -> list[str]:
    """Raises InputError for a reference outside the file's folder or to a URL; returns warnings for missing pictures."""
    warnings = []
    for reference in found:
        uri = reference.uri
        if URL.match(uri) and not re.match(r"^[a-zA-Z]:[\\/]", uri):
            raise InputError(f"{path.name} refers to the URL {uri!r}; valid are files in its own folder")
        target = _inside(path, uri)
        if target is None:
            raise InputError(f"{path.name} refers to {uri!r} outside its own folder; valid are files within it")
        if not target.is_file():
            if reference.needed:
                raise InputError(f"{path.name} refers to {uri!r}, which is missing")
            warnings.append(f"{uri} is missing; the surfaces that use it have no picture")
    return warnings


def _inside(path: Path, uri: str) -> Path | None:
    """The file that a reference means if it lies in the mesh's folder (links followed), else None."""
    folder = path.parent.resolve()
    plain = unquote(uri).replace("\\", "/")
    if plain.startswith("/") or re.match(r"^[a-zA-Z]:", plain) or "\0" in plain:
        return None
    target = (folder / plain).resolve()
    return target if target.is_relative_to(folder) else None
