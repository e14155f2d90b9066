"""The command line of `anymesh view`."""

from __future__ import annotations

import getpass
import threading
import webbrowser
from contextlib import ExitStack, suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Annotated

import typer

from anymesh.cli.options import Root
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
    from anymesh.viewer.live_serve_ import serve

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
