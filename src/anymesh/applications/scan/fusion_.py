"""Fusion of depth maps into a truncated signed distance field on blocks of voxels near the surface (Curless and Levoy 1996).

libigl extracts the surface by marching cubes; the pictures that see it best give its colours.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Float32, Int, Int32, UInt8
from scipy import ndimage

from anymesh.applications.scan.frames import Frames, Pinhole
from anymesh.errors import InputError, OptionError
from anymesh.runtime import Progress
from anymesh.types import Brief
from anymesh.types.triangles import face_cross

SIDE = 8  # voxels along the edge of a block
CHUNK = 1024  # blocks projected at a time
HITS = 4  # depth pixels that a block needs to be allocated
MOST_BLOCKS = 120_000  # memory limit; about 1 GB of voxels
BEHIND = 0.5  # [truncations] behind the surface up to which a view contributes
FADE = 0.9  # share of its weight that a view has lost there
FELLOWS, DEPTH_TOLERANCE_RATIO = 4, 0.015  # neighbouring pixels that must differ by less than this share of the depth
STEEP = 0.15  # cosine of the viewing angle below which depth is ignored
_LOCAL = np.stack(np.meshgrid(*[np.arange(SIDE)] * 3, indexing="ij"), -1).reshape(-1, 3)
_CUBE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])  # in libigl's order
SEEN = 0.012  # share of the depth; largest difference between a visible vertex and the depth map
SHARP = 4  # exponent of a view's weight; emphasizes frontal, near views
UNSEEN = 150  # grey value where no picture shows the surface


@dataclass(frozen=True, eq=False)
class Grid(Brief):
    """Sparse grid of blocks of SIDE**3 voxels.

    origin: of voxel (0, 0, 0) [m]; voxel: edge length [m]; table: index of each block, -1 if not allocated; blocks: (B, 3)
    positions in the table.
    """

    origin: Float[np.ndarray, " 3"]
    voxel: float
    table: Int32[np.ndarray, "x y z"]
    blocks: Int[np.ndarray, "B 3"]


@dataclass(frozen=True, eq=False)
class Field(Brief):
    """Truncated signed distance field.

    distance: (B, SIDE**3) in units of the truncation, positive outside, 1 if unknown; weight: (B, SIDE**3), 1 for one frontal
    view from the usual distance; truncation [m].
    """

    grid: Grid
    distance: Float32[np.ndarray, "B n"]
    weight: Float32[np.ndarray, "B n"]
    truncation: float


def place_blocks(
    frames: Frames, T: Float[np.ndarray, "4 4"], bounds: Float[np.ndarray, "2 3"], voxel: float, truncation: float,
    depth_max: float, progress: Progress,
) -> Grid:  # fmt: skip
    """Allocate the blocks within the bounds that contain surfaces. bounds: in the frame to which T maps the world [m].

    Raise OptionError if there would be too many, with a voxel size that would fit.
    """
    size = SIDE * voxel
    origin = np.floor(bounds[0] / size) * size
    shape = np.ceil((bounds[1] - origin) / size).astype(int) + 1
    if float(np.prod(shape.astype(float))) > 200 * MOST_BLOCKS:
        raise OptionError(f"--voxel {voxel:.4g} m is too fine for a region of {np.round(np.ptp(bounds, axis=0), 2)} m")
    count = np.zeros(shape, np.int32)
    for number, frame in enumerate(frames.frames):
        progress("allocate", frame.name, number, len(frames))
        depth = _limited(frame.observe().depth, depth_max)
        eye = (T @ frame.T_world_camera)[:3, 3]
        p = frame.points(depth) @ T[:3, :3].T + T[:3, 3]
        p = p[((p > bounds[0]) & (p < bounds[1])).all(1)]
        way = (p - eye) / np.maximum(np.linalg.norm(p - eye, axis=1, keepdims=True), 1e-9)
        cells = np.concatenate([np.floor((p + s * truncation * way - origin) / size).astype(np.int64) for s in (-1, 0, 1)])
        cells = cells[((cells >= 0) & (cells < shape)).all(1)]
        count += np.bincount(np.ravel_multi_index(tuple(cells.T), tuple(shape)), minlength=count.size).reshape(shape)
    blocks = np.argwhere(count >= HITS)
    if len(blocks) == 0:
        raise InputError("no frame shows a surface within the region; check --crop, --depth-max and the poses")
    if len(blocks) > MOST_BLOCKS:
        wanted = voxel * float(np.sqrt(len(blocks) / MOST_BLOCKS)) * 1.05
        raise OptionError(f"--voxel {voxel:.4g} m makes {len(blocks)} blocks, more than {MOST_BLOCKS}; {wanted:.4g} m would do")
    table = np.full(shape, -1, np.int32)
    table[tuple(blocks.T)] = np.arange(len(blocks))
    return Grid(origin, voxel, table, blocks)


def fuse(
    frames: Frames, T: Float[np.ndarray, "4 4"], grid: Grid, truncation: float, usual: float, depth_max: float,
    progress: Progress,
) -> Field:  # fmt: skip
    """Compute the weighted mean of the distances of all frames. usual: depth at which a frontal view has weight 1 [m].

    The weight follows the precision of depth: squared cosine of the viewing angle over the fourth power of the depth (noise
    grows with its square), reduced behind the surface. Distances are measured along the surface normal.
    """
    total = np.zeros((len(grid.blocks), SIDE**3), np.float32)
    weight = np.zeros_like(total)
    for number, frame in enumerate(frames.frames):
        progress("fuse", frame.name, number, len(frames))
        depth = _limited(frame.observe().depth, depth_max)
        camera = frame.depth_camera(depth)
        cosine = _cosine(depth, camera)
        frame_weight = cosine**2 * np.minimum((usual / np.maximum(depth, 1e-3)) ** 4, 4.0).astype(np.float32)
        frame_weight[(depth <= 0) | (cosine < STEEP)] = 0
        view = _View(np.linalg.inv(T @ frame.T_world_camera), camera, depth, cosine, frame_weight)
        for rows in _blocks_in_sight(grid, view, truncation):
            _add(total, weight, rows, grid, view, truncation)
    known = weight > 0
    distance = np.ones_like(total)
    np.divide(total, weight, out=distance, where=known)
    return Field(grid, distance, weight, truncation)


@dataclass(frozen=True, eq=False)
class _View(Brief):
    T_camera_grid: Float[np.ndarray, "4 4"]
    camera: Pinhole
    depth: Float32[np.ndarray, "h w"]
    cosine: Float32[np.ndarray, "h w"]
    frame_weight: Float32[np.ndarray, "h w"]


def _limited(depth: np.ndarray, most: float) -> Float32[np.ndarray, "h w"]:
    """Return depth up to `most` [m] where at least FELLOWS of the eight neighbours agree, else 0.

    At edges a sensor mixes the depth of both sides; such pixels behind an edge would remove the surface there.
    """
    height, width = depth.shape
    padded = np.pad(depth, 1)
    same = np.zeros(depth.shape, np.int8)
    for y, x in ((0, 0), (0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1), (2, 2)):
        same += np.abs(padded[y : y + height, x : x + width] - depth) < DEPTH_TOLERANCE_RATIO * depth
    return np.where((depth <= most) & (same >= FELLOWS), depth, np.float32(0))


def _cosine(depth: Float32[np.ndarray, "h w"], camera: Pinhole) -> Float32[np.ndarray, "h w"]:
    """Return the cosine of the angle between ray and surface normal, which is computed from a smoothed depth map."""
    there = (depth > 0).astype(np.float32)
    share = ndimage.uniform_filter(there, 5)
    smooth = ndimage.uniform_filter(depth, 5) / np.maximum(share, 1e-3)
    near = (there > 0) & (np.abs(smooth - depth) < 0.03 * depth)
    rays = camera.directions()
    p = rays * np.where(near, smooth, depth)[..., None]
    normal = np.cross(_slope(p, 1), _slope(p, 0))
    length = np.linalg.norm(normal, axis=2) * np.linalg.norm(rays, axis=2)
    return (np.abs(np.einsum("hwk,hwk->hw", normal, rays)) / np.maximum(length, 1e-12)).astype(np.float32)


def _slope(p: Float32[np.ndarray, "h w 3"], axis: int) -> Float32[np.ndarray, "h w 3"]:
    """Return the shorter of the differences to the next and the previous pixel; at an edge the other one crosses the gap."""
    step = np.diff(p, axis=axis)
    ahead, back = (np.concatenate(pair, axis) for pair in ((step, np.take(step, [-1], axis)), (np.take(step, [0], axis), step)))
    shorter = np.abs(ahead[..., 2:]) < np.abs(back[..., 2:])
    return np.where(shorter, ahead, back)


def _blocks_in_sight(grid: Grid, view: _View, truncation: float) -> list[Int[np.ndarray, " _"]]:
    """Return chunks of blocks that are within the picture and not entirely behind the surfaces that it shows."""
    half = SIDE * grid.voxel / 2
    centers = grid.origin + (grid.blocks + 0.5) * SIDE * grid.voxel
    p = centers @ view.T_camera_grid[:3, :3].T + view.T_camera_grid[:3, 3]
    radius = np.sqrt(3) * half
    z = np.maximum(p[:, 2], 1e-6)
    spread = view.camera.fx * radius / z
    u, v = view.camera.fx * p[:, 0] / z + view.camera.cx, view.camera.fy * p[:, 1] / z + view.camera.cy
    inside = (p[:, 2] > radius) & (u > -spread) & (u < view.camera.width + spread)
    inside &= (v > -spread) & (v < view.camera.height + spread)
    rows = np.flatnonzero(inside)
    if len(rows) == 0:
        return []
    tile = 16
    far = ndimage.maximum_filter(view.depth, 2 * tile)[tile // 2 :: tile, tile // 2 :: tile]
    i = np.clip((v[rows] / tile).astype(int), 0, far.shape[0] - 1)
    j = np.clip((u[rows] / tile).astype(int), 0, far.shape[1] - 1)
    rows = rows[(z[rows] - radius < far[i, j] + truncation) | (spread[rows] > tile)]
    return [rows[k : k + CHUNK] for k in range(0, len(rows), CHUNK)]


def _add(total: np.ndarray, weight: np.ndarray, rows: np.ndarray, grid: Grid, view: _View, truncation: float) -> None:
    """Add the contribution of a view to some blocks, in place."""
    R, t = view.T_camera_grid[:3, :3], view.T_camera_grid[:3, 3]
    corner = (grid.origin + grid.blocks[rows] * (SIDE * grid.voxel)) @ R.T + t
    offset = (_LOCAL * grid.voxel) @ R.T
    x, y, z = (corner[:, k, None].astype(np.float32) + offset[None, :, k].astype(np.float32) for k in range(3))
    camera = view.camera
    with np.errstate(divide="ignore", invalid="ignore"):
        u, v = camera.fx * x / z + camera.cx, camera.fy * y / z + camera.cy
    inside = (z > 1e-3) & (u >= 0) & (u < camera.width) & (v >= 0) & (v < camera.height)
    at = np.where(inside, v, 0).astype(np.int32) * camera.width + np.where(inside, u, 0).astype(np.int32)
    frame_weight = view.frame_weight.reshape(-1)[at]
    ahead = view.depth.reshape(-1)[at] - z
    sdf = ahead * view.cosine.reshape(-1)[at] / np.float32(truncation)
    use: Bool[np.ndarray, "n m"] = inside & (frame_weight > 0) & (sdf > -BEHIND)
    fade = 1 + FADE * np.minimum(sdf, 0) / BEHIND  # less weight behind the surface, for thin walls and grooves
    frame_weight = np.where(use, frame_weight * fade, 0)
    total[rows] += frame_weight * np.minimum(sdf, 1)
    weight[rows] += frame_weight


def extract(field: Field, least: float) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "F 3"]]:
    """Return vertices [m] and outward faces, open where the surface was not observed. least: smallest weight of voxels used.

    Raise InputError if there is no surface.
    """
    import igl

    grid = field.grid
    value, weight = field.distance.reshape(-1), field.weight.reshape(-1)
    candidates = np.flatnonzero((weight >= least) & (np.abs(value) < 1))  # suffices: a truncation exceeds a cube's diagonal
    block, local = np.divmod(candidates, SIDE**3)
    at = grid.blocks[block] * SIDE + np.stack(np.unravel_index(local, (SIDE,) * 3), 1)
    index = np.stack([_index(grid.table, at + corner) for corner in _CUBE], 1)
    index = index[(index >= 0).all(1)]
    index = index[(weight[index] >= least).all(1)]
    inside = (value[index] < 0).sum(1)
    index = index[(inside > 0) & (inside < 8)]
    if len(index) == 0:
        raise InputError("frames were fused, but no surface came out: too few views of the same place, or depth too noisy")
    used, cubes = np.unique(index, return_inverse=True)
    block, local = np.divmod(used, SIDE**3)
    nodes = (grid.blocks[block] * SIDE + np.stack(np.unravel_index(local, (SIDE,) * 3), 1)) * grid.voxel + grid.origin
    level = value[used].astype(np.float64)
    level[np.abs(level) < 1e-3] = -1e-3  # keeps the surface away from the corners of cubes
    vertices, faces = igl.marching_cubes(level, nodes, cubes.reshape(-1, 8).astype(np.int64), 0.0)[:2]
    return np.asarray(vertices, np.float64), np.asarray(faces).astype(np.int64)


def _index(table: np.ndarray, at: Int[np.ndarray, "n 3"]) -> Int[np.ndarray, " n"]:
    """Return the flat index of each voxel, -1 if it is not allocated."""
    block, local = np.divmod(at, SIDE)
    inside = ((block >= 0) & (block < table.shape)).all(1)
    row = np.full(len(at), -1, np.int64)
    row[inside] = table[tuple(block[inside].T)]
    return np.where(row >= 0, row * SIDE**3 + np.ravel_multi_index(tuple(local.T), (SIDE,) * 3), -1)


def vertex_colors(
    vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], frames: Frames, T: Float[np.ndarray, "4 4"],
    progress: Progress,
) -> UInt8[np.ndarray, "V 3"]:  # fmt: skip
    """Return sRGB colours, averaged over the frames that see a vertex, weighted by viewing angle and distance.

    T: from the world to the vertices' frame.
    """
    cross = face_cross(vertices[faces])
    normal = np.stack([np.bincount(faces.reshape(-1), np.repeat(c, 3), len(vertices)) for c in cross.T], 1)
    normal = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    total, weight = np.zeros((len(vertices), 3)), np.zeros(len(vertices))
    for number, frame in enumerate(frames.frames):
        progress("color", frame.name, number, len(frames))
        observation = frame.observe()
        T_camera = np.linalg.inv(T @ frame.T_world_camera)
        p = vertices @ T_camera[:3, :3].T + T_camera[:3, 3]
        facing = -np.einsum("ij,ij->i", normal @ T_camera[:3, :3].T, p) / np.maximum(np.linalg.norm(p, axis=1), 1e-9)
        column, row = frame.depth_camera(observation.depth).pixels(p)
        depth = np.where(column >= 0, observation.depth[row, column], 0)
        rows = np.flatnonzero((depth > 0) & (np.abs(depth - p[:, 2]) < SEEN * p[:, 2]) & (facing > 0.1))
        if len(rows) == 0:
            continue
        height, width = observation.color.shape[:2]
        column, row = frame.camera.resized(width, height).pixels(p[rows])
        rows, column, row = rows[column >= 0], column[column >= 0], row[column >= 0]
        w = (facing[rows] / p[rows, 2]) ** SHARP
        total[rows] += w[:, None] * observation.color[row, column]
        weight[rows] += w
    known = weight > 0
    colors = np.full((len(vertices), 3), float(UNSEEN))
    colors[known] = total[known] / weight[known, None]
    return _spread(colors, known, faces)


def _spread(colors: np.ndarray, known: np.ndarray, faces: np.ndarray) -> UInt8[np.ndarray, "V 3"]:
    """Fill the colours of unseen vertices with the mean of their neighbours, starting from the seen ones."""
    ends = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    ends = np.concatenate([ends, ends[:, ::-1]])
    for _ in range(30):
        use = known[ends[:, 0]] & ~known[ends[:, 1]]
        if not use.any():
            break
        source, target = ends[use].T
        count = np.bincount(target, minlength=len(colors))
        mean = np.stack([np.bincount(target, colors[source, k], len(colors)) for k in range(3)], 1)
        new = count > 0
        colors[new] = mean[new] / count[new, None]
        known = known | new
    return np.clip(np.rint(colors), 0, 255).astype(np.uint8)
