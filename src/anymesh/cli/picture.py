"""The command line of `anymesh picture`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from anymesh.cli.options import FolderPath, Quiet
from anymesh.cli.output import Shown, plain

File = Annotated[
    Path, typer.Option("--out", "-o", metavar="FILE", help=".gif or .mp4: a film of the motions; .png: a contact sheet.")
]


def picture(
    folder: FolderPath,
    out: File,
    size: Annotated[
        int | None,
        typer.Option(help="Width of a turntable (default 400), or of a cell of a film of several assets (200), in pixels."),
    ] = None,
    rate: Annotated[float, typer.Option(help="Frames per second.")] = 12.5,
    turn: Annotated[float, typer.Option(help="Degrees that a turntable turns; less than 360 swings around the front.")] = 360.0,
    materials: Annotated[
        bool, typer.Option("--materials", help="Use the object's materials instead of a colour per part.")
    ] = False,
    columns: Annotated[int, typer.Option(help="Columns of a contact sheet, or of a film of several assets.")] = 4,
    quiet: Quiet = False,
) -> None:
    """Draw the assets in FOLDER: a contact sheet (.png), or a film of their motions (.gif, .mp4; of one asset a turntable)."""
    from anymesh.viewer.pictures_write import write_picture

    with Shown(quiet) as progress:
        path = write_picture(
            folder, out, size=size, rate=rate, turn=turn, materials=materials, columns=columns, progress=progress
        )
    if not quiet:
        typer.echo(plain(f"wrote {path}"))
