"""`anymesh articulate --scene split`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import typer

from anymesh.applications.scenes.splitting import articulate_scene as split
from anymesh.cli.output import Shown, plain, print_result
from anymesh.runtime import read_json


def articulate_scene(mesh: Path, out: Path, options: dict[str, Any], json_: bool, quiet: bool) -> None:
    """Articulate each object of a scene and print them."""
    with Shown(quiet or json_) as progress:
        scene = split(mesh, out, progress=progress, **options)
    rows = []
    for name, placements in scene.placements.items():
        made = read_json(out / "assets" / name / "asset.json") or {}
        error = scene.errors.get(name)
        joints = ", ".join(j["name"] for j in made.get("joints", [])) if error is None else ""
        rows.append(
            {"asset": name, "placed": len(placements), "joints": joints, "note": "" if error is None else plain(str(error))}
        )
    if not (json_ or quiet):
        for warning in scene.warnings:
            typer.echo(f"warning: {plain(warning)}")
    print_result(
        {"out": str(out), "assets": rows, "warnings": list(scene.warnings)},
        rows,
        ("asset", "placed", "joints", "note"),
        json_,
        quiet,
    )
    if scene.errors:
        raise typer.Exit(next(iter(scene.errors.values())).exit_code)
