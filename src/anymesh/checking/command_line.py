"""The command line of `anymesh check`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from anymesh.cli.output import plain

NOT_IN_ORDER = 8  # exit code if a check fails

AssetPath = Annotated[
    Path,
    typer.Argument(metavar="ASSET", help="A folder that anymesh made, any URDF or MJCF, or a folder with one."),
]
Engines = Annotated[
    list[str],
    typer.Option(
        "--engine",
        help="Engine that drives every joint; may be repeated: mujoco, pybullet, sapien, drake, pinocchio, newton, genesis, "
        "physx.",
    ),
]


def check(
    asset: AssetPath,
    engine: Engines = ["mujoco"],  # noqa: B006, as required by the command line library
    json_: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No report, only the exit code.")] = False,
) -> None:
    """Check that ASSET is complete and valid for simulators. Exit code 8 if a check fails."""
    from anymesh.checking import check_asset

    report = check_asset(asset, engines=engine)
    if json_:
        typer.echo(json.dumps(report.as_json(), indent=2))
    elif not quiet:
        typer.echo("\n".join(plain(line) for line in report.lines()))
    if not report.ok:
        raise typer.Exit(NOT_IN_ORDER)
