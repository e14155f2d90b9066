"""Times, peak memory and the time of each stage on synthetic objects with more and more faces or components.

python -m benchmarks.speed [NAME[:SIZE,...] ...]      writes benchmarks/speed.md

Names: pot (by faces), boards, chandelier, shelf and pile (by connected components), see speed_scenes.py. The slope is that of
a line fitted to log(processor time) over log(size), sizes below a tenth of the largest left out: 1 is linear.
"""

from __future__ import annotations

import datetime
import json
import os
import platform
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import numpy as np

from benchmarks.speed_scenes import COMPONENTS, FACES

HERE = Path(__file__).parent
STAGES = ("load", "segment", "joints", "export")
SIZES = {"pot": (1_000, 10_000, 61_000, 250_000, 1_000_000)} | dict.fromkeys(COMPONENTS, (1, 10, 100, 500, 2_000, 5_000))
Z_TO_Y = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])  # GLB files are Y up
LIMIT = 600.0  # [s] for one object
WARM_UP = 100  # faces of the pot that compiles the modules
TAIL = 0.1  # of the largest size: smaller ones do not count in the slope


@dataclass(frozen=True)
class Run:
    """One object through all stages: times [s] and memory [GiB] of the child process."""

    name: str
    size: int
    faces: int
    joints: int
    wall: float
    cpu: float
    peak: float
    stages: tuple[float, ...]

    @property
    def row(self) -> str:
        """One row of the table."""
        stages = " | ".join(f"{s:.1f}" for s in self.stages)
        seconds = f"{self.wall:.1f} | {self.cpu:.1f} | {self.peak:.2f}"
        return f"| {self.name} | {self.size} | {self.faces} | {self.joints} | {seconds} | {stages} |"


def timed(name: str, size: int, byte_code: Path) -> Run:
    """Run `anymesh articulate` on one object in a child process with empty caches. Raises SystemExit where it fails or takes
    too long.

    byte_code: a folder that keeps compiled modules between calls, as an installed package does.
    """
    with tempfile.TemporaryDirectory() as folder:
        path, out = Path(folder) / f"{name}.glb", Path(folder) / "out"
        mesh = (FACES | COMPONENTS)[name](size).apply_transform(Z_TO_Y)
        mesh.export(path)
        command = [sys.executable, "-m", "anymesh.cli", "articulate", str(path), "-o", str(out), "-q"]
        kept = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
        settings = {"ANYMESH_CACHE": str(Path(folder) / "cache"), "PYTHONPYCACHEPREFIX": str(byte_code)}
        begin = time.perf_counter()
        child = subprocess.Popen(["timeout", str(LIMIT), *command], env=kept | settings)
        _, status, usage = os.wait4(child.pid, 0)
        wall = time.perf_counter() - begin
        if status:
            raise SystemExit(f"{name} {size}: failed, or took longer than {LIMIT:g} s")
        seconds = json.loads((out / "timing.json").read_text())
        joints = len(json.loads((out / "asset.json").read_text())["joints"])
    stages = tuple(float(seconds.get(s, 0)) for s in STAGES)
    return Run(name, size, len(mesh.faces), joints, wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 2**20, stages)


def slope(runs: list[Run]) -> float:
    """Return the exponent of the growth of processor time with size, NaN for fewer than two sizes."""
    tail = [r for r in runs if r.size >= TAIL * runs[-1].size]
    if len(tail) < 2:
        return float("nan")
    return float(np.polyfit(np.log([r.size for r in tail]), np.log([r.cpu for r in tail]), 1)[0])


def requested(arguments: list[str]) -> Iterator[tuple[str, tuple[int, ...]]]:
    """Yield names with sizes: all by default."""
    for argument in arguments or SIZES:
        name, _, sizes = argument.partition(":")
        if name not in SIZES:
            raise SystemExit(f"found {name!r}; valid are {', '.join(SIZES)}")
        yield name, tuple(int(s) for s in sizes.split(",")) if sizes else SIZES[name]


def main() -> None:
    """Time all that is asked for; the table is written after each object."""
    lines: list[str] = []
    with tempfile.TemporaryDirectory() as byte_code:
        timed("pot", WARM_UP, Path(byte_code))
        for name, sizes in requested(sys.argv[1:]):
            runs = []
            for size in sorted(sizes):
                runs.append(timed(name, size, Path(byte_code)))
                print(runs[-1].row, flush=True)
                write([*lines, *(r.row for r in runs)])
            lines += [r.row for r in runs] + [f"| {name} | slope | | | {slope(runs):.2f} | | | | | | |"]
            print(lines[-1], flush=True)
            write(lines)


def write(lines: list[str]) -> None:
    """Write the table to speed.md."""
    head = [
        "# Speed",
        "",
        f"`python -m benchmarks.speed {' '.join(sys.argv[1:])}`, {datetime.date.today()}, "
        f"version {version('articulate-anymesh')}, Python {platform.python_version()}, {os.cpu_count()} cores. Synthetic "
        "objects of `speed_scenes.py`; size: requested number of faces (pot), connected components (the others). Slope: "
        "exponent of the growth of the processor time with the size, over the largest tenfold range. cpu: processor time of "
        "the process and its children. Load average of the machine at the end: "
        f"{os.getloadavg()[1]:.1f}; above the number of cores, other jobs ran too, and both times are longer than on an idle "
        "machine.",
        "",
        "| object | size | faces | joints | wall [s] | cpu [s] | peak [GiB] | "
        + " | ".join(f"{stage} [s]" for stage in STAGES)
        + " |",
        "|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    (HERE / "speed.md").write_text("\n".join([*head, *lines, ""]), encoding="utf-8")


if __name__ == "__main__":
    main()
