"""The views that a model is shown (paper, 3.2 and 3.3): eight cameras round the object, the best view of a part, close-ups."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8

from anymesh.config import ViewsConfig
from anymesh.rendering.raycast_ import RayScene
from anymesh.rendering.render import BACKGROUND, View, render, shade
from anymesh.types import Mesh
from anymesh.types.camera import Camera

SIDES = ("front", "front right", "right", "back right", "back", "back left", "left", "front left")
EDGE = 10  # difference of neighbouring pixels (0..255) from which they are drawn smoothly


def views(mesh: Mesh, config: ViewsConfig, *, size: int | None = None, scene: RayScene | None = None) -> list[View]:
    """The views round the object, the first from its front (the -y side), then counterclockwise seen from above.

    size: [px] both ways, `config.size` if None; scene: of this very mesh, when it is cast at again.
    """
    scene = scene or RayScene(mesh.vertices, mesh.faces)
    return [shown(mesh, camera, scene) for camera in cameras(mesh.bounds, config, size or config.size)]


def cameras(bounds: Float[np.ndarray, "2 3"], config: ViewsConfig, size: int) -> list[Camera]:
    """The cameras of `views`, which look at the middle of the bounding box."""
    center, diagonal = bounds.mean(0), float(np.linalg.norm(bounds[1] - bounds[0]))
    high = np.deg2rad(config.elevation)
    found = []
    for azimuth in np.deg2rad(config.azimuth_step) * np.arange(config.count):
        eye = center + config.distance * diagonal * away(azimuth, high)
        found.append(Camera.looking_at(eye, center, float(np.deg2rad(config.fov)), size, size))
    return found


def away(azimuth: float, elevation: float) -> Float[np.ndarray, " 3"]:
    """Unit vector from the object to the camera; azimuth 0 looks along +y, 90 degrees along -x."""
    return np.array([np.sin(azimuth) * np.cos(elevation), -np.cos(azimuth) * np.cos(elevation), np.sin(elevation)])


def orbit_camera(bounds: Float[np.ndarray, "2 3"], azimuth: float, elevation: float, size: int) -> Camera:
    """A camera that sees the whole box, from an azimuth (0 looks along +y) and an elevation [rad]."""
    center = bounds.mean(0)
    radius = 0.5 * float(np.linalg.norm(bounds[1] - bounds[0]))
    fov = np.deg2rad(32)
    return Camera.looking_at(center + away(azimuth, elevation) * radius * 1.02 / np.sin(fov / 2), center, fov, size, size)


def caption(number: int, config: ViewsConfig) -> str:
    """A view in words; views are counted from 0 in code and from 1 in words."""
    side = SIDES[round(number * config.azimuth_step / 45) % 8]
    slightly = "slightly " if abs(config.elevation) < 35 else ""
    height = "" if abs(config.elevation) < 5 else f", {slightly}{'above' if config.elevation > 0 else 'below'}"
    return f"view {number + 1}: from the {side}{height}"


def shown(mesh: Mesh, camera: Camera, scene: RayScene) -> View:
    """A view whose colours are smooth at edges: four rays a pixel there. The other buffers stay exact."""
    view = render(mesh, camera, scene=scene)
    color = view.color.astype(int)
    edge = np.zeros(view.face.shape, bool)
    for axis in (0, 1):
        steps = np.abs(np.diff(color, axis=axis)).max(-1) > EDGE
        before, after = ((slice(None),) * axis + (s,) for s in (slice(None, -1), slice(1, None)))
        edge[before] |= steps
        edge[after] |= steps
    rows = np.flatnonzero(edge)
    origins, directions = (a[rows] for a in camera.rays())
    right, down = camera.T_world_camera[:3, 0], camera.T_world_camera[:3, 1]
    mean = np.zeros((len(rows), 3))
    for dx, dy in ((-0.25, -0.25), (0.25, -0.25), (-0.25, 0.25), (0.25, 0.25)):
        turned = directions + (dx * right + dy * down) / camera.focal
        mean += shade(mesh, scene.first_hit(origins, turned), turned)[0] / 4
    color[edge] = np.round(mean)
    return replace(view, color=color.astype(np.uint8))


def normal_picture(view: View) -> UInt8[np.ndarray, "H W 3"]:
    """Normals as colours, x y z of the asset frame to red green blue; the background as in `View.color`."""
    color = np.round(127.5 * (view.normal + 1))
    color[view.face < 0] = BACKGROUND
    return color.astype(np.uint8)


def part_pixels(view: View, face_part: Int[np.ndarray, " F"], part: int) -> Bool[np.ndarray, "H W"]:
    """Where a view shows a part: pixels whose first hit is one of its faces."""
    return (view.face >= 0) & (face_part[view.face] == part)


def visible_pixels(view: View, face_part: Int[np.ndarray, " F"], part: int) -> int:
    """How many pixels show a part, what hides it taken into account."""
    return int(part_pixels(view, face_part, part).sum())


def best_view(views: Sequence[View], face_part: Int[np.ndarray, " F"], part: int) -> int:
    """The number of the view with most pixels of a part (paper, 3.3); the first of those that have as many."""
    return int(np.argmax([visible_pixels(v, face_part, part) for v in views]))


def hidden_points(scene: RayScene, camera: Camera, points: Float[np.ndarray, "k 3"], depth: float) -> Bool[np.ndarray, " k"]:
    """Which points lie behind a surface by more than `depth` [m], as the camera sees them."""
    eye = camera.T_world_camera[:3, 3]
    rays = points - eye
    hits = scene.first_hit(np.broadcast_to(eye, rays.shape).copy(), rays, 1.0)
    return (hits.face >= 0) & ((1 - hits.distance) * np.linalg.norm(rays, axis=1) > depth)


def box_of(mask: Bool[np.ndarray, "H W"]) -> Float[np.ndarray, " 4"]:
    """The pixels' bounding box x0, y0, x1, y1, pixel (0, 0) being 0..1. Raises ValueError when there is none."""
    if not mask.any():
        raise ValueError("a box needs at least one pixel, found none")
    columns, rows = np.flatnonzero(mask.any(0)), np.flatnonzero(mask.any(1))
    return np.array([columns[0], rows[0], columns[-1] + 1, rows[-1] + 1], float)


def zoom(camera: Camera, box: Float[np.ndarray, " 4"], margin: float, size: int) -> Camera:
    """A camera at the same place that is turned at a box of the picture (x0, y0, x1, y1 [px]) and sees just that.

    margin: added on each side, a share of the box. Nothing is cut from a finer picture: rays are exact at any fineness.
    """
    low, high = box[:2] - margin * (box[2:] - box[:2]), box[2:] + margin * (box[2:] - box[:2])
    corners = np.array([[low[0], low[1]], [high[0], low[1]], [low[0], high[1]], [high[0], high[1]], (low + high) / 2])
    flat = (corners - np.array([camera.width, camera.height]) / 2) / camera.focal
    eye = camera.T_world_camera[:3, 3]
    points = eye + np.concatenate([flat, np.ones((5, 1))], 1) @ camera.T_world_camera[:3, :3].T
    turned = Camera.looking_at(eye, points[4], np.pi / 2, size, size)
    half = np.abs(turned.project(points[:4])[0] / (size / 2) - 1).max()  # the tangent, as 45 degrees have 1
    return replace(turned, fov=float(2 * np.arctan(half)))


def close_up(
    mesh: Mesh, view: View, face_part: Int[np.ndarray, " F"], part: int, config: ViewsConfig, scene: RayScene
) -> View | None:
    """A close-up of a part that covers too little of a view; None when it covers enough, or nothing.

    `config.zoom_below` counts pixels of a picture of `config.size`.
    """
    mask = part_pixels(view, face_part, part)
    least = config.zoom_below * (view.camera.height / config.size) ** 2
    if not 0 < mask.sum() < least:
        return None
    return shown(mesh, zoom(view.camera, box_of(mask), config.zoom_margin, view.camera.height), scene)
