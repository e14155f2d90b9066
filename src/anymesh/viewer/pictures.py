"""Turntables of the motion of an asset, by the project's own renderer, and the encoding of films as GIF."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import UInt8
from PIL import Image

from anymesh.export.glb import tracks
from anymesh.export.model import ExportConfig
from anymesh.geometry.kinematics import posed
from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.drawing import (
    Window,
    draw,
    face_colors,
    ground,
    light_on,
    material_colors,
    render_target,
    sample,
    smoothed,
)
from anymesh.rendering.preview import best_camera, part_colors, shown_position
from anymesh.rendering.viewpoints import away
from anymesh.types import Asset, Mesh
from anymesh.types.camera import Camera

ELEVATION = 20.0  # [deg] elevation of the turntable's camera
LOOPS = 3  # number of motions through every joint's range per turn: open at 60 and 300 degrees, where the front is visible
COLORS = 255  # of a GIF; the index after them is transparent
ROOM = 1.12  # factor of the margin around the object, with its outline
REACHED = 5  # number of positions along a range, from limit to limit, that must be in the picture


@dataclass(frozen=True)
class Turntable:
    """Settings of a turntable.

    size [px]; rate: frames per second; turn [deg]: a full one, or less to swing around the front.
    """

    size: int = 400
    rate: float = 12.5
    turn: float = 360.0
    materials: bool = False  # use the object's materials instead of a colour per part

    def __post_init__(self) -> None:
        if not 16 <= self.size <= 4096:
            raise ValueError(f"size must lie in 16..4096 pixels, found {self.size}")
        if not 1 <= self.rate <= 60:
            raise ValueError(f"rate must lie in 1..60 frames a second, found {self.rate}")
        if not 0 <= self.turn <= 360:
            raise ValueError(f"turn must lie in 0..360 degrees, found {self.turn}")


def film(asset: Asset, how: Turntable) -> Iterator[UInt8[np.ndarray, "H W 3"]]:
    """Yield the frames of a loop: the camera turns while every joint moves through its range and back, as in the GLB."""
    moving = tracks(asset.joints, ExportConfig())
    length = LOOPS * float(max((t.times[-1] for t in moving), default=4.0))
    count = max(2, round(length * how.rate))
    opened = posed(asset, {j.name: shown_position(j) for j in asset.joints})
    begin = best_camera(asset, opened, [RayScene(m.vertices, m.faces) for m in (asset.mesh, opened)])
    toward = -begin.T_world_camera[:3, 2]
    front = float(np.arctan2(toward[0], -toward[1]))
    points = np.concatenate([asset.mesh.vertices, *_reach(asset)])
    asset = replace(asset, mesh=smoothed(asset.mesh))
    color = None if how.materials else part_colors(asset)
    for frame in range(count):
        share = frame / count
        swing = how.turn * share if how.turn == 360 else how.turn / 2 * np.sin(2 * np.pi * share)
        camera = _camera(points, front + float(np.deg2rad(swing)), how.size)
        time = length * share % (length / LOOPS)
        mesh = posed(asset, {t.joint.name: float(np.interp(time, t.times, t.amounts)) for t in moving})
        yield drawn_pose(asset, mesh, camera, color)


def gif_bytes(frames: Sequence[UInt8[np.ndarray, "H W 3"]], rate: float) -> bytes:
    """Encode a looping GIF with one palette for all frames, to avoid flicker.

    Pixels that are the same as in the frame before are stored as transparent, which makes the file much smaller.
    """
    height = frames[0].shape[0]
    some = np.concatenate([f[:: max(1, height // 100), :: max(1, height // 100)] for f in frames])
    palette = Image.fromarray(some).quantize(COLORS, dither=Image.Dither.NONE)
    pages = [Image.fromarray(f).quantize(palette=palette, dither=Image.Dither.NONE) for f in frames]
    indices = [np.asarray(page) for page in pages]
    for page, last, this in zip(pages[1:], indices, indices[1:], strict=False):
        page.putdata(np.where(last == this, COLORS, this).ravel().tolist())
    buffer = io.BytesIO()
    pages[0].save(
        buffer,
        "GIF",
        save_all=True,
        append_images=pages[1:],
        duration=round(1000 / rate),
        loop=0,
        optimize=False,
        transparency=COLORS,
        disposal=1,
    )
    return buffer.getvalue()


def drawn_pose(
    asset: Asset, pose: Mesh, camera: Camera, color: UInt8[np.ndarray, "F 3"] | None, scene: RayScene | None = None
) -> UInt8[np.ndarray, "H W 3"]:
    """Draw the asset in a pose, with colours per face, or with its materials."""
    subject = render_target(pose, scene or RayScene(pose.vertices, pose.faces), asset.segmentation.face_part)
    samples = sample(subject, camera, Window(0, 0, camera.width, camera.height))
    look = material_colors(pose, samples) if color is None else face_colors(color, samples)
    return draw(samples, look, light_on(samples), ground(camera.height, camera.width))


def _camera(points: np.ndarray, azimuth: float, size: int) -> Camera:
    """Return a camera with the same distance and centre for all azimuths."""
    center = (points.min(0) + points.max(0)) / 2
    around = float(np.linalg.norm(points[:, :2] - center[:2], axis=1).max())
    radius = float(np.hypot(around, np.ptp(points[:, 2]) / 2)) * ROOM
    fov = np.deg2rad(32)
    eye = center + away(azimuth, np.deg2rad(ELEVATION)) * radius / np.sin(fov / 2)
    return Camera.looking_at(eye, center, float(fov), size, size)


def _reach(asset: Asset) -> Iterator[np.ndarray]:
    """Yield the vertices with all joints at several positions of their ranges."""
    for share in np.linspace(0, 1, REACHED):
        at = {j.name: float(np.interp(share, (0, 1), j.limits or (-np.pi, np.pi))) for j in asset.joints}
        yield posed(asset, at).vertices
