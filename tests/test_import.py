"""Importing costs next to nothing, and help comes at once."""

import subprocess
import sys
import time


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
