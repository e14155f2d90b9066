"""The command line of `anymesh models`."""

from __future__ import annotations

import json
import os
from typing import Any

import typer

from anymesh.cli.options import Json
from anymesh.cli.output import plain


def models(json_: Json = False) -> None:
    """List the models available on this machine, and which keys are set (without their values)."""
    from anymesh.prompted.models.address import KEYS
    from anymesh.prompted.models.servers import SERVERS, probe_servers

    probes = probe_servers()
    keys = [
        {"provider": provider, "variable": name, "set": bool(os.environ.get(name, "").strip())}
        for provider, names in KEYS.items()
        for name in names
    ]
    record: dict[str, Any] = {
        "servers": [
            {
                "server": f.server,
                "url": f.url,
                "answers": f.models is not None,
                "note": f.note,
                "models": list(f.models or ()),
            }
            for f in probes
        ],
        "keys": keys,
    }
    if json_:
        typer.echo(json.dumps(record, indent=2))
        return
    for f in probes:
        typer.echo(plain(f"{f.server} at {f.url or 'no address'}: {f.note or f'{len(f.models or ())} models'}"))
        for m in f.models or ():
            typer.echo(plain(f"  {m}"))
        if f.models is None:
            typer.echo(f"  to use another address, set {' or '.join(SERVERS[f.server].variables)}")
    variables = {k["variable"]: k["set"] for k in keys}  # several providers may use one key
    typer.echo("keys: " + ", ".join(f"{name} {'is set' if is_set else 'is not set'}" for name, is_set in variables.items()))
    typer.echo("choose a model that accepts pictures; without one, you or your agent can answer: --answerer files:FOLDER")
