"""`anymesh finish`: Stage C on the command line."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from anymesh.cli.options import FORMATS, BaseName, Drives, Force, Formats, Json, MaxCalls, Out, Quiet, TimeLimit
from anymesh.cli.output import Shown, tell_asset
from anymesh.deadline import DEFAULT_SECONDS

Asset = Annotated[Path, typer.Argument(metavar="DIR", help="An output of `anymesh articulate`.")]
Completer = Annotated[str, typer.Option(help="Completer of shapes: builtin, off, holopart:FOLDER(#PYTHON) or holopart:URL.")]
Texture = Annotated[str, typer.Option(help="builtin, bake or bake:PIXELS (one atlas), meshy or meshy:PROMPT (paid).")]
Watertight = Annotated[bool, typer.Option(help="Also close surfaces that no motion uncovers.")]


def finish(
    folder: Asset,
    out: Out,
    completer: Completer = "builtin",
    texture: Texture = "builtin",
    watertight: Watertight = True,
    max_calls: MaxCalls = None,
    base: BaseName = "fixed",
    formats: Formats = FORMATS,
    drives: Drives = "passive",
    force: Force = False,
    time_limit: TimeLimit = DEFAULT_SECONDS,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Complete shapes and textures of the asset in DIR: inner walls, drawer boxes, thickness, textures of new faces."""
    from anymesh import pipeline

    with Shown(quiet or json_) as progress:
        asset = pipeline.finish(
            folder, out, completer=completer, texture=texture, watertight=watertight, max_calls=max_calls, base=base,
            formats=formats, drives=drives, force=force, time_limit=time_limit, progress=progress,
        )  # fmt: skip
    tell_asset(asset, out, json_, quiet)
