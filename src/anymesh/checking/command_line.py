"""The command line of `anymesh check`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from anymesh.cli.output import plain

NOT_IN_ORDER, DIFFERENT = 8, 10  # exit codes: a check fails; two assets differ

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
    certificate: Annotated[
        bool, typer.Option("--certificate", help="If it passes, write certificate.json, which binds its bytes to the result.")
    ] = False,
    verify: Annotated[
        bool, typer.Option("--verify", help="Instead, compare ASSET with its certificate, byte for byte.")
    ] = False,
) -> None:
    """Check that ASSET is complete and valid for simulators. Exit code 8 if a check fails."""
    from anymesh.checking import certificate as certificates
    from anymesh.checking import check_asset

    if verify:
        _verified(asset, json_, quiet)
        return
    report, written = certificates.certify(asset, engines=engine) if certificate else (check_asset(asset, engines=engine), None)
    if json_:
        typer.echo(json.dumps(report.as_json(), indent=2))
    elif not quiet:
        typer.echo("\n".join(plain(line) for line in report.lines()))
        if certificate:
            typer.echo(plain(f"wrote {written}" if written else "no certificate is written, since the check failed"))
    if not report.ok:
        raise typer.Exit(NOT_IN_ORDER)


def _verified(asset: Path, json_: bool, quiet: bool) -> None:
    from anymesh.checking.certificate import verify

    problems, words = verify(asset)
    if json_:
        typer.echo(json.dumps({"path": str(asset), "ok": not problems, "problems": problems, "verified": words}, indent=2))
    elif not quiet:
        lines = [f"failure certificate: {problem}" for problem in problems]
        typer.echo("\n".join(map(plain, lines or [f"{asset}: its certificate holds: {words}"])))
    if problems:
        raise typer.Exit(NOT_IN_ORDER)


ASSET = "An asset: a folder that anymesh made, any URDF or MJCF, or a folder with one; or a folder of such folders."


def diff(
    a: Annotated[Path, typer.Argument(metavar="A", help=ASSET)],
    b: Annotated[Path, typer.Argument(metavar="B", help="The same of another version.")],
    json_: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No report, only the exit code.")] = False,
) -> None:
    """Tell which parts and joints differ between two assets, or two folders of assets. Exit code 10 if any does."""
    from anymesh.checking.differences import differences, lines

    result = differences(a, b)
    if json_:
        typer.echo(json.dumps(result, indent=2))
    elif not quiet:
        typer.echo("\n".join(map(plain, lines(result))))
    if not result["same"]:
        raise typer.Exit(DIFFERENT)
