"""Options shared by several commands."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

MeshPath = Annotated[Path, typer.Argument(metavar="MESH", help="GLB, glTF, OBJ, PLY, STL, OFF or DAE.")]
Folder = Annotated[Path, typer.Argument(metavar="DIR", help="A folder that `anymesh segment` made.")]
FolderPath = Annotated[
    Path, typer.Argument(metavar="FOLDER", help="An output of `anymesh articulate`, or a folder with several of them.")
]
Out = Annotated[Path, typer.Option("--out", "-o", metavar="DIR", help="Folder to write.")]
Parts = Annotated[str, typer.Option(help="auto, nodes (the scene's nodes), or a .npy/.json file of face labels.")]
AnswererName = Annotated[
    str,
    typer.Option(
        "--answerer",
        help="geometry, openai:MODEL, openai-responses:MODEL, anthropic:MODEL, google:MODEL, ollama:MODEL, lmstudio:MODEL, "
        "vllm:MODEL, openai-compatible:BASE_URL#MODEL, files:FOLDER (answers in files), replay:FOLDER, "
        "or auto (a local model, else geometry).",
    ),
]
Category = Annotated[str | None, typer.Option(help="What the object is; used by models, not by geometry.")]
PartsList = Annotated[
    str,
    typer.Option(
        "--parts-list", metavar="LABELS", help="Labels of the moving parts, such as door,drawer, instead of asking a model."
    ),
]
AtLeast = Annotated[
    int,
    typer.Option("--at-least", metavar="N", help="Parts accepted regardless of evidence; 1 if the object is known to move."),
]
Proposer = Annotated[str, typer.Option(help="Source of masks for a model: exact, sam:WEIGHTS or exact+sam:WEIGHTS.")]
Viewpoints = Annotated[
    str,
    typer.Option(
        "--views", "--viewpoints", help="For a model: cameras as COUNT@ELEVATION[+AZIMUTH],... in degrees; 8@15 is the paper's."
    ),
]
VERIFY_HELP = "motion: a model chooses among motions; free: its picks are used unless blocked; off: the paper's method."
Verify = Annotated[str, typer.Option(help=VERIFY_HELP)]
MaxCalls = Annotated[int | None, typer.Option("--max-calls", help="Maximum number of model calls.")]
MaxCost = Annotated[float | None, typer.Option("--max-cost", metavar="USD", help="Maximum cost of model calls.")]
Cache = Annotated[
    str, typer.Option(metavar="DIR", help="Cache of model answers: auto (the user's cache folder), off, or a folder.")
]
Timeout = Annotated[float, typer.Option("--timeout", metavar="SECONDS", help="Time-out of one model call.")]
Wait = Annotated[bool, typer.Option("--wait", help="With files:FOLDER, wait for missing answers.")]
Seed = Annotated[int, typer.Option(help="From 0 up; the same input and seed give the same bytes.")]
Up = Annotated[str, typer.Option(help="The file's up axis: auto, x, y, z.")]
Scale = Annotated[str, typer.Option(help="auto, a factor to metres, or METRES:AXIS such as 0.9:z.")]
Root = Annotated[
    Path | None,
    typer.Option("--root", metavar="FOLDER", help="Folder for textures, and for package:// and model:// references."),
]
FORMATS = "urdf,mjcf,sdf,glb"
Package = Annotated[
    Path | None, typer.Option(metavar="DIR", help="Also write a ROS 2 package of the URDF, as a new folder in DIR.")
]
Zip = Annotated[Path | None, typer.Option("--zip", metavar="FILE", help="Also write the asset as one zip file.")]
BaseName = Annotated[str, typer.Option("--base", help="fixed or free: whether the root link is fixed to the world.")]
Formats = Annotated[str, typer.Option(help="Comma-separated, of urdf, mjcf, usd, sdf, glb; usd needs its extra.")]
Drives = Annotated[str, typer.Option(help="passive, or position: joints follow a commanded position, initially 0.")]
TimeLimit = Annotated[
    float, typer.Option("--time-limit", metavar="SECONDS", help="Stages shorten their work, with a warning, past shares of it.")
]
Force = Annotated[bool, typer.Option("--force", help="Replace an existing output.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No progress, no summary.")]
