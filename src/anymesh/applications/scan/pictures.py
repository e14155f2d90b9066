"""Reading of colour pictures, depth maps and masks with Pillow."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Bool, Float32, UInt8

from anymesh.applications.scan.frames import Observation
from anymesh.errors import InputError

CONFIDENT = 1  # lowest confidence at which depth is used; 0 means "low" in every supported layout


def read_object(path: Path) -> dict[str, Any]:
    """Read a JSON object. Raise InputError if the file is missing or holds anything else."""
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise InputError(f"{path} is missing") from None
    except (OSError, ValueError) as error:
        raise InputError(f"{path} cannot be read as JSON: {error}") from None
    if not isinstance(record, dict):
        raise InputError(f"{path} must hold a JSON object, found {type(record).__name__}")
    return record


def within(folder: Path, name: object) -> Path:
    """Return the path of a file named in a recording's description. Raise InputError if it is missing or outside the folder."""
    if not isinstance(name, str) or not name:
        raise InputError(f"{folder}: a file name was expected, found {name!r}")
    path = (folder / name).resolve()
    if not path.is_relative_to(folder.resolve()):
        raise InputError(f"{folder}: {name} lies outside the recording's folder")
    if not path.is_file():
        raise InputError(f"{folder}: the file {name}, which the recording names, is missing")
    return path


@contextmanager
def _opened(source: Path | io.BytesIO, name: object) -> Generator[Any]:
    """Open a picture with Pillow. Raise InputError if it cannot be decoded."""
    from PIL import Image

    try:
        with Image.open(source) as image:
            yield image
    except (OSError, SyntaxError, Image.DecompressionBombError) as error:
        raise InputError(f"{name} is not a readable picture: {error}") from None


def picture_size(path: Path) -> tuple[int, int]:
    """Return width and height [px] from the file's header. Raise InputError if the file is no picture."""
    with _opened(path, path) as image:
        return image.size


def read_color(source: Path | bytes, name: str) -> UInt8[np.ndarray, "H W 3"]:
    """Read a picture as sRGB bytes. Raise InputError if it cannot be decoded."""
    with _opened(source if isinstance(source, Path) else io.BytesIO(source), name) as image:
        return np.asarray(image.convert("RGB"))


def read_depth(path: Path, scale: float) -> Float32[np.ndarray, "h w"]:
    """Read a depth map [m] from a 16-bit PNG (units of `scale` metres) or a .npy file of floats; 0 where there is no depth."""
    if path.suffix == ".npy":
        try:
            return clean_depth(np.load(path, allow_pickle=False), path.name, scale)
        except (OSError, ValueError) as error:
            raise InputError(f"{path} cannot be read as a depth map: {error}") from None
    with _opened(path, path) as image:
        if image.mode not in ("I;16", "I;16B", "I", "F"):
            raise InputError(f"{path}: depth must be a picture of 16 bits and one channel, found mode {image.mode}")
        return clean_depth(np.asarray(image), path.name, scale)


def clean_depth(raw: np.ndarray, name: str, scale: float = 1.0) -> Float32[np.ndarray, "h w"]:
    """Return raw values times `scale` [m], 0 where not positive and finite. Raise InputError unless they have one channel."""
    raw = raw[..., 0] if raw.ndim == 3 and raw.shape[2] == 1 else raw
    if raw.ndim != 2 or raw.size == 0 or raw.dtype.kind not in "iuf":
        raise InputError(f"{name}: a depth map of one channel was expected, found {raw.shape} of {raw.dtype}")
    depth = raw.astype(np.float32) * np.float32(scale)
    return np.where(np.isfinite(depth) & (depth > 0), depth, np.float32(0))


def read_mask(path: Path | None) -> Bool[np.ndarray, "h w"] | None:
    """Return where a mask or confidence map is not 0; None without a file."""
    if path is None:
        return None
    with _opened(path, path) as image:
        pixels = np.asarray(image)
    return (pixels if pixels.ndim == 2 else pixels.max(2)) >= CONFIDENT


def observed(color: np.ndarray, depth: np.ndarray, *masks: np.ndarray | None) -> Observation:
    """Return an observation with depth where all masks allow it; masks of other sizes are scaled to that of the depth map."""
    kept = depth
    for mask in masks:
        if mask is not None:
            rows = np.arange(depth.shape[0]) * mask.shape[0] // depth.shape[0]
            columns = np.arange(depth.shape[1]) * mask.shape[1] // depth.shape[1]
            kept = np.where(mask[rows[:, None], columns], kept, np.float32(0))
    return Observation(color, np.ascontiguousarray(kept, np.float32))


def file_reader(color: Path, depth: Path | None, scale: float, *masks: Path | None) -> Callable[[], Observation]:
    """Return a function that reads an observation from files; without a depth file, its depth map is a single 0."""

    def read() -> Observation:
        depth_map = np.zeros((1, 1), np.float32) if depth is None else read_depth(depth, scale)
        return observed(read_color(color, color.name), depth_map, *(read_mask(m) for m in masks))

    return read
