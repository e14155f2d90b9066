"""Rendered pictures for people: antialiased, lit surfaces with outlines and creases on a grey background.

One ray is cast per pixel, and a grid of rays in pixels where the surface changes. Outlines are steps in depth and the border to
the background, creases are steps in the normal. Corner normals for shading are smooth across flat edges, sharp across creases.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float32, Int, UInt8

from anymesh.geometry.raycast_ import RayScene, SurfaceHits
from anymesh.geometry.topology import edge_pairs, label_connected, weld, without_cracks
from anymesh.rendering.render import KEY_LIGHT, base_colors, dot, texels_per_pixel
from anymesh.types import Brief, Mesh
from anymesh.types.camera import Camera
from anymesh.types.triangles import face_cross

GRID = 3  # rays per side of a pixel where the surface changes
FLAT = 1e-4  # tolerance of the cosine between corner normals and face normal, below which normals are not interpolated
# [px] distance of a surface behind its neighbour's plane at which a line begins, and at which it has full strength
STEP = (0.6, 1.6)
FULL_CREASE = float(np.deg2rad(50))  # [rad] angle between faces at which a crease has full strength; it begins at CREASE_ANGLE
GROUND = (222.0, 190.0)  # grey of the background (0..255), at its top and at its bottom
SHEEN = 30.0  # brightness (0..255) of a black surface in full light, so that its shape remains visible
DARK, LIGHT = (38.0, 40.0, 46.0), (176.0, 178.0, 184.0)  # colours of lines on bright and on dark surfaces
DARK_SURFACE = 78.0  # brightness (0..255) below which lines are drawn light
OUTLINE, CREASE = 0.9, 0.6  # opacity of lines
COLOR_BITS = 4  # low bits of vertex colours that are ignored: smaller differences need no antialiasing
LINE_WIDTH = 1  # [px of the finer grid] width of a line beyond the two rays between which it lies
AMBIENT, KEY, SKY = 0.48, 0.4, 0.18  # strength of ambient, directional and sky light; a surface that faces up gets 0.96
BRIGHTNESS = np.array([0.299, 0.587, 0.114], np.float32)  # weights of red, green, blue (ITU-R BT.601)
CREASE_ANGLE = float(np.deg2rad(35))  # [rad] faces that meet at a larger angle form a crease; wheels of 11 sides are round
COPLANAR = 1 - 1e-6  # cosine between faces in one plane, whose normals need no averaging
SMOOTHED_FACES = 20_000  # above this number of faces, facets are too small to be seen and flat shading is enough


def ground(rows: int, columns: int) -> Float32[np.ndarray, "h w 3"]:
    """Return the grey background of pictures, darker towards the bottom."""
    shade = np.linspace(*GROUND, rows, dtype=np.float32)
    return np.broadcast_to(shade[:, None, None], (rows, columns, 3))


def render_target(mesh: Mesh, scene: RayScene, groups: Int[np.ndarray, " F"]) -> RenderTarget:
    """Return a mesh with normals for shading. groups: faces in different groups may be drawn in different colours."""
    key = groups.astype(np.int64) * (len(mesh.materials) + 1) + mesh.face_material + 1
    if mesh.corner_color is not None:
        coarse = (mesh.corner_color[:, 0, :3] >> COLOR_BITS).astype(np.int64)
        key = (key << 24) | (coarse[:, 0] << 16) | (coarse[:, 1] << 8) | coarse[:, 2]
    return RenderTarget(scene, mesh.corner_normal, key)


def material_colors(mesh: Mesh, samples: Samples) -> Float32[np.ndarray, "n 3"]:
    """Return the base colour (0..255) at the hit of each ray, with textures averaged to the picture's resolution."""
    hits = samples.hits
    seen = np.flatnonzero(hits.face >= 0)
    color = np.zeros((len(hits.face), 3), np.float32)
    reduce = texels_per_pixel(mesh, hits, samples.pairs_beside())
    color[seen] = base_colors(mesh, hits.face[seen], hits.u[seen], hits.v[seen], reduce)
    return color


def face_colors(color: UInt8[np.ndarray, "F 3"], samples: Samples) -> Float32[np.ndarray, "n 3"]:
    """Return the colour of the face that each ray hits; undefined for rays without a hit."""
    return color.astype(np.float32)[samples.hits.face]


def light_on(samples: Samples) -> Float32[np.ndarray, " n"]:
    """Return the brightness of the surface at each ray's hit."""
    light = dot(samples.normal, KEY_LIGHT.astype(np.float32))
    np.maximum(light, 0, out=light)
    light *= KEY
    light += AMBIENT + SKY / 2 + SKY / 2 * samples.normal[:, 2]
    return light


def draw(
    samples: Samples, base: Float32[np.ndarray, "n 3"], light: Float32[np.ndarray, " n"], behind: Float32[np.ndarray, "h w 3"]
) -> UInt8[np.ndarray, "h w 3"]:
    """Shade the surfaces, draw the lines, and put the result over the background `behind`."""
    color = base + (SHEEN - SHEEN / 255 * np.maximum(np.maximum(base[:, 0], base[:, 1]), base[:, 2]))[:, None]
    color *= light[:, None]
    np.minimum(color, 255, out=color)
    nothing = np.flatnonzero(samples.hits.face < 0)
    pixel = samples.split[(nothing - len(samples.plain)) // GRID**2]
    color[nothing] = behind.reshape(-1, 3)[pixel]
    _draw_lines(samples, color)
    return (samples.resolve(color, behind) + np.float32(0.5)).astype(np.uint8)


def _draw_lines(samples: Samples, color: Float32[np.ndarray, "n 3"]) -> None:
    """Draw lines over the colours of the rays, in place: dark on bright surfaces, light on dark ones."""
    steps, first = samples.steps, len(samples.plain)
    height, width = samples.window.shape
    bright = dot(color[steps.pairs], BRIGHTNESS).max(1) > DARK_SURFACE
    strength = np.round(255 * np.maximum(OUTLINE * steps.outline, CREASE * steps.crease)).astype(np.uint8)
    for tone, line in ((False, LIGHT), (True, DARK)):
        mine = np.flatnonzero(bright == tone)
        if len(mine) == 0:
            continue
        at = samples.place[steps.pairs[mine].reshape(-1) - first]
        lines = stroke((height * GRID, width * GRID), at, np.repeat(strength[mine], 2), LINE_WIDTH)
        opacity = lines.reshape(-1)[samples.place]
        drawn = np.flatnonzero(opacity)
        rows = first + drawn
        color[rows] += (opacity[drawn] / np.float32(255))[:, None] * (np.array(line, np.float32) - color[rows])


def smoothed(mesh: Mesh) -> Mesh:
    """Return the mesh with corner normals for shading: those of the file, or averages over smooth edges.

    No normals are added where flat shading is enough: to meshes with many faces, and to meshes without smooth edges.
    """
    if mesh.corner_normal is not None or len(mesh.faces) > SMOOTHED_FACES:
        return mesh
    vertices = without_cracks(mesh.vertices, mesh.faces)
    pairs = edge_pairs(vertices, mesh.faces)
    cosine = np.einsum("ij,ij->i", mesh.face_normals[pairs.faces[:, 0]], mesh.face_normals[pairs.faces[:, 1]])
    smooth = pairs.aligned & (cosine > np.cos(CREASE_ANGLE))
    if not (smooth & (cosine < COPLANAR)).any():
        return mesh
    welded = weld(vertices)
    faces, ends = pairs.faces[smooth], welded[pairs.vertices[smooth]]
    corners = [3 * faces + (welded[mesh.faces][faces] == end[:, None, None]).argmax(2) for end in ends.T]
    group = label_connected(3 * len(mesh.faces), np.concatenate(corners))
    weight = np.repeat(face_cross(mesh.triangles), 3, axis=0)
    total = np.stack([np.bincount(group, weight[:, k]) for k in range(3)], 1)[group]
    length = np.linalg.norm(total, axis=1, keepdims=True)
    normal = np.divide(total, length, out=np.zeros_like(total), where=length > 0).astype(np.float32)
    return replace(mesh, corner_normal=normal.reshape(-1, 3, 3))


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
class Samples(Brief):
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
class RenderTarget(Brief):
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


@dataclass(frozen=True, eq=False)
class Steps(Brief):
    """Pairs of neighbouring rays between which the surface changes.

    pairs: (m, 2) rows of the hits; outline, crease: (m,) strength of the line between them, 0..1.
    """

    pairs: Int[np.ndarray, "m 2"]
    outline: Float32[np.ndarray, " m"]
    crease: Float32[np.ndarray, " m"]


def changes(value: Int[np.ndarray, "H W"], row: Int[np.ndarray, "H W"]) -> Int[np.ndarray, "m 2"]:
    """Return the rows of horizontal and vertical neighbours with different values; pixels whose row is -1 are ignored."""
    neighbours = []
    for near, far in (((slice(None), slice(None, -1)), (slice(None), slice(1, None))), (slice(None, -1), slice(1, None))):
        at = np.flatnonzero(value[near] != value[far])
        pairs = np.stack([row[near].reshape(-1)[at], row[far].reshape(-1)[at]], 1)
        neighbours.append(pairs[(pairs >= 0).all(1)])
    return np.concatenate(neighbours)


def find_steps(
    hits: SurfaceHits,
    directions: Float32[np.ndarray, "n 3"],
    normal: Float32[np.ndarray, "n 3"],
    pairs: Int[np.ndarray, "m 2"],
    pixel: float,
) -> Steps:
    """Find the lines between neighbouring rays that hit different faces; pairs without a line are left out.

    directions: of the rays, which share one origin; normal: for shading; pixel: size of a pixel at depth 1.
    Two hits lie on one surface if either is near the other's tangent plane, even at grazing angles.
    """
    outline = (hits.face[pairs] < 0).any(1).astype(np.float32)
    crease = np.zeros(len(pairs), np.float32)
    inner = np.flatnonzero(outline == 0)
    p, q = pairs[inner].T
    offset = hits.depth[q, None] * directions[q] - hits.depth[p, None] * directions[p]
    apart = np.minimum(*(np.abs(np.einsum("ij,ij->i", offset, hits.normal[k])) for k in (p, q)))
    apart /= pixel * np.minimum(hits.depth[p], hits.depth[q])
    outline[inner] = np.clip((apart - STEP[0]) / (STEP[1] - STEP[0]), 0, 1)
    angle = np.arccos(np.clip(np.einsum("ij,ij->i", normal[p], normal[q]), -1, 1))
    crease[inner] = np.clip((angle - CREASE_ANGLE) / (FULL_CREASE - CREASE_ANGLE), 0, 1)
    lines = np.flatnonzero(np.maximum(outline, crease) > 0)
    return Steps(pairs[lines], outline[lines], crease[lines])


def stroke(
    shape: tuple[int, int], at: Int[np.ndarray, " n"], strength: UInt8[np.ndarray, " n"], width: int
) -> UInt8[np.ndarray, "H W"]:
    """Draw lines through pixels (flat indices), widened by `width` pixels on either side."""
    drawn = np.zeros(shape, np.uint8)
    order = np.argsort(strength, kind="stable")  # where lines meet, the strongest one counts
    drawn.reshape(-1)[at[order]] = strength[order]
    for _ in range(width):
        grown = drawn.copy()
        np.maximum(grown[1:], drawn[:-1], out=grown[1:])
        np.maximum(grown[:-1], drawn[1:], out=grown[:-1])
        np.maximum(grown[:, 1:], drawn[:, :-1], out=grown[:, 1:])
        np.maximum(grown[:, :-1], drawn[:, 1:], out=grown[:, :-1])
        drawn = grown
    return drawn
