"""The file that a reference means: paths, file URLs and packages of ROS and Gazebo, within one folder.

A file that is not where its reference says is looked for where stores and people put it: beside the mesh, and in the folders
of pictures there. Names that are not UTF-8 keep their bytes as surrogates, as Python's file names do.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote

SCHEME = re.compile(r"([a-zA-Z][a-zA-Z0-9+.-]+):")  # one letter is a Windows drive
DRIVE = re.compile(r"[a-zA-Z]:")
FILE_URL = re.compile(r"(?i)file:(//localhost(?=/)|//)?")
PACKAGE_URL = re.compile(r"(?i)(?:package|model)://([^/]*)/?(.*)", re.S)
PACKAGES = ("package", "model")  # schemes of ROS and of Gazebo
PICTURE_FOLDERS = ("textures", "texture", "tex", "maps", "images", "materials")
ASIDE = ("textures", "Textures", "texture", "Texture")  # folders beside that of the mesh that are read without `root`
ABOVE = 4  # folders above that of the mesh, within root, whose folders of pictures are searched
ENCODINGS = ("cp1252", "latin-1", "cp932", "gbk", "big5", "cp949", "cp1251", "cp1250", "cp437", "cp850", "mac-roman")
SHOWN = 100  # characters of a reference shown in a message


@dataclass(frozen=True)
class Unresolved:
    """Reason why a reference leads to no readable file, as the end of a sentence."""

    reason: str


def resolve_reference(uri: str, bases: Sequence[Path], root: Path, aside: Sequence[Path] = ()) -> Path | Unresolved:
    """Find the file within `root` or `aside` that a reference means; nothing else is read or listed, no URL is followed.

    bases: the folders that relative paths start from, in order; they and root are resolved, and lie within root.
    aside: other folders in which a file of the same name may be read, resolved.

    A backslash counts as a slash. Percent-encoded names are decoded if the name as written is missing. If no name is equal,
    the only one that differs in case or encoding is used. `package://NAME/REST` and `model://NAME/REST` mean REST in a folder
    NAME between the first base and root, or in the folder NAME of root. Links are followed before any check. A file that is
    not there is looked for by its last folders and name: in the bases, and in folders of pictures there and up to four above.
    """
    scheme = SCHEME.match(uri)
    kind = scheme[1].lower() if scheme else ""
    starts: Iterator[tuple[Path | None, str]] = iter(())
    if kind in PACKAGES:
        starts = _package_starts(uri, bases[0], root)
    elif kind in ("", "file"):
        starts = _path_starts(FILE_URL.sub("", uri, count=1) if kind else uri, bases, root)
    outside = False
    for start, name in starts:
        path = None if start is None else _walk(start, name, root)
        if path is not None and _is_file(path):
            return path
        outside = outside or path is None
    for start, name, limit in _nearby(uri, bases, root, aside):
        path = _walk(start, name, limit)
        if path is not None and _is_file(path):
            return path
    last = next((name for name in reversed(_parts(uri)) if name), "")
    put = f"put {readable(last)[-40:]!r} beside the mesh" if last else ""
    if kind not in ("", "file", *PACKAGES):
        return Unresolved(f"has the scheme {kind}:, which is not followed; {put}")
    foreign = DRIVE.match(FILE_URL.sub("", uri).lstrip("/")) or uri.startswith(("\\\\", "//"))
    if outside and not foreign:
        return Unresolved(f"lies outside the permitted folder ({put}, or name a folder above both with --root FOLDER)")
    return Unresolved(f"is {'a path of another computer' if foreign else 'missing'}{put and '; '}{put}")


def _nearby(uri: str, bases: Sequence[Path], root: Path, aside: Sequence[Path]) -> Iterator[tuple[Path, str, Path]]:
    """Yield folders in which a file that is not where its reference says may lie, its last names, and the permitted folder."""
    around = [a for base in bases for a in (base, *list(base.parents)[:ABOVE]) if a.is_relative_to(root)]
    places = [*((base, root) for base in bases), *((a / name, root) for a in dict.fromkeys(around) for name in PICTURE_FOLDERS)]
    places += [(folder, folder) for folder in aside]
    for parts in dict.fromkeys(tuple(_parts(text)) for text in (uri, unquote(uri))):
        for count in range(min(len(parts), 3), 0, -1):
            for place, limit in places:
                folder = _walk(place.parent, place.name, limit) if limit == root else place
                if folder is not None and folder.is_dir():
                    yield folder, "/".join(parts[-count:]), limit


def _parts(uri: str) -> list[str]:
    return [part for part in re.split(r"[\\/]+|^[a-zA-Z]+:", uri.strip(" \"'")) if part not in ("", ".", "..")]


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
    """Return the entry of that name, or the only one that differs in case or encoding; nothing outside root is listed."""
    exact = folder / name
    if exact.exists() or not folder.is_relative_to(root) or not folder.is_dir():
        return exact
    wanted = meanings(name)
    alike = [entry for entry in folder.iterdir() if wanted & meanings(entry.name)]
    return alike[0] if len(alike) == 1 else exact


def meanings(name: str) -> set[str]:
    """Return the texts that a name may stand for, without case: itself, and its bytes in common encodings."""
    texts = [name]
    if not name.isascii():
        raw = name.encode("utf-8", "surrogateescape")
        for encoding in ENCODINGS:
            with suppress(UnicodeDecodeError):
                texts.append(raw.decode(encoding))
    return {unicodedata.normalize("NFC", text).casefold() for text in texts}


def readable(name: str) -> str:
    """Return a name without surrogates: bytes that are not UTF-8 are read in an encoding that they are likely in."""
    try:
        name.encode()
    except UnicodeEncodeError:
        raw = name.encode("utf-8", "surrogateescape")
        likely = ("cp1252",)  # a letter with an accent stands alone
        if re.search(rb"[\x81-\x9f]", raw):
            likely = ("cp932", "gbk", "cp1252")
        elif re.search(rb"[\xa0-\xff]{2}", raw):
            likely = ("gb2312", "gbk", "cp932", "cp1252")
        for encoding in (*likely, "latin-1"):
            with suppress(UnicodeDecodeError):
                return raw.decode(encoding)
    return name


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False
