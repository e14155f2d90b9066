"""Checks of a file's own statements on its raw bytes, before a reader parses it."""

from __future__ import annotations

import re
import struct
from pathlib import Path

from anymesh.errors import InputError

FORMATS = (".glb", ".gltf", ".obj", ".ply", ".stl", ".off", ".dae")
MAX_FACES = 20_000_000
MAX_BYTES = 4 * 1024**3
ASCII_STL = re.compile(rb"(?is)(\xef\xbb\xbf)?\s*solid\b.{0,2000}facet")
SIGNS = {  # start of files of other formats
    "GLB": rb"glTF",
    "PLY": rb"ply\r?\n",
    "DAE": rb"(?s).{0,2000}<COLLADA",
    "OFF": rb"\s*(ST)?C?N?4?OFF",
    "glTF": rb"(\xef\xbb\xbf)?\s*\{",
    "a PNG picture": rb"\x89PNG",
    "a JPEG picture": rb"\xff\xd8\xff",
    "a ZIP archive": rb"PK\x03\x04",
    "an FBX": rb"Kaydara FBX",
    "an ASCII STL": ASCII_STL,
    "a web page": rb"(?i)\s*<(!doctype )?html",
}


def check_file(path: Path) -> bytes:
    """Return the bytes of the file if they are plausible for its format.

    Raise InputError otherwise.
    """
    if not path.exists():
        raise InputError(f"found no file {path}")
    if not path.is_file():
        raise InputError(f"{path} is not a file; a mesh file is expected ({', '.join(FORMATS)})")
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        raise InputError(f"{path.name}: found the format {suffix or '(none)'}; valid are {', '.join(FORMATS)}")
    size = path.stat().st_size
    if size == 0:
        raise InputError(f"{path.name} is empty (0 bytes); valid is a file with at least one triangle")
    if size > MAX_BYTES:
        raise InputError(f"{path.name} has {size} bytes; at most {MAX_BYTES} are read")
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path.name} cannot be opened: {error.strerror}") from None
    if not _plausible(suffix, data):
        seems = next((f"; it looks like {kind}" for kind, sign in SIGNS.items() if re.match(sign, data)), "")
        raise InputError(f"{path.name}: found no {suffix[1:].upper()} file inside{seems}; is the extension right?")
    return data


def _plausible(suffix: str, data: bytes) -> bool:
    match suffix:
        case ".glb":
            return data[:4] == b"glTF"
        case ".gltf":
            return re.match(SIGNS["glTF"], data) is not None
        case ".ply":
            return data[:3] == b"ply"
        case ".off":
            return re.match(SIGNS["OFF"], data) is not None
        case ".dae":
            return b"<COLLADA" in data[:4096]
        case ".stl":
            return ASCII_STL.match(data) is not None or is_binary_stl(data)
        case _:
            return b"\0" not in data[:4096] and re.search(rb"(^|[\r\n])[ \t]*(v|f|o|g|mtllib|usemtl)\s", data) is not None


def is_binary_stl(data: bytes) -> bool:
    """Return whether bytes that are no ASCII STL could be a binary one, complete or truncated."""
    if len(data) < 84:
        return data[:5].lower() == b"solid" or b"\0" in data
    count = struct.unpack_from("<I", data, 80)[0]
    known = any(re.match(sign, data) for kind, sign in SIGNS.items() if "STL" not in kind)
    return len(data) >= 84 + 50 * count or (b"\0" in data and not known)


def check_count(name: str, what: str, stated: int, room: int) -> None:
    """Raise InputError if a header states more elements than the file has room for."""
    if stated < 0 or stated > room:
        raise InputError(f"{name} is truncated or broken: it states {stated} {what}, and has room for at most {max(room, 0)}")
