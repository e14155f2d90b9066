"""Bytes of a mesh file and of the files that it refers to: checked, and only within its own folder or a given root.

Pictures of materials are kept as the bytes of their file.
"""

from __future__ import annotations

import copy
import hashlib
import io
import json
import os
import re
import struct
import warnings
from collections.abc import Generator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

import numpy as np
from PIL import Image

from anymesh.entry_points import ADVISE, ADVISE_ON_CONTENT, READERS, REMEDY, resolve
from anymesh.errors import InputError, OptionError
from anymesh.loading.ktx2_ import open_ktx2
from anymesh.loading.references import ASIDE, SHOWN, Unresolved, readable, resolve_reference
from anymesh.types import Mesh, Texture

MAX_PIXELS = 16384**2
MIME_TYPES = {"PNG": "image/png", "JPEG": "image/jpeg"}
MODES = ("1", "L", "LA", "P", "PA", "RGB", "RGBA")  # that all readers of PNG and JPEG decode alike
KTX2 = b"\xabKTX 20"
OBJECT = re.compile(r"\s*<[^>]*>")  # Python's name of a stream in an error, with an address that differs between runs
ARCHIVE = ".zip"
FORMATS = tuple(READERS)
MAX_FACES = 20_000_000
MAX_BYTES = 4 * 1024**3
BEGIN = 100  # bytes of a file that an error may quote
LFS = b"version https://git-lfs.github.com/"
ADDRESS, SLASHES = re.compile(r"(?i)([a-z][a-z0-9+.-]+):/+(?=[^/])"), r"\1://"  # pathlib leaves one slash of two
ASCII_STL = re.compile(rb"(?is)(\xef\xbb\xbf)?\s*solid\b.{0,2000}facet")
SIGNS = {  # start of files of other formats
    "a GLB": rb"glTF",
    "a PLY": rb"ply\r?\n",
    "a DAE": rb"(?s).{0,2000}<COLLADA",
    "an OFF": rb"\s*(ST)?C?N?4?OFF",
    "JSON, as a .gltf": rb"(\xef\xbb\xbf)?\s*\{",
    "a PNG picture": rb"\x89PNG",
    "a JPEG picture": rb"\xff\xd8\xff",
    "a ZIP archive": rb"PK\x03\x04",
    "an FBX": rb"Kaydara FBX",
    "a Blender file": rb"BLENDER",
    "USD": rb"#usda |PXR-USDC",
    "an ASCII STL": ASCII_STL,
    "a web page": rb"(?i)\s*<(!doctype )?html",
    "an OBJ": rb"(?s)(.{0,2000}[\r\n])?v +[-.\d]+ +[-.\d]",
}
STARTS = {
    ".glb": rb"glTF", ".gltf": SIGNS["JSON, as a .gltf"], ".ply": rb"ply", ".off": SIGNS["an OFF"],
    ".dae": rb"(?s).{0,4088}<COLLADA",
    **dict.fromkeys((".usd", ".usda", ".usdc"), SIGNS["USD"]), ".usdz": rb"PK", ARCHIVE: rb"PK\x03\x04",
    **dict.fromkeys((".step", ".stp"), rb"\s*ISO-10303-21"), ".3mf": rb"PK", ".fbx": rb"(?s)Kaydara FBX|.{0,4088}FBXHeader",
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class FileMesh:
    """A mesh in the coordinates of its file, with the up axis (x, y or z) and the unit [m] that the file states."""

    mesh: Mesh
    up: str | None
    unit: float | None


class Folder:
    """The files around one mesh file, and the warnings from reading what the file refers to.

    root: the folder within which references may be read, by default the mesh's own; joints: whether joints are read.

    Raise OptionError if it is not a folder or the mesh is not inside it.
    """

    def __init__(self, path: Path, root: str | Path | None = None, joints: bool = True) -> None:
        self.path, self.joints = path, joints
        self.warnings: list[str] = []
        self.credits: dict[str, str] = {}  # what the file states of its licence and author
        self._digests: dict[str, str] = {}  # of the files that were read
        own = path.parent.resolve()
        self.root = own if root is None else _checked(Path(root), path, own)
        self._bases: tuple[Path, ...] = (own,)
        beside = [own.parent / name for name in ASIDE] if root is None else []
        self._aside = tuple(folder for folder in beside if folder.is_dir() and not folder.is_symlink())

    def beside(self, file: Path) -> Folder:
        """Return the same files, but with relative references starting from the folder of `file` first.

        This is used for references in a material library.
        """
        folder = copy.copy(self)  # caches and warnings are shared
        folder._bases = tuple(dict.fromkeys((file.parent, *self._bases)))
        return folder

    def find(self, uri: str) -> Path | None:
        """Return the file that a reference means; None if none may be read."""
        file = resolve_reference(uri, self._bases, self.root, self._aside)
        return None if isinstance(file, Unresolved) else file

    def read(self, uri: str) -> bytes:
        """Return the bytes of a file that the mesh requires. Raise InputError if it cannot be read."""
        content = self._bytes(uri)
        if isinstance(content, Unresolved):
            advice = resolve(ADVISE)("buffer", uri=readable(uri)[:SHOWN], reason=content.reason)
            raise InputError(f"{self.path.name} {advice}")
        return content

    def read_or_warn(self, uri: str, what: str) -> bytes | None:
        """Return the bytes of an optional file; None, with a warning, if it cannot be read. what: its role."""
        content = self._bytes(uri)
        if isinstance(content, Unresolved):
            self.warn(f"{what} {readable(uri)[:SHOWN]!r} left out: it {content.reason}")
            return None
        return content

    def _bytes(self, uri: str) -> bytes | Unresolved:
        file = resolve_reference(uri, self._bases, self.root, self._aside)
        if isinstance(file, Unresolved):
            return file
        try:
            data = file.read_bytes()
        except OSError as error:
            return Unresolved(f"cannot be opened ({error.strerror})")
        if data.startswith(LFS):
            return Unresolved(resolve(ADVISE)("lfs").removeprefix("it "))
        self._digests[os.path.relpath(file, self._bases[-1])] = hashlib.sha256(data).hexdigest()
        return data

    def warn(self, text: str) -> None:
        """Record a warning, once."""
        if text not in self.warnings:
            self.warnings.append(text)

    def take(self, other: Folder) -> None:
        """Take over what the same folder recorded in another process."""
        self.warnings[:], self.credits = other.warnings, other.credits
        self._digests.update(other._digests)

    def digest(self) -> str:
        """Return a digest that differs between loads of the same mesh file with other referenced contents or warnings."""
        contents = (sorted(self._digests.items()), self.warnings)
        return hashlib.sha256(json.dumps(contents).encode()).hexdigest()


def _checked(root: Path, path: Path, own: Path) -> Path:
    if not root.is_dir():
        raise OptionError(f"--root: found {str(root)!r}, which is not a folder; valid is the mesh's folder or one above it")
    resolved = root.resolve()
    if not own.is_relative_to(resolved):
        raise OptionError(f"--root: {path} does not lie within {str(root)!r}; valid is the mesh's folder or one above it")
    return resolved


def picture_file(folder: Folder, uri: str) -> Texture | None:
    """Return the texture in a named file; None, with a warning, if it cannot be read."""
    data = folder.read_or_warn(uri, "texture")
    return None if data is None else picture(folder, data, uri)


def picture(folder: Folder, data: bytes, name: str) -> Texture | None:
    """Return a texture of encoded bytes; None, with a warning, if they are broken.

    PNG and JPEG are kept unchanged, other formats, CMYK and grey of more than 8 bits are converted to PNG.
    """
    stem = PurePosixPath(readable(name).replace("\\", "/")).stem
    try:
        with quiet_decoder():
            image = open_ktx2(data, MAX_PIXELS) if data.startswith(KTX2) else Image.open(io.BytesIO(data))
        if image.width * image.height > MAX_PIXELS:
            raise ValueError(f"{image.width} x {image.height} pixels")
        image.load()
        if image.format in MIME_TYPES and image.mode in MODES:
            return Texture(data, MIME_TYPES[image.format], stem)
        if image.mode[0] in "IF":  # grey of 16 or 32 bits: 65535 or 1.0 is white
            grey = np.nan_to_num(np.asarray(image, np.float64)) * (255 if image.mode == "F" else 1 / 257)
            image = Image.fromarray(np.clip(np.rint(grey), 0, 255).astype(np.uint8))
        buffer = io.BytesIO()
        image.convert("RGBA" if image.has_transparency_data else "RGB").save(buffer, "PNG")
    except Exception as error:  # decoders raise many types of errors for broken pictures
        warn_unreadable(folder, name, error)
        return None
    return Texture(buffer.getvalue(), "image/png", stem)


def warn_unreadable(folder: Folder, name: str, error: Exception) -> None:
    """Warn of an existing texture that cannot be read."""
    reason = f"{type(error).__name__}: {OBJECT.sub('', str(error))}"[:100]
    folder.warn(f"texture {readable(name)[:SHOWN]!r} left out: it cannot be read ({reason})")


@contextmanager
def quiet_decoder() -> Generator[None]:
    """Suppress the decoder's warning about large pictures, which are limited by MAX_PIXELS."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        yield


def check_file(path: Path, formats: Sequence[str] = FORMATS) -> bytes:
    """Return the bytes of the file if they are plausible for its format. Raise InputError otherwise."""
    if not path.exists():
        if ADDRESS.match(str(path)):
            raise InputError(f"{ADDRESS.sub(SLASHES, str(path))}: {resolve(ADVISE)('url')}")
        raise InputError(f"found no file {path}")
    if not path.is_file():
        raise InputError(f"{path}: {resolve(ADVISE)('folder')}")
    suffix = path.suffix.lower()
    if suffix not in formats:
        remedy = resolve(REMEDY)(suffix) or f"valid are {', '.join(formats)}"
        raise InputError(f"{path.name}: found the format {suffix or '(none)'}; {remedy}")
    size = path.stat().st_size
    if size == 0:
        raise InputError(f"{path.name} is empty (0 bytes); valid is a file with at least one triangle")
    if size > MAX_BYTES:
        raise InputError(f"{path.name} has {size} bytes; at most {MAX_BYTES} are read")
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path.name} cannot be opened: {error.strerror}") from None
    if data.startswith(LFS):
        raise InputError(f"{path.name}: {resolve(ADVISE)('lfs')}")
    if not _plausible(suffix, data):
        kind = next((kind for kind, sign in SIGNS.items() if re.match(sign, data)), "")
        raise InputError(f"{path.name}: {resolve(ADVISE_ON_CONTENT)(suffix, kind, data[:BEGIN])}")
    return data


def _plausible(suffix: str, data: bytes) -> bool:
    if suffix in STARTS:
        return re.match(STARTS[suffix], data) is not None
    if suffix == ".stl":
        return ASCII_STL.match(data) is not None or is_binary_stl(data)
    return b"\0" not in data[:4096] and re.search(rb"(^|[\r\n])[ \t]*(v|f|o|g|mtllib|usemtl)\s", data) is not None


def is_binary_stl(data: bytes) -> bool:
    """Return whether bytes that are no ASCII STL could be a binary one, complete or truncated."""
    if len(data) < 84:
        return data[:5].lower() == b"solid" or b"\0" in data
    count = struct.unpack_from("<I", data, 80)[0]
    known = any(re.match(sign, data) for kind, sign in SIGNS.items() if "STL" not in kind)
    return len(data) >= 84 + 50 * count or (b"\0" in data and not known)
