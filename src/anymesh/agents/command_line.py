"""The command line of `anymesh mcp`."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import Annotated

import typer

from anymesh.errors import MissingExtraError, OptionError, pip_install

LOOPBACK = ("127.0.0.1", "localhost", "::1")
Folders = Annotated[list[Path], typer.Argument(metavar="FOLDER", help="Folders that the tools may read and write.")]
Http = Annotated[bool, typer.Option("--http", help="Streamable HTTP at http://HOST:PORT/mcp instead of stdio.")]
Host = Annotated[str, typer.Option(help="A loopback address: 127.0.0.1, localhost or ::1.")]
Port = Annotated[int, typer.Option(min=1, max=65535, help="Port for --http.")]


def mcp(folders: Folders, http: Http = False, host: Host = "127.0.0.1", port: Port = 8765) -> None:
    """Serve the Model Context Protocol, so that agents can articulate, answer, inspect, correct, check and export."""
    if host not in LOOPBACK:
        raise OptionError(f"--host: found {host!r}; valid are {', '.join(LOOPBACK)}: there is no password")
    if find_spec("mcp") is None:
        raise MissingExtraError(f"the MCP server is not installed; install it with {pip_install('mcp')}")
    from anymesh.agents.server_ import serve_http, serve_stdio

    names = [str(folder) for folder in folders]
    if http:
        typer.echo(f"http://{host}:{port}/mcp (Ctrl-C ends it)", err=True)
        serve_http(names, host, port)
    else:
        serve_stdio(names)


def skill() -> None:
    """Print the skill file for agents: how to get from a mesh to a checked asset."""
    from anymesh.agents.tools import skill_text

    typer.echo(skill_text(), nl=False)
