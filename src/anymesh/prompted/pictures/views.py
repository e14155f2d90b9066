"""Views that are shown to a model (paper, 3.2 and 3.3): cameras around the object, the best view of a part, close-ups."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float, Float32, Int, UInt8
from PIL import Image

from anymesh.config import REFERENCE_PX
from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.drawing import Samples, Window, draw, first_hits, material_colors, render_target, sample
from anymesh.rendering.render import BACKGROUND, View, dot
from anymesh.rendering.viewpoints import away, framed, zoom
from anymesh.types import Mesh
from anymesh.types.camera import Camera

# strength of the light that moves with the camera: ambient, at the camera, above its shoulder, from the sky
HEAD_AMBIENT, HEAD, SHOULDER, HEAD_SKY = 0.36, 0.22, 0.30, 0.16
PICTURE_PX = 640  # [px] width and height of a picture
# [px] of a picture of the whole object without marks: one tile of models that count tiles of 512 px, and two on a sheet are two
RECOGNITION_PX = 500
EYE_RATIO = 1.0  # of the diagonal: distance of a camera from the object's center; 2 for a diagonal of 2 (the paper's)
FOV_DEG = 60.0  # [deg] vertical, before the camera is zoomed (the paper's implementation)
AIR = 0.04  # margin around the object on each side, as a share of its box in the picture
MIN_PART_PIXELS = 5000  # a part that covers less of the best view, were it of REFERENCE_PX, is shown in a close-up
ZOOM_MARGIN = 0.3  # margin of a close-up on each side, as a share of the part's box in the picture
SIDES = ("front", "front right", "right", "back right", "back", "back left", "left", "front left")
MAX_BEHIND = 0.2  # sine (12 degrees) up to which a camera behind a plane still counts as before it: views along it
MAX_LEVEL_DEG = 0.5  # elevation below which a view is level
MIN_STEEP_DEG = 30.0  # elevation from which it is described as from above or below


def views(
    mesh: Mesh, directions: Sequence[tuple[float, float]], *, size: int | None = None, scene: RayScene | None = None
) -> list[View]:
    """Render views of the object, one for each azimuth and elevation [deg] of its camera.

    size: [px] per side, PICTURE_PX if None; scene: the ray scene of this mesh, if it already exists.
    """
    scene = scene or RayScene(mesh.vertices, mesh.faces)
    return [shown(mesh, camera, scene) for camera in cameras(mesh, directions, size)]


def cameras(mesh: Mesh, directions: Sequence[tuple[float, float]], size: int | None = None) -> list[Camera]:
    """Return the cameras of `views`: at the paper's distance, each turned and zoomed until the object fills its picture."""
    size = size or PICTURE_PX
    center, distance = mesh.bounds.mean(0), EYE_RATIO * float(np.linalg.norm(np.ptp(mesh.bounds, axis=0)))
    used = mesh.vertices[np.unique(mesh.faces)]
    cameras = []
    for azimuth, elevation in directions:
        eye = center + distance * away(np.deg2rad(azimuth), np.deg2rad(elevation))
        camera = Camera.looking_at(eye, center, float(np.deg2rad(FOV_DEG)), size, size)
        for _ in range(2):  # turning the camera changes the object's outline slightly
            camera = framed(camera, used, AIR, size)
        cameras.append(camera)
    return cameras


def caption(azimuth: float, elevation: float, front: float | None = None) -> str:
    """Describe the direction of a view in words. front: azimuth from which the front is seen, None if unknown; all in [deg]."""
    side = f"turned by {azimuth:.0f} degrees" if front is None else f"from the {SIDES[round((azimuth - front) / 45) % 8]}"
    if abs(elevation) < MAX_LEVEL_DEG:
        return f"{side}, level"
    way, name = ("up", "above") if elevation > 0 else ("down", "below")
    height = f"{abs(elevation):.0f} degrees {way}"
    return f"{side}, from {name} ({height})" if abs(elevation) >= MIN_STEEP_DEG else f"{side}, {height}"


def shown(mesh: Mesh, camera: Camera, scene: RayScene) -> View:
    """Render a view with outlines and creases, lit from the camera.

    Colours are antialiased; the other buffers hold one ray per pixel. With corner normals (`drawing.smoothed`), curved surfaces
    look curved.
    """
    shape = (camera.height, camera.width)
    window = Window(0, 0, camera.width, camera.height)
    hits = first_hits(scene, camera, window)

    def paint() -> UInt8[np.ndarray, "H W 3"]:
        samples = sample(render_target(mesh, scene, np.zeros(len(mesh.faces), np.int64)), camera, window, hits)
        white = np.full((*shape, 3), BACKGROUND, np.float32)
        return draw(samples, material_colors(mesh, samples), headlight_on(samples, camera), white)

    return View(camera, hits.depth.reshape(shape), hits.normal.reshape(*shape, 3), hits.face.reshape(shape), paint)


def shrunk(image: UInt8[np.ndarray, "H W 3"], size: int) -> UInt8[np.ndarray, "h w 3"]:
    """Return a picture with a longer side of at most `size` [px]."""
    picture = Image.fromarray(image)
    picture.thumbnail((size, size), Image.Resampling.LANCZOS)
    return np.asarray(picture)


def normal_picture(view: View) -> UInt8[np.ndarray, "H W 3"]:
    """Return normals as colours: x, y, z of the asset frame as red, green, blue; the background is as in `View.color`."""
    color = np.round(127.5 * (view.normal + 1))
    color[view.face < 0] = BACKGROUND
    return color.astype(np.uint8)


def is_beside(way: Float[np.ndarray, " 3"], facing: Float[np.ndarray, " 3"]) -> bool:
    """Return whether a direction to a camera is on the side of a unit direction, or not clearly on the other side."""
    return bool(way @ facing > -MAX_BEHIND * np.linalg.norm(way))


def part_pixels(view: View, face_part: Int[np.ndarray, " F"], part: int) -> Bool[np.ndarray, "H W"]:
    """Return the pixels that show a part: those whose first hit is one of its faces."""
    return (view.face >= 0) & (face_part[view.face] == part)


def visible_pixels(view: View, face_part: Int[np.ndarray, " F"], part: int) -> int:
    """Count the pixels that show a part, considering occlusion."""
    return int(part_pixels(view, face_part, part).sum())


def best_view(views: Sequence[View], face_part: Int[np.ndarray, " F"], part: int) -> int:
    """Return the index of the view with most pixels of a part (paper, 3.3); the first one in case of a tie."""
    return int(np.argmax([visible_pixels(v, face_part, part) for v in views]))


def hidden_points(scene: RayScene, camera: Camera, points: Float[np.ndarray, "k 3"], depth: float) -> Bool[np.ndarray, " k"]:
    """Return which points lie more than `depth` [m] behind a surface, as seen by the camera."""
    eye = camera.T_world_camera[:3, 3]
    rays = points - eye
    hits = scene.first_hit(np.broadcast_to(eye, rays.shape).copy(), rays, 1.0)
    return (hits.face >= 0) & ((1 - hits.distance) * np.linalg.norm(rays, axis=1) > depth)


def box_of(mask: Bool[np.ndarray, "H W"]) -> Float[np.ndarray, " 4"]:
    """Return the bounding box x0, y0, x1, y1 of the pixels; pixel (0, 0) spans 0..1. Raise ValueError if there is none."""
    if not mask.any():
        raise ValueError("a box needs at least one pixel, found none")
    columns, rows = np.flatnonzero(mask.any(0)), np.flatnonzero(mask.any(1))
    return np.array([columns[0], rows[0], columns[-1] + 1, rows[-1] + 1], float)


def close_up(mesh: Mesh, view: View, face_part: Int[np.ndarray, " F"], part: int, scene: RayScene) -> View | None:
    """Return a close-up of a part that covers too few pixels of a view; None if it covers enough, or none."""
    mask = part_pixels(view, face_part, part)
    least = MIN_PART_PIXELS * (view.camera.height / REFERENCE_PX) ** 2
    if not 0 < mask.sum() < least:
        return None
    return shown(mesh, zoom(view.camera, box_of(mask), ZOOM_MARGIN, view.camera.height), scene)


def headlight_on(samples: Samples, camera: Camera) -> Float32[np.ndarray, " n"]:
    """Return the brightness of each ray's surface under light that moves with the camera.

    One lamp is at the camera and one above its left shoulder; the sky adds the rest. No visible side is dark, and sides of
    different directions differ in brightness.
    """
    right, down, ahead = camera.T_world_camera[:3, :3].T.astype(np.float32)
    shoulder = -ahead - np.float32(0.9) * down - np.float32(0.7) * right
    light = np.full(len(samples.normal), HEAD_AMBIENT + HEAD_SKY / 2, np.float32)
    for lamp, strength in ((-ahead, HEAD), (shoulder / np.linalg.norm(shoulder), SHOULDER)):
        light += strength * np.maximum(dot(samples.normal, lamp), 0)
    return light + HEAD_SKY / 2 * samples.normal[:, 2]
