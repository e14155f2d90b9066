"""The folders that an agent may read and write."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from anymesh.errors import InputError, OptionError


class Places:
    """Allowed folders, with resolved links. Raises InputError for one that does not exist."""

    def __init__(self, folders: Sequence[str | Path]) -> None:
        if not folders:
            raise OptionError("name at least one folder that the tools may work in")
        for folder in folders:
            if not Path(folder).is_dir():
                raise InputError(f"{folder} is not a folder")
        self.folders = tuple(Path(folder).resolve() for folder in folders)

    def inside(self, path: str, *, below: bool = False) -> Path:
        """Resolve a path relative to the first folder, following links. Raise OptionError if it is outside all folders.

        below: the path must not be one of the folders themselves, since files are written beside it.
        """
        try:
            resolved = (self.folders[0] / path).resolve()
        except (OSError, RuntimeError, ValueError):  # a cycle of links, a null byte
            raise OptionError(f"{path!r} is not a path") from None
        if not any(resolved.is_relative_to(folder) for folder in self.folders):
            raise OptionError(f"{path!r} lies outside of the folders of this server: {', '.join(map(str, self.folders))}")

        if below and not any(resolved.parent.is_relative_to(folder) for folder in self.folders):
            raise OptionError(f"{path!r} is the whole folder of this server; name a folder in it")
        return resolved

    def shown(self, path: Path) -> str:
        """Return a path in the form that `inside` accepts: relative to the first folder if it is there."""
        first = self.folders[0]
        return path.relative_to(first).as_posix() if path.is_relative_to(first) else str(path)
