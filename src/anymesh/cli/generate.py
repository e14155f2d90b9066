"""Command line of `anymesh generate`: text or an image to an articulated asset."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from anymesh.cli.finish import Completer, Texture, Watertight
from anymesh.cli.options import (
    FORMATS,
    AnswererName,
    AtLeast,
    BaseName,
    Cache,
    Category,
    Drives,
    Force,
    Formats,
    Json,
    MaxCost,
    Out,
    PartsList,
    Proposer,
    Quiet,
    Root,
    Scale,
    Seed,
    TimeLimit,
    Timeout,
    Up,
    Verify,
    Viewpoints,
    Wait,
)
from anymesh.cli.output import Shown, cache_of, chosen_answerer, ended_by_signal, plain, split_labels, tell_asset
from anymesh.config import DEFAULT_VIEWS
from anymesh.deadline import CALL_SECONDS, DEFAULT_SECONDS

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
    float, typer.Option("--generator-time-limit", metavar="SECONDS", help="For a program that makes the mesh.")
]
Regenerate = Annotated[
    bool, typer.Option("--regenerate", help="Make, and pay for, another mesh; else one made for the same request is used.")
]
DryRun = Annotated[bool, typer.Option("--dry-run", help="Explain each step and its cost; nothing is sent, paid or written.")]
MaxCalls = Annotated[
    int | None, typer.Option("--max-calls", help="Paid tasks and calls of a model together: none is made beyond so many.")
]


def generate(
    out: Out,
    prompt: Prompt = None,
    image: Image = None,
    mesh: MeshFile = None,
    generator: GeneratorName = "meshy",
    generator_time_limit: GeneratorTime = 1800.0,
    regenerate: Regenerate = False,
    dry_run: DryRun = False,
    answerer: AnswererName = "geometry",
    parts_list: PartsList = "",
    at_least: AtLeast = 0,
    proposer: Proposer = "exact",
    viewpoints: Viewpoints = DEFAULT_VIEWS,
    verify: Verify = "motion",
    category: Category = None,
    timeout: Timeout = CALL_SECONDS,
    wait: Wait = False,
    max_calls: MaxCalls = None,
    max_cost: MaxCost = None,
    cache: Cache = "auto",
    seed: Seed = 0,
    up: Up = "auto",
    scale: Scale = "auto",
    root: Root = None,
    completer: Completer = "builtin",
    texture: Texture = "builtin",
    watertight: Watertight = True,
    base: BaseName = "fixed",
    formats: Formats = FORMATS,
    drives: Drives = "passive",
    force: Force = False,
    time_limit: TimeLimit = DEFAULT_SECONDS,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """PROMPT or a picture to a finished articulated asset in DIR: a 3D generator makes the mesh, the pipeline its joints,
    stage C what is inside. A second run goes on where one ended; nothing is paid for twice."""
    from anymesh.applications.generate import explain_generation
    from anymesh.applications.generate import generate as run

    options: dict[str, Any] = {
        "image": image, "mesh": mesh, "generator": generator, "generator_time_limit": generator_time_limit,
        "regenerate": regenerate, "force": force, "parts_list": split_labels(parts_list), "at_least": at_least,
        "proposer": proposer, "viewpoints": viewpoints, "verify": verify, "category": category, "timeout": timeout,
        "wait": wait, "max_calls": max_calls, "max_cost": max_cost, "seed": seed, "up": up, "scale": scale, "root": root,
        "completer": completer, "texture": texture, "watertight": watertight, "base": base, "formats": formats,
        "drives": drives, "time_limit": time_limit, **cache_of(cache),
    }  # fmt: skip
    if dry_run:
        _tell(explain_generation(prompt, out, answerer=answerer, **options), json_)
        return
    options["answerer"] = chosen_answerer(answerer, quiet or json_)
    with ended_by_signal(), Shown(quiet or json_) as progress:
        asset = run(prompt, out, progress=progress, **options)
    tell_asset(asset, out, json_, quiet)
    if not (json_ or quiet):
        from anymesh.applications.generate.record import read_record

        record = read_record(out) or {}
        typer.echo(f"generation.json: {len(record.get('tasks', ()))} paid tasks, {record.get('credits', 0):g} credits in all")


def _tell(found: Explanation, json_: bool) -> None:
    if json_:
        typer.echo(json.dumps({**asdict(found), "credits": found.credits}, indent=2))
        return
    for number, step in enumerate(found.steps, start=1):
        cost = f" - about {step.credits:g} credits ({step.source})" if step.credits else ""
        typer.echo(plain(f"{number}. {step.what}{cost}"))
    typer.echo(plain(f"size: {found.size}"))
    for warning in found.warnings:
        typer.echo(plain(f"warning: {warning}"))
    typer.echo(f"in all about {found.credits:g} credits; nothing was sent, paid or written")
