"""The command line: one module per command."""

from anymesh.cli.app import app, main, run

__all__ = ["app", "main", "run"]
