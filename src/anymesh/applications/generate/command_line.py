"""Command line of `anymesh generate`: text or an image to an articulated asset."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from anymesh.cli.options import Completion, Formats, Json, OptionsOf, Out, Placement, Quiet, Running, with_options
from anymesh.cli.output import Shown, ended_by_signal, plain, print_asset
from anymesh.pipeline.options import AnswererOptions

if TYPE_CHECKING:
    from anymesh.applications.generate import Explanation

Prompt = Annotated[str | None, typer.Argument(metavar="PROMPT", help="What to make, such as 'a retro fridge'.")]
Image = Annotated[Path | None, typer.Option("--image", metavar="FILE", help="A PNG or JPEG of what to make.")]
MeshFile = Annotated[Path | None, typer.Option("--mesh", metavar="FILE", help="Start from this mesh; nothing is generated.")]
GeneratorName = Annotated[
    str,
    typer.Option(
        "--generator",
        help="meshy (paid, MESHY_API_KEY), meshy:untextured, or 'command:PROGRAM ... {out}' with {prompt} or {image}, {seed}.",
    ),
]
GeneratorTime = Annotated[
    float, typer.Option("--generator-time-limit", metavar="SECONDS", help="Time limit of a program that makes the mesh.")
]
Regenerate = Annotated[
    bool,
    typer.Option("--regenerate", help="Make, and pay for, another mesh for a request that was made before."),
]
DryRun = Annotated[bool, typer.Option("--dry-run", help="Explain each step and its cost; nothing is sent, paid or written.")]
GENERATION_HELPS = {"max_calls": "Maximum number of paid tasks and model calls together."}


@with_options
def generate(
    out: Out,
    *,
    prompt: Prompt = None,
    image: Image = None,
    mesh: MeshFile = None,
    generator: GeneratorName = "meshy",
    generator_time_limit: GeneratorTime = 1800.0,
    regenerate: Regenerate = False,
    dry_run: DryRun = False,
    answering: Annotated[dict[str, Any], OptionsOf(AnswererOptions, helps=GENERATION_HELPS)],
    placement: Placement,
    completion: Completion,
    writing: Formats,
    running: Running,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """PROMPT or a picture to a finished articulated asset in DIR: a 3D generator makes the mesh, the pipeline its joints,
    stage C what is inside. A second run goes on where one ended; nothing is paid for twice."""
    from anymesh.applications.generate import explain_generation
    from anymesh.applications.generate import generate as run

    answerer = answering.pop("answerer")
    options: dict[str, Any] = {
        "image": image, "mesh": mesh, "generator": generator, "generator_time_limit": generator_time_limit,
        "regenerate": regenerate, **answering, **placement, **completion, **writing, **running,
    }  # fmt: skip
    if dry_run:
        _print_explanation(explain_generation(prompt, out, answerer=answerer, **options), json_)
        return
    options["answerer"] = answerer
    with ended_by_signal(), Shown(quiet or json_) as progress:
        asset = run(prompt, out, progress=progress, **options)
    print_asset(asset, out, json_, quiet)
    if not (json_ or quiet):
        from anymesh.applications.generate.work import read_record

        record = read_record(out) or {}
        typer.echo(f"generation.json: {len(record.get('tasks', ()))} paid tasks, {record.get('credits', 0):g} credits in all")


def _print_explanation(explanation: Explanation, json_: bool) -> None:
    if json_:
        typer.echo(json.dumps({**asdict(explanation), "credits": explanation.credits}, indent=2))
        return
    for number, step in enumerate(explanation.steps, start=1):
        cost = f" - about {step.credits:g} credits ({step.source})" if step.credits else ""
        typer.echo(plain(f"{number}. {step.what}{cost}"))
    typer.echo(plain(f"size: {explanation.size}"))
    for warning in explanation.warnings:
        typer.echo(plain(f"warning: {warning}"))
    typer.echo(f"in all about {explanation.credits:g} credits; nothing was sent, paid or written")
