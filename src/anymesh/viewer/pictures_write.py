"""`anymesh picture`: the suffix of the file determines the kind of picture."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from jaxtyping import UInt8
from PIL import Image

from anymesh.errors import InputError, OptionError, OutputError
from anymesh.runtime import Progress, silent
from anymesh.types import Asset
from anymesh.viewer.contact_sheet import FILM_CELL, contact_sheet, sheet_film
from anymesh.viewer.pictures import Turntable, film, gif_bytes
from anymesh.viewer.pictures_mp4_ import write_mp4
from anymesh.viewer.report_asset import find_assets, read_asset
from anymesh.viewer.report_display import displayed

FACES = 200_000  # number of faces above which an asset is decimated before it is drawn
KINDS = ".gif or .mp4 (a turntable of one asset, or a film of several), .png (a contact sheet)"
TURNTABLE = 400  # [px] width of a turntable, by default


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
    try:
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
    except OSError as error:
        raise OutputError(f"cannot write {out}: {os.strerror(error.errno) if error.errno else error}") from error
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
