"""An object with one part in many poses, cast at without building it anew: the rays move instead of the part."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, UInt8

from anymesh.rendering.paint import HIGHLIGHT, lighten
from anymesh.rendering.raycast_ import Hits, RayScene
from anymesh.rendering.render import BACKGROUND, lit, shade
from anymesh.types import Mesh
from anymesh.types.camera import Camera

LIGHTEN = 0.5  # of what stands still
MARGIN = 2.0  # [px] round the part's box in a picture, in which rays are cast at it

Rays = tuple[np.ndarray, np.ndarray]  # origins and directions, as of `Camera.rays`
Pose = Float[np.ndarray, "4 4"]


@dataclass(frozen=True, eq=False)
class PartPixels:
    """What a part alone would show in a picture: distance [m] (inf: nothing) and normal, towards the camera, of each pixel."""

    distance: Float[np.ndarray, " n"]
    normal: Float[np.ndarray, "n 3"]

    @property
    def mask(self) -> Bool[np.ndarray, " n"]:
        """Pixels that it covers."""
        return np.isfinite(self.distance)


@dataclass(frozen=True, eq=False)
class Posed:
    """The object as modelled and the faces that move. Poses are rigid transforms of these faces from where they are."""

    mesh: Mesh
    moving: Bool[np.ndarray, " F"]

    @cached_property
    def still(self) -> Mesh:
        """The faces that stand still."""
        return self.mesh.subset(~self.moving)

    @cached_property
    def _still_scene(self) -> RayScene | None:
        return RayScene(self.still.vertices, self.still.faces) if len(self.still.faces) else None

    @cached_property
    def part(self) -> Mesh:
        """The faces that move, at rest."""
        return self.mesh.subset(self.moving)

    @cached_property
    def _part_scene(self) -> RayScene:
        return RayScene(self.part.vertices, self.part.faces)

    @cached_property
    def corners(self) -> Float[np.ndarray, "n 3"]:
        """Vertices of the faces that move, at rest."""
        return self.part.vertices

    @cached_property
    def bounds(self) -> Float[np.ndarray, "2 3"]:
        """Of what stands still; of the part where nothing does."""
        points = self.still.vertices if len(self.still.vertices) else self.corners
        return np.stack([points.min(0), points.max(0)])

    def still_hits(self, rays: Rays) -> Hits:
        """The first hits of what stands still."""
        if self._still_scene is not None:
            return self._still_scene.first_hit(*rays)
        nothing = np.zeros(len(rays[0]))
        return Hits(np.full(len(rays[0]), -1), nothing + np.inf, nothing, nothing)

    def still_picture(self, rays: Rays) -> tuple[UInt8[np.ndarray, "n 3"], Hits, Float[np.ndarray, "n 3"]]:
        """The lit and lightened colours of what stands still, its hits and its normals."""
        hits = self.still_hits(rays)
        if self._still_scene is None:
            return np.full((len(rays[0]), 3), BACKGROUND, np.uint8), hits, np.zeros((len(rays[0]), 3))
        color, normal = shade(self.still, hits, rays[1])
        return lighten(color, LIGHTEN), hits, normal

    def part_pixels(self, T: Pose, camera: Camera, rays: Rays) -> PartPixels:
        """What the part alone would show in a pose. rays: of this camera."""
        rows = self._rows(T, camera)
        R, t = T[:3, :3], T[:3, 3]
        hits = self._part_scene.first_hit((rays[0][rows] - t) @ R, rays[1][rows] @ R)
        seen = hits.face >= 0
        distance = np.full(len(rays[0]), np.inf)
        normal = np.zeros((len(rays[0]), 3))
        distance[rows[seen]] = hits.distance[seen]
        own = self.part.face_normals[hits.face[seen]] @ R.T
        toward = np.einsum("ij,ij->i", own, rays[1][rows[seen]]) > 0
        normal[rows[seen]] = np.where(toward[:, None], -own, own)
        return PartPixels(distance, normal)

    def _rows(self, T: Pose, camera: Camera) -> np.ndarray:
        """The pixels in the box of the part's pose."""
        pixel, depth = camera.project(self.corners @ T[:3, :3].T + T[:3, 3])
        if (depth <= 0).any():
            return np.arange(camera.width * camera.height)
        limit = np.array([camera.width, camera.height])
        low = np.clip(np.floor(pixel.min(0) - MARGIN), 0, limit).astype(int)
        high = np.clip(np.ceil(pixel.max(0) + MARGIN), 0, limit).astype(int)
        grid = np.arange(camera.width * camera.height).reshape(camera.height, camera.width)
        return grid[low[1] : high[1], low[0] : high[0]].reshape(-1)


def part_color(normal: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """The lit colour (0..255) of a part that is asked about."""
    return lit(np.tile(np.array(HIGHLIGHT, float), (len(normal), 1)), normal)


def bounds_of(boxes: Sequence[np.ndarray]) -> Float[np.ndarray, "2 3"]:
    """The box (2, 3) round some boxes or points (n, 3)."""
    return np.stack([np.min([b.min(0) for b in boxes], axis=0), np.max([b.max(0) for b in boxes], axis=0)])
