"""Resolve references of a mesh file: paths, file URLs and the packages of ROS and Gazebo, within one permitted folder."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote

SCHEME = re.compile(r"([a-zA-Z][a-zA-Z0-9+.-]+):")  # one letter is a Windows drive
DRIVE = re.compile(r"[a-zA-Z]:")
FILE_URL = re.compile(r"(?i)file:(//localhost(?=/)|//)?")
PACKAGE_URL = re.compile(r"(?i)(?:package|model)://([^/]*)/?(.*)", re.S)
PACKAGES = ("package", "model")  # schemes of ROS and of Gazebo
MISSING = "is missing"
OUTSIDE = "lies outside the permitted folder"


@dataclass(frozen=True)
class Unresolved:
    """Reason why a reference leads to no readable file, as the end of a sentence."""

    reason: str


def resolve_reference(uri: str, bases: Sequence[Path], root: Path) -> Path | Unresolved:
    """Find the file within `root` that a reference means; nothing outside is read or listed, and no URL is followed.

    bases: the folders that relative paths start from, in order; they and root are resolved, and lie within root.

    A backslash counts as a slash. Percent-encoded names are decoded if the name as written is missing. If no name has the same
    case, the only one that differs in case is used. `package://NAME/REST` and `model://NAME/REST` mean REST in a folder NAME
    between the first base and root, or in the folder NAME of root. Links are followed before any check.
    """
    scheme = SCHEME.match(uri)
    kind = scheme[1].lower() if scheme else ""
    if kind in PACKAGES:
        starts = _package_starts(uri, bases[0], root)
    elif kind in ("", "file"):
        starts = _path_starts(FILE_URL.sub("", uri, count=1) if kind else uri, bases, root)
    else:
        return Unresolved(f"has the scheme {kind}:, which is not followed")
    outside = False
    for start, name in starts:
        path = None if start is None else _walk(start, name, root)
        if path is not None and _is_file(path):
            return path
        outside = outside or path is None
    return Unresolved(OUTSIDE if outside else MISSING)


def _path_starts(text: str, bases: Sequence[Path], root: Path) -> Iterator[tuple[Path | None, str]]:
    """Yield folders and the paths to walk from them; None for an absolute path that does not lead into root."""
    for name in dict.fromkeys(n.replace("\\", "/") for n in (text, unquote(text))):
        drive = name[1:] if DRIVE.match(name[1:]) and name.startswith("/") else name
        if drive.startswith("//"):  # a server is not searched
            yield None, ""
        elif drive.startswith("/") or DRIVE.match(drive):
            inner = _relative(Path(drive), root) if Path(drive).is_absolute() else None
            yield (None, "") if inner is None else (root, inner)
        else:
            yield from ((base, drive) for base in bases)


def _package_starts(uri: str, base: Path, root: Path) -> Iterator[tuple[Path, str]]:
    match = PACKAGE_URL.match(uri.replace("\\", "/"))
    if match is None:
        return
    for name, rest in dict.fromkeys((match.groups(), (unquote(match[1]), unquote(match[2])))):
        above = (folder for folder in (base, *base.parents) if folder.is_relative_to(root))
        yield from ((folder, rest) for folder in above if folder.name == name)
        yield root, f"{name}/{rest}"


def _relative(path: Path, root: Path) -> str | None:
    try:
        return path.resolve().relative_to(root).as_posix()
    except (OSError, RuntimeError, ValueError):  # links in a circle, another place, a name with a null character
        return None


def _walk(start: Path, name: str, root: Path) -> Path | None:
    """Return the resolved path that a relative path leads to, whether a file exists or not; None outside root."""
    here = start
    try:
        for part in name.split("/"):
            if part == "..":
                here = here.parent
            elif part not in ("", "."):
                here = _child(here, part, root).resolve()
    except (OSError, RuntimeError, ValueError):  # such as links in a circle, a name that is too long, a null character
        return root / "\ufffd"
    return here if here.is_relative_to(root) else None


def _child(folder: Path, name: str, root: Path) -> Path:
    """Return the entry of that name, or the only one that differs in case or Unicode form; nothing outside root is listed."""
    exact = folder / name
    if exact.exists() or not folder.is_relative_to(root) or not folder.is_dir():
        return exact
    alike = [entry for entry in folder.iterdir() if _folded(entry.name) == _folded(name)]
    return alike[0] if len(alike) == 1 else exact


def _folded(name: str) -> str:
    return unicodedata.normalize("NFC", name).casefold()


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False
