"""Count files and lines of every part of the repository, at one or more revisions, as a Markdown table.

python -m benchmarks.house                                 the working tree
python -m benchmarks.house --rev 80cc4289 --rev HEAD       files and lines before and after
"""

from __future__ import annotations

import argparse
import io
import subprocess
import tarfile
from collections import Counter
from pathlib import Path, PurePosixPath

ROOT = Path(__file__).parents[1]
TREE = "working tree"
PARTS = (
    "core",
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
    "prompted": ("prompted", "vlm", "models", "cli/answer", "cli/models", "weights"),
    "finishing": ("finishing", "completion", "pipeline/finishing", "cli/finish"),
    "checking": ("checking", "simulation", "cli/check"),
    "evaluation": ("evaluation", "cli/evaluate", "cli/report"),
    PARTS[5]: ("viewer", "correcting", "agents", "cli/view", "cli/mcp", "cli/skill"),
    PARTS[6]: ("applications", *(f"cli/{name}" for name in ("annotate", "generate", "plan", "scan", "train"))),
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
    """Return the text of each Python file of a revision, or of the working tree without what git ignores."""
    if revision == TREE:
        listed = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.py"]
        names = subprocess.run(listed, cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
        return {PurePosixPath(name): (ROOT / name).read_text("utf-8") for name in names if (ROOT / name).is_file()}
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


def main() -> None:
    parser = argparse.ArgumentParser(description="Files and lines of every part of the repository.")
    parser.add_argument("--rev", action="append", help="a revision of git, more than once for columns beside each other")
    revisions = parser.parse_args().rev or [TREE]
    counts = [counted(revision) for revision in revisions]
    print(f"| files / lines | {' | '.join(revisions)} |\n|---|{'---|' * len(revisions)}")
    for part in PARTS:
        print(f"| {part} | {' | '.join(f'{files[part]} / {lines[part]:,}' for files, lines in counts)} |")


if __name__ == "__main__":
    main()
