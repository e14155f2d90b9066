"""Zip files as stores give them: a mesh with its pictures, read like a folder. Their content is not trusted.

Bytes are counted while they are unpacked, since headers may be wrong.
"""

from __future__ import annotations

import re
import stat
import tempfile
import zipfile
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath
from typing import TypeVar

from anymesh.errors import InputError
from anymesh.formats.advice import advise
from anymesh.loading.references import readable
from anymesh.loading.scene_graph import DETAIL

MAX_UNPACKED_BYTES = 1 << 30  # of all files
MAX_FILES = 2000
MAX_RATIO = 300  # of the bytes of all files to those of the zip, above MIN_BYTES
MIN_BYTES = 64 << 20
BLOCK = 1 << 20  # [bytes] unpacked per step
ENCRYPTED = 0x1  # flag of an entry with a password
UTF_8 = 0x800  # flag of an entry whose name is UTF-8; others are read as code page 437
# Of one model in several formats, the one that says most is read.
BEST_FIRST = tuple(".glb .gltf .usdz .usdc .usd .usda .dae .obj .fbx .ply .3mf .step .stp .stl .off".split())
FORMAT_WORDS = re.compile(r"[\W_]*(?:obj|gltf|glb|usdz?|dae|fbx|ply|stl|off|3mf)$")

Loaded = TypeVar("Loaded")


@dataclass(frozen=True)
class Unpacked:
    """A mesh of an unpacked zip. root: folder with the files that it refers to; others: meshes of it in other formats."""

    mesh: Path
    root: Path
    others: tuple[str, ...] = ()


@contextmanager
def unpacked(path: Path, formats: Sequence[str]) -> Generator[Unpacked]:
    """Unpack the mesh of a zip into a temporary folder. Raise InputError as `unpack` and `only_mesh`."""
    with tempfile.TemporaryDirectory(prefix="anymesh-") as folder:
        inside = Path(folder).resolve() / "zip"
        try:
            unpack(path, inside)
            yield only_mesh(inside, formats)
        except InputError as error:
            raise InputError(f"{path.name}: {error}") from None


def unpack(path: Path, folder: Path) -> None:
    """Unpack a zip into a new folder.

    Raise InputError if it is broken, encrypted, too large once unpacked, or has a path outside the folder.
    """
    folder.mkdir()
    try:
        with zipfile.ZipFile(path) as archive:
            entries = [e for e in archive.infolist() if not e.is_dir()]
            if len(entries) > MAX_FILES:
                raise InputError(f"the zip holds {len(entries)} files; at most {MAX_FILES} are unpacked")
            if any(e.flag_bits & ENCRYPTED for e in entries):
                raise InputError(advise("locked_zip"))
            limit = min(MAX_UNPACKED_BYTES, max(MIN_BYTES, MAX_RATIO * path.stat().st_size))
            left = limit
            for entry in entries:
                left = _unpack_entry(archive, entry, folder, left)
                if left < 0:
                    raise InputError(f"the zip holds more than {limit >> 20} MB once unpacked")
    except InputError:
        raise
    except Exception as error:  # the library raises many types of errors for a broken archive
        reason = " ".join(f"{type(error).__name__}: {error}".split())[:120]
        raise InputError(f"the zip cannot be unpacked, it is broken or of an unknown kind ({reason})") from None


def _unpack_entry(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, folder: Path, left: int) -> int:
    """Write one file and return the number of bytes that are left, below 0 if it has more."""
    target = _inside(entry, folder)
    if target is None:
        return left
    target.parent.mkdir(parents=True, exist_ok=True)
    with archive.open(entry) as source, target.open("xb") as sink:
        while block := source.read(BLOCK):
            left -= len(block)
            if left < 0:
                return left
            sink.write(block)
    return left


def _inside(entry: zipfile.ZipInfo, folder: Path) -> Path | None:
    """Return the path of an entry, None for hidden files that some systems add. Raise InputError for an unsafe one."""
    name = entry.filename.replace("\\", "/")  # as some programs of Windows write
    if not entry.flag_bits & UTF_8:
        name = readable(name.encode("cp437").decode("utf-8", "surrogateescape"))
    place = PurePosixPath(name)
    unsafe = place.is_absolute() or ".." in place.parts or re.search(r"[:\x00-\x1f]", name) is not None
    if unsafe or stat.S_ISLNK(entry.external_attr >> 16):
        raise InputError(f"the zip has an unsafe entry, {name[:60]!r}; valid are plain files within the zip")
    if not place.parts or place.parts[0] == "__MACOSX" or any(part.startswith(".") for part in place.parts):
        return None
    return folder / place


def only_mesh(folder: Path, formats: Sequence[str], *, outer: bool = True) -> Unpacked:
    """Return the only mesh in a folder, or, if outer, in the only zip in it.

    Of one in several levels of detail or formats, the finest and best of them is returned.

    Raise InputError if there is none, or several.
    """
    files = sorted(p for p in folder.rglob("*") if p.is_file())
    meshes = [p for p in files if p.suffix.lower() in formats]
    archives = [p for p in files if p.suffix.lower() == ".zip"]
    if outer and not meshes and len(archives) == 1:  # as Sketchfab gives source/model.zip beside textures/
        inner = archives[0].with_suffix("")
        inner = inner.with_name(f"{inner.name}_zip") if inner.exists() else inner
        unpack(archives[0], inner)
        archives[0].unlink()
        return replace(only_mesh(inner, formats, outer=False), root=folder)
    names = [p.relative_to(folder).as_posix() for p in meshes]
    if len({FORMAT_WORDS.sub("", DETAIL.sub("", p.stem).casefold().strip("_-. ")) for p in meshes}) == 1:
        ranks = [(_level(p), BEST_FIRST.index(p.suffix.lower()) if p.suffix.lower() in BEST_FIRST else 99) for p in meshes]
        if ranks.count(min(ranks)) == 1:
            best = ranks.index(min(ranks))
            return Unpacked(meshes[best], folder, tuple(n for k, n in enumerate(names) if k != best))
    listed = f"{len(meshes)} meshes ({', '.join(names[:4])}{', ...' if len(names) > 4 else ''})"
    raise InputError(advise("zip", listed=listed) if meshes else advise("empty_zip", formats=", ".join(formats)))


def _level(path: Path) -> int:
    """Return the level of detail that a file's name states, 0 for the finest."""
    mark = DETAIL.search(path.stem)
    return int(mark[1]) if mark else 0


def load_zipped(
    path: Path, formats: Sequence[str], load: Callable[[Path, Path], Loaded]
) -> tuple[Loaded, str, tuple[str, ...]]:
    """Return the result of `load(mesh, root)` for the mesh of a zip, the name of the mesh within it, and warnings."""
    with unpacked(path, formats) as inside:
        name = inside.mesh.relative_to(inside.root).as_posix()
        warning = f"the zip also holds {', '.join(inside.others[:4])}; {name} is read"
        return load(inside.mesh, inside.root), name, (warning,) if inside.others else ()
