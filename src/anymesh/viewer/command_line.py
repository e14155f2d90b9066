"""The command lines of `anymesh view`, `anymesh report` and `anymesh picture`."""

from __future__ import annotations

import getpass
import json
import threading
import webbrowser
from contextlib import ExitStack, suppress
from dataclasses import asdict
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated

import typer

from anymesh.cli.options import FolderPath, Json, Quiet, Root
from anymesh.cli.output import Shown, plain

Target = Annotated[
    Path | None,
    typer.Argument(
        metavar="[ASSET|MESH|FOLDER]",
        help="An output of anymesh, a mesh (articulated first), or a folder of outputs; by default, the page accepts meshes.",
    ),
]
Ask = Annotated[bool, typer.Option("--ask", help="Answer the questions about MESH yourself, by clicks on the page.")]
Kept = Annotated[
    Path | None,
    typer.Option(
        "--out",
        "-o",
        metavar="DIR",
        help="Folder for the assets and answers of a page that accepts meshes; else they are removed.",
    ),
]
Host = Annotated[str, typer.Option(help="Address to listen on; the default is only reachable from this machine.")]
Port = Annotated[int, typer.Option(min=0, max=65535, help="If the port is taken, the next one is used.")]
NoBrowser = Annotated[bool, typer.Option("--no-browser", help="Do not open a browser.")]
Reviewer = Annotated[
    str, typer.Option(metavar="NAME", help="Name in the logs of corrections and decisions; the user's name by default.")
]
Page = Annotated[
    Path | None, typer.Option("--out", "-o", metavar="FILE", help="The HTML file; default: FOLDER_report.html beside FOLDER.")
]
File = Annotated[
    Path, typer.Option("--out", "-o", metavar="FILE", help=".gif or .mp4: a film of the motions; .png: a contact sheet.")
]


def view(
    target: Target = None,
    ask: Ask = False,
    out: Kept = None,
    host: Host = "127.0.0.1",
    port: Port = 8080,
    no_browser: NoBrowser = False,
    reviewer: Reviewer = "",
    root: Root = None,
) -> None:
    """View, animate, correct and review assets in the browser, until Ctrl-C."""
    from anymesh.viewer.server_ import serve

    with ExitStack() as stack:
        with Shown(hidden=False) as progress:
            page = serve(
                target, host=host, port=port, author=reviewer or _user(), clock=_now, root=root, ask=ask, out=out,
                progress=progress,
            )  # fmt: skip
            serving = stack.enter_context(page)
        for line in (*serving.notes, f"{serving.url} (Ctrl-C ends it)"):
            typer.echo(plain(line))
        if not no_browser:
            webbrowser.open(serving.url)
        with suppress(KeyboardInterrupt):
            threading.Event().wait()


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")


def _user() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError):
        return "unknown"


def report(
    folder: FolderPath,
    out: Page = None,
    faces: Annotated[
        int, typer.Option(min=1000, help="Number of faces above which an asset is decimated for display.")
    ] = 60_000,
    megabytes: Annotated[
        float, typer.Option(min=1, help="Maximum size of the page; content beyond it is left out with a note.")
    ] = 100.0,
    json_: Json = False,
    quiet: Quiet = False,
) -> None:
    """Write one HTML file of every asset in FOLDER: 3D view with moving joints, warnings, tables. It works offline."""
    from anymesh.viewer.report import write_report

    with Shown(quiet or json_) as progress:
        written = write_report(folder, out, faces=faces, megabytes=megabytes, progress=progress)
    if json_:
        typer.echo(json.dumps(asdict(written) | {"path": str(written.path)}, indent=2))
    elif not quiet:
        lines = [f"cannot be shown: {name}" for name in written.unreadable] + list(written.notes)
        count = f"{written.assets} asset{'s' if written.assets != 1 else ''}"
        lines.append(f"wrote {written.path}: {count}, {written.size / 1e6:.1f} MB")
        typer.echo("\n".join(plain(line) for line in lines))


def picture(
    folder: FolderPath,
    out: File,
    size: Annotated[
        int | None,
        typer.Option(help="Width of a turntable (default 400), or of a cell of a film of several assets (200), in pixels."),
    ] = None,
    rate: Annotated[float, typer.Option(help="Frames per second.")] = 12.5,
    turn: Annotated[float, typer.Option(help="Degrees that a turntable turns; less than 360 swings around the front.")] = 360.0,
    materials: Annotated[
        bool, typer.Option("--materials", help="Use the object's materials instead of a colour per part.")
    ] = False,
    columns: Annotated[int, typer.Option(help="Columns of a contact sheet, or of a film of several assets.")] = 4,
    quiet: Quiet = False,
) -> None:
    """Draw the assets in FOLDER: a contact sheet (.png), or a film of their motions (.gif, .mp4; of one asset a turntable)."""
    from anymesh.viewer.pictures_ import write_picture

    with Shown(quiet) as progress:
        path = write_picture(
            folder, out, size=size, rate=rate, turn=turn, materials=materials, columns=columns, progress=progress
        )
    if not quiet:
        typer.echo(plain(f"wrote {path}"))
