"""Posed pictures with depth: the common representation of all recording layouts.

Poses from files are validated and converted to one convention: camera to world, OpenCV axes, metres.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from jaxtyping import Float, Float32, Float64, Int, UInt8

from anymesh.errors import InputError
from anymesh.types import Brief

ASPECT = 0.02  # largest relative difference of aspect ratio between depth map and picture; above, they show different sections
FLIPPED = np.diag([1.0, -1.0, -1.0, 1.0])  # OpenGL camera axes (y up, z back) to OpenCV ones (y down, z ahead), and back
STRAIGHT = 1e-2  # largest deviation of a rotation's columns from unit length and orthogonality
AXES = ("opencv", "opengl")
PIXELS_OFF = 2.0  # [px] largest lens distortion at a corner that may be ignored


@dataclass(frozen=True)
class Pinhole:
    """Pinhole camera without distortion.

    All values are in pixels; (0, 0) is the outer corner of the first pixel, pixel centres are at .5.
    """

    fx: float
    fy: float
    cx: float
    cy: float
    width: int
    height: int

    def __post_init__(self) -> None:
        if not (self.fx > 0 and self.fy > 0 and self.width > 0 and self.height > 0 and np.isfinite([self.cx, self.cy]).all()):
            raise ValueError(f"a camera needs focal lengths and a size above 0, found {self}")

    def resized(self, width: int, height: int) -> Pinhole:
        """Return the camera of the same view at another size [px]. Raise ValueError if the proportions differ."""
        x, y = width / self.width, height / self.height
        if abs(x / y - 1) > ASPECT:
            raise ValueError(f"{width} x {height} has other proportions than {self.width} x {self.height}")
        return Pinhole(self.fx * x, self.fy * y, self.cx * x, self.cy * y, width, height)

    def directions(self) -> Float32[np.ndarray, "h w 3"]:
        """Directions of the rays through the pixel centres, in the camera's frame, scaled to depth 1."""
        x = (np.arange(self.width, dtype=np.float32) + 0.5 - self.cx) / self.fx
        y = (np.arange(self.height, dtype=np.float32) + 0.5 - self.cy) / self.fy
        directions = np.ones((self.height, self.width, 3), np.float32)
        directions[..., 0], directions[..., 1] = x, y[:, None]
        return directions

    def pixels(self, points: Float[np.ndarray, "n 3"]) -> tuple[Int[np.ndarray, " n"], Int[np.ndarray, " n"]]:
        """Project points of the camera's frame to pixels; return columns and rows, -1 for points outside the picture."""
        x, y, z = points.T
        ahead = z > 1e-6
        deep = np.where(ahead, z, 1)
        column = np.floor(np.where(ahead, self.fx * x / deep + self.cx, -1))
        row = np.floor(np.where(ahead, self.fy * y / deep + self.cy, -1))
        outside = ~((column >= 0) & (column < self.width) & (row >= 0) & (row < self.height))
        column[outside] = row[outside] = -1
        return column.astype(np.int64), row.astype(np.int64)


@dataclass(frozen=True, eq=False)
class Observation(Brief):
    """Data of a frame. color: (H, W, 3) sRGB; depth: (h, w) along the optical axis [m], 0 if not measured."""

    color: UInt8[np.ndarray, "H W 3"]
    depth: Float32[np.ndarray, "h w"]

    def __post_init__(self) -> None:
        if not (np.isfinite(self.depth).all() and (self.depth >= 0).all()):
            raise ValueError("depth must be finite and not negative; 0 stands for none")


@dataclass(frozen=True, eq=False)
class RgbdFrame(Brief):
    """Picture with depth and pose, read on demand so that memory does not grow with the recording.

    camera: of the colour picture; T_world_camera: (4, 4) rigid [m], the camera looks along its +z, x to the right, y down.
    """

    name: str
    camera: Pinhole
    T_world_camera: Float64[np.ndarray, "4 4"]
    read: Callable[[], Observation]

    def observe(self) -> Observation:
        """Read the picture and its depth. Raise InputError if their sizes do not fit the intrinsics."""
        observation = self.read()
        for what, size in (("picture", observation.color.shape[1::-1]), ("depth map", observation.depth.shape[::-1])):
            try:
                if size != (1, 1):
                    self.camera.resized(*size)
            except ValueError:
                raise InputError(
                    f"frame {self.name}: the {what} has {size[0]} x {size[1]} pixels, its intrinsics are for "
                    f"{self.camera.width} x {self.camera.height}; valid is the same or another resolution of the same section"
                ) from None
        return observation

    def depth_camera(self, depth: Float32[np.ndarray, "h w"]) -> Pinhole:
        """Return the camera of the depth map, which may be smaller than the picture."""
        return self.camera.resized(depth.shape[1], depth.shape[0])

    def points(self, depth: Float32[np.ndarray, "h w"], step: int = 1) -> Float[np.ndarray, "n 3"]:
        """Return the world positions [m] of pixels with depth, at every `step`-th row and column."""
        some = depth[::step, ::step]
        seen = some > 0
        rays = self.depth_camera(depth).directions()[::step, ::step][seen]
        return (rays * some[seen][:, None]) @ self.T_world_camera[:3, :3].T + self.T_world_camera[:3, 3]


def cropped(frame: RgbdFrame, low: Float[np.ndarray, " 3"], high: Float[np.ndarray, " 3"]) -> RgbdFrame:
    """Return the frame without depth outside a box of the world."""

    def read() -> Observation:
        observation = frame.read()
        depth = observation.depth.copy()
        seen = depth > 0
        p = frame.points(depth)
        depth[seen] = np.where(((p >= low) & (p <= high)).all(1), depth[seen], np.float32(0))
        return Observation(observation.color, depth)

    return replace(frame, read=read)


@dataclass(frozen=True, eq=False)
class Frames:
    """Recording.

    layout: name for messages; has_depth: whether frames have depth; up: the world's upward direction if the layout defines it;
    warnings: collected while reading.
    """

    frames: tuple[RgbdFrame, ...]
    layout: str
    has_depth: bool = True
    up: tuple[float, float, float] | None = None
    warnings: tuple[str, ...] = ()

    @classmethod
    def read(
        cls, frames: Sequence[tuple[RgbdFrame, bool]], layout: str, up: tuple[float, float, float] | None, *warnings: str
    ) -> Frames:
        """Return the recording of frames, each with whether it has depth; if some have, those without are left out."""
        deep = [frame for frame, has_depth in frames if has_depth]
        if deep and len(deep) < len(frames):
            warnings = (*warnings, f"{len(frames) - len(deep)} of {len(frames)} frames have no depth and are left out")
        return cls(tuple(deep or [frame for frame, _ in frames]), layout, bool(deep), up, warnings)

    def __len__(self) -> int:
        return len(self.frames)

    def of(self, kept: list[RgbdFrame], *warnings: str) -> Frames:
        """Return the recording with some of its frames and additional warnings."""
        return replace(self, frames=tuple(kept), warnings=(*self.warnings, *warnings))


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
