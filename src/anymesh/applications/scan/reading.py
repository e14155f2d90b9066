"""Detection of a recording's layout, and reading of its frames."""

from __future__ import annotations

from pathlib import Path

from anymesh.applications.scan.frames import Frames
from anymesh.applications.scan.read_colmap import model_folder, read_colmap
from anymesh.applications.scan.read_folder import NERFSTUDIO, OURS, read_frames_json, read_transforms_json
from anymesh.applications.scan.read_polycam import keyframes, read_polycam
from anymesh.applications.scan.read_record3d import is_record3d, read_record3d
from anymesh.errors import InputError

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
