"""Importing costs next to nothing, and help comes at once."""

import subprocess
import sys
import time
from pathlib import Path

import anymesh


def best_of(count: int, *command: str) -> float:
    times = []
    for _ in range(count):
        begin = time.perf_counter()
        subprocess.run(command, check=True, capture_output=True)
        times.append(time.perf_counter() - begin)
    return min(times)


def test_import_is_light() -> None:
    bare = best_of(3, sys.executable, "-c", "pass")
    assert best_of(3, sys.executable, "-c", "import anymesh") - bare < 0.3
    told = subprocess.run(
        [sys.executable, "-c", "import anymesh, sys; print(*sys.modules)"], check=True, capture_output=True, text=True
    )
    assert not {"trimesh", "scipy", "PIL", "numpy"} & set(told.stdout.split())


def test_help_comes_at_once() -> None:
    assert best_of(3, sys.executable, "-m", "anymesh.cli", "--help") < 1.0


def test_no_public_name_is_hidden_by_a_package():
    """Importing a subpackage sets an attribute of the package, which would replace a function of the same name."""
    packages = {path.stem for path in Path(anymesh.__file__).parent.iterdir() if path.is_dir() or path.suffix == ".py"}
    assert not packages & set(anymesh.__all__)
