"""Camera poses read from files, validated and converted to one convention: camera to world, OpenCV axes, metres."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.applications.scan.frames import FLIPPED, Pinhole
from anymesh.errors import InputError

STRAIGHT = 1e-2  # largest deviation of a rotation's columns from unit length and orthogonality
AXES = ("opencv", "opengl")
PIXELS_OFF = 2.0  # [px] largest lens distortion at a corner that may be ignored


def pose(matrix: object, name: str, *, axes: str = "opencv", scale: float = 1.0) -> Float[np.ndarray, "4 4"]:
    """Return T_world_camera from a 4x4 or 3x4 matrix in a file, orthonormalized, its translation times `scale` [m].

    axes: opencv (x right, y down, z ahead) or opengl (x right, y up, z back). Raise InputError if the matrix is not rigid.
    """
    try:
        T = np.array(matrix, np.float64)
    except (TypeError, ValueError):
        T = np.zeros(0)
    if T.shape == (3, 4):
        T = np.vstack([T, [0, 0, 0, 1.0]])
    if T.shape != (4, 4) or not np.isfinite(T).all():
        raise InputError(f"frame {name}: a pose is 4 x 4 (or 3 x 4) finite numbers, found {_shown(matrix)}")
    if not np.allclose(T[3], [0, 0, 0, 1], atol=1e-6):
        hint = "; it looks transposed (the translation is in the last row)" if np.allclose(T[:3, 3], 0, atol=1e-9) else ""
        raise InputError(f"frame {name}: the last row of a pose is 0 0 0 1, found {_row(T[3])}{hint}")
    R = T[:3, :3]
    off = float(np.abs(R.T @ R - np.eye(3)).max())
    if off > STRAIGHT:
        size = float(np.cbrt(abs(np.linalg.det(R))))
        scaled = np.allclose(R.T @ R, size * size * np.eye(3), atol=STRAIGHT * size * size)
        why = f"it is scaled by {size:.4g}; a scale belongs to the translation (--scale)" if scaled else "it is sheared"
        raise InputError(f"frame {name}: the rotation of a pose must be orthonormal, this is off by {off:.3g}: {why}")
    if np.linalg.det(R) < 0:
        raise InputError(f"frame {name}: the rotation of a pose mirrors (determinant -1); one axis is flipped")
    u, _, v = np.linalg.svd(R)
    T[:3, :3] = u @ v
    T[:3, 3] *= scale
    if axes not in AXES:
        raise InputError(f"camera axes {axes!r}; valid are {' and '.join(AXES)}")
    return T @ FLIPPED if axes == "opengl" else T


def quaternion_pose(xyzw: Sequence[float], at: Sequence[float], name: str) -> Float[np.ndarray, "4 4"]:
    """Return the transform of a quaternion (x, y, z, w) and a translation. Raise InputError for a zero quaternion."""
    q = np.asarray(xyzw, np.float64)
    length = float(np.linalg.norm(q))
    if q.shape != (4,) or not np.isfinite(length) or abs(length - 1) > STRAIGHT:
        raise InputError(f"frame {name}: a quaternion has length 1, found {_row(q)} of length {length:.4g}")
    x, y, z, w = q / length
    T = np.eye(4)
    T[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    T[:3, 3] = at
    return T


def pinhole(intrinsics: dict[str, Any], keys: Sequence[str], name: str) -> Pinhole:
    """Return the camera with fx, fy, cx, cy, width and height under `keys`. Raise InputError that names missing ones."""
    missing = [
        key for key in keys if not isinstance(intrinsics.get(key), (int, float)) or isinstance(intrinsics.get(key), bool)
    ]
    if missing:
        raise InputError(f"{name}: intrinsics are missing: {', '.join(missing)}; needed are {', '.join(keys)} [px]")
    fx, fy, cx, cy, width, height = (float(intrinsics[key]) for key in keys)
    try:
        return Pinhole(fx, fy, cx, cy, int(width), int(height))
    except ValueError as error:
        raise InputError(f"{name}: {error}") from None


def _row(values: np.ndarray) -> str:
    return " ".join(f"{v:.4g}" for v in np.ravel(values))


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) < 80 else f"{text[:77]}..."


def fitted(camera: Pinhole, size: tuple[int, int], name: str) -> Pinhole:
    """Scale the camera to a picture of `size` (width, height). Raise InputError if more than the resolution differs."""
    if size == (camera.width, camera.height):
        return camera
    try:
        return camera.resized(*size)
    except ValueError:
        raise InputError(
            f"frame {name}: the picture has {size[0]} x {size[1]} pixels, its intrinsics are for {camera.width} x "
            f"{camera.height}; other proportions mean a crop or a rotation that the intrinsics do not include"
        ) from None


def check_distortion(camera: Pinhole, k: Sequence[float], name: str) -> str:
    """Return a warning about ignored radial distortion k1, k2, ...; empty if it is less than half a pixel.

    Raise InputError if it moves a corner by more than PIXELS_OFF pixels.
    """
    corner = max(camera.cx, camera.width - camera.cx) / camera.fx, max(camera.cy, camera.height - camera.cy) / camera.fy
    r2 = corner[0] ** 2 + corner[1] ** 2
    shift = abs(sum(c * r2 ** (n + 1) for n, c in enumerate(k))) * float(np.sqrt(r2)) * camera.fx
    if shift > PIXELS_OFF:
        raise InputError(
            f"{name}: lens distortion moves the corners by {shift:.0f} pixels; undistort first (`colmap image_undistorter`, "
            "or an export with corrected images): at most 2 pixels can be left out"
        )
    return f"{name}: lens distortion of {shift:.1f} pixels at the corners is left out" if shift > 0.5 else ""
