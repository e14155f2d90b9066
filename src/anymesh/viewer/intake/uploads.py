"""Uploaded files (a mesh, or a zip with a mesh and its referenced files), whose content is not trusted."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from anymesh.errors import InputError
from anymesh.formats.advice import remedy
from anymesh.formats.zipped import only_mesh, unpack
from anymesh.loading.files import FORMATS

MAX_UPLOAD_BYTES = 200 << 20  # maximum size of a file [bytes]
PLAIN_NAME = re.compile(r"[^A-Za-z0-9._-]+")


@dataclass(frozen=True)
class Upload:
    """An uploaded mesh. root: folder with the files that it refers to."""

    mesh: Path
    root: Path


def receive(name: str, content: bytes, folder: Path) -> Upload:
    """Save an uploaded file in an empty folder; a zip is unpacked there.

    Raise InputError for a file that is too large, of unknown format, or a zip that is unsafe or without exactly one mesh.
    """
    if len(content) > MAX_UPLOAD_BYTES:
        raise InputError(f"the file has {_size(len(content))}; at most {_size(MAX_UPLOAD_BYTES)} are accepted")
    folder.mkdir(parents=True)
    plain = plain_name(name)
    suffix = Path(plain).suffix.lower()
    if suffix not in (*FORMATS, ".zip"):
        way = remedy(suffix) or f"valid are {', '.join(FORMATS)}, and .zip"
        raise InputError(f"{plain}: found the format {suffix or '(none)'}; {way}")
    path = folder / plain
    path.write_bytes(content)
    if suffix != ".zip":
        return Upload(path, folder)
    inside = folder / "unpacked"
    unpack(path, inside)
    path.unlink()
    return Upload(only_mesh(inside, FORMATS).mesh, inside)


def plain_name(name: str) -> str:
    """Return the last part of a file name in plain characters, never hidden or empty."""
    last = re.split(r"[\\/]", name)[-1]
    plain = PLAIN_NAME.sub("_", last).strip("._") or "mesh"
    stem, dot, suffix = plain.rpartition(".")
    return f"{stem[:60]}{dot}{suffix[:10]}" if dot else plain[:60]


def _size(count: int) -> str:
    return f"{count / (1 << 20):.0f} MB"
