"""`anymesh finish`: Stage C on the command line."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from anymesh.cli.options import Completion, Formats, Json, MaxCalls, Out, Quiet, Running, with_options
from anymesh.cli.output import Shown, print_asset

Asset = Annotated[Path, typer.Argument(metavar="DIR", help="An output of `anymesh articulate`.")]


@with_options
def finish(
    folder: Asset,
    out: Out,
    *,
    completion: Completion,
    max_calls: MaxCalls = None,
    writing: Formats,
    running: Running,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Complete shapes and textures of the asset in DIR: inner walls, drawer boxes, thickness, textures of new faces."""
    from anymesh.finishing.finishing import finish as finish_asset

    with Shown(quiet or json_) as progress:
        asset = finish_asset(folder, out, max_calls=max_calls, progress=progress, **completion, **writing, **running)
    print_asset(asset, out, json_, quiet)
