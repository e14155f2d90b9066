"""Extraction of a file from a Debian package file, without installing it."""

from __future__ import annotations

import io
import tarfile
from pathlib import Path

from anymesh.errors import InputError

MAGIC = b"!<arch>\n"
HEADER = 60  # bytes before each member of the archive


def member(package: Path, name: str) -> io.BytesIO:
    """Return the first file of that name in the .deb. Raise InputError if it cannot be read."""
    archive = package.read_bytes()
    if not archive.startswith(MAGIC):
        raise InputError(f"{package.name} is not a Debian package file; it must start with {MAGIC!r}")
    at = len(MAGIC)
    while at + HEADER <= len(archive):
        header = archive[at : at + HEADER]
        size = int(header[48:58])
        if header[:16].strip().rstrip(b"/").startswith(b"data.tar"):
            return _from_tar(package.name, archive[at + HEADER : at + HEADER + size], name)
        at += HEADER + size + size % 2
    raise InputError(f"{package.name} holds no data.tar; it is broken or truncated")


def _from_tar(package: str, data: bytes, name: str) -> io.BytesIO:
    try:
        with tarfile.open(fileobj=io.BytesIO(data)) as tar:
            tar_member = next((m for m in tar if m.isfile() and m.name.rsplit("/", 1)[-1] == name), None)
            opened = None if tar_member is None else tar.extractfile(tar_member)
            if opened is not None:
                return io.BytesIO(opened.read())
    except (tarfile.TarError, EOFError, OSError) as error:
        raise InputError(f"{package}: its data cannot be read ({error}); valid are packages packed with xz or gzip") from None
    raise InputError(f"{package}: found no file {name} in the package")
