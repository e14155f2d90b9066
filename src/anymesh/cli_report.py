"""The command line of `anymesh report` and `anymesh picture`."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from anymesh.cli_options import Json, Quiet
from anymesh.cli_output import Shown, plain

FolderPath = Annotated[
    Path, typer.Argument(metavar="FOLDER", help="An output of `anymesh articulate`, or a folder with several of them.")
]
Page = Annotated[
    Path | None, typer.Option("--out", "-o", metavar="FILE", help="The HTML file; default: FOLDER_report.html beside FOLDER.")
]
File = Annotated[
    Path, typer.Option("--out", "-o", metavar="FILE", help=".gif or .mp4: a film of the motions; .png: a contact sheet.")
]


def report(
    folder: FolderPath,
    out: Page = None,
    faces: Annotated[
        int, typer.Option(min=1000, help="Number of faces above which an asset is decimated for display.")
    ] = 60_000,
    megabytes: Annotated[
        float, typer.Option(min=1, help="Maximum size of the page; content beyond it is left out with a note.")
    ] = 100.0,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Write one HTML file of every asset in FOLDER: 3D view with moving joints, warnings, tables. It works offline."""
    from anymesh.viewer.report import write_report

    with Shown(quiet or json_) as progress:
        told = write_report(folder, out, faces=faces, megabytes=megabytes, progress=progress)
    if json_:
        typer.echo(json.dumps(asdict(told) | {"path": str(told.path)}, indent=2))
    elif not quiet:
        lines = [f"cannot be shown: {name}" for name in told.unreadable] + list(told.notes)
        count = f"{told.assets} asset{'s' if told.assets != 1 else ''}"
        lines.append(f"wrote {told.path}: {count}, {told.size / 1e6:.1f} MB")
        typer.echo("\n".join(plain(line) for line in lines))


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
