"""Count files and lines of every part of the repository, or the files that `anymesh articulate` goes through.

python -m benchmarks.house                                 the working tree
python -m benchmarks.house --rev 80cc4289 --rev HEAD       files and lines before and after, as a table
python -m benchmarks.house --walk [--list] --rev HEAD      files that one run imports, and those of which a function runs
"""

from __future__ import annotations

import io
import json
import subprocess
import sys
import tarfile
import tempfile
from collections import Counter
from contextlib import nullcontext
from pathlib import Path, PurePosixPath

from benchmarks import EXAMPLES, ROOT, parser_of, table_head, table_row, worktree

MESH = EXAMPLES / "meshes" / "cabinet.glb"  # that --walk articulates
TREE = "working tree"
PARTS = (
    "core",
    "readers of formats and of stated joints",
    "prompted",
    "finishing",
    "checking",
    "evaluation",
    "viewer, correcting, agents and their commands",
    "applications and their commands",
    "src",
    "benchmarks without reports and recordings",
    "training without kinds",
    "training kinds",
    "tests",
    "all Python",
)
FOLDERS = {  # of src/anymesh, by part; what is not listed is core
    "readers of formats and of stated joints": ("formats", "stated"),
    "prompted": ("prompted", "vlm", "models", "cli/answer", "cli/models", "weights"),
    "finishing": ("finishing", "completion", "pipeline/finishing", "cli/finish"),
    "checking": ("checking", "simulation", "cli/check"),
    "evaluation": ("evaluation", "cli/evaluate", "cli/report"),
    PARTS[6]: ("viewer", "correcting", "agents", "cli/view", "cli/mcp", "cli/skill"),
    PARTS[7]: ("applications", *(f"cli/{name}" for name in ("annotate", "generate", "plan", "scan", "train"))),
}
FINISHING_MODELS = ("holopart", "meshy", "web")  # in `models`, before it was divided
PROMPTED_MODULES = {  # among modules of the core, before the paper's method had a folder of its own
    "segmentation": "ask_marks close_ups cloud em faces fuse ground_exact ground_masks grounded grounded_parts hidden"
    " mark_pictures mask_instances propose regions regrounding unseen",
    "articulation": "answer_evidence candidate_points cases contradictions decode offers own_axes prompted relabel unverified"
    " verify",
    "rendering": "arrows card insides marks points sheet visual_prompts",
    "pipeline": "prompted_stages answering",
}
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


def part_of(path: PurePosixPath) -> str:
    """Return the part of PARTS that a module of src/anymesh belongs to; path: relative to that folder."""
    module, place = path.stem, path.with_suffix("").as_posix()
    if path.parts[0] == "models" and module.startswith(FINISHING_MODELS):
        return "finishing"
    if len(path.parts) == 2 and module in PROMPTED_MODULES.get(path.parts[0], "").split():
        return "prompted"
    for part, folders in FOLDERS.items():
        if any(place == folder or place.startswith(f"{folder}/") for folder in folders):
            return part
    return "core"


def sums_of(path: PurePosixPath) -> list[str]:
    """Return the rows that a Python file of the repository counts in."""
    found = ["all Python"]
    top = path.parts[0]
    if top == "src":
        found += ["src", part_of(path.relative_to("src/anymesh"))]
    elif top == "training":
        found.append("training kinds" if path.parts[1] == "kinds" else "training without kinds")
    elif top == "tests":
        found.append("tests")
    elif top == "benchmarks" and len(path.parts) == 2:
        found.append("benchmarks without reports and recordings")
    return found


def sources(revision: str) -> dict[PurePosixPath, str]:
    """Return the text of each Python file of a revision, or of the working tree without hidden and built folders."""
    if revision == TREE:
        paths = [path.relative_to(ROOT) for path in sorted(ROOT.rglob("*.py"))]
        kept = [path for path in paths if not path.parts[0].startswith(".") and path.parts[0] not in ("build", "dist", "out")]
        return {PurePosixPath(path): (ROOT / path).read_text("utf-8") for path in kept}
    packed = subprocess.run(["git", "archive", revision], cwd=ROOT, capture_output=True, check=True).stdout
    with tarfile.open(fileobj=io.BytesIO(packed)) as tree:
        files = {member.name: tree.extractfile(member) for member in tree if member.name.endswith(".py")}
        return {PurePosixPath(name): file.read().decode() for name, file in files.items() if file}


def counted(revision: str) -> tuple[Counter[str], Counter[str]]:
    """Return files and lines by row of PARTS."""
    files, lines = Counter[str](), Counter[str]()
    for path, text in sources(revision).items():
        for part in sums_of(path):
            files[part] += 1
            lines[part] += text.count("\n")
    return files, lines


def walk(tree: Path) -> dict[str, list[str]]:
    """Return the files of the package, relative to it, that were imported and that ran, when the code of a tree articulates."""
    source = tree.resolve() / "src"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-c", CHILD, source, MESH, folder], check=True)
        found = json.loads((Path(folder) / "walk.json").read_text())
    if found.pop("code"):
        raise SystemExit(f"{MESH}: articulate failed")
    return {what: [str(Path(file).relative_to(source)) for file in files] for what, files in found.items()}


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("--rev", action="append", help="a revision of git, more than once for columns beside each other")
    parser.add_argument("--walk", action="store_true", help="count the files that articulating a mesh goes through")
    parser.add_argument("--list", action="store_true", help="with --walk: name the files that ran")
    options = parser.parse_args()
    revisions = options.rev or [TREE]
    if not options.walk:
        counts = [counted(revision) for revision in revisions]
        print(*table_head(["files / lines", *revisions]), sep="\n")
        for part in PARTS:
            print(table_row([part, *(f"{files[part]} / {lines[part]:,}" for files, lines in counts)]))
        return
    for revision in revisions:
        with nullcontext(ROOT) if revision == TREE else worktree(revision) as tree:
            found = walk(tree)
        print(f"{revision}: {len(found['imported'])} files imported, {len(found['ran'])} with a function that runs")
        if options.list:
            print(*found["ran"], sep="\n")


if __name__ == "__main__":
    main()
