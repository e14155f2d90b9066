"""Rendering of one part in many poses without rebuilding the ray scene: rays are transformed instead of the part."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8

from anymesh.geometry.raycast_ import Hits, RayScene
from anymesh.rendering.paint import HIGHLIGHT, lighten
from anymesh.rendering.render import lit, shade, turned
from anymesh.types import Mesh
from anymesh.types.camera import Camera

LIGHTEN = 0.5  # share by which the colours of static faces are moved towards white
MARGIN = 2.0  # [px] margin around the part's box within which rays are cast
ONWARD = 1e-5  # share of the diagonal by which a ray continues behind a moving face
MAX_LAYERS = 24  # maximum number of moving faces that a ray passes before it counts as lost

Rays = tuple[np.ndarray, np.ndarray]  # origins and directions, as returned by `Camera.rays`
Pose = Float[np.ndarray, "4 4"]


@dataclass(frozen=True, eq=False)
class PartPixels:
    """Pixels that the part alone would cover.

    pixel: flat indices in row-major order; distance: in lengths of the pixel's ray; normal: turned towards the camera.
    """

    pixel: Int[np.ndarray, " k"]
    distance: Float[np.ndarray, " k"]
    normal: Float[np.ndarray, "k 3"]


@dataclass(frozen=True, eq=False)
class Still:
    """Static faces in a picture: shaded and lightened colour, distance (inf: nothing) and normal of each pixel."""

    color: UInt8[np.ndarray, "n 3"]
    distance: Float[np.ndarray, " n"]
    normal: Float[np.ndarray, "n 3"]


@dataclass(frozen=True, eq=False)
class Posed:
    """The object as modelled, its ray scene, and its moving faces. Poses are rigid transforms of these from their rest pose."""

    mesh: Mesh
    moving: Bool[np.ndarray, " F"]
    scene: RayScene

    @cached_property
    def part(self) -> Mesh:
        """The moving faces, at rest."""
        return self.mesh.subset(self.moving)

    @cached_property
    def _part_scene(self) -> RayScene:
        return RayScene(self.part.vertices, self.part.faces)

    @cached_property
    def corners(self) -> Float[np.ndarray, "n 3"]:
        """Vertices of the moving faces, at rest."""
        return self.part.vertices

    @cached_property
    def _box(self) -> Float[np.ndarray, "8 3"]:
        """Corners of the bounding box of the moving faces, at rest."""
        return np.stack(np.meshgrid(*bounds_of([self.corners]).T, indexing="ij"), -1).reshape(-1, 3)

    def still_hits(self, rays: Rays) -> Hits:
        """Return the first hits on static faces; rays continue behind moving faces."""
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
        """Render the static faces."""
        hits = self.still_hits(rays)
        color, normal = shade(self.mesh, hits, rays[1])
        return Still(lighten(color, LIGHTEN), hits.distance, normal)

    def part_pixels(self, T: Pose, camera: Camera) -> PartPixels:
        """Return the pixels that the part alone would cover in a pose, by casting rays in the frame of the part."""
        columns, rows = self._box_pixels(T, camera)
        R, t = T[:3, :3], T[:3, 3]
        across, along = (turned(terms, R.astype(np.float32)) for terms in camera.ray_grid(columns + 0.5, rows + 0.5))
        directions = (along[:, None] + across).reshape(-1, 3)
        hits = self._part_scene.surface_hits(turned((camera.T_world_camera[:3, 3] - t)[None], R)[0], directions)
        seen = np.flatnonzero(hits.face >= 0)
        pixel = (rows[:, None] * camera.width + columns).reshape(-1)[seen]
        normal = turned(hits.normal[seen], R.T.astype(np.float32))
        return PartPixels(pixel, hits.depth[seen].astype(float), normal.astype(float))

    def _box_pixels(self, T: Pose, camera: Camera) -> tuple[Int[np.ndarray, " w"], Int[np.ndarray, " h"]]:
        """Return the columns and rows of the bounding box of the part in a pose."""
        pixel, depth = camera.project(self._box @ T[:3, :3].T + T[:3, 3])
        if (depth <= 0).any():
            return np.arange(camera.width), np.arange(camera.height)
        limit = np.array([camera.width, camera.height])
        low = np.clip(np.floor(pixel.min(0) - MARGIN), 0, limit).astype(int)
        high = np.clip(np.ceil(pixel.max(0) + MARGIN), 0, limit).astype(int)
        return np.arange(low[0], high[0]), np.arange(low[1], high[1])


def part_color(normal: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Return the shaded colour (0..255) of the highlighted part."""
    return lit(np.tile(np.array(HIGHLIGHT, float), (len(normal), 1)), normal)


def bounds_of(boxes: Sequence[np.ndarray]) -> Float[np.ndarray, "2 3"]:
    """Return the bounds (2, 3) of several boxes or point sets (n, 3)."""
    return np.stack([np.min([b.min(0) for b in boxes], axis=0), np.max([b.max(0) for b in boxes], axis=0)])
