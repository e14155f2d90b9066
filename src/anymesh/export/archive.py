"""Reproducible zip of a folder, whose bytes depend on its content only."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

from anymesh.errors import OutputError

EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest date that a zip can hold
PLAIN_FILE = 0o100644 << 16  # a file readable by all and writable by its owner


def check_zip(path: Path) -> None:
    """Raise OutputError if no zip can be written there."""
    if path.suffix.lower() != ".zip" or path.is_dir() or not path.parent.is_dir():
        raise OutputError(f"--zip: found {str(path)!r}; valid is the path of a file that ends in .zip, in an existing folder")


def write_zip(folder: Path, path: Path) -> None:
    """Zip an asset folder under its own name, with files sorted by name and fixed dates and permissions.

    Hidden files and saved stages, which no simulator needs, are left out.
    """
    partial = path.with_name(f".{path.name}.partial")
    with partial.open("wb") as sink:
        _zip(folder, sink, without=path)
    partial.replace(path)


def zip_bytes(folder: Path) -> bytes:
    """Return the zip of an asset folder, as `write_zip` writes it."""
    sink = io.BytesIO()
    _zip(folder, sink)
    return sink.getvalue()


def _zip(folder: Path, sink: io.BufferedIOBase, without: Path | None = None) -> None:
    with zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED, compresslevel=6) as archive:
        for file in sorted(p for p in folder.rglob("*") if p.is_file()):
            inside = file.relative_to(folder)
            if file == without or inside.parts[0] == "stages" or any(part.startswith(".") for part in inside.parts):
                continue
            entry = zipfile.ZipInfo(f"{folder.name}/{inside.as_posix()}", EPOCH)
            entry.compress_type, entry.external_attr, entry.create_system = zipfile.ZIP_DEFLATED, PLAIN_FILE, 3
            archive.writestr(entry, file.read_bytes())
