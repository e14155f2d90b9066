"""The command line of `anymesh report`."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from anymesh.cli.options import FolderPath, Json, Quiet
from anymesh.cli.output import Shown, plain

Page = Annotated[
    Path | None, typer.Option("--out", "-o", metavar="FILE", help="The HTML file; default: FOLDER_report.html beside FOLDER.")
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
        written = write_report(folder, out, faces=faces, megabytes=megabytes, progress=progress)
    if json_:
        typer.echo(json.dumps(asdict(written) | {"path": str(written.path)}, indent=2))
    elif not quiet:
        lines = [f"cannot be shown: {name}" for name in written.unreadable] + list(written.notes)
        count = f"{written.assets} asset{'s' if written.assets != 1 else ''}"
        lines.append(f"wrote {written.path}: {count}, {written.size / 1e6:.1f} MB")
        typer.echo("\n".join(plain(line) for line in lines))
