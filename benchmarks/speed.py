"""Processor time of whole processes, a revision and the working tree in turns, and how it grows with the size of an object.

python -m benchmarks.speed --against REV [--quick] [--only WORK ...] [--pairs 5] [--data NAME=FOLDER[:COUNT] ...]

REV runs from a worktree in a temporary folder with the same interpreter. Each pair runs REV, then the working tree, each in a
process of its own with empty caches and compiled modules; the ratio is the median over the pairs of the processor time of the
process and its children. Works: import, help, examples, boards, shelf and chandelier (by components), smooth (torus, tube,
gear), pot (by faces; peak memory too), visual (the prompted road with the reference answerer), annotate (the examples on two
cores), and every --data: COUNT meshes of a folder, evenly spaced by name. --quick takes a few small ones. Slope: exponent of
the growth of the processor time with the size, sizes below a tenth of the largest left out. Writes benchmarks/reports/speed.md.

python -m benchmarks.speed --count [--renew]

Counts the work on three objects (`benchmarks/recordings/work.json`) and fails where a count is over 1.2 times the recorded one:
rays and calls of the ray caster, points and calls of exact distances and of those up to a limit, candidates with features, and
calls of Python functions.
--renew records the present counts.
"""

from __future__ import annotations

import argparse
import cProfile
import json
import os
import pstats
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any
from unittest.mock import patch

import numpy as np
import trimesh
from trimesh.creation import box, cylinder, icosphere, revolve, torus
from trimesh.util import concatenate

from benchmarks import EXAMPLES, RECORDINGS, REPORTS, ROOT, made_with, parser_of, table_head, table_row, worktree

Z_TO_Y = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])  # GLB files are Y up
LIMIT = 1200.0  # [s] for one process
TAIL = 0.1  # of the largest size: smaller ones do not count in the slope
SEED = 0
POT_LINES = 12  # segments of the three profiles of a pot, before they are divided
POT_POLES = 6  # ends of profiles on the axis, whose last row has triangles for quadrilaterals
POT_SECTIONS = 6  # sections round the axis, per row of a segment
TUBE_SHARE = 0.1  # of the components of a chandelier; the rest are beads
RING = 40  # items on one board of a shelf
SIDES = 256  # of a smooth solid
TEETH = 24  # of a cycloidal gear
MESHES = (".glb", ".gltf", ".obj", ".ply", ".stl", ".off", ".dae", ".fbx", ".usd", ".usdz")
WORK = RECORDINGS / "work.json"
COUNTED = ("table", "drill", "toy_car")
CLI = ("-m", "anymesh.cli")
MAX_MORE = 1.2  # a count may be so many times the recorded one


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


def smooth(kind: str) -> trimesh.Trimesh:
    """Make a smooth solid: a torus, a tube, or a gear with cycloidal teeth."""
    if kind == "torus":
        return torus(0.2, 0.06, major_sections=SIDES, minor_sections=SIDES // 4)
    if kind == "tube":
        return trimesh.creation.annulus(0.05, 0.06, 0.3, sections=SIDES)
    turn = np.linspace(0, 2 * np.pi, 16 * TEETH, endpoint=False)
    ring = np.stack([np.cos(turn), np.sin(turn)], 1) * (0.1 + 0.01 * np.abs(np.sin(TEETH / 2 * turn)))[:, None]
    count = len(ring)
    after = (np.arange(count) + 1) % count
    low, high = np.column_stack([ring, np.zeros(count)]), np.column_stack([ring, np.full(count, 0.03)])
    points = np.concatenate([low, high, [[0, 0, 0], [0, 0, 0.03]]])
    k = np.arange(count)
    sides = [[k, after, after + count], [k, after + count, k + count]]
    ends = [[after, k, np.full(count, 2 * count)], [k + count, after + count, np.full(count, 2 * count + 1)]]
    return trimesh.Trimesh(points, np.concatenate([np.stack(f, 1) for f in (*sides, *ends)]), process=False)


OBJECTS: dict[str, Callable[[Any], trimesh.Trimesh]] = {f.__name__: f for f in (boards, shelf, chandelier, smooth, pot)}
SIZES: dict[str, tuple[Any, ...]] = {
    "boards": (10, 100, 500), "shelf": (10, 100, 500), "chandelier": (10, 100, 500, 5_000),
    "smooth": ("torus", "tube", "gear"), "pot": (1_000, 10_000, 100_000, 1_000_000),
}  # fmt: skip
WORKS = ("import", "help", "examples", *SIZES, "visual", "annotate")
QUICK = {"boards": (100,), "smooth": ("tube",)}
FEW = ("cabinet", "toy_car", "valve")  # examples of --quick
AIMS = dict.fromkeys(("boards", "shelf", "chandelier", "smooth"), 0.2)
AIMS |= {"examples": 0.5, "pot": 0.5, "visual": 0.4, "annotate": 0.4}  # ratios


@dataclass(frozen=True)
class Work:
    """Commands that are timed together, as arguments of Python; {out} stands for a new folder. size: None without a slope."""

    name: str
    commands: tuple[tuple[str, ...], ...]
    size: float | None = None


@dataclass(frozen=True)
class Cost:
    """Processor time [s] of processes and their children, and the largest resident memory of one process [GiB]."""

    seconds: float
    peak: float


def articulated(mesh: Path, *more: str) -> tuple[str, ...]:
    """Return the arguments that articulate a mesh."""
    return (*CLI, "articulate", str(mesh), "-o", "{out}/asset", "-q", *more)


def works(folder: Path, wanted: Sequence[str], data: Sequence[str], quick: bool) -> Iterator[Work]:
    """Yield what is timed; meshes that are made go to the folder."""
    meshes = [EXAMPLES / "meshes" / f"{n}.glb" for n in FEW] if quick else sorted((EXAMPLES / "meshes").glob("*.glb"))
    sizes = QUICK if quick else SIZES
    for name in wanted:
        if name == "import":
            yield Work("`import anymesh`", (("-c", "import anymesh"),) * 5)
        elif name == "help":
            yield Work("`anymesh --help`", ((*CLI, "--help"),) * 5)
        elif name == "examples":
            yield Work(f"examples: {len(meshes)}", tuple(map(articulated, meshes)))
        elif name == "visual":
            only = ("--only", ",".join(FEW)) if quick else ()
            yield Work(
                "visual: examples", ((*CLI, "eval", "examples", "--answerer", "oracle", "-o", "{out}/asset", "-q", *only),)
            )
        elif name == "annotate" and not quick:
            source = str(EXAMPLES / "meshes")
            yield Work("annotate: examples", ((*CLI, "annotate", source, "-o", "{out}/asset", "-j", "2", "-q"),))
        for size in sizes.get(name, ()):
            path = folder / f"{name}_{size}.glb"
            OBJECTS[name](size).apply_transform(Z_TO_Y).export(path)
            yield Work(f"{name}: {size}", (articulated(path),), None if isinstance(size, str) else size)
    for word in data:
        name, _, place = word.partition("=")
        source, _, count = place.partition(":")
        found = sorted(p for p in Path(source).rglob("*") if p.suffix.lower() in MESHES)
        if not found:
            print(f"{name}: left out, no mesh in {source}", flush=True)
            continue
        chosen = found[:: max(1, len(found) // int(count or len(found)))][: int(count or len(found))]
        yield Work(f"{name}: {len(chosen)}", tuple(map(articulated, chosen)))


def cost(work: Work, tree: Path, byte_code: Path) -> Cost:
    """Run the commands of a work with the code of a tree. Raises SystemExit where one fails or takes too long."""
    seconds = peak = 0.0
    kept = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    for command in work.commands:
        with tempfile.TemporaryDirectory() as out:
            settings = {"ANYMESH_CACHE": f"{out}/cache", "PYTHONPYCACHEPREFIX": str(byte_code), "PYTHONPATH": str(tree / "src")}
            arguments = ["timeout", str(LIMIT), sys.executable, *(a.replace("{out}", out) for a in command)]
            child = subprocess.Popen(arguments, env=kept | settings, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            _, status, usage = os.wait4(child.pid, 0)
        if status:
            raise SystemExit(f"{work.name}: {' '.join(command)} failed, or took longer than {LIMIT:g} s")
        seconds += usage.ru_utime + usage.ru_stime
        peak = max(peak, usage.ru_maxrss / 2**20)
    return Cost(seconds, peak)


def slope(points: Sequence[tuple[float, float]]) -> float:
    """Return the exponent of the growth of processor time with size, NaN for fewer than two sizes."""
    tail = [(size, seconds) for size, seconds in points if size >= TAIL * points[-1][0]]
    return float(np.polyfit(*np.log(tail).T, 1)[0]) if len(tail) > 1 else float("nan")


def compare(how: argparse.Namespace) -> None:
    """Time all works in pairs; the table is written after each."""
    lines, growth = list[str](), dict[str, list[tuple[float, float]]]()
    with worktree(how.against) as old, tempfile.TemporaryDirectory() as scratch:
        trees = (old, Path(scratch) / "old"), (ROOT, Path(scratch) / "new")
        for tree, code in trees:  # compile the modules
            cost(Work("warm up", (articulated(EXAMPLES / "meshes" / f"{FEW[0]}.glb"),)), tree, code)
        for work in works(Path(scratch), how.only or WORKS, how.data, how.quick):
            runs = [[cost(work, tree, code) for tree, code in trees] for _ in range(how.pairs)]
            before, after = (median(run[k].seconds for run in runs) for k in (0, 1))
            ratio, memory = median(n.seconds / o.seconds for o, n in runs), median(n.peak / o.peak for o, n in runs)
            kind = work.name.partition(":")[0]
            cells = f"{before:.2f}", f"{after:.2f}", f"{ratio:.2f}", f"{memory:.2f}"
            lines.append(table_row((work.name, *cells, AIMS.get(kind, ""))))
            print(lines[-1], flush=True)
            if work.size is not None:
                growth.setdefault(kind, []).append((work.size, after))
            write(lines + [f"Slope of {k}: {slope(sorted(v)):.2f}." for k, v in growth.items() if len(v) > 1], how)


def write(lines: list[str], how: argparse.Namespace) -> None:
    """Write the table to speed.md."""
    rows, slopes = [x for x in lines if x.startswith("|")], [x for x in lines if not x.startswith("|")]
    head = [
        "# Speed",
        "",
        f"`python -m benchmarks.speed {' '.join(sys.argv[1:])}`, {made_with('articulate-anymesh')}, {os.cpu_count()} cores, "
        f"median of {how.pairs} pairs. Load average at the end: {os.getloadavg()[1]:.1f}; above the number of cores, other "
        "jobs ran too, and all times are longer than on an idle machine.",
        "",
        *table_head(["work", f"{how.against[:9]} [s]", "now [s]", "ratio", "peak memory, ratio", "aim"]),
    ]
    (REPORTS / "speed.md").write_text("\n".join([*head, *rows, "", *slopes, ""]), encoding="utf-8")


def counts(name: str) -> dict[str, int]:
    """Count the work of one example in this process; child processes do not count."""
    from anymesh import articulate
    from anymesh.geometry import distance_
    from anymesh.geometry.raycast_ import RayScene
    from anymesh.segmentation import segment

    found: Counter[str] = Counter()

    def counted(function: Callable[..., Any], calls: str, size: str = "", points: int = 1) -> Callable[..., Any]:
        def call(*arguments: Any, **named: Any) -> Any:
            found[calls] += 1
            if size:
                found[size] += len(arguments[points])
            return function(*arguments, **named)

        return call

    profile = cProfile.Profile()
    with ExitStack() as stack, tempfile.TemporaryDirectory() as folder:
        stack.enter_context(patch.dict(os.environ, {"ANYMESH_CACHE": f"{folder}/cache"}))
        stack.enter_context(patch.object(RayScene, "first_hit", counted(RayScene.first_hit, "ray calls", "rays")))
        exact, near = counted(distance_.TriangleTree.nearest, "distance calls", "distances"), distance_.distances_within
        stack.enter_context(patch.object(distance_.TriangleTree, "nearest", exact))
        stack.enter_context(patch.object(distance_, "distances_within", counted(near, "limited calls", "limited distances", 0)))
        stack.enter_context(patch.object(segment, "part_features", counted(segment.part_features, "candidate features")))
        stack.enter_context(patch.object(segment, "ThreadPoolExecutor", InTurn))
        profile.runcall(articulate, EXAMPLES / "meshes" / f"{name}.glb", Path(folder) / name)
    found["python calls"] = sum(calls for _, calls, *_ in pstats.Stats(profile).stats.values())  # ty: ignore[unresolved-attribute]
    return dict(found)


class InTurn:
    """A pool without threads, which a profile would not see into."""

    def __init__(self, _size: int) -> None: ...

    def __enter__(self) -> InTurn:
        return self

    def __exit__(self, *_: object) -> None: ...

    map = staticmethod(map)


def count(renew: bool) -> None:
    """Compare the counts with the recorded ones, or record them. Raises SystemExit where one has grown too much."""
    counts(COUNTED[0])  # imports, and what is kept between runs
    now = {name: counts(name) for name in COUNTED}
    if renew:
        WORK.write_text(json.dumps(now, indent=1) + "\n", encoding="utf-8")
        return
    known = json.loads(WORK.read_text(encoding="utf-8"))
    more = [
        f"{name}: {amount} {what}, recorded {known[name].get(what, 0)}"
        for name, found in now.items()
        for what, amount in found.items()
        if amount > MAX_MORE * known[name].get(what, 0)
    ]
    if more:
        what_to_do = "find what does it (cProfile); where it must be, say so in the commit and run with --count --renew"
        raise SystemExit("\n".join([f"more than {MAX_MORE:g} times the recorded work; {what_to_do}:", *more]))


def main() -> None:
    """Compare times with a revision, or count work."""
    parser = parser_of(__doc__)
    parser.add_argument("--against", metavar="REV")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", nargs="+", choices=WORKS)
    parser.add_argument("--pairs", type=int, default=5)
    parser.add_argument("--data", nargs="+", default=[], metavar="NAME=FOLDER[:COUNT]")
    parser.add_argument("--count", action="store_true")
    parser.add_argument("--renew", action="store_true")
    how = parser.parse_args()
    if how.count:
        count(how.renew)
    elif how.against:
        compare(how)
    else:
        parser.error("one of --against and --count is needed")


if __name__ == "__main__":
    main()
