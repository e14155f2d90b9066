"""Recordings of a mesh by a simulated depth camera, for testing and measuring scans.

The camera moves around the object on rings, some of them low, and close enough that a large object does not fit the picture.
The sensor resembles a structured-light camera: noise grows with the square of the depth (Khoshelham and Elberink 2012), pixels
at edges are lost or mixed, and surfaces that are dark or seen at a grazing angle give no depth.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float, Float32
from scipy import ndimage

from anymesh.errors import OutputError
from anymesh.geometry.raycast_ import RayScene, SurfaceHits
from anymesh.pipeline.atomic_folder import make_locked_folder, replace_folder
from anymesh.rendering.render import base_colors, lit
from anymesh.rendering.viewpoints import away
from anymesh.types import Mesh
from anymesh.types.camera import Camera
from anymesh.types.triangles import about_z

NOISE = 0.0015  # [1/m] standard deviation of depth over its square
DEPTH_UNIT = 0.001  # [m] per unit of a 16-bit depth picture
RINGS, SHARES = (8.0, 28.0, 48.0, 70.0), (0.3, 0.3, 0.25, 0.15)  # [deg] elevations of the rings; shares of the cameras
DISTANCES = (0.3, 0.75)  # [m] from the object's box
FOV = np.deg2rad(45)  # vertical
FILLED = 1.15  # size of the picture over the object's diagonal, if `DISTANCES` allow it
GRAZING = 0.17  # cosine of the viewing angle below which there is no depth
DARK = 40.0  # sRGB luminance below which half of the pixels have no depth
EDGE = 0.02  # relative step of depth that counts as an edge
LOST, MIXED = 0.6, 0.2  # shares of edge pixels without depth, and with a depth between both sides
FLOOR = 2.5  # side of the floor over the object's diagonal
FLOOR_COLORS = ((168.0, 150.0, 130.0), (140.0, 124.0, 106.0))  # of its squares


@dataclass(frozen=True, eq=False)
class Sensor:
    """Sensor model. noise: [1/m]; missing: whether depth is lost at edges and on grazing or dark surfaces."""

    noise: float = NOISE
    missing: bool = True


def render_frames(
    mesh: Mesh,
    out: str | Path,
    *,
    views: int = 60,
    size: tuple[int, int] = (640, 480),
    noise: float = NOISE,
    missing: bool = True,
    floor: bool = True,
    seed: int = 0,
) -> Path:
    """Write a recording of a mesh (metres, z up, standing on z = 0) to a new folder, in the layout `frames.json`.

    size: width and height [px]; noise: of depth, over its square [1/m]; missing: whether depth has gaps; floor: whether the
    object stands on a floor. The world frame is rotated about the vertical and shifted, depending on the seed; `truth.json`
    stores T_world_mesh. Return the folder. Raise OutputError if it exists.
    """
    out, rng, sensor = Path(out), np.random.default_rng(seed), Sensor(noise, missing)
    if out.exists():
        raise OutputError(f"{out} exists; choose another folder")
    out.parent.mkdir(parents=True, exist_ok=True)
    T_world_mesh = _anywhere(rng)
    whole, ground = _with_floor(mesh) if floor else (mesh, len(mesh.faces))
    scene = RayScene(whole.vertices, whole.faces)
    hidden = make_locked_folder(out.parent, f".{out.name}.frames-")
    try:
        for name in ("color", "depth"):
            (hidden.path / name).mkdir()
        entries = []
        for number, camera in enumerate(orbit(mesh.bounds, views, size, rng)):
            color, depth = observe(whole, scene, camera, ground, sensor, rng)
            _write(hidden.path, number, color, depth)
            entries.append({"color": f"color/{number:04d}.jpg", "depth": f"depth/{number:04d}.png",
                            "T_world_camera": (T_world_mesh @ camera.T_world_camera).tolist()})  # fmt: skip
        focal = size[1] / (2 * np.tan(FOV / 2))
        about = {"fx": focal, "fy": focal, "cx": size[0] / 2, "cy": size[1] / 2, "width": size[0], "height": size[1]}
        record = {"camera": about, "camera_axes": "opencv", "depth_scale": DEPTH_UNIT, "frames": entries}
        (hidden.path / "frames.json").write_text(json.dumps(record), encoding="utf-8")
        (hidden.path / "truth.json").write_text(json.dumps({"T_world_mesh": T_world_mesh.tolist()}), encoding="utf-8")
        replace_folder(hidden.path, out, None)
    except BaseException:
        hidden.discard()
        raise
    hidden.release()
    return out


def orbit(bounds: Float[np.ndarray, "2 3"], views: int, size: tuple[int, int], rng: np.random.Generator) -> list[Camera]:
    """Return cameras on rings around a box; if it is too large for one picture, each looks at another place in it."""
    half, center = np.ptp(bounds, axis=0) / 2, bounds.mean(0)
    fit = FILLED * float(np.linalg.norm(half)) / np.sin(FOV / 2)
    cameras = []
    ring = np.searchsorted(np.cumsum(SHARES), (np.arange(views) + 0.5) / views)
    for k in range(views):
        around = (k - np.flatnonzero(ring == ring[k])[0] + 0.37 * ring[k]) / (ring == ring[k]).sum()
        way = away(2 * np.pi * around, np.deg2rad(RINGS[ring[k]] + rng.uniform(-4, 4)))
        reach = float(np.abs(way) @ half)
        near = float(np.clip(fit - reach, *DISTANCES))
        share = float(np.clip(1.2 - (reach + near) / fit, 0, 0.85))
        target = center + rng.uniform(-1, 1, 3) * half * share
        eye = target + way * (reach + near)
        eye[2] = max(eye[2], 0.06)
        cameras.append(Camera.looking_at(eye, target, float(FOV), *size))
    return cameras


def observe(
    mesh: Mesh, scene: RayScene, camera: Camera, ground: int, sensor: Sensor, rng: np.random.Generator
) -> tuple[np.ndarray, Float32[np.ndarray, "h w"]]:
    """Simulate colour (sRGB bytes) and depth [m] of the sensor. ground: index of the floor's first face."""
    origins, directions = camera.rays()
    hits = scene.surface_hits(origins[0], directions.astype(np.float32))
    shape = (camera.height, camera.width)
    seen = np.flatnonzero(hits.face >= 0)
    base = np.zeros((len(directions), 3))
    base[seen] = base_colors(mesh, hits.face[seen], hits.u[seen], hits.v[seen])
    _tile(base, hits, ground, origins, directions)
    color = np.full((len(directions), 3), 225.0)
    color[seen] = lit(base[seen], hits.normal[seen].astype(np.float64))
    cosine = np.abs(np.einsum("ij,ij->i", hits.normal, directions)) / np.linalg.norm(directions, axis=1)
    depth = np.where(np.isfinite(hits.depth), hits.depth, 0).reshape(shape)
    gone = ((cosine < GRAZING) | (hits.face < 0)).reshape(shape)
    dark = (base @ [0.299, 0.587, 0.114] < DARK).reshape(shape)
    return color.reshape(*shape, 3).astype(np.uint8), _sensed(depth, gone, dark, sensor, rng)


def _sensed(
    depth: np.ndarray, gone: Bool[np.ndarray, "h w"], dark: Bool[np.ndarray, "h w"], sensor: Sensor, rng: np.random.Generator
) -> Float32[np.ndarray, "h w"]:
    noisy = depth + rng.normal(size=depth.shape) * sensor.noise * depth**2
    if not sensor.missing:
        return np.where(depth > 0, noisy, 0).astype(np.float32)
    least, most = ndimage.minimum_filter(depth, 3), ndimage.maximum_filter(depth, 3)
    edge = most - least > EDGE * np.maximum(most, 1e-6)
    chance = rng.random(depth.shape)
    mixed = edge & (chance > LOST) & (chance < LOST + MIXED) & (least > 0)
    noisy[mixed] = (least + rng.random(depth.shape) * (most - least))[mixed]
    blotch = ndimage.gaussian_filter(rng.normal(size=depth.shape), 6) > 0
    lost = gone | (edge & (chance <= LOST)) | (dark & blotch)
    return np.where((depth > 0) & ~lost, np.maximum(noisy, 0), 0).astype(np.float32)


def _tile(base: np.ndarray, hits: SurfaceHits, ground: int, origins: np.ndarray, directions: np.ndarray) -> None:
    """Draw the squares of the floor, in place."""
    on = np.flatnonzero(hits.face >= ground)
    at = origins[on, :2] + directions[on, :2] * hits.depth[on, None]
    odd = (np.floor(at / 0.1).sum(1) % 2 == 1)[:, None]
    base[on] = np.where(odd, FLOOR_COLORS[0], FLOOR_COLORS[1])


def _with_floor(mesh: Mesh) -> tuple[Mesh, int]:
    """Return the mesh on a square floor at its lowest point, and the index of the floor's first face."""
    low, high = mesh.bounds
    x, y = (low + high)[:2] / 2
    s = FLOOR * mesh.diagonal / 2
    corners = np.array([[x - s, y - s], [x + s, y - s], [x + s, y + s], [x - s, y + s]])
    first, count = len(mesh.vertices), len(mesh.faces)

    def padded(a: np.ndarray | None) -> np.ndarray | None:
        return None if a is None else np.concatenate([a, np.zeros((2, *a.shape[1:]), a.dtype)])

    return replace(
        mesh,
        vertices=np.concatenate([mesh.vertices, np.c_[corners, np.full(4, low[2])]]),
        faces=np.concatenate([mesh.faces, [[first, first + 1, first + 2], [first, first + 2, first + 3]]]),
        face_node=np.concatenate([mesh.face_node, [0, 0]]),
        face_material=np.concatenate([mesh.face_material, [-1, -1]]),
        corner_uv=padded(mesh.corner_uv),
        corner_color=padded(mesh.corner_color),
        corner_normal=padded(mesh.corner_normal),
        corner_more_uv=padded(mesh.corner_more_uv),
    ), count


def _anywhere(rng: np.random.Generator) -> Float[np.ndarray, "4 4"]:
    T = about_z(rng.uniform(0, 2 * np.pi))
    T[:3, 3] = rng.uniform(-1, 1, 3)
    return T


def _write(folder: Path, number: int, color: np.ndarray, depth: np.ndarray) -> None:
    from PIL import Image

    Image.fromarray(color).save(folder / "color" / f"{number:04d}.jpg", quality=92)
    raw = np.minimum(np.rint(depth / DEPTH_UNIT), 65535).astype(np.uint16)
    Image.fromarray(raw).save(folder / "depth" / f"{number:04d}.png", compress_level=3)
