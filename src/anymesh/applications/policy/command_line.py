"""Command line of `anymesh train`."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from anymesh.cli.options import Json, Quiet
from anymesh.cli.output import Shown, print_result

Assets = Annotated[list[Path], typer.Argument(metavar="ASSETS...", help="Assets, or folders of assets, to train on.")]
TaskName = Annotated[str, typer.Option("--task", help="open, close or lift.")]
TrainOut = Annotated[Path, typer.Option("--out", "-o", metavar="DIR", help="Folder of the policy; a stopped training resumes.")]
Steps = Annotated[int, typer.Option(help="Steps of training, of 50 ms each.")]
Start = Annotated[Path | None, typer.Option("--start", metavar="FILE", help="A policy whose training is continued.")]
Tested = Annotated[list[Path] | None, typer.Option("--test", metavar="ASSETS", help="Held-out assets; may be repeated.")]
Episodes = Annotated[int, typer.Option(help="Evaluated episodes per held-out asset, in random poses.")]
SizeName = Annotated[str, typer.Option("--size", help="cpu, gpu (Shadow hand, point clouds) or smoke.")]


def train(
    assets: Assets,
    out: TrainOut,
    task: TaskName = "open",
    steps: Steps = 100_000,
    start: Start = None,
    test: Tested = None,
    episodes: Episodes = 100,
    size: SizeName = "cpu",
    seed: Annotated[int, typer.Option(help="From 0 up.")] = 0,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Train a policy on assets with PPO (extra policy), and evaluate it on held-out ones."""
    from anymesh.applications.policy.objects_ import find_assets
    from anymesh.applications.policy.training_ import SETTINGS, evaluate_policy
    from anymesh.applications.policy.training_ import train as run
    from anymesh.errors import OptionError

    if size not in SETTINGS:
        raise OptionError(f"--size: found {size!r}; valid are {', '.join(SETTINGS)}")
    settings = SETTINGS[size]
    with Shown(quiet or json_) as progress:
        policy = run(find_assets(assets), task, out, steps=steps, seed=seed, start=start, settings=settings, progress=progress)
        held_out = find_assets(test) if test else []
        outcomes = evaluate_policy(policy, held_out, task, episodes=episodes, seed=seed, settings=settings) if held_out else []
    rows = []
    for name in dict.fromkeys(e.asset for e in outcomes):
        own = [e.success for e in outcomes if e.asset == name]
        rows.append({"asset": name, "episodes": len(own), "success": f"{sum(own) / len(own):.3f}"})
    print_result(
        {"policy": str(policy), "episodes": [asdict(e) for e in outcomes]}, rows, ("asset", "episodes", "success"), json_, quiet
    )
    if not (json_ or quiet):
        typer.echo(f"wrote {policy}")
