"""Options that several commands take, once each."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

MeshPath = Annotated[Path, typer.Argument(metavar="MESH", help="GLB, glTF, OBJ, PLY, STL, OFF or DAE.")]
Folder = Annotated[Path, typer.Argument(metavar="DIR", help="A folder that `anymesh segment` made.")]
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
Category = Annotated[str | None, typer.Option(help="What the object is; a model is told, geometry does not use it.")]
PartsList = Annotated[
    str, typer.Option("--parts-list", metavar="LABELS", help="What moves, such as door,drawer; a model is not asked then.")
]
AtLeast = Annotated[
    int, typer.Option("--at-least", metavar="N", help="Parts taken however thin the evidence is; 1 for what is known to move.")
]
Proposer = Annotated[str, typer.Option(help="Of masks for a model: exact, sam:WEIGHTS or exact+sam:WEIGHTS.")]
Viewpoints = Annotated[
    str,
    typer.Option(
        "--views", "--viewpoints", help="For a model: cameras as COUNT@ELEVATION[+AZIMUTH],... in degrees; 8@15 is the paper's."
    ),
]
VERIFY_HELP = (
    "motion: a model chooses among motions; free: its picks are taken, replaced where blocked; off: the paper's method."
)
Verify = Annotated[str, typer.Option(help=VERIFY_HELP)]
MaxCalls = Annotated[int | None, typer.Option("--max-calls", help="No call of a model beyond so many.")]
MaxCost = Annotated[float | None, typer.Option("--max-cost", metavar="USD", help="No call that could pass this cost.")]
Cache = Annotated[
    str, typer.Option(metavar="DIR", help="Answers of models are kept here: auto (the user's cache folder), off, or a folder.")
]
Timeout = Annotated[float, typer.Option("--timeout", metavar="SECONDS", help="Of one call of a model.")]
Wait = Annotated[bool, typer.Option("--wait", help="With files:FOLDER, wait for an answer that is not there yet.")]
Seed = Annotated[int, typer.Option(help="From 0 up; same input and seed, same bytes.")]
Up = Annotated[str, typer.Option(help="The file's up axis: auto, x, y, z.")]
Scale = Annotated[str, typer.Option(help="auto, a factor to metres, or METRES:AXIS such as 0.9:z.")]
Root = Annotated[
    Path | None,
    typer.Option("--root", metavar="FOLDER", help="Textures may be read within it, and package://, model:// resolve in it."),
]
FORMATS = "urdf,mjcf,sdf,glb"
Package = Annotated[Path | None, typer.Option(metavar="DIR", help="Also a ROS 2 package of the URDF, as a new folder in DIR.")]
Zip = Annotated[Path | None, typer.Option("--zip", metavar="FILE", help="Also the asset as one zip file.")]
BaseName = Annotated[str, typer.Option("--base", help="fixed or free: whether the root link is fixed to the world.")]
Formats = Annotated[str, typer.Option(help="Of urdf, mjcf, usd, sdf, glb, with commas between; usd needs its extra.")]
Drives = Annotated[str, typer.Option(help="passive, or position: joints are led to a commanded position, 0 at first.")]
TimeLimit = Annotated[
    float, typer.Option("--time-limit", metavar="SECONDS", help="Past shares of it stages cut their work short and say so.")
]
Force = Annotated[bool, typer.Option("--force", help="Replace an existing output.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No progress, no summary.")]
