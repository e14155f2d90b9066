"""A pinhole camera."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Float32

from anymesh.types.brief import Brief


@dataclass(frozen=True, eq=False)
class Camera(Brief):
    """A pinhole camera that looks along its +z, with x to the right and y down.

    T_world_camera: (4, 4) rigid; fov: vertical [rad]; width, height [px].
    """

    T_world_camera: Float[np.ndarray, "4 4"]
    fov: float
    width: int
    height: int

    def __post_init__(self) -> None:
        if not 0 < self.fov < np.pi or self.width < 1 or self.height < 1:
            raise ValueError(f"a camera needs 0 < fov < pi and a size, found {self.fov}, {self.width} x {self.height}")

    @classmethod
    def looking_at(
        cls, eye: Float[np.ndarray, " 3"], target: Float[np.ndarray, " 3"], fov: float, width: int, height: int
    ) -> Camera:
        """Return a camera at `eye` with `target` at its center and the world's +z up."""
        z = (target - eye) / np.linalg.norm(target - eye)
        up = np.array([0.0, 0, 1]) if abs(z[2]) < 0.999 else np.array([0.0, 1, 0])
        x = np.cross(z, up)
        x /= np.linalg.norm(x)
        T = np.eye(4)
        T[:3, :3] = np.stack([x, np.cross(z, x), z], 1)
        T[:3, 3] = eye
        return cls(T, fov, width, height)

    @property
    def focal(self) -> float:
        """Return the focal length [px]."""
        return self.height / (2 * np.tan(self.fov / 2))

    def rays(self) -> tuple[Float[np.ndarray, "n 3"], Float[np.ndarray, "n 3"]]:
        """Return origins and directions (depth 1) of the rays through the pixel centres, row by row."""
        u, v = np.meshgrid(np.arange(self.width) + 0.5, np.arange(self.height) + 0.5)
        x, y = ((u - self.width / 2) / self.focal).reshape(-1, 1), ((v - self.height / 2) / self.focal).reshape(-1, 1)
        right, down, ahead = self.T_world_camera[:3, :3].T
        return np.broadcast_to(self.T_world_camera[:3, 3], (x.size, 3)), x * right + y * down + ahead

    def ray_grid(
        self, x: Float[np.ndarray, " w"], y: Float[np.ndarray, " h"]
    ) -> tuple[Float32[np.ndarray, "w 3"], Float32[np.ndarray, "h 3"]]:
        """Return terms of the directions (depth 1) of rays through positions x[i], y[j] [px].

        The direction of a ray is the sum of terms i and j.
        """
        right, down, ahead = self.T_world_camera[:3, :3].T
        across = ((x - self.width / 2) / self.focal)[:, None] * right + ahead
        along = ((y - self.height / 2) / self.focal)[:, None] * down
        return across.astype(np.float32), along.astype(np.float32)

    def project(self, points: Float[np.ndarray, "n 3"]) -> tuple[Float[np.ndarray, "n 2"], Float[np.ndarray, " n"]]:
        """Return pixel positions and depths of points; points behind the camera have depth <= 0."""
        x, y, z = (points - self.T_world_camera[:3, 3]).T
        across, down, depth = (a * x + b * y + c * z for a, b, c in self.T_world_camera[:3, :3].T)
        scale = self.focal / np.where(np.abs(depth) < 1e-9, 1e-9, depth)
        return np.stack([across * scale + self.width / 2, down * scale + self.height / 2], 1), depth
