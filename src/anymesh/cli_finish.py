"""`anymesh finish`: Stage C on the command line."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from anymesh.cli_output import Shown, tell_asset

Asset = Annotated[Path, typer.Argument(metavar="DIR", help="An output of `anymesh articulate`.")]
Out = Annotated[Path, typer.Option("--out", "-o", metavar="DIR", help="Folder to write.")]
Completer = Annotated[str, typer.Option(help="Of shapes: builtin, off, holopart:FOLDER[#PYTHON] or holopart:URL.")]
Texture = Annotated[str, typer.Option(help="builtin, bake[:PIXELS] (one atlas), or meshy[:PROMPT], which is paid.")]
Watertight = Annotated[bool, typer.Option(help="Also close what no motion ever lays open.")]
MaxCalls = Annotated[int | None, typer.Option("--max-calls", help="No paid task beyond so many.")]
BaseName = Annotated[str, typer.Option("--base", help="fixed or free: whether the root link is fixed to the world.")]
Formats = Annotated[str, typer.Option(help="Of urdf, mjcf, usd, sdf, glb, with commas between; usd needs its extra.")]
Drives = Annotated[str, typer.Option(help="passive, or position: joints are led to a commanded position, 0 at first.")]
Force = Annotated[bool, typer.Option("--force", help="Replace an existing output.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No progress, no summary.")]


def finish(
    folder: Asset,
    out: Out,
    completer: Completer = "builtin",
    texture: Texture = "builtin",
    watertight: Watertight = True,
    max_calls: MaxCalls = None,
    base: BaseName = "fixed",
    formats: Formats = "urdf,mjcf,sdf,glb",
    drives: Drives = "passive",
    force: Force = False,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Completes shapes and looks of the asset in DIR: inner walls, drawer boxes, thickness, textures of new faces."""
    from anymesh import pipeline

    with Shown(quiet or json_) as progress:
        asset = pipeline.finish(
            folder, out, completer=completer, texture=texture, watertight=watertight, max_calls=max_calls, base=base,
            formats=formats, drives=drives, force=force, progress=progress,
        )  # fmt: skip
    tell_asset(asset, out, json_, quiet)
