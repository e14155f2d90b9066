"""Every block of code in README and tutorials runs as it stands there, in order, from the root of the repository.

A comment before a block says what it needs, or with which code it exits: `<!-- needs sapien -->`, `<!-- exits with 9 -->`.
Blocks without a language are not run.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).parents[1]
README = ROOT / "README.md"
BLOCK = re.compile(r"^(?:<!-- (needs|exits with) ([\w ]+) -->\n)?```(bash|python)\n(.*?)^```", re.M | re.S)
SECONDS = 300  # [s] limit of one block
INSTALLS = 2  # blocks of the README that install; .ci/run runs them

pytestmark = pytest.mark.slow


class CodeBlock(NamedTuple):
    language: str
    code: str
    needs: tuple[str, ...]
    exit_code: int


def blocks(path: Path) -> list[CodeBlock]:
    written = [
        CodeBlock(language, code, tuple(word.split()) if what == "needs" else (), int(word) if what == "exits with" else 0)
        for what, word, language, code in BLOCK.findall(path.read_text(encoding="utf-8"))
    ]
    return written[INSTALLS:] if path == README else written


PAGES = [path for path in (README, *sorted((ROOT / "docs" / "tutorials").glob("*.md"))) if blocks(path)]


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
def test_blocks_run_as_they_are_written(path: Path, tmp_path: Path) -> None:
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    tools = Path(sys.executable).parent
    env = {
        **os.environ,
        "PATH": f"{tools}{os.pathsep}{os.environ['PATH']}",
        "PYTHONPATH": os.pathsep.join(p for p in sys.path if p),
    }
    ran = 0
    for block in blocks(path):
        if not all(find_spec(module) for module in block.needs):
            continue
        command = ["bash", "-euo", "pipefail", "-c"] if block.language == "bash" else [sys.executable, "-c"]
        done = subprocess.run([*command, block.code], cwd=tmp_path, env=env, capture_output=True, text=True, timeout=SECONDS)
        assert done.returncode == block.exit_code, f"{block.code}\n{done.stdout}\n{done.stderr}"
        ran += 1
    if not ran:
        pytest.skip("what its blocks need is not installed")


def test_blocks_are_found() -> None:
    """A comment that is spelt otherwise would leave a block out, or run it without what it needs."""
    for path in PAGES:
        text = path.read_text(encoding="utf-8")
        assert len(BLOCK.findall(text)) == len(re.findall(r"^```(?:bash|python)\n", text, re.M))
        assert len(re.findall(r"<!-- (?:needs|exits)", text)) == sum(bool(b.needs or b.exit_code) for b in blocks(path))
