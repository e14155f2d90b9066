"""Count the files that one run of `anymesh articulate` goes through: imported, and with a function that runs.

python -m benchmarks.walk [--mesh FILE] [--list] [REV]       REV: a revision of git; the working tree by default
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from contextlib import nullcontext
from pathlib import Path

from benchmarks.same_bytes import MESHES, ROOT, worktree

CHILD = """
import json, sys, threading
source, mesh, folder = sys.argv[1:]
sys.path.insert(0, source)
IN_A_FUNCTION = 1  # flag of code: neither a module nor the body of a class
ran = set()
def profile(frame, event, argument):
    code = frame.f_code
    if event == "call" and code.co_flags & IN_A_FUNCTION and code.co_filename.startswith(source):
        ran.add(code.co_filename)
threading.setprofile(profile)
sys.setprofile(profile)
from anymesh.cli.app import run
code = run(["articulate", mesh, "-o", folder + "/asset", "--quiet"])
sys.setprofile(None)
modules = [m for name, m in sys.modules.items() if name.split(".")[0] == "anymesh"]
imported = sorted(m.__file__ for m in modules if getattr(m, "__file__", None))
with open(folder + "/walk.json", "w") as file:
    json.dump({"code": code, "imported": imported, "ran": sorted(ran)}, file)
"""


def walk(tree: Path, mesh: Path) -> dict[str, list[str]]:
    """Return the files of the package, relative to it, that were imported and that ran, when the code of a tree articulates."""
    source = tree.resolve() / "src"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-c", CHILD, source, mesh, folder], check=True)
        found = json.loads((Path(folder) / "walk.json").read_text())
    if found.pop("code"):
        raise SystemExit(f"{mesh}: articulate failed")
    return {what: [str(Path(file).relative_to(source)) for file in files] for what, files in found.items()}


def main() -> None:
    parser = argparse.ArgumentParser(description="Files that articulating a mesh goes through.")
    parser.add_argument("revision", nargs="?", help="a revision of git")
    parser.add_argument("--mesh", type=Path, default=MESHES / "cabinet.glb")
    parser.add_argument("--list", action="store_true", help="name the files that ran")
    options = parser.parse_args()
    with worktree(options.revision) if options.revision else nullcontext(ROOT) as tree:
        found = walk(tree, options.mesh)
    print(f"{len(found['imported'])} files imported, {len(found['ran'])} with a function that runs")
    if options.list:
        print(*found["ran"], sep="\n")


if __name__ == "__main__":
    main()
