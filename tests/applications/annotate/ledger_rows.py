"""What a ledger and the trace of the fake work say."""

from __future__ import annotations

import sqlite3
from pathlib import Path


def states(out: Path) -> dict[str, str]:
    """The state of each object."""
    with sqlite3.connect(out / "ledger.sqlite") as connection:
        return {Path(name).stem: state for name, state in connection.execute("SELECT name, state FROM objects")}


def column(out: Path, name: str, what: str) -> object:
    """A column of one object's row."""
    with sqlite3.connect(out / "ledger.sqlite") as connection:
        return connection.execute(f"SELECT {what} FROM objects WHERE name = ?", (f"{name}.glb",)).fetchone()[0]


def trace(out: Path) -> list[str]:
    """Objects that were finished, in order; one that was finished twice stands there twice."""
    path = out / "trace"
    return path.read_text().split() if path.exists() else []
