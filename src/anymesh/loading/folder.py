"""Read the files that a mesh file refers to, only within its own folder or a given root."""

from __future__ import annotations

import copy
import hashlib
import json
import os
from pathlib import Path

from anymesh.errors import InputError, OptionError
from anymesh.loading.references import OUTSIDE, Unresolved, resolve_reference

SHOWN = 100  # characters of a reference shown in a message
HINT = "--root FOLDER names the folder within which files may be read"


class Folder:
    """The files around one mesh file, and the warnings from reading what the file refers to.

    root: the folder within which references may be read, by default the mesh's own.

    Raise OptionError if it is not a folder or the mesh is not inside it.
    """

    def __init__(self, path: Path, root: str | Path | None = None) -> None:
        self.path = path
        self.warnings: list[str] = []
        self._digests: dict[str, str] = {}  # of the files that were read
        own = path.parent.resolve()
        self._root = own if root is None else _checked(Path(root), path, own)
        self._bases: tuple[Path, ...] = (own,)

    def beside(self, file: Path) -> Folder:
        """Return the same files, but with relative references starting from the folder of `file` first.

        This is used for references in a material library.
        """
        folder = copy.copy(self)  # caches and warnings are shared
        folder._bases = tuple(dict.fromkeys((file.parent, *self._bases)))
        return folder

    def find(self, uri: str) -> Path | None:
        """Return the file that a reference means; None if none may be read."""
        file = resolve_reference(uri, self._bases, self._root)
        return None if isinstance(file, Unresolved) else file

    def read(self, uri: str) -> bytes:
        """Return the bytes of a file that the mesh requires.

        Raise InputError if it cannot be read.
        """
        content = self._bytes(uri)
        if isinstance(content, Unresolved):
            raise InputError(f"{self.path.name} refers to {uri[:SHOWN]!r}, which {_reason(content)}")
        return content

    def read_or_warn(self, uri: str, what: str) -> bytes | None:
        """Return the bytes of an optional file; None, with a warning, if it cannot be read.

        what: its role.
        """
        content = self._bytes(uri)
        if isinstance(content, Unresolved):
            self.warn(f"{what} {uri[:SHOWN]!r} left out: it {_reason(content)}")
            return None
        return content

    def _bytes(self, uri: str) -> bytes | Unresolved:
        file = resolve_reference(uri, self._bases, self._root)
        if isinstance(file, Unresolved):
            return file
        try:
            data = file.read_bytes()
        except OSError as error:
            return Unresolved(f"cannot be opened ({error.strerror})")
        self._digests[os.path.relpath(file, self._bases[-1])] = hashlib.sha256(data).hexdigest()
        return data

    def warn(self, text: str) -> None:
        """Record a warning, once."""
        if text not in self.warnings:
            self.warnings.append(text)

    def digest(self) -> str:
        """Return a digest that differs between loads of the same mesh file with other referenced contents or warnings."""
        contents = (sorted(self._digests.items()), self.warnings)
        return hashlib.sha256(json.dumps(contents).encode()).hexdigest()


def _reason(unresolved: Unresolved) -> str:
    return f"{unresolved.reason} ({HINT})" if unresolved.reason == OUTSIDE else unresolved.reason


def _checked(root: Path, path: Path, own: Path) -> Path:
    if not root.is_dir():
        raise OptionError(f"--root: found {str(root)!r}, which is not a folder; valid is the mesh's folder or one above it")
    resolved = root.resolve()
    if not own.is_relative_to(resolved):
        raise OptionError(f"--root: {path} does not lie within {str(root)!r}; valid is the mesh's folder or one above it")
    return resolved
