"""Times, peak memory and the time of each stage on synthetic objects with more and more faces or components.

python -m benchmarks.speed [NAME[:SIZE,...] ...]      writes benchmarks/reports/speed.md

Names: pot (by faces), boards, chandelier and shelf (by connected components). The slope is that of
a line fitted to log(processor time) over log(size), sizes below a tenth of the largest left out: 1 is linear.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh
from trimesh.creation import box, cylinder, icosphere, revolve
from trimesh.util import concatenate

from benchmarks import REPORTS, made_with, parser_of, table_head, table_row

STAGES = ("load", "segment", "joints", "export")
Z_TO_Y = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])  # GLB files are Y up
LIMIT = 600.0  # [s] for one object
WARM_UP = 100  # faces of the pot that compiles the modules
TAIL = 0.1  # of the largest size: smaller ones do not count in the slope
SEED = 0
POT_LINES = 12  # segments of the three profiles of a pot, before they are divided
POT_POLES = 6  # ends of profiles on the axis, whose last row has triangles for quadrilaterals
POT_SECTIONS = 6  # sections round the axis, per row of a segment
TUBE_SHARE = 0.1  # of the components of a chandelier; the rest are beads
RING = 40  # items on one board of a shelf


def pot(faces: int) -> trimesh.Trimesh:
    """Make a pot with a lid that rests on it and a knob: three components, about `faces` faces."""
    rows = max(1, round(np.sqrt(faces / (2 * POT_LINES * POT_SECTIONS))))
    sections = max(12, round(faces / (2 * POT_LINES * rows - POT_POLES)))
    body = [(0, 0), (0.11, 0), (0.12, 0.02), (0.12, 0.14), (0.117, 0.14), (0.117, 0.022), (0, 0.004)]
    lid = [(0, 0.1405), (0.119, 0.1405), (0.119, 0.146), (0, 0.156)]
    knob = [(0, 0.1565), (0.012, 0.1565), (0.015, 0.17), (0, 0.178)]
    millimetres = [revolve(1000 * _finer(line, rows), sections=sections) for line in (body, lid, knob)]
    return concatenate(millimetres).apply_scale(0.001)  # revolved in metres, the smallest faces would be dropped


def _finer(line: list[tuple[float, float]], rows: int) -> np.ndarray:
    """Divide every segment of a line into `rows`."""
    at = np.linspace(0, len(line) - 1, rows * (len(line) - 1) + 1)
    points = np.array(line, float)
    return np.stack([np.interp(at, np.arange(len(line)), points[:, k]) for k in range(2)], 1)


def boards(components: int) -> trimesh.Trimesh:
    """Make a container of boards on a tray, each crossed by bars that go through it."""
    made = [_box((1.0, 0.6, 0.03), (0, 0, 0.015))]
    count = max(0, components - 1)
    across = max(1, int(np.ceil(np.sqrt(count / 4))))
    rng = np.random.default_rng(SEED)
    for k in range(count):
        board, bar = divmod(k, 4)
        row, column = divmod(board, across)
        x, y = -0.45 + 0.9 * (column + 0.5) / across, -0.27 + 0.54 * (row + 0.5) / across
        width, height = 0.7 / across, 0.25 + 0.1 * rng.random()
        if bar == 0:
            made.append(_box((width, 0.05 / across, height), (x, y, 0.03 + height / 2)))
        else:
            made.append(_box((0.04 / across, 0.3 / across, 0.01), (x, y, 0.03 + 0.06 * bar)))
    return concatenate(made)


def chandelier(components: int) -> trimesh.Trimesh:
    """Make a lamp: a stem, thin tubes out from it and strings of beads that hang below them."""
    made = [cylinder(0.02, 0.8, sections=24).apply_translation((0, 0, 0.4))]
    tubes = max(1, int(TUBE_SHARE * components)) if components > 1 else 0
    per_tube = -(-max(0, components - 1 - tubes) // max(1, tubes))
    bead = icosphere(subdivisions=1, radius=0.004)
    for k in range(tubes):
        angle, level = 2.4 * k, 0.3 + 0.4 * (k + 0.5) / tubes
        end = np.array([0.4 * np.cos(angle), 0.4 * np.sin(angle), level])
        made.append(cylinder(0.003, segment=[[0, 0, level], end], sections=12))
        for b in range(min(per_tube, components - len(made))):
            made.append(bead.copy().apply_translation(end - (0, 0, 0.012 * (b + 1))))
    return concatenate(made[:components])


def shelf(components: int) -> trimesh.Trimesh:
    """Make a shelf: a frame of boards in one piece, and items that stand on them."""
    levels = max(1, -(-components // RING))
    walls = [_box((0.02, 0.3, 0.35 * levels + 0.02), (x, 0, 0.175 * levels)) for x in (-0.51, 0.51)]
    floors = [_box((1.04, 0.3, 0.02), (0, 0, 0.35 * k)) for k in range(levels + 1)]
    frame = trimesh.boolean.union([*walls, *floors], engine="manifold")
    rng = np.random.default_rng(SEED)
    items = []
    for k in range(components - 1):
        level, at = divmod(k, RING)
        row, column = divmod(at, RING // 2)
        height, side = 0.05 + 0.2 * rng.random(), 0.02 + 0.015 * rng.random()
        where = (-0.47 + 0.94 * column / (RING // 2 - 1), -0.07 + 0.14 * row, 0.35 * level + 0.0101 + height / 2)
        round_one = k % 3 == 0
        shape = cylinder(side / 2, height, sections=16) if round_one else box((side, 1.5 * side, height))
        items.append(shape.apply_translation(where))
    return concatenate([frame, *items])


def _box(size: tuple[float, ...], middle: tuple[float, ...]) -> trimesh.Trimesh:
    return box(size).apply_translation(middle)


OBJECTS: dict[str, Callable[[int], trimesh.Trimesh]] = {f.__name__: f for f in (pot, boards, chandelier, shelf)}
SIZES = dict.fromkeys(OBJECTS, (1, 10, 100, 500, 2_000, 5_000)) | {"pot": (1_000, 10_000, 61_000, 250_000, 1_000_000)}


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
        seconds = (f"{self.wall:.1f}", f"{self.cpu:.1f}", f"{self.peak:.2f}", *(f"{s:.1f}" for s in self.stages))
        return table_row((self.name, self.size, self.faces, self.joints, *seconds))


def timed(name: str, size: int, byte_code: Path) -> Run:
    """Run `anymesh articulate` on one object in a child process with empty caches. Raises SystemExit where it fails or takes
    too long.

    byte_code: a folder that keeps compiled modules between calls, as an installed package does.
    """
    with tempfile.TemporaryDirectory() as folder:
        path, out = Path(folder) / f"{name}.glb", Path(folder) / "out"
        mesh = OBJECTS[name](size).apply_transform(Z_TO_Y)
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


def requested(word: str) -> tuple[str, tuple[int, ...]]:
    """Return the name and the sizes in NAME or NAME:SIZE,..."""
    name, _, sizes = word.partition(":")
    if name not in SIZES:
        raise argparse.ArgumentTypeError(f"found {name!r}; valid are {', '.join(SIZES)}")
    return name, tuple(int(s) for s in sizes.split(",")) if sizes else SIZES[name]


def main() -> None:
    """Time all that is asked for; the table is written after each object."""
    parser = parser_of(__doc__)
    parser.add_argument("objects", nargs="*", type=requested, default=list(SIZES.items()), metavar="NAME[:SIZE,...]")
    options = parser.parse_args()
    lines: list[str] = []
    with tempfile.TemporaryDirectory() as byte_code:
        timed("pot", WARM_UP, Path(byte_code))
        for name, sizes in options.objects:
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
        f"`python -m benchmarks.speed {' '.join(sys.argv[1:])}`, {made_with('articulate-anymesh')}, {os.cpu_count()} cores. "
        "Synthetic objects; size: requested number of faces (pot), connected components (the others). Slope: "
        "exponent of the growth of the processor time with the size, over the largest tenfold range. cpu: processor time of "
        "the process and its children. Load average of the machine at the end: "
        f"{os.getloadavg()[1]:.1f}; above the number of cores, other jobs ran too, and both times are longer than on an idle "
        "machine.",
        "",
        *table_head(["object", "size", "faces", "joints", "wall [s]", "cpu [s]", "peak [GiB]", *(f"{s} [s]" for s in STAGES)]),
    ]
    (REPORTS / "speed.md").write_text("\n".join([*head, *lines, ""]), encoding="utf-8")


if __name__ == "__main__":
    main()
