"""Compare what a revision and the working tree write for the examples, byte for byte.

python -m benchmarks.same_bytes REV [--only NAME ...] [--work FOLDER]

Each example is articulated and finished with all formats by the code of REV, from a worktree in a temporary folder, and by
that of the working tree, with the same interpreter. Left out are `timing.json` (durations) and what contains the version
(the generator in `asset.json` and in GLB, the keys of saved stages) and reasons, which are prose. Prints a table and each
file that differs, and exits with 1 if there is one.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from benchmarks import EXAMPLES, ROOT, worktree

MESHES = EXAMPLES / "meshes"
FORMATS = "urdf,mjcf,usd,sdf,glb"
FINISHED = "finished"  # folder of Stage C's result
DURATIONS = "timing.json"
LEFT_OUT = {"version", "key", "reason"}  # in JSON; a key is a hash that contains the version


def write_assets(tree: Path, name: str, out: Path) -> None:
    """Articulate and finish an example with the code of a tree; the commands' messages go to out/log.txt."""
    out.mkdir(parents=True)
    environment = {**os.environ, "PYTHONPATH": str(tree / "src"), "ANYMESH_CACHE": str(out.parent / "cache")}
    mesh = (MESHES / f"{name}.glb").relative_to(ROOT)  # asset.json states the path as given
    commands = (
        ["articulate", str(mesh), "-o", str(out / name)],
        ["finish", str(out / name), "-o", str(out / FINISHED)],
    )
    with (out / "log.txt").open("w") as log:
        for command in commands:
            run = [sys.executable, "-m", "anymesh.cli", *command, "--formats", FORMATS, "--quiet"]
            subprocess.run(run, cwd=ROOT, env=environment, stdout=log, stderr=subprocess.STDOUT, check=True)


def without(value: Any) -> Any:
    """Return a JSON value without what is left out of the comparison."""
    if isinstance(value, dict):
        return {k: without(v) for k, v in value.items() if k not in LEFT_OUT}
    return [without(v) for v in value] if isinstance(value, list) else value


def contents(out: Path) -> dict[str, bytes]:
    """Return the bytes of each file of an example's outputs, and the log, without what is left out and folders."""
    found = {}
    for path in sorted(out.rglob("*")):
        if path.is_file() and path.name != DURATIONS:
            data = path.read_bytes().replace(str(out).encode(), b"OUT")
            if path.suffix == ".json" and path.parent.name != "transcript":
                data = json.dumps(without(json.loads(data))).encode()
            data = re.sub(rb"(articulate-anymesh )\d+\.\d+\.\d+", rb"\1", data)  # in a GLB
            found[str(path.relative_to(out))] = data
    return found


def differences(before: dict[str, bytes], after: dict[str, bytes]) -> list[str]:
    """Return what differs, a line per file."""
    lines = [f"{name}: {'only before' if name in before else 'only after'}" for name in sorted(before.keys() ^ after.keys())]
    for name in sorted(before.keys() & after.keys()):
        old, new = before[name], after[name]
        if old != new:
            first = next((k for k, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), min(len(old), len(new)))
            lines.append(f"{name}: {len(old)} and {len(new)} bytes, different from byte {first}")
    return lines


def main() -> int:
    parser = argparse.ArgumentParser(description="Compare outputs of two revisions byte for byte.")
    parser.add_argument("revision", help="a revision of git to compare the working tree with")
    parser.add_argument("--only", nargs="+", help="examples by name; all by default")
    parser.add_argument("--work", type=Path, help="keep the outputs in this new folder")
    options = parser.parse_args()
    names = options.only or sorted(path.stem for path in MESHES.glob("*.glb"))
    with worktree(options.revision) as tree, tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        work = options.work or Path(folder)
        trees = {"before": tree, "after": ROOT}
        runs = [pool.submit(write_assets, place, name, work / name / side) for name in names for side, place in trees.items()]
        for run in runs:
            run.result()
        different: list[str] = []
        print("| example | files | different |\n|---|---|---|")
        for name in names:
            before, after = (contents(work / name / side) for side in trees)
            found = differences(before, after)
            different += [f"{name}/{line}" for line in found]
            print(f"| {name} | {len(after)} | {len(found)} |")
    print(*different, sep="\n")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
