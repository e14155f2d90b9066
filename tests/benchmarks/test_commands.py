"""Test that the commands of scripts in the docs name scripts and options that exist."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
COMMAND = re.compile(r"python\s+-m\s+((?:benchmarks|training)(?:\.\w+)*)([^`|\n#]*)")
PAGES = [
    *ROOT.glob("*.md"),
    *(path for folder in ("benchmarks", "docs", "training") for path in (ROOT / folder).rglob("*.md")),
    *ROOT.glob("docs/decisions/*.csv"),
]


def source_of(module: str) -> str:
    """Return the text of a script, "" if there is none."""
    place = ROOT / module.replace(".", "/")
    path = place.with_suffix(".py") if place.with_suffix(".py").is_file() else place / "__main__.py"
    return path.read_text(encoding="utf-8") if path.is_file() else ""


@pytest.mark.parametrize("page", [p for p in PAGES if COMMAND.search(p.read_text(encoding="utf-8"))], ids=lambda p: p.stem)
def test_a_page_names_scripts_and_options_that_exist(page: Path) -> None:
    for module, arguments in COMMAND.findall(page.read_text(encoding="utf-8")):
        text = source_of(module)
        assert text, module
        if "training.collect_rows" in text:
            text += source_of("training.collect_rows")  # has the options of both scripts of rows
        assert not [o for o in re.findall(r"--[a-z][\w-]*", arguments) if f'"{o}"' not in text], (module, arguments)
