"""The files that a mesh file names: read from its own folder and from nowhere else."""

from __future__ import annotations

import re
from pathlib import Path
from urllib.parse import unquote

from anymesh.errors import InputError

ADDRESS = re.compile(r" at 0x[0-9a-fA-F]+")
URL = re.compile(r"^[a-zA-Z][a-zA-Z0-9+.-]+:")


class Folder:
    """The folder of one mesh file, and the warnings that came up while reading what the file refers to."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.warnings: list[str] = []

    def find(self, uri: str) -> Path | None:
        """The file that a reference means, None if there is none. Raises InputError for a URL or a place outside."""
        if URL.match(uri):
            raise InputError(f"{self.path.name} refers to the URL {uri[:100]!r}; valid are files in its own folder")
        found = None
        for name in dict.fromkeys((uri, unquote(uri))):
            target = self._inside(name.replace("\\", "/"))
            if target is None:
                raise InputError(f"{self.path.name} refers to {uri[:100]!r} outside its own folder; valid are files within it")
            found = found or (target if _is_file(target) else None)
        return found

    def _inside(self, name: str) -> Path | None:
        if name.startswith("/") or re.match(r"^[a-zA-Z]:", name) or "\0" in name:
            return None
        folder = self.path.parent.resolve()
        try:
            target = (folder / name).resolve()
        except (OSError, RuntimeError):  # links in a circle
            return None
        return target if target.is_relative_to(folder) else None

    def read(self, uri: str) -> bytes:
        """The bytes of a file that the mesh cannot do without. Raises InputError."""
        found = self.find(uri)
        if found is None:
            raise InputError(f"{self.path.name} refers to {uri[:100]!r}, which is missing")
        return found.read_bytes()

    def read_or_warn(self, uri: str, loss: str) -> bytes | None:
        """The bytes of a file that the mesh can do without; a warning names the loss where it is missing."""
        found = self.find(uri)
        if found is None:
            self.warn(f"{uri} is missing; {loss}")
            return None
        return found.read_bytes()

    def warn(self, text: str) -> None:
        """Keeps a warning, once. A library's message may name an object by its address, which differs between runs."""
        text = ADDRESS.sub("", text)
        if text not in self.warnings:
            self.warnings.append(text)

    def get(self, name: str) -> bytes:
        """As `read`, under the name by which trimesh asks."""
        return self.read(name)

    __getitem__ = get


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:  # such as a name that is too long
        return False
