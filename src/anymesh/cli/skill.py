"""The command line of `anymesh skill`."""

from __future__ import annotations

import typer


def skill() -> None:
    """Print the skill file for agents: how to get from a mesh to a checked asset."""
    from anymesh.agents.tools import skill_text

    typer.echo(skill_text(), nl=False)
