"""Plain folders: `frames.json` (this project's layout) and `transforms.json` (nerfstudio, instant-ngp)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from anymesh.applications.scan.frames import Frames, RgbdFrame
from anymesh.applications.scan.pictures import file_reader, picture_size, read_object, within
from anymesh.applications.scan.poses import AXES, check_distortion, fitted, pinhole, pose
from anymesh.errors import InputError

OURS = "frames.json"
NERFSTUDIO = "transforms.json"
MILLIMETRES = 0.001
KEYS = ("fx", "fy", "cx", "cy", "width", "height")
NERF_KEYS = ("fl_x", "fl_y", "cx", "cy", "w", "h")
PERSPECTIVE = ("OPENCV", "PINHOLE", "SIMPLE_PINHOLE", "PERSPECTIVE")
UPS = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


def read_frames_json(folder: Path, depth_scale: float | None, scale: float | None) -> Frames:
    """Read this project's layout.

    Its keys are `camera`, `camera_axes`, `depth_scale` and `frames` of color, depth, mask, confidence, T_world_camera.
    """
    record = read_object(folder / OURS)
    axes, unit = record.get("camera_axes", "opencv"), depth_scale or float(record.get("depth_scale", MILLIMETRES))
    if axes not in AXES:
        raise InputError(f"{folder / OURS}: camera_axes {axes!r}; valid are {', '.join(AXES)}")
    frames = []
    for number, entry in enumerate(_entries(record, folder / OURS)):
        name = str(entry.get("name", number))
        color = within(folder, entry.get("color"))
        camera = pinhole({**record.get("camera", {}), **entry.get("camera", {})}, KEYS, f"frame {name} in {OURS}")
        T = pose(entry.get("T_world_camera"), name, axes=axes, scale=scale or 1.0)
        depth, mask, sure = (within(folder, entry[k]) if k in entry else None for k in ("depth", "mask", "confidence"))
        reader = file_reader(color, depth, unit, mask, sure)
        frames.append((RgbdFrame(name, fitted(camera, picture_size(color), name), T, reader), depth))
    return _frames(frames, OURS, UPS.get(str(record.get("up", ""))), [])


def read_transforms_json(folder: Path, depth_scale: float | None, scale: float | None) -> Frames:
    """Read nerfstudio's layout: camera-to-world, OpenGL axes, depth in millimetres unless `depth_unit_scale_factor` is set."""
    record = read_object(folder / NERFSTUDIO)
    model = str(record.get("camera_model", "OPENCV")).upper()
    if model not in PERSPECTIVE:
        raise InputError(f"{folder / NERFSTUDIO}: camera_model {model}; valid are {', '.join(PERSPECTIVE)}")
    unit = depth_scale or float(record.get("depth_unit_scale_factor", MILLIMETRES))
    warnings, frames = set(), []
    for number, entry in enumerate(_entries(record, folder / NERFSTUDIO)):
        name = str(entry.get("file_path", number))
        color = within(folder, _with_suffix(folder, name))
        both = _intrinsics({**record, **entry}, picture_size(color))
        camera = pinhole(both, NERF_KEYS, f"frame {name} in {NERFSTUDIO}")
        warnings.add(check_distortion(camera, [float(both.get(f"k{n}", 0.0)) for n in (1, 2, 3)], NERFSTUDIO))
        T = pose(entry.get("transform_matrix"), name, axes="opengl", scale=scale or 1.0)
        depth, mask = (within(folder, entry[k]) if entry.get(k) else None for k in ("depth_file_path", "mask_path"))
        reader = file_reader(color, depth, unit, mask)
        frames.append((RgbdFrame(name, fitted(camera, picture_size(color), name), T, reader), depth))
    if "applied_scale" in record and scale is None:
        warnings.add(
            f"{NERFSTUDIO} was rescaled by {record['applied_scale']}; "
            f"--scale {1 / float(record['applied_scale']):.6g} undoes it"
        )
    return _frames(frames, NERFSTUDIO, UPS["z"], sorted(warnings - {""}))


def _entries(record: dict[str, Any], path: Path) -> list[dict[str, Any]]:
    entries = record.get("frames")
    if not isinstance(entries, list) or not entries or not all(isinstance(f, dict) for f in entries):
        raise InputError(f"{path}: `frames` must be a list of one or more objects, found {str(entries)[:80]}")
    return entries


def _with_suffix(folder: Path, name: str) -> str:
    """Add the suffix of pictures, which Blender's layout omits."""
    return name if Path(name).suffix or (folder / name).is_file() else f"{name}.png"


def _intrinsics(stated: dict[str, Any], size: tuple[int, int]) -> dict[str, Any]:
    """Add values that the format allows to omit: size, principal point, and focal lengths from the field of view."""
    intrinsics = {"w": size[0], "h": size[1], **stated}
    intrinsics = {"cx": intrinsics["w"] / 2, "cy": intrinsics["h"] / 2, **intrinsics}
    for key, angle, side in (("fl_x", "camera_angle_x", "w"), ("fl_y", "camera_angle_y", "h")):
        if key not in intrinsics and angle in intrinsics:
            intrinsics[key] = intrinsics[side] / (2 * np.tan(float(intrinsics[angle]) / 2))
    if "fl_x" in intrinsics:
        intrinsics.setdefault("fl_y", intrinsics["fl_x"])
    return intrinsics


def _frames(
    frames: list[tuple[RgbdFrame, Path | None]], layout: str, up: tuple[float, float, float] | None, warnings: list[str]
) -> Frames:
    """Return a recording; frames without depth are dropped if others have depth."""
    deep = [frame for frame, depth in frames if depth is not None]
    if deep and len(deep) < len(frames):
        warnings.append(f"{len(frames) - len(deep)} of {len(frames)} frames have no depth and are left out")
    return Frames(tuple(deep or [frame for frame, _ in frames]), layout, bool(deep), up, tuple(warnings))
