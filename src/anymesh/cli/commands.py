"""The commands of the pipeline: all stages of one mesh or of many, or one stage alone."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from anymesh.cli.options import (
    INPUT,
    OUTPUT,
    Animation,
    Answering,
    Folder,
    Formats,
    Json,
    MeshPath,
    OptionsOf,
    Out,
    Package,
    Parts,
    Placement,
    Quiet,
    Running,
    Sample,
    Time,
    Verbose,
    Zip,
    with_options,
)
from anymesh.cli.output import Shown, echo, plain, print_asset, print_joints, print_result
from anymesh.entry_points import ARTICULATE_SCENE, resolve
from anymesh.errors import OpenQuestionError, OptionError
from anymesh.isolation import AHEAD, shared_pool
from anymesh.pipeline.options import GEOMETRY, AnswererOptions

if TYPE_CHECKING:
    from anymesh.pipeline.batch import MeshOutcome

Meshes = Annotated[
    list[Path],
    typer.Argument(
        metavar="MESH", help="GLB, glTF, OBJ, PLY, STL, OFF, DAE, 3MF, USD, FBX, STEP or zip; several with --batch."
    ),
]
SceneOption = Annotated[
    str,
    typer.Option(
        "--scene",
        help="auto: the mesh is one object, with a warning if not; split: each object of a scene.",
        rich_help_panel=INPUT,
    ),
]
Batch = Annotated[
    bool,
    typer.Option("--batch", help="Several meshes, or folders; one that fails does not stop the others.", rich_help_panel=INPUT),
]


@with_options
def articulate(
    mesh: Meshes,
    out: Out,
    *,
    parts: Parts = "auto",
    answering: Answering,
    batch: Batch = False,
    scene: SceneOption = "auto",
    placement: Placement,
    writing: Formats,
    running: Running,
    json_: Json = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Turn MESH into an articulated asset in DIR; --batch takes many, --scene split its objects."""
    shared_pool().fork("anymesh.pipeline.api", *AHEAD)
    from anymesh import pipeline

    options: dict[str, Any] = {"parts": parts, **placement, **writing, **running, **answering}
    if scene not in ("auto", "split") or (batch and scene == "split"):
        raise OptionError(f"--scene: found {scene!r}; valid are auto and split, which takes one mesh without --batch")
    if batch:
        _articulate_many(mesh, out, options, json_, quiet)
        return
    if len(mesh) != 1:
        raise OptionError(f"found {len(mesh)} meshes; several need --batch")
    if scene == "split":
        resolve(ARTICULATE_SCENE)(mesh[0], out, options, json_, quiet)
        return
    with Shown(quiet or json_, whole=answering["answerer"] == GEOMETRY) as progress:
        asset = pipeline.articulate(mesh[0], out, progress=progress, **options)
    print_asset(asset, out, json_, quiet, verbose)


def _articulate_many(meshes: list[Path], out: Path, options: dict[str, Any], json_: bool, quiet: bool) -> None:
    from anymesh.pipeline.batch import articulate_many

    with Shown(quiet or json_) as progress:
        outcomes = articulate_many(meshes, out, progress=progress, **options)
    rows = [{"mesh": str(o.mesh), "out": str(o.out), "state": o.state, "note": plain(_note(o))} for o in outcomes]
    waiting = [o.error for o in outcomes if isinstance(o.error, OpenQuestionError)]
    questions = [str(folder) for error in waiting for folder in error.folders]
    print_result({"out": str(out), "objects": rows, "questions": questions}, rows, ("mesh", "state", "note"), json_, quiet)
    if not (json_ or quiet):
        states = [o.state for o in outcomes]
        echo(", ".join(f"{states.count(s)} {s}" for s in dict.fromkeys(states)))
    if questions and not (json_ or quiet):
        answers = str(options["answerer"]).removeprefix("files:")
        typer.echo(f"{len(questions)} open questions; `anymesh answer {answers}` shows them; then run the same command again")
    codes = [o.error.exit_code for o in outcomes if o.error is not None]
    if codes:
        raise typer.Exit(waiting[0].exit_code if waiting else codes[0])


def _note(outcome: MeshOutcome) -> str:
    """Return the line on all joints, or what stopped an object: the folder of its question, or the message."""
    from anymesh.pipeline.results import summary
    from anymesh.pipeline.run_folder import Saved

    if outcome.error is None:
        asset = Saved.at(outcome.out).written()
        return summary(asset.segmentation, asset.joints, asset.warnings, len(asset.proposals))
    return ", ".join(map(str, outcome.error.folders)) if isinstance(outcome.error, OpenQuestionError) else str(outcome.error)


@with_options
def segment(
    mesh: MeshPath,
    out: Out,
    *,
    parts: Parts = "auto",
    answering: Annotated[dict[str, Any], OptionsOf(AnswererOptions, without=("verify",))],
    placement: Placement,
    running: Running,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Run only Stage A: find the parts. Continue with `anymesh joints DIR`."""
    from anymesh import pipeline

    with Shown(quiet or json_) as progress:
        segmentation = pipeline.segment(mesh, out, parts=parts, progress=progress, **placement, **running, **answering)
    rows = [
        {"name": p.name, "label": p.label, "faces": len(segmentation.faces(k)), "confidence": p.confidence, "reason": p.reason}
        for k, p in enumerate(segmentation.parts)
    ]
    print_result({"out": str(out), "parts": rows}, rows, ("name", "label", "faces", "confidence", "reason"), json_, quiet)


@with_options
def joints(
    folder: Folder,
    *,
    answering: Annotated[dict[str, Any], OptionsOf(AnswererOptions, without=("parts_list", "at_least", "proposer"))],
    animation: Animation = "read",
    time: Time,
    json_: Json = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Run only Stage B: find the joints of the parts in DIR. Continue with `anymesh export DIR`."""
    from anymesh import pipeline
    from anymesh.pipeline.run_folder import Saved

    with Shown(quiet or json_) as progress:
        pipeline.joints(folder, animation=animation, progress=progress, **time, **answering)
    if json_ or not quiet:
        asset, record = Saved.at(folder).asset(), {"out": str(folder)}
        print_joints(asset, record, json_, verbose)
        if not json_:
            echo(record["summary"])


@with_options
def export(
    folder: Folder,
    *,
    writing: Formats,
    package: Package = None,
    zip_: Zip = None,
    sample: Sample = 0,
    seed: Annotated[int, typer.Option(help="Seed of --sample.", rich_help_panel=OUTPUT)] = 0,
    time: Time,
    json_: Json = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Write the files of the asset whose stages are in DIR."""
    from anymesh import pipeline

    more: dict[str, Any] = {"package": package, "archive": zip_, "sample": sample, "seed": seed}
    with Shown(quiet or json_) as progress:
        asset = pipeline.export_asset(folder, progress=progress, **more, **writing, **time)
    print_asset(asset, folder, json_, quiet, verbose)
