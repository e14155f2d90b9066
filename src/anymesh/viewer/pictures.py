"""Pictures by the project's own renderer: a turntable of the motion, and a contact sheet of many assets."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import UInt8
from PIL import Image, ImageDraw

from anymesh.export.animation import tracks
from anymesh.export.settings import ExportConfig
from anymesh.geometry.kinematics import posed
from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.axes import axis_shapes, draw_axes
from anymesh.rendering.drawing import draw, face_colors, ground, light_on, material_colors, render_target
from anymesh.rendering.labels import font
from anymesh.rendering.preview import best_camera, part_colors, shown_position
from anymesh.rendering.samples import Window, sample
from anymesh.rendering.smooth import smoothed
from anymesh.rendering.viewpoints import away
from anymesh.types import Asset, JointType, Mesh
from anymesh.types.camera import Camera

ELEVATION = 20.0  # [deg] elevation of the turntable's camera
LOOPS = 3  # number of motions through every joint's range per turn: open at 60 and 300 degrees, where the front is visible
COLORS = 256  # of a GIF
CELL = 300  # [px] size of a cell of a contact sheet
BAR = 44  # [px] height of the text under a cell
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
        yield _drawn(asset, mesh, camera, color)


def gif_bytes(frames: Sequence[UInt8[np.ndarray, "H W 3"]], rate: float) -> bytes:
    """Encode a looping GIF with one palette for all frames, to avoid flicker."""
    height = frames[0].shape[0]
    some = np.concatenate([f[:: max(1, height // 100), :: max(1, height // 100)] for f in frames])
    palette = Image.fromarray(some).quantize(COLORS, dither=Image.Dither.NONE)
    pages = [Image.fromarray(f).quantize(palette=palette, dither=Image.Dither.NONE) for f in frames]
    buffer = io.BytesIO()
    pages[0].save(buffer, "GIF", save_all=True, append_images=pages[1:], duration=round(1000 / rate), loop=0, optimize=False)
    return buffer.getvalue()


def contact_sheet(assets: Sequence[tuple[str, Asset | None]], *, columns: int = 4) -> UInt8[np.ndarray, "H W 3"]:
    """Draw a cell per asset: opened, with coloured parts and axes; below it title, joints and the lowest confidence.

    None: an asset that cannot be read, which its cell states.
    """
    if not assets or columns < 1:
        raise ValueError(f"a sheet needs assets and columns, found {len(assets)} and {columns}")
    columns = min(columns, len(assets))
    rows = -(-len(assets) // columns)
    sheet = Image.new("RGB", (columns * CELL, rows * (CELL + BAR)), (255, 255, 255))
    pen = ImageDraw.Draw(sheet)
    for k, (title, asset) in enumerate(assets):
        x, y = k % columns * CELL, k // columns * (CELL + BAR)
        if asset is not None:
            sheet.paste(Image.fromarray(_opened(asset)), (x, y))
        _words(pen, x, y + CELL, title, _told(asset))
        pen.rectangle([x, y, x + CELL - 1, y + CELL + BAR - 1], outline=(210, 210, 210))
    return np.asarray(sheet)


def _opened(asset: Asset) -> UInt8[np.ndarray, "h w 3"]:
    asset = replace(asset, mesh=smoothed(asset.mesh))
    at = {j.name: shown_position(j) for j in asset.joints}
    opened = posed(asset, at)
    scene = RayScene(opened.vertices, opened.faces)
    found = best_camera(asset, opened, [RayScene(asset.mesh.vertices, asset.mesh.faces), scene])
    camera = Camera(found.T_world_camera, found.fov, CELL, CELL)
    return draw_axes(_drawn(asset, opened, camera, part_colors(asset), scene), axis_shapes(asset, at), camera, scale=0.8)


def _drawn(
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


def _told(asset: Asset | None) -> str:
    if asset is None:
        return "cannot be shown"
    moving = [j for j in asset.joints if j.type is not JointType.FIXED]
    if not moving:
        return "nothing moves"
    warned = f", {len(asset.warnings)} warnings" if len(asset.warnings) > 1 else ", a warning" if asset.warnings else ""
    return f"{len(moving)} joint{'s' if len(moving) > 1 else ''}, least sure {min(j.confidence for j in moving):.2f}{warned}"


def _words(draw: ImageDraw.ImageDraw, x: int, y: int, title: str, told: str) -> None:
    plain = title.encode("ascii", "replace").decode()
    letters = font(16)
    while draw.textlength(plain, font=letters) > CELL - 16 and len(plain) > 4:
        plain = f"...{plain[4:]}" if plain.startswith("...") else f"...{plain[3:]}"
    draw.text((x + 8, y + 2), plain, fill=(20, 20, 20), font=letters)
    draw.text((x + 8, y + 22), told, fill=(90, 90, 90), font=font(14))
