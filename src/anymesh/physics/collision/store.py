"""Cache of decompositions by content: each surface is decomposed once, as that is the slow step of an export."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from anymesh.types import Box, Cylinder, Hull, Shape

VERSION = b"9"  # change it if the same surface would give other shapes


def content_key(*values: np.ndarray | float | int) -> str:
    """Return a key over arrays and numbers."""
    digest = hashlib.sha256(VERSION)
    for value in values:
        digest.update(np.ascontiguousarray(value, np.float64).tobytes())
    return digest.hexdigest()


def load_shapes(folder: Path | None, key: str) -> tuple[Shape, ...] | None:
    """Return the shapes stored under a key; None if there are none, or the file is incomplete."""
    if folder is None:
        return None
    try:
        with np.load(folder / f"{key}.npz", allow_pickle=False) as archive:
            return tuple(
                _shape([archive[f"{k}_{n}"] for n in range(int(archive["arrays"][k]))]) for k in range(len(archive["arrays"]))
            )
    except (OSError, ValueError, KeyError, EOFError, BadZipFile):
        return None


def save_shapes(folder: Path | None, key: str, shapes: tuple[Shape, ...]) -> None:
    """Store shapes under a key; a folder that cannot be written is ignored."""
    if folder is None:
        return
    rows = [_arrays(shape) for shape in shapes]
    named = {f"{k}_{n}": array for k, some in enumerate(rows) for n, array in enumerate(some)}
    own = folder / f"{key}.{os.getpid()}.tmp.npz"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        np.savez(own, arrays=np.array([len(some) for some in rows], np.int64), **named)  # ty: ignore[invalid-argument-type]
        own.replace(folder / f"{key}.npz")
    except OSError:
        return


def _arrays(shape: Shape) -> list[np.ndarray]:
    match shape:
        case Hull():
            return [shape.vertices, shape.faces]
        case Box():
            return [shape.center, shape.rotation, shape.size]
        case Cylinder():
            return [shape.center, shape.rotation, np.array(shape.radius), np.array(shape.length)]


def _shape(arrays: list[np.ndarray]) -> Shape:
    match arrays:
        case [vertices, faces]:
            return Hull(vertices, faces)
        case [center, rotation, size]:
            return Box(center, rotation, size)
        case [center, rotation, radius, length]:
            return Cylinder(center, rotation, float(radius), float(length))
        case _:
            raise ValueError(f"a shape is kept in 2 to 4 arrays, found {len(arrays)}")
