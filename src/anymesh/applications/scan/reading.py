"""Detection of a recording's layout, and reading of its frames."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from anymesh.applications.scan.frames import AXES, Frames, RgbdFrame, check_distortion, fitted, pinhole, pose
from anymesh.applications.scan.pictures import file_reader, picture_size, read_object, within
from anymesh.applications.scan.read_colmap import model_folder, read_colmap
from anymesh.applications.scan.read_record3d_ import is_record3d, read_record3d
from anymesh.errors import InputError

ENTRIES = [[f"t_{row}{column}" for column in range(4)] for row in range(3)]
OURS = "frames.json"
NERFSTUDIO = "transforms.json"
MILLIMETRES = 0.001
KEYS = ("fx", "fy", "cx", "cy", "width", "height")
NERF_KEYS = ("fl_x", "fl_y", "cx", "cy", "w", "h")
PERSPECTIVE = ("OPENCV", "PINHOLE", "SIMPLE_PINHOLE", "PERSPECTIVE")
UPS = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
FEWEST = 3  # minimum number of frames to fuse


def read_frames(path: Path, *, depth_scale: float | None = None, scale: float | None = None) -> Frames:
    """Read the frames of a recording in any supported layout.

    depth_scale: metres per unit of the depth maps (None: the layout's own); scale: metres per unit of the poses.
    Raise InputError if no layout is recognized, files are missing, or intrinsics or poses are wrong; OptionError for a COLMAP
    model without a scale.
    """
    path = Path(path)
    if not path.exists():
        raise InputError(f"{path} does not exist; a folder of frames or an .r3d file is expected")
    try:
        frames = _read(path, depth_scale, scale)
    except (TypeError, ValueError, LookupError, ArithmeticError, AttributeError, RecursionError, OSError) as error:
        cause = " ".join(f"{type(error).__name__}: {error}".split())[:200]
        raise InputError(f"{path}: the description of the recording is broken ({cause})") from None
    if len(frames) < FEWEST:
        raise InputError(f"{path}: found {len(frames)} usable frames; a surface needs {FEWEST} or more from different sides")
    return frames


def _read(path: Path, depth_scale: float | None, scale: float | None) -> Frames:
    if (path / OURS).is_file():
        return read_frames_json(path, depth_scale, scale)
    if (path / NERFSTUDIO).is_file():
        return read_transforms_json(path, depth_scale, scale)
    if is_record3d(path):
        return read_record3d(path, depth_scale, scale)
    if path.is_dir() and keyframes(path) is not None:
        return read_polycam(path, depth_scale, scale)
    if path.is_dir() and model_folder(path) is not None:
        return read_colmap(path, depth_scale, scale)
    raise InputError(
        f"{path} holds no recording that is known; valid are a folder with {OURS}, {NERFSTUDIO} (nerfstudio), "
        "keyframes/ (Polycam's raw data), sparse/ (COLMAP), or metadata and rgbd/ (Record3D), or an .r3d file"
    )


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
        frames.append((RgbdFrame(name, fitted(camera, picture_size(color), name), T, reader), depth is not None))
    return Frames.read(frames, OURS, UPS.get(str(record.get("up", ""))))


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
        frames.append((RgbdFrame(name, fitted(camera, picture_size(color), name), T, reader), depth is not None))
    if "applied_scale" in record and scale is None:
        warnings.add(
            f"{NERFSTUDIO} was rescaled by {record['applied_scale']}; "
            f"--scale {1 / float(record['applied_scale']):.6g} undoes it"
        )
    return Frames.read(frames, NERFSTUDIO, UPS["z"], *sorted(warnings - {""}))


def keyframes(folder: Path) -> Path | None:
    """Return the folder `keyframes` of an export, None if there is none."""
    for place in (folder / "keyframes", folder):
        if any((place / name).is_dir() for name in ("cameras", "corrected_cameras")):
            return place
    return None


def read_polycam(folder: Path, depth_scale: float | None, scale: float | None) -> Frames:
    """Read Polycam's raw data export, with optimized cameras and undistorted images if present. ARKit: OpenGL axes, y is up."""
    home = keyframes(folder)
    if home is None:
        raise InputError(f"{folder}: found no keyframes/cameras; Polycam exports it as raw data (developer mode)")
    corrected = (home / "corrected_cameras").is_dir() and (home / "corrected_images").is_dir()
    cameras, images = (home / f"{'corrected_' if corrected else ''}{name}" for name in ("cameras", "images"))
    frames = []
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
        frames.append((RgbdFrame(name, fitted(camera, picture_size(color), name), T, reader), depth is not None))
    warnings = [] if corrected else ["found no corrected_cameras: poses are those of ARKit, which drift"]
    return Frames.read(frames, "Polycam", UPS["y"], *warnings)


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
