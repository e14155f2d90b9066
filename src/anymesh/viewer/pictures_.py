"""`anymesh picture`: contact sheets and films of assets, by the project's own renderer, encoded as PNG, GIF or MP4."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import UInt8
from PIL import Image, ImageDraw

from anymesh.errors import InputError, MissingExtraError, OptionError, pip_install
from anymesh.export.glb import tracks
from anymesh.export.model import ExportConfig
from anymesh.geometry.kinematics import posed
from anymesh.geometry.raycast_ import RayScene
from anymesh.mechanisms.following import together
from anymesh.pipeline.results import verdict
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
from anymesh.rendering.marks import axis_shapes, draw_axes, font
from anymesh.rendering.preview import best_camera, opened_positions, opened_view, part_colors
from anymesh.rendering.viewpoints import away, framed
from anymesh.runtime import Progress, silent, writing
from anymesh.types import Asset, JointType, Mesh
from anymesh.types.camera import Camera
from anymesh.viewer.report_asset import displayed, find_assets, read_asset
from anymesh.viewer.scene import shown_range

ELEVATION = 20.0  # [deg] elevation of the turntable's camera
LOOPS = 3  # number of motions through every joint's range per turn: open at 60 and 300 degrees, where the front is visible
COLORS = 255  # of a GIF; the index after them is transparent
ROOM = 1.12  # factor of the margin around the object, with its outline
REACHED = 5  # number of positions along a range, from limit to limit, that must be in the picture
CELL = 300  # [px] size of a cell of a sheet
FILM_CELL = 200  # [px] size of a cell of a film, by default
BAR = 44  # [px] height of the text under a cell
STILL_S = 2.0  # [s] length of a film in which nothing moves
FITTED = 25  # number of moments of a film whose poses must be in the picture
MARGIN = 0.05  # margin on each side of the moving object in a cell of a film, as a share of its size
FACES = 200_000  # number of faces above which an asset is decimated before it is drawn
KINDS = ".gif or .mp4 (a turntable of one asset, or a film of several), .png (a contact sheet)"
TURNTABLE = 400  # [px] width of a turntable, by default


def write_mp4(frames: Iterable[UInt8[np.ndarray, "H W 3"]], path: Path, rate: float) -> None:
    """Write a widely playable MP4. rate: frames per second. Raise MissingExtraError without the package."""
    try:
        from imageio_ffmpeg import write_frames
    except ImportError as error:
        raise MissingExtraError(f"imageio-ffmpeg is missing; install it with {pip_install('video')}") from error
    writer = None
    for frame in frames:
        if writer is None:
            size = (frame.shape[1], frame.shape[0])
            writer = write_frames(str(path), size, fps=rate, codec="libx264", quality=8, macro_block_size=2)
            writer.send(None)
        writer.send(np.ascontiguousarray(frame))
    if writer is not None:
        writer.close()


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
    moving = tracks(asset, ExportConfig())
    length = LOOPS * float(max((t.times[-1] for t in moving), default=4.0))
    count = max(2, round(length * how.rate))
    toward = -opened_view(asset)[1].T_world_camera[:3, 2]
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
        at = {j.name: float(np.interp(share, (0, 1), shown_range(asset, j))) for j in asset.joints}
        yield posed(asset, together(asset, at) if asset.loops else at).vertices


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
    moving = tracks(asset, ExportConfig())
    length = float(max((t.times[-1] for t in moving), default=STILL_S))
    asset = replace(asset, mesh=smoothed(asset.mesh))
    color = None if materials else part_colors(asset)

    def pose(time: float) -> Mesh:
        return posed(asset, {t.joint.name: float(np.interp(time, t.times, t.amounts)) for t in moving})

    reached = np.concatenate([pose(time).vertices for time in np.linspace(0, length, FITTED)])
    camera = framed(opened_view(asset)[1], reached, MARGIN, size)
    return length, lambda time: drawn_pose(asset, pose(time), camera, color)


def _opened(asset: Asset) -> UInt8[np.ndarray, "h w 3"]:
    asset = replace(asset, mesh=smoothed(asset.mesh))
    at = opened_positions(asset)
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
    words = [verdict(asset.segmentation, j, asset.warnings).word for j in moving]
    said = [f"{words.count(w)} {text}" for w, text in (("check", "to check"), ("guess", "guessed")) if w in words]
    return f"{len(moving)} joint{'s' if len(moving) > 1 else ''}, {', '.join(said) or 'sure'}{warned}"


def _words(pen: ImageDraw.ImageDraw, corner: tuple[int, int], width: int, title: str, summary: str) -> None:
    plain = title.encode("ascii", "replace").decode()
    letters = font(16)
    while pen.textlength(plain, font=letters) > width - 16 and len(plain) > 4:
        plain = f"...{plain[4:]}" if plain.startswith("...") else f"...{plain[3:]}"
    x, y = corner
    pen.text((x + 8, y + 2), plain, fill=(20, 20, 20), font=letters)
    small = font(14 if pen.textlength(summary, font=font(14)) <= width - 12 else 12)
    pen.text((x + 8, y + 22), summary, fill=(90, 90, 90), font=small)


def write_picture(
    folder: str | Path,
    out: str | Path,
    *,
    size: int | None = None,
    rate: float = 12.5,
    turn: float = 360.0,
    materials: bool = False,
    columns: int = 4,
    progress: Progress = silent,
) -> Path:
    """Write a film of the motions of the assets in `folder` (out: .gif or .mp4), or a contact sheet of them (out: .png).

    One asset gives a turntable: size [px], rate [frames per second], turn [deg] and materials are those of `Turntable`. Several
    assets give a contact sheet in which the joints move, with cells of `size` pixels; turn is not used. The same folder gives
    the same bytes of a GIF or PNG.
    Raise InputError, OptionError, OutputError or MissingExtraError.
    """
    folder, out = Path(folder), Path(out)
    if not folder.is_dir():
        raise InputError(f"{folder} is not a folder; valid is one that `anymesh articulate` made, or a folder of such")
    kind = out.suffix.lower()
    if kind not in (".gif", ".mp4", ".png"):
        raise OptionError(f"found the file {out.name!r}; valid are names that end in {KINDS}")
    if columns < 1:
        raise OptionError(f"columns must be 1 or more, found {columns}")
    folders = find_assets(folder)
    several = len(folders) > 1
    size = size or (FILM_CELL if several else TURNTABLE)
    try:
        how = Turntable(size - size % 2, rate, turn, materials)
    except ValueError as error:
        raise OptionError(str(error)) from error
    with writing(out):
        if kind == ".png" or several:
            assets = _read_all(folder, folders, progress)
        if kind == ".png":
            Image.fromarray(contact_sheet(assets, columns=columns)).save(out, "PNG")
        elif several:
            moving = sheet_film(assets, size=how.size, rate=rate, materials=materials, columns=columns)
            _write_film(moving, out, rate)
        else:
            asset = displayed(read_asset(folders[0]), faces=FACES)[0]
            progress("picture", asset.name, 0, 1)
            _write_film(film(asset, how), out, rate)
    return out


def _read_all(folder: Path, folders: list[Path], progress: Progress) -> list[tuple[str, Asset | None]]:
    """Read the assets with their titles; None stands for one that cannot be read."""
    assets: list[tuple[str, Asset | None]] = []
    for k, place in enumerate(folders):
        progress("picture", place.name, k, len(folders))
        title = place.resolve().name if place == folder else place.relative_to(folder).as_posix()
        try:
            assets.append((title, displayed(read_asset(place), faces=FACES)[0]))
        except InputError:
            assets.append((title, None))
    return assets


def _write_film(frames: Iterable[UInt8[np.ndarray, "H W 3"]], out: Path, rate: float) -> None:
    if out.suffix.lower() == ".mp4":
        write_mp4(frames, out, rate)
    else:
        out.write_bytes(gif_bytes(list(frames), rate))
