"""The tables of docs/formats.md: each row is tested."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby
from pathlib import Path

PAGE = Path(__file__).parents[2] / "docs" / "formats.md"


def check_table(section: str, tested: Iterable[str], number: int = 0) -> None:
    """Assert that the first column of a table of a section is what is tested."""
    text = PAGE.read_text(encoding="utf-8").split(f"\n### {section}\n")[1].split("\n### ")[0].split("\n## ")[0]
    tables = [list(lines) for is_table, lines in groupby(text.splitlines(), lambda line: line.startswith("|")) if is_table]
    assert [line.split("|")[1].strip() for line in tables[number][2:]] == list(tested)
