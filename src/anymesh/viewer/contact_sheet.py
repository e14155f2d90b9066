"""Contact sheets of several assets, as one picture or as a film in which every joint moves."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import UInt8
from PIL import Image, ImageDraw

from anymesh.export.glb import tracks
from anymesh.export.model import ExportConfig
from anymesh.geometry.kinematics import posed
from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.drawing import smoothed
from anymesh.rendering.marks import axis_shapes, draw_axes, font
from anymesh.rendering.preview import best_camera, part_colors, shown_position
from anymesh.rendering.viewpoints import zoom
from anymesh.types import Asset, JointType, Mesh
from anymesh.types.camera import Camera
from anymesh.viewer.pictures import drawn_pose

CELL = 300  # [px] size of a cell of a sheet
FILM_CELL = 200  # [px] size of a cell of a film, by default
BAR = 44  # [px] height of the text under a cell
STILL_S = 2.0  # [s] length of a film in which nothing moves
FITTED = 25  # number of moments of a film whose poses must be in the picture
MARGIN = 0.05  # margin on each side of the moving object in a cell of a film, as a share of its size


def contact_sheet(assets: Sequence[tuple[str, Asset | None]], *, columns: int = 4) -> UInt8[np.ndarray, "H W 3"]:
    """Draw a cell per asset: opened, with coloured parts and axes; below it title, joints and the lowest confidence.

    None: an asset that cannot be read, which its cell states.
    """
    return _laid_out(assets, [None if asset is None else _opened(asset) for _, asset in assets], CELL, columns)


def sheet_film(
    assets: Sequence[tuple[str, Asset | None]],
    *,
    size: int = FILM_CELL,
    rate: float = 12.5,
    materials: bool = False,
    columns: int = 4,
) -> Iterator[UInt8[np.ndarray, "H W 3"]]:
    """Yield the frames of a loop: a contact sheet in which every joint moves through its range and back, as in the GLB.

    size: of a cell [px]; rate [frames per second]; materials: instead of a colour per part. The cameras do not move. An asset
    whose motion is shorter than that of another is repeated.
    """
    scenes = [None if asset is None else _moving(asset, size, materials) for _, asset in assets]
    length = max((scene[0] for scene in scenes if scene), default=STILL_S)
    count = max(2, round(length * rate))
    for frame in range(count):
        time = length * frame / count
        cells = [None if scene is None else scene[1](time % scene[0]) for scene in scenes]
        yield _laid_out(assets, cells, size, columns)


def _moving(asset: Asset, size: int, materials: bool) -> tuple[float, Callable[[float], UInt8[np.ndarray, "h w 3"]]]:
    """Return the length of an asset's motion [s], and a function that draws it at a time [s]."""
    moving = tracks(asset.joints, ExportConfig())
    length = float(max((t.times[-1] for t in moving), default=STILL_S))
    asset = replace(asset, mesh=smoothed(asset.mesh))
    color = None if materials else part_colors(asset)

    def pose(time: float) -> Mesh:
        return posed(asset, {t.joint.name: float(np.interp(time, t.times, t.amounts)) for t in moving})

    opened = posed(asset, {j.name: shown_position(j) for j in asset.joints})
    viewpoint = best_camera(asset, opened, [RayScene(m.vertices, m.faces) for m in (asset.mesh, opened)])
    pixel = viewpoint.project(np.concatenate([pose(time).vertices for time in np.linspace(0, length, FITTED)]))[0]
    camera = zoom(viewpoint, np.concatenate([pixel.min(0), pixel.max(0)]), MARGIN, size)
    return length, lambda time: drawn_pose(asset, pose(time), camera, color)


def _opened(asset: Asset) -> UInt8[np.ndarray, "h w 3"]:
    asset = replace(asset, mesh=smoothed(asset.mesh))
    at = {j.name: shown_position(j) for j in asset.joints}
    opened = posed(asset, at)
    scene = RayScene(opened.vertices, opened.faces)
    viewpoint = best_camera(asset, opened, [RayScene(asset.mesh.vertices, asset.mesh.faces), scene])
    camera = Camera(viewpoint.T_world_camera, viewpoint.fov, CELL, CELL)
    return draw_axes(drawn_pose(asset, opened, camera, part_colors(asset), scene), axis_shapes(asset, at), camera, scale=0.8)


def _laid_out(
    assets: Sequence[tuple[str, Asset | None]], cells: Sequence[UInt8[np.ndarray, "h w 3"] | None], size: int, columns: int
) -> UInt8[np.ndarray, "H W 3"]:
    """Arrange the cells in rows, each with the title of its asset and a summary below it."""
    if not assets or columns < 1:
        raise ValueError(f"a sheet needs assets and columns, found {len(assets)} and {columns}")
    columns = min(columns, len(assets))
    rows = -(-len(assets) // columns)
    sheet = Image.new("RGB", (columns * size, rows * (size + BAR)), (255, 255, 255))
    pen = ImageDraw.Draw(sheet)
    for k, ((title, asset), cell) in enumerate(zip(assets, cells, strict=True)):
        x, y = k % columns * size, k // columns * (size + BAR)
        if cell is not None:
            sheet.paste(Image.fromarray(cell), (x, y))
        _words(pen, (x, y + size), size, title, _summary(asset))
        pen.rectangle([x, y, x + size - 1, y + size + BAR - 1], outline=(210, 210, 210))
    return np.asarray(sheet)


def _summary(asset: Asset | None) -> str:
    if asset is None:
        return "cannot be shown"
    moving = [j for j in asset.joints if j.type is not JointType.FIXED]
    if not moving:
        return "nothing moves"
    warned = f", {len(asset.warnings)} warnings" if len(asset.warnings) > 1 else ", a warning" if asset.warnings else ""
    lowest = min(j.confidence for j in moving)
    return f"{len(moving)} joint{'s' if len(moving) > 1 else ''}, min. confidence {lowest:.2f}{warned}"


def _words(pen: ImageDraw.ImageDraw, corner: tuple[int, int], width: int, title: str, summary: str) -> None:
    plain = title.encode("ascii", "replace").decode()
    letters = font(16)
    while pen.textlength(plain, font=letters) > width - 16 and len(plain) > 4:
        plain = f"...{plain[4:]}" if plain.startswith("...") else f"...{plain[3:]}"
    x, y = corner
    pen.text((x + 8, y + 2), plain, fill=(20, 20, 20), font=letters)
    small = font(14 if pen.textlength(summary, font=font(14)) <= width - 12 else 12)
    pen.text((x + 8, y + 22), summary, fill=(90, 90, 90), font=small)
