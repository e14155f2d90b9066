"""The command line. Everything heavy is imported inside the commands, so that help and completion come at once."""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer.core import TyperGroup

from anymesh import __version__
from anymesh.errors import AnymeshError
from anymesh.progress import Progress, silent

if TYPE_CHECKING:
    from anymesh.types import Asset, Joint

EXIT_CODES = (
    "Exit codes: 0 done; 1 unexpected error; 2 a wrong option; 3 the mesh cannot be used; 4 the output folder exists or "
    "cannot be written; 5 an optional dependency is missing; 130 interrupted."
)


class _Commands(TyperGroup):
    """Hands on two errors that the library turns into others of its own: an interrupt, and the end of a file."""

    def invoke(self, ctx: Any) -> Any:
        try:
            return super().invoke(ctx)
        except (KeyboardInterrupt, EOFError) as error:
            raise _HandedError(error) from error


class _HandedError(Exception):
    def __init__(self, error: BaseException) -> None:
        self.error = error


app = typer.Typer(
    cls=_Commands,
    help="Any rigid 3D mesh in, a simulation-ready articulated asset out.",
    epilog=EXIT_CODES,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)

MeshPath = Annotated[Path, typer.Argument(metavar="MESH", help="GLB, glTF, OBJ, PLY, STL, OFF or DAE.")]
Folder = Annotated[Path, typer.Argument(metavar="DIR", help="A folder that `anymesh segment` made.")]
Out = Annotated[Path, typer.Option("--out", "-o", metavar="DIR", help="Folder to write.")]
Parts = Annotated[str, typer.Option(help="auto, nodes (the scene's nodes), or a .npy/.json file of face labels.")]
AnswererName = Annotated[str, typer.Option("--answerer", help="Who answers the questions: geometry.")]
Category = Annotated[str | None, typer.Option(help="What the object is; geometry does not use it.")]
Seed = Annotated[int, typer.Option(help="From 0 up; same input and seed, same bytes.")]
Up = Annotated[str, typer.Option(help="The file's up axis: auto, x, y, z.")]
Scale = Annotated[str, typer.Option(help="auto, a factor to metres, or METRES:AXIS such as 0.9:z.")]
Force = Annotated[bool, typer.Option("--force", help="Replace an existing output.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No progress, no summary.")]


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"anymesh {__version__}")
        raise typer.Exit


@app.callback()
def _main(
    version: Annotated[bool | None, typer.Option("--version", callback=_version, is_eager=True, help="Print it.")] = False,
    debug: Annotated[bool, typer.Option("--debug", help="Show the traceback of an unexpected error.")] = False,
) -> None: ...


@app.command(epilog=EXIT_CODES)
def articulate(
    mesh: MeshPath,
    out: Out,
    parts: Parts = "auto",
    answerer: AnswererName = "geometry",
    category: Category = None,
    seed: Seed = 0,
    up: Up = "auto",
    scale: Scale = "auto",
    force: Force = False,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """The whole job: MESH to an articulated asset in DIR."""
    from anymesh import pipeline

    with _Shown(quiet or json_) as progress:
        asset = pipeline.articulate(
            mesh, out, parts=parts, answerer=answerer, category=category, seed=seed, up=up, scale=scale, force=force,
            progress=progress,
        )  # fmt: skip
    _tell_asset(asset, out, json_, quiet)


@app.command(epilog=EXIT_CODES)
def segment(
    mesh: MeshPath,
    out: Out,
    parts: Parts = "auto",
    answerer: AnswererName = "geometry",
    category: Category = None,
    seed: Seed = 0,
    up: Up = "auto",
    scale: Scale = "auto",
    force: Force = False,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Stage A alone: which parts move. `anymesh joints DIR` goes on from there."""
    from anymesh import pipeline

    with _Shown(quiet or json_) as progress:
        found = pipeline.segment(
            mesh, out, parts=parts, answerer=answerer, category=category, seed=seed, up=up, scale=scale, force=force,
            progress=progress,
        )  # fmt: skip
    rows = [
        {"name": p.name, "label": p.label, "faces": len(found.faces(k)), "confidence": p.confidence, "reason": p.reason}
        for k, p in enumerate(found.parts)
    ]
    _tell({"out": str(out), "parts": rows}, rows, ("name", "label", "faces", "confidence", "reason"), json_, quiet)


@app.command(epilog=EXIT_CODES)
def joints(
    folder: Folder,
    answerer: AnswererName = "geometry",
    category: Category = None,
    seed: Seed = 0,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Stage B alone: the joints of the parts in DIR. `anymesh export DIR` goes on from there."""
    from anymesh import pipeline

    with _Shown(quiet or json_) as progress:
        found = pipeline.joints(folder, answerer=answerer, category=category, seed=seed, progress=progress)
    rows = [_joint_row(j) for j in found]
    _tell({"out": str(folder), "joints": rows}, rows, JOINT_COLUMNS, json_, quiet)


@app.command(epilog=EXIT_CODES)
def export(folder: Folder, json_: Json = False, quiet: Quiet = False) -> None:
    """Writes the files of the asset whose stages are in DIR."""
    from anymesh import pipeline

    with _Shown(quiet or json_) as progress:
        asset = pipeline.export(folder, progress=progress)
    _tell_asset(asset, folder, json_, quiet)


JOINT_COLUMNS = ("name", "type", "parent", "range", "confidence", "reason")


def _joint_row(joint: Joint) -> dict[str, Any]:
    from anymesh.rendering.preview import extent

    return {
        "name": joint.name,
        "type": joint.type.value,
        "parent": joint.parent,
        "child": joint.child,
        "origin": [float(v) for v in joint.origin],
        "axis": [float(v) for v in joint.axis],
        "limits": None if joint.limits is None else list(joint.limits),
        "range": extent(joint),
        "confidence": joint.confidence,
        "reason": joint.reason,
    }


def _tell_asset(asset: Asset, out: Path, json_: bool, quiet: bool) -> None:
    rows = [_joint_row(j) for j in asset.joints]
    record = {
        "name": asset.name,
        "out": str(out),
        "parts": [p.name for p in asset.segmentation.parts],
        "joints": rows,
        "notes": list(asset.source.notes),
        "warnings": list(asset.warnings),
        "timing": dict(asset.timing),
    }
    if not (json_ or quiet):
        for line in (*(f"warning: {w}" for w in asset.warnings), *asset.source.notes):
            typer.echo(_plain(line))
    _tell(record, rows, JOINT_COLUMNS, json_, quiet)
    if not (json_ or quiet):
        typer.echo(f"wrote {out / asset.name}.urdf, {asset.name}.glb, preview.png and asset.json")


def _tell(record: dict[str, Any], rows: list[dict[str, Any]], columns: tuple[str, ...], json_: bool, quiet: bool) -> None:
    if json_:
        typer.echo(json.dumps(record, indent=2))
    elif not quiet:
        from rich.console import Console
        from rich.table import Table
        from rich.text import Text

        table = Table(*columns)
        for row in rows:
            cells = (f"{row[c]:.2f}" if isinstance(row[c], float) else str(row[c]) for c in columns)
            table.add_row(*(Text(_plain(cell)) for cell in cells))
        Console(width=None if sys.stdout.isatty() else 140).print(table)


def _plain(text: str) -> str:
    """Without control characters: a name in a file must not steer the terminal."""
    return "".join(c if c.isprintable() else "?" for c in text)


class _Shown:
    """Progress on stderr (stage, what it is at, seconds), only where someone looks."""

    def __init__(self, hidden: bool) -> None:
        self._status: Any = None
        self._hidden = hidden or not sys.stderr.isatty()
        self._begin = time.monotonic()

    def __enter__(self) -> Progress:
        if self._hidden:
            return silent
        from rich.console import Console

        self._status = Console(stderr=True).status("")
        self._status.start()
        return self._tell

    def _tell(self, stage: str, item: str, done: int, total: int) -> None:
        seconds = time.monotonic() - self._begin
        self._status.update(f"{stage} {_plain(item)} ({done + 1}/{total}, {seconds:.0f} s)")

    def __exit__(self, *_: object) -> None:
        if self._status is not None:
            self._status.stop()


def main(arguments: list[str] | None = None) -> None:
    """Runs the command line and ends the process with its exit code."""
    sys.exit(run(sys.argv[1:] if arguments is None else arguments))


def run(arguments: list[str]) -> int:
    """Runs the command line; returns the exit code."""
    try:
        code = app(arguments, standalone_mode=False)
        return code if isinstance(code, int) else 0
    except (typer.Exit, SystemExit) as stop:
        return int(getattr(stop, "exit_code", getattr(stop, "code", 0)) or 0)
    except (KeyboardInterrupt, typer.Abort):
        return _interrupted(arguments)
    except _HandedError as handed:
        if isinstance(handed.error, KeyboardInterrupt):
            return _interrupted(arguments)
        return _failed(arguments, handed.error)
    except Exception as error:
        return _failed(arguments, error)


def _failed(arguments: list[str], error: BaseException) -> int:
    if isinstance(error, AnymeshError):
        return _fail(arguments, error, str(error), error.exit_code)
    if hasattr(error, "format_message"):  # a usage error of the command line itself
        if not arguments:  # the help was shown instead
            return 2
        return _fail(arguments, error, str(error.format_message()), 2)  # ty: ignore[not-callable]
    if "--debug" in arguments:
        raise error
    told = f"unexpected {type(error).__name__}: {error} (put --debug before the command for the traceback)"
    return _fail(arguments, error, told, 1)


def _interrupted(arguments: list[str]) -> int:
    if "--json" in arguments:
        typer.echo(json.dumps({"error": "interrupted", "kind": "KeyboardInterrupt", "exit_code": 130}))
    typer.echo("interrupted", err=True)
    return 130


def _fail(arguments: list[str], error: BaseException, told: str, code: int) -> int:
    told = _plain(" ".join(told.split()))
    if "--json" in arguments:
        typer.echo(json.dumps({"error": told, "kind": type(error).__name__, "exit_code": code}))
    typer.echo(f"error: {told}", err=True)
    return code


if __name__ == "__main__":
    main()
