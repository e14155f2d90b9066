"""Options shared by several commands."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from anymesh.cli.from_options import OptionsOf, option_of
from anymesh.pipeline.options import AnswererOptions, CompletionOptions, FormatOptions, PlacementOptions, RunOptions

MeshPath = Annotated[Path, typer.Argument(metavar="MESH", help="GLB, glTF, OBJ, PLY, STL, OFF or DAE.")]
Folder = Annotated[Path, typer.Argument(metavar="DIR", help="A folder that `anymesh segment` made.")]
FolderPath = Annotated[
    Path, typer.Argument(metavar="FOLDER", help="An output of `anymesh articulate`, or a folder with several of them.")
]
Out = Annotated[Path, typer.Option("--out", "-o", metavar="DIR", help="Folder to write.")]
Parts = Annotated[str, typer.Option(help="auto, nodes (the scene's nodes), or a .npy/.json file of face labels.")]
Answering = Annotated[dict[str, Any], OptionsOf(AnswererOptions)]
Placement = Annotated[dict[str, Any], OptionsOf(PlacementOptions)]
Completion = Annotated[dict[str, Any], OptionsOf(CompletionOptions)]
Formats = Annotated[dict[str, Any], OptionsOf(FormatOptions)]
Running = Annotated[dict[str, Any], OptionsOf(RunOptions)]
Time = Annotated[dict[str, Any], OptionsOf(RunOptions, without=("force",))]
Force = Annotated[bool, option_of(RunOptions, "force")]
MaxCalls = Annotated[int | None, option_of(AnswererOptions, "max_calls")]
Root = Annotated[Path | None, option_of(PlacementOptions, "root")]
Seed = Annotated[int, option_of(AnswererOptions, "seed")]
Package = Annotated[
    Path | None, typer.Option(metavar="DIR", help="Also write a ROS 2 package of the URDF, as a new folder in DIR.")
]
Zip = Annotated[Path | None, typer.Option("--zip", metavar="FILE", help="Also write the asset as one .zip file.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No progress, no summary.")]
