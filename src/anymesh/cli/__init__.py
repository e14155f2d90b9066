"""The command line: one module per command of the core; those of other packages are found by name."""

from anymesh.cli.app import main, make_app, run

__all__ = ["main", "make_app", "run"]
