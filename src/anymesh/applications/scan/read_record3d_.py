"""Record3D recordings: an `.r3d` file, or the folder that it unpacks to."""

from __future__ import annotations

import importlib
import json
import re
import zipfile
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.applications.scan.frames import FLIPPED, Frames, Observation, Pinhole, RgbdFrame, quaternion_pose
from anymesh.applications.scan.pictures import clean_depth, observed, read_color
from anymesh.errors import InputError, MissingExtraError, pip_install

METADATA = ("metadata", "metadata.json")
MOST_BYTES = 1 << 28  # [bytes] limit of one file in the archive


def is_record3d(path: Path) -> bool:
    """Return whether a folder or file holds a recording of Record3D."""
    if path.is_file():
        return path.suffix.lower() in (".r3d", ".zip")
    return (path / "rgbd").is_dir() and any((path / name).is_file() for name in METADATA)


def read_record3d(path: Path, depth_scale: float | None, scale: float | None) -> Frames:
    """Read a recording: poses are camera-to-world with OpenGL axes (ARKit), depth is float32 in metres, y is up."""
    home = _Home(path)
    names = home.names()
    metadata = _metadata(home, names)
    numbers = sorted(int(m[1]) for name in names if (m := re.fullmatch(r"rgbd/(\d+)\.(?:jpg|png)", name)))
    if not numbers:
        raise InputError(f"{path}: found no rgbd/NUMBER.jpg; an export as .r3d has them")
    stated = metadata.get("poses")
    poses = stated if isinstance(stated, list) else []
    if len(poses) <= max(numbers):
        raise InputError(f"{path}: metadata has {len(poses)} poses for pictures up to number {max(numbers)}")
    factor = depth_scale or 1.0
    frames = []
    for n in numbers:
        row = [float(v) for v in poses[n]]
        T = quaternion_pose(row[:4], [v * (scale or 1.0) for v in row[4:7]], str(n)) @ FLIPPED
        frame = RgbdFrame(str(n), _camera(metadata, n, path), T, _reader(home, names, n, metadata, factor))
        frames.append((frame, f"rgbd/{n}.depth" in names))
    return Frames.read(frames, "Record3D", (0.0, 1.0, 0.0))


def unpack(data: bytes, name: str) -> bytes:
    """Decompress bytes. Raise InputError if they are damaged, MissingExtraError if the library is not installed."""
    try:
        lzfse: Any = importlib.import_module("lzfse")  # a compiled module without types
    except ImportError:
        raise MissingExtraError(
            f"depth of Record3D is compressed with LZFSE; {pip_install('scan')} brings what reads it"
        ) from None
    try:
        return lzfse.decompress(data)
    except lzfse.error as error:
        raise InputError(f"{name} is not LZFSE data: {error}") from None


def pack(data: bytes) -> bytes:
    """Compress bytes, for writing recordings."""
    lzfse: Any = importlib.import_module("lzfse")
    return lzfse.compress(data)


@dataclass(frozen=True)
class _Home:
    """Access to the files of a recording, in a folder or an archive."""

    path: Path

    def names(self) -> set[str]:
        if self.path.is_dir():
            return {p.relative_to(self.path).as_posix() for p in self.path.rglob("*") if p.is_file()}
        with _opened(self.path) as archive:
            return set(archive.namelist())

    def content(self, name: str) -> bytes:
        if self.path.is_dir():
            return (self.path / name).read_bytes()
        with _opened(self.path) as archive:
            if archive.getinfo(name).file_size > MOST_BYTES:
                raise InputError(f"{self.path}: {name} would unpack to more than {MOST_BYTES >> 20} MB")
            return archive.read(name)


def _opened(path: Path) -> zipfile.ZipFile:
    try:
        return zipfile.ZipFile(path)
    except (OSError, zipfile.BadZipFile) as error:
        raise InputError(f"{path} is not an archive of Record3D: {error}") from None


def _metadata(home: _Home, names: set[str]) -> dict[str, Any]:
    name = next((m for m in METADATA if m in names), None)
    if name is None:
        raise InputError(f"{home.path}: found no {' or '.join(METADATA)}; a recording of Record3D (.r3d) has one")
    try:
        metadata = json.loads(home.content(name))
    except ValueError as error:
        raise InputError(f"{home.path}: {name} cannot be read as JSON: {error}") from None
    if not isinstance(metadata, dict):
        raise InputError(f"{home.path}: {name} must hold a JSON object, found {type(metadata).__name__}")
    return metadata


def _camera(metadata: dict[str, Any], number: int, path: Path) -> Pinhole:
    """Return the camera of a frame from perFrameIntrinsicCoeffs (fx, fy, cx, cy) if present, else from K, stored by columns."""
    with suppress(KeyError, IndexError, TypeError, ValueError):
        size = int(metadata["w"]), int(metadata["h"])
        each = metadata.get("perFrameIntrinsicCoeffs")
        if each:
            fx, fy, cx, cy = (float(v) for v in each[number])
        else:
            K = np.array(metadata["K"], float).reshape(3, 3).T
            fx, fy, cx, cy = K[0, 0], K[1, 1], K[0, 2], K[1, 2]
        return Pinhole(float(fx), float(fy), float(cx), float(cy), *size)
    raise InputError(
        f"{path}: intrinsics are missing: metadata needs w, h and K (9 numbers) or perFrameIntrinsicCoeffs (4 per frame)"
    )


def _reader(home: _Home, names: set[str], n: int, metadata: dict[str, Any], factor: float) -> Callable[[], Observation]:
    def read() -> Observation:
        picture = next(f"rgbd/{n}{s}" for s in (".jpg", ".png") if f"rgbd/{n}{s}" in names)
        color = read_color(home.content(picture), picture)
        if f"rgbd/{n}.depth" not in names:
            return observed(color, np.zeros((1, 1), np.float32))
        raw = unpack(home.content(f"rgbd/{n}.depth"), f"rgbd/{n}.depth")
        flat = np.frombuffer(raw[: len(raw) // 4 * 4], "<f4")
        depth = clean_depth(flat.reshape(_size(metadata, flat.size, home.path)), f"{n}.depth", factor)
        sure = None
        if f"rgbd/{n}.conf" in names:
            values = np.frombuffer(unpack(home.content(f"rgbd/{n}.conf"), f"rgbd/{n}.conf"), np.uint8)
            sure = values.reshape(depth.shape) > 0 if values.size == depth.size else None
        return observed(color, depth, sure)

    return read


def _size(metadata: dict[str, Any], count: int, path: Path) -> tuple[int, int]:
    """Return rows and columns of a depth map, as stated or, in older recordings, from the picture's proportions."""
    if {"dw", "dh"} <= set(metadata):
        rows, columns = int(metadata["dh"]), int(metadata["dw"])
    else:
        rows = round(float(np.sqrt(count * metadata["h"] / metadata["w"])))
        columns = count // max(rows, 1)
    if rows * columns != count:
        raise InputError(f"{path}: a depth map holds {count} values, metadata states {columns} x {rows}")
    return rows, columns
