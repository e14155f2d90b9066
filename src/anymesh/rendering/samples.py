"""Rays for antialiased pictures: one per pixel, and a grid of rays in pixels where the surface changes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32, Int

from anymesh.geometry.raycast_ import RayScene, SurfaceHits
from anymesh.rendering.outlines import Steps, changes, find_steps
from anymesh.types.camera import Camera

GRID = 3  # rays per side of a pixel where the surface changes
FLAT = 1e-4  # tolerance of the cosine between corner normals and face normal, below which normals are not interpolated


@dataclass(frozen=True, eq=False)
class Window:
    """A rectangle of a camera's picture [px]; right and bottom are exclusive."""

    left: int
    top: int
    right: int
    bottom: int

    @property
    def shape(self) -> tuple[int, int]:
        """Number of rows and columns."""
        return self.bottom - self.top, self.right - self.left


@dataclass(frozen=True, eq=False)
class Samples:
    """Hits of the rays of a window, and the lines between them.

    first: hits of one ray through the centre of every pixel; plain: (p,) pixels (flat indices into the window) with a single
    ray that hits;
    split: (k,) pixels with GRID x GRID rays; hits, normal (for shading): of all p + k * GRID**2 rays, the plain ones first;
    steps: lines between rays of split pixels; place: (k * GRID**2,) flat indices of those rays in a picture of the window with
    GRID times the resolution.
    """

    window: Window
    first: SurfaceHits
    plain: Int[np.ndarray, " p"]
    split: Int[np.ndarray, " k"]
    hits: SurfaceHits
    normal: Float32[np.ndarray, "n 3"]
    steps: Steps
    place: Int[np.ndarray, " m"]

    def pairs_beside(self) -> Int[np.ndarray, "m 2"]:
        """Return the rows of rays of horizontally adjacent plain pixels that hit the same face."""
        face = self.hits.face[: len(self.plain)]
        left = np.flatnonzero((np.diff(self.plain) == 1) & (face[1:] == face[:-1]))
        return np.stack([left, left + 1], 1)

    def resolve(self, color: Float32[np.ndarray, "n 3"], ground: Float32[np.ndarray, "h w 3"]) -> Float32[np.ndarray, "h w 3"]:
        """Combine the rays' colours into a picture over a background."""
        picture = ground.reshape(-1, 3).copy()
        count = len(self.plain)
        picture[self.plain] = color[:count]
        picture[self.split] = color[count:].reshape(len(self.split), GRID**2, 3).mean(1)
        return picture.reshape(ground.shape)


@dataclass(frozen=True, eq=False)
class RenderTarget:
    """A mesh to cast rays at.

    corner_normal: for shading, None where surfaces are flat; face_key: pixels are split where the key changes between faces,
    since these faces look different.
    """

    scene: RayScene
    corner_normal: Float32[np.ndarray, "F 3 3"] | None
    face_key: Int[np.ndarray, " F"]


def first_hits(scene: RayScene, camera: Camera, window: Window) -> SurfaceHits:
    """Cast one ray through the centre of every pixel of a window."""
    return scene.surface_hits(camera.T_world_camera[:3, 3], _center_directions(camera, window))


def sample(target: RenderTarget, camera: Camera, window: Window, first: SurfaceHits | None = None) -> Samples:
    """Cast the rays of a window. first: result of `first_hits`, if it already exists."""
    height, width = window.shape
    origin, pixel = camera.T_world_camera[:3, 3], 1 / camera.focal
    directions = _center_directions(camera, window)
    hits = first_hits(target.scene, camera, window) if first is None else first
    normal = _shading_normals(hits, target.corner_normal)
    divided = _split(target, hits, directions, normal, window.shape, pixel)
    plain, split = np.flatnonzero((hits.face >= 0) & ~divided), np.flatnonzero(divided)
    place = _places(split, width)
    across, down = _terms(camera, window, GRID)
    row, column = np.divmod(place, width * GRID)
    more = down[row] + across[column]
    grids = target.scene.surface_hits(origin, more)
    joined = SurfaceHits.joined(hits.take(plain), grids)
    normals = np.concatenate([normal[plain], _shading_normals(grids, target.corner_normal)])
    rows = np.full((height * GRID, width * GRID), -1, np.int32)
    rows.reshape(-1)[place] = np.arange(len(plain), len(plain) + len(place))
    face = np.full(rows.shape, -2, np.int32)
    face.reshape(-1)[place] = grids.face
    steps = find_steps(joined, np.concatenate([directions[plain], more]), normals, changes(face, rows), pixel)
    return Samples(window, hits, plain, split, joined, normals, steps, place)


def _center_directions(camera: Camera, window: Window) -> Float32[np.ndarray, "n 3"]:
    across, down = _terms(camera, window, 1)
    return (down[:, None] + across).reshape(-1, 3)


def _terms(camera: Camera, window: Window, grid: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the terms of the directions of grid x grid rays per pixel of a window (`Camera.ray_grid`)."""
    inside = (np.arange(grid) + 0.5) / grid
    x, y = np.arange(window.left, window.right), np.arange(window.top, window.bottom)
    return camera.ray_grid((x[:, None] + inside).reshape(-1), (y[:, None] + inside).reshape(-1))


def _split(
    target: RenderTarget, hits: SurfaceHits, directions: np.ndarray, normal: np.ndarray, shape: tuple[int, int], pixel: float
) -> np.ndarray:
    """Return a flat mask of the pixels that differ from a horizontal or vertical neighbour."""
    rows = np.arange(len(directions), dtype=np.int32).reshape(shape)
    pairs = changes(hits.face.reshape(shape), rows)
    key = np.where(hits.face < 0, -1, target.face_key[hits.face])
    mask = np.zeros(len(directions), bool)
    mask[pairs[key[pairs[:, 0]] != key[pairs[:, 1]]]] = True
    mask[find_steps(hits, directions, normal, pairs, pixel).pairs] = True
    return mask


def _places(split: Int[np.ndarray, " k"], width: int) -> Int[np.ndarray, " m"]:
    """Return the flat indices of the ray grids of these pixels in the finer picture."""
    row, column = np.divmod(split, width)
    first = row * GRID * width * GRID + column * GRID
    grid = np.arange(GRID)[:, None] * width * GRID + np.arange(GRID)
    return (first[:, None, None] + grid).reshape(-1)


def _shading_normals(hits: SurfaceHits, corner_normal: Float32[np.ndarray, "F 3 3"] | None) -> Float32[np.ndarray, "n 3"]:
    """Interpolate corner normals where present, turned towards the camera; use face normals elsewhere."""
    if corner_normal is None:
        return hits.normal
    rows = np.flatnonzero(hits.face >= 0)
    corners = corner_normal[hits.face[rows]]
    cosine = np.einsum("nkc,nc->nk", corners, hits.normal[rows])
    curved = np.flatnonzero(np.abs(cosine).min(1) < 1 - FLAT)
    rows, corners, cosine = rows[curved], corners[curved], cosine[curved]
    u, v = hits.u[rows], hits.v[rows]
    mixed = np.einsum("nk,nkc->nc", np.stack([1 - u - v, u, v], 1), corners)
    length = np.linalg.norm(mixed, axis=1) * np.sign(cosine.sum(1))
    normal = hits.normal.copy()
    usable = length != 0
    normal[rows[usable]] = mixed[usable] / length[usable, None]
    return normal
