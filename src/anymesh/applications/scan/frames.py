"""Posed pictures with depth: the common representation of all recording layouts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, Float32, Float64, Int, UInt8

from anymesh.errors import InputError

ASPECT = 0.02  # largest relative difference of aspect ratio between depth map and picture; above, they show different sections
FLIPPED = np.diag([1.0, -1.0, -1.0, 1.0])  # OpenGL camera axes (y up, z back) to OpenCV ones (y down, z ahead), and back


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
class Observation:
    """Data of a frame. color: (H, W, 3) sRGB; depth: (h, w) along the optical axis [m], 0 if not measured."""

    color: UInt8[np.ndarray, "H W 3"]
    depth: Float32[np.ndarray, "h w"]

    def __post_init__(self) -> None:
        if not (np.isfinite(self.depth).all() and (self.depth >= 0).all()):
            raise ValueError("depth must be finite and not negative; 0 stands for none")


@dataclass(frozen=True, eq=False)
class RgbdFrame:
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
