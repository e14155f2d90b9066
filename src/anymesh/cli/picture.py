"""The command line of `anymesh picture`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from anymesh.cli.options import FolderPath, Quiet
from anymesh.cli.output import Shown, plain

File = Annotated[
    Path, typer.Option("--out", "-o", metavar="FILE", help=".gif or .mp4: a turntable of the motion; .png: a contact sheet.")
]


def picture(
    folder: FolderPath,
    out: File,
    size: Annotated[int, typer.Option(help="Width of a turntable in pixels.")] = 400,
    rate: Annotated[float, typer.Option(help="Frames per second.")] = 12.5,
    turn: Annotated[float, typer.Option(help="Degrees; less than 360 swings around the front.")] = 360.0,
    materials: Annotated[
        bool, typer.Option("--materials", help="Use the object's materials instead of a colour per part.")
    ] = False,
    columns: Annotated[int, typer.Option(help="Columns of a contact sheet.")] = 4,
    quiet: Quiet = False,
) -> None:
    """Make a turntable of the motion of the asset in FOLDER (.gif, .mp4), or a contact sheet of all assets in it (.png)."""
    from anymesh.viewer.pictures_write import write_picture

    with Shown(quiet) as progress:
        path = write_picture(
            folder, out, size=size, rate=rate, turn=turn, materials=materials, columns=columns, progress=progress
        )
    if not quiet:
        typer.echo(plain(f"wrote {path}"))
