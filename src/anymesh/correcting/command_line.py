"""`anymesh correct`: corrections on the command line."""

from __future__ import annotations

import inspect
import json
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_type_hints

import typer

from anymesh.cli.options import Json, Quiet
from anymesh.cli.output import plain, print_result
from anymesh.correcting.operations import OPERATIONS, Operation
from anymesh.errors import OptionError
from anymesh.names import listed

if TYPE_CHECKING:
    from anymesh.correcting.editable import EditableAsset

AssetFolder = Annotated[Path, typer.Argument(metavar="DIR", help="An output of `anymesh articulate`.")]
Part = Annotated[
    str | None,
    typer.Argument(metavar="PART", help="The part, by its own name or that of its joint; without it, all are listed."),
]
Motions = Annotated[bool, typer.Option("--motions", help="List the free motions of the part with their numbers.")]
Regions = Annotated[bool, typer.Option("--regions", help="List the regions of the part with their numbers.")]
PART_COLUMNS = ("part", "joint", "motion", "range", "parent", "verdict", "why")
MOTION_COLUMNS, REGION_COLUMNS = ("number", "motion", "range", "share"), ("number", "kind", "faces", "size", "middle")
PAIR = "merge"  # the operation that takes two names
CHANGE_COLUMNS = ("part", "joint", "motion", "range", "parent", "change")


def _correct(
    folder: AssetFolder,
    part: Part = None,
    *,
    motions: Motions = False,
    regions: Regions = False,
    json_: Json = False,
    quiet: Quiet = False,
    **operations: bool | str | tuple[str, str] | None,
) -> None:
    """Correct a part or joint of the asset in DIR, and write all files again. Without an operation, list the parts.

    Several operations are one step, applied in the order in which they are listed below: all of them or none.
    """
    from anymesh.correcting.editable import load
    from anymesh.correcting.listing import motion_rows, part_rows, region_rows

    asset = load(folder)
    wanted = {name: value for name, value in operations.items() if value not in (None, False)}
    if sum((motions, regions, bool(wanted))) > 1:
        raise OptionError("list motions or regions, or correct: one at a time")
    if wanted:
        _apply(asset, part, wanted, json_, quiet)
    elif motions or regions:
        if part is None:
            raise OptionError(f"name the part whose {'motions' if motions else 'regions'} to list: {listed(asset.parts)}")
        rows, columns = (
            (motion_rows(asset.asset, part), MOTION_COLUMNS) if motions else (region_rows(asset.asset, part), REGION_COLUMNS)
        )
        print_result({"part": part, "motions" if motions else "regions": rows}, rows, columns, json_, quiet)
    else:
        rows = [row for row in part_rows(asset.asset, asset.precision) if part is None or row["part"] == asset.joint(part).part]
        record = {"out": str(folder), "parts": list(asset.parts), "joints": rows, "warnings": list(asset.warnings)}
        print_result(record, rows, PART_COLUMNS, json_, quiet)


def _apply(asset: EditableAsset, part: str | None, operations: dict[str, Any], json_: bool, quiet: bool) -> None:
    """Correct and save an asset, and print the joints that changed, with what stops them."""
    from anymesh.correcting.motions import motion_faults

    if operations.pop("undo", False):
        asset.undo()
    asset.correct(part, **operations)
    rows, out = asset.changes(), asset.folder
    doubts = motion_faults(asset.asset, {row["part"] for row in rows} & {*asset.parts})
    asset.save()
    files = [*json.loads((out / "asset.json").read_bytes())["files"].values(), "preview.png", "asset.json", "corrections.json"]
    warnings = [*asset.warnings, *(f"joint {asset.joint(part).name}: {fault}" for part, fault in doubts.items())]
    record = {
        "out": str(out),
        "changed": rows,
        "parts": list(asset.parts),
        "warnings": warnings,
        "files": files if rows else [],
    }
    print_result(record, rows, CHANGE_COLUMNS, json_, quiet)
    if not (json_ or quiet):
        about = tuple(f"joint {row['joint']}:" for row in rows)
        for warning in (w for w in warnings if w.startswith(about)):
            typer.echo(plain(f"warning: {warning}"))
        typer.echo(plain(f"wrote {listed(files)} to {out}" if rows else f"{out} is so already; nothing was written"))


def _option(operation: Operation) -> inspect.Parameter:
    """Return the command's option of an operation."""
    kind: Any = bool if not operation.metavar else tuple[str, str] | None if operation.name == PAIR else str | None
    shown = operation.metavar.replace(",", " ") if operation.name == PAIR else operation.metavar or None
    option = typer.Option(operation.option, metavar=shown, help=operation.help, show_default=False)
    default = None if operation.metavar else False
    return inspect.Parameter(
        operation.name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=Annotated[kind, option]
    )


def _command() -> Any:
    """Return the command, with one option per operation."""
    hints = get_type_hints(_correct, include_extras=True)
    own = [
        p.replace(annotation=hints[p.name])
        for p in inspect.signature(_correct).parameters.values()
        if p.kind is not p.VAR_KEYWORD
    ]
    positional, last = [p for p in own if p.kind is not p.KEYWORD_ONLY], [p for p in own if p.kind is p.KEYWORD_ONLY]
    parameters = [*positional, *last[:2], *(_option(o) for o in OPERATIONS), *last[2:]]
    parameters = [p.replace(kind=inspect.Parameter.KEYWORD_ONLY) for p in parameters]

    @wraps(_correct)
    def command(**given: Any) -> None:
        _correct(**given)

    command.__signature__ = inspect.Signature(parameters)  # ty: ignore[missing-attribute]
    command.__annotations__ = {p.name: p.annotation for p in parameters}
    return command


correct = _command()
