"""Scripts that measure the package; each is run as `python -m benchmarks.NAME` and names its options with --help.

`reports/` has their results, `recordings/` the recorded answers that some of them replay. Here stands what they share.
"""

from __future__ import annotations

import argparse
import platform
import subprocess
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from datetime import date
from importlib.metadata import version
from pathlib import Path

ROOT = Path(__file__).parents[1]
EXAMPLES = ROOT / "examples"
REPORTS = ROOT / "benchmarks" / "reports"
RECORDINGS = ROOT / "benchmarks" / "recordings"


def parser_of(doc: str | None) -> argparse.ArgumentParser:
    """Return a parser whose help is the docstring of a script as it stands."""
    return argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)


def table_row(cells: Iterable[object]) -> str:
    """Return one row of a Markdown table."""
    return f"| {' | '.join(map(str, cells))} |"


def table_head(titles: Iterable[object]) -> list[str]:
    """Return the two lines above the rows of a Markdown table."""
    cells = list(titles)
    return [table_row(cells), f"|{'---|' * len(cells)}"]


def made_with(*packages: str) -> str:
    """Return the date and the versions of Python and of packages."""
    return ", ".join([f"{date.today()}, Python {platform.python_version()}", *(f"{p} {version(p)}" for p in packages)])


@contextmanager
def worktree(revision: str) -> Iterator[Path]:
    """Check a revision out into a temporary folder."""
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder) / "tree"
        subprocess.run(["git", "worktree", "add", "--quiet", "--detach", tree, revision], cwd=ROOT, check=True)
        try:
            yield tree
        finally:
            subprocess.run(["git", "worktree", "remove", "--force", tree], cwd=ROOT, check=True)
