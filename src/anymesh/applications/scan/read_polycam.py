"""Polycam's raw data export: keyframes/ with images, cameras, depth (16-bit, millimetres) and confidence."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from anymesh.applications.scan.frames import Frames, RgbdFrame
from anymesh.applications.scan.pictures import file_reader, picture_size, read_object
from anymesh.applications.scan.poses import fitted, pinhole, pose
from anymesh.errors import InputError

KEYS = ("fx", "fy", "cx", "cy", "width", "height")
ENTRIES = [[f"t_{row}{column}" for column in range(4)] for row in range(3)]
MILLIMETRES = 0.001


def keyframes(folder: Path) -> Path | None:
    """Return the folder `keyframes` of an export, None if there is none."""
    for place in (folder / "keyframes", folder):
        if any((place / name).is_dir() for name in ("cameras", "corrected_cameras")):
            return place
    return None


def read_polycam(folder: Path, depth_scale: float | None, scale: float | None) -> Frames:
    """Read an export, with optimized cameras and undistorted images if present. ARKit: OpenGL axes, y is up."""
    home = keyframes(folder)
    if home is None:
        raise InputError(f"{folder}: found no keyframes/cameras; Polycam exports it as raw data (developer mode)")
    corrected = (home / "corrected_cameras").is_dir() and (home / "corrected_images").is_dir()
    cameras, images = (home / f"{'corrected_' if corrected else ''}{name}" for name in ("cameras", "images"))
    frames, deep = [], []
    for path in sorted(cameras.glob("*.json")):
        record, name = read_object(path), path.stem
        color = next((p for s in (".jpg", ".jpeg", ".png") if (p := images / f"{name}{s}").is_file()), None)
        if color is None:
            raise InputError(f"{images}: the picture {name}.jpg, which {path.name} describes, is missing")
        camera = pinhole(record, KEYS, str(path))
        missing = [key for row in ENTRIES for key in row if key not in record]
        if missing:
            raise InputError(f"{path}: the pose is missing: {', '.join(missing)}")
        T = pose(np.array([[record[key] for key in row] for row in ENTRIES]), name, axes="opengl", scale=scale or 1.0)
        depth, sure = (p if (p := home / kind / f"{name}.png").is_file() else None for kind in ("depth", "confidence"))
        reader = file_reader(color, depth, depth_scale or MILLIMETRES, sure)
        frames.append(RgbdFrame(name, fitted(camera, picture_size(color), name), T, reader))
        deep.append(depth is not None)
    kept = tuple(frame for frame, d in zip(frames, deep, strict=True) if d or not any(deep))
    warnings = [] if corrected else ["found no corrected_cameras: poses are those of ARKit, which drift"]
    if len(kept) < len(frames):
        warnings.append(f"{len(frames) - len(kept)} of {len(frames)} frames have no depth and are left out")
    return Frames(kept, "Polycam", any(deep), (0.0, 1.0, 0.0), tuple(warnings))
