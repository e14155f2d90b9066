"""Wall time, peak memory and the cost of each stage for growing meshes.

python benchmarks/speed.py [FACES ...]      writes benchmarks/speed.md
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
from importlib.metadata import version
from pathlib import Path

import trimesh

HERE = Path(__file__).parent
SOURCE = HERE.parent / "examples" / "meshes" / "cabinet.glb"


def subdivided(faces: int, path: Path) -> int:
    """The cabinet with at least this many faces, as a GLB; returns how many."""
    scene = trimesh.load_scene(SOURCE)
    mesh = trimesh.Trimesh(*(lambda m: (m.vertices, m.faces))(scene.to_geometry()), process=False)
    while len(mesh.faces) * 4 <= faces:
        mesh = mesh.subdivide()
    if len(mesh.faces) < faces:
        mesh = mesh.subdivide(range((faces - len(mesh.faces)) // 3))
    mesh.export(path)
    return len(mesh.faces)


def main() -> None:
    sizes = [int(a) for a in sys.argv[1:]] or [10_000, 50_000, 100_000, 1_000_000]
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for size in sizes:
            path, out = Path(folder) / f"{size}.glb", Path(folder) / f"out_{size}"
            count = subdivided(size, path)
            begin = time.perf_counter()
            child = subprocess.Popen([sys.executable, "-m", "anymesh.cli", "articulate", str(path), "-o", str(out), "-q"])
            _, status, usage = os.wait4(child.pid, 0)
            wall = time.perf_counter() - begin
            if status:
                sys.exit(f"failed on {count} faces")
            told = json.loads((out / "timing.json").read_text())
            joints = len(json.loads((out / "asset.json").read_text())["joints"])
            stages = " | ".join(f"{told.get(s, 0):.1f}" for s in ("load", "segment", "joints", "export"))
            rows.append(f"| {count} | {joints} | {wall:.1f} | {usage.ru_maxrss / 2**20:.2f} | {stages} |")
            print(rows[-1], flush=True)
    text = "\n".join(
        [
            "# Speed",
            "",
            f"`python benchmarks/speed.py`, {datetime.date.today()}, version {version('articulate-anymesh')}, "
            f"Python {platform.python_version()}, {os.cpu_count()} cores. The cabinet of the examples, subdivided.",
            "",
            "| faces | joints | wall [s] | peak [GiB] | load | segment | joints [s] | export |",
            "|---|---|---|---|---|---|---|---|",
            *rows,
            "",
        ]
    )
    (HERE / "speed.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
