"""`anymesh picture`: the suffix of the file determines the kind of picture."""

from __future__ import annotations

import os
from pathlib import Path

from PIL import Image

from anymesh.errors import InputError, OptionError, OutputError
from anymesh.progress import Progress, silent
from anymesh.types import Asset
from anymesh.viewer.pictures import Turntable, contact_sheet, film, gif_bytes
from anymesh.viewer.pictures_mp4_ import write_mp4
from anymesh.viewer.report_asset import find_assets, read_asset
from anymesh.viewer.report_display import displayed

FACES = 200_000  # number of faces above which an asset is decimated before it is drawn
KINDS = ".gif or .mp4 (a turntable of one asset), .png (a contact sheet)"


def write_picture(
    folder: str | Path,
    out: str | Path,
    *,
    size: int = 400,
    rate: float = 12.5,
    turn: float = 360.0,
    materials: bool = False,
    columns: int = 4,
    progress: Progress = silent,
) -> Path:
    """Write a turntable of the asset in `folder` (out: .gif or .mp4), or a contact sheet of those below it (out: .png).

    size [px], rate [frames per second], turn [deg] and materials: as in `Turntable`. The same folder gives the same bytes of a
    GIF or PNG.
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
    try:
        how = Turntable(size - size % 2, rate, turn, materials)
    except ValueError as error:
        raise OptionError(str(error)) from error
    found = find_assets(folder)
    if kind != ".png" and len(found) > 1:
        raise OptionError(f"{folder} holds {len(found)} assets; a turntable is of one, a contact sheet (.png) of many")
    try:
        if kind == ".png":
            _write_sheet(folder, found, out, columns, progress)
        else:
            _write_film(found[0], out, how, progress)
    except OSError as error:
        raise OutputError(f"cannot write {out}: {os.strerror(error.errno) if error.errno else error}") from error
    return out


def _write_sheet(folder: Path, found: list[Path], out: Path, columns: int, progress: Progress) -> None:
    assets: list[tuple[str, Asset | None]] = []
    for k, place in enumerate(found):
        progress("picture", place.name, k, len(found))
        title = place.resolve().name if place == folder else place.relative_to(folder).as_posix()
        try:
            assets.append((title, displayed(read_asset(place), faces=FACES)[0]))
        except InputError:
            assets.append((title, None))
    Image.fromarray(contact_sheet(assets, columns=columns)).save(out, "PNG")


def _write_film(place: Path, out: Path, how: Turntable, progress: Progress) -> None:
    asset = displayed(read_asset(place), faces=FACES)[0]
    progress("picture", asset.name, 0, 1)
    if out.suffix.lower() == ".mp4":
        write_mp4(film(asset, how), out, how.rate)
    else:
        out.write_bytes(gif_bytes(list(film(asset, how)), how.rate))
