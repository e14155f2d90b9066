"""An object with one part in many poses, cast at without building it anew: the rays move instead of the part."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8

from anymesh.rendering.paint import HIGHLIGHT, lighten
from anymesh.rendering.raycast_ import Hits, RayScene
from anymesh.rendering.render import lit, shade
from anymesh.types import Mesh
from anymesh.types.camera import Camera

LIGHTEN = 0.5  # of what stands still
MARGIN = 2.0  # [px] round the part's box in a picture, in which rays are cast at it
ONWARD = 1e-5  # share of the diagonal by which a ray goes on behind a face that moves
MAX_LAYERS = 24  # faces that move, which a ray passes before it counts as lost

Rays = tuple[np.ndarray, np.ndarray]  # origins and directions, as of `Camera.rays`
Pose = Float[np.ndarray, "4 4"]


@dataclass(frozen=True, eq=False)
class PartPixels:
    """The pixels that a part alone would cover: their numbers, row by row, the distance of each in lengths of its ray, and its
    normal, towards the camera."""

    pixel: Int[np.ndarray, " k"]
    distance: Float[np.ndarray, " k"]
    normal: Float[np.ndarray, "k 3"]


@dataclass(frozen=True, eq=False)
class Still:
    """What stands still in a picture: lit and lightened colour, distance (inf: nothing) and normal of each pixel."""

    color: UInt8[np.ndarray, "n 3"]
    distance: Float[np.ndarray, " n"]
    normal: Float[np.ndarray, "n 3"]


@dataclass(frozen=True, eq=False)
class Posed:
    """The object as modelled, its rays, and the faces that move. Poses are rigid transforms of these from where they are."""

    mesh: Mesh
    moving: Bool[np.ndarray, " F"]
    scene: RayScene

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
    def _box(self) -> Float[np.ndarray, "8 3"]:
        """The corners of the box round the faces that move, at rest."""
        return np.stack(np.meshgrid(*bounds_of([self.corners]).T, indexing="ij"), -1).reshape(-1, 3)

    def still_hits(self, rays: Rays) -> Hits:
        """The first hits of what stands still: rays go on behind faces that move."""
        hits = self.scene.first_hit(*rays)
        face, distance, u, v = (a.copy() for a in (hits.face, hits.distance, hits.u, hits.v))
        step = ONWARD * self.mesh.diagonal / np.linalg.norm(rays[1], axis=1)
        for _ in range(MAX_LAYERS):
            rows = np.flatnonzero(face >= 0)
            rows = rows[self.moving[face[rows]]]
            if len(rows) == 0:
                break
            done = distance[rows] + step[rows]
            onward = self.scene.first_hit(rays[0][rows] + done[:, None] * rays[1][rows], rays[1][rows])
            face[rows], distance[rows], u[rows], v[rows] = onward.face, onward.distance + done, onward.u, onward.v
        lost = (face >= 0) & self.moving[face]
        face[lost], distance[lost] = -1, np.inf
        return Hits(face, distance, u, v)

    def still_picture(self, rays: Rays) -> Still:
        """What a picture shows of what stands still."""
        hits = self.still_hits(rays)
        color, normal = shade(self.mesh, hits, rays[1])
        return Still(lighten(color, LIGHTEN), hits.distance, normal)

    def part_pixels(self, T: Pose, camera: Camera) -> PartPixels:
        """The pixels that the part alone would cover in a pose: rays are cast at it from where it sees the camera."""
        columns, rows = self._box_pixels(T, camera)
        R, t = T[:3, :3], T[:3, 3]
        across, along = (terms @ R.astype(np.float32) for terms in camera.ray_grid(columns + 0.5, rows + 0.5))
        directions = (along[:, None] + across).reshape(-1, 3)
        hits = self._part_scene.surface_hits((camera.T_world_camera[:3, 3] - t) @ R, directions)
        seen = np.flatnonzero(hits.face >= 0)
        pixel = (rows[:, None] * camera.width + columns).reshape(-1)[seen]
        return PartPixels(pixel, hits.depth[seen].astype(float), (hits.normal[seen] @ R.T.astype(np.float32)).astype(float))

    def _box_pixels(self, T: Pose, camera: Camera) -> tuple[Int[np.ndarray, " w"], Int[np.ndarray, " h"]]:
        """The columns and rows of the box of the part's pose."""
        pixel, depth = camera.project(self._box @ T[:3, :3].T + T[:3, 3])
        if (depth <= 0).any():
            return np.arange(camera.width), np.arange(camera.height)
        limit = np.array([camera.width, camera.height])
        low = np.clip(np.floor(pixel.min(0) - MARGIN), 0, limit).astype(int)
        high = np.clip(np.ceil(pixel.max(0) + MARGIN), 0, limit).astype(int)
        return np.arange(low[0], high[0]), np.arange(low[1], high[1])


def part_color(normal: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """The lit colour (0..255) of a part that is asked about."""
    return lit(np.tile(np.array(HIGHLIGHT, float), (len(normal), 1)), normal)


def bounds_of(boxes: Sequence[np.ndarray]) -> Float[np.ndarray, "2 3"]:
    """The box (2, 3) round some boxes or points (n, 3)."""
    return np.stack([np.min([b.min(0) for b in boxes], axis=0), np.max([b.max(0) for b in boxes], axis=0)])
