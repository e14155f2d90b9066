"""What the built-in shape completer gives back of objects made into surface meshes on purpose; parts and joints are given.

python -m benchmarks.completion                              all sets, as tables
python -m benchmarks.completion --markdown FILE              also written to a file
python -m benchmarks.completion --only NAME --pictures DIR   some objects, open before and after
"""

from __future__ import annotations

import argparse
import platform
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date
from importlib.metadata import version
from pathlib import Path

import numpy as np

from anymesh.evaluation.changes import changed
from anymesh.evaluation.datasets.urdf_ import CLASSES, synthesize
from anymesh.evaluation.evaluate_sample import drive
from anymesh.evaluation.ground_truth import GroundTruth, example_truths, prepared
from anymesh.finishing.complete import complete_shapes
from anymesh.types import JointType
from benchmarks.completion_figures import cavity, grid_of, iou, moved, open_parts, picture

EXAMPLES = Path(__file__).parents[1] / "examples"
CHANGES = ("unseen-gone", "fused")
LEAST = 0.01  # share of the grid that a cavity takes at least; less is a gap
STEPS = 60  # places along a joint's range in the simulator
PACKAGES = ("articulate-anymesh", "numpy", "mujoco", "manifold3d", "scene_synthesizer")
HEAD = """# Shape completion (paper, 3.4)

`python -m benchmarks.completion --markdown benchmarks/completion.md`, {date}, Python {python}, {packages}.

The interior of objects whose interior is known is removed: `unseen-gone` removes the faces that no view shows at rest,
`fused` wraps the visible surface in one closed surface, as scans and generators produce it, and cuts it into parts by the
true labels. Parts and joints are the true ones, so that only completion is measured. Objects that ship fused are left out:
their interior is not known.

- Cavity IoU: cells (40 along the longest side) of empty space that is enclosed at rest and that the moving parts open, of the
  completed mesh against the true one; "-" if the true cavity fills less than 1 % of the grid.
- Moved: distance between the visible surfaces at rest, in both directions, as a share of the diagonal (99th percentile over the
  visible points).
- Watertight: parts all of whose surfaces are closed and consistently wound, before and after.
- Faults: joints that a motor cannot drive through their range in MuJoCo, before and after.
"""


@dataclass(frozen=True)
class Row:
    """One object. cavity: IoU, not a number without one; moved: share of the diagonal; faults: joints; seconds: to complete."""

    name: str
    cavity: float
    moved: float
    parts: int
    tight: tuple[int, int]
    joints: int
    faults: tuple[int, int]
    new: int
    seconds: float


def measure(truth: GroundTruth, change: str, pictures: Path | None) -> Row:
    whole = prepared(truth)
    true, surface = whole.asset(), changed(change, whole).asset()
    begin = time.perf_counter()
    finished = complete_shapes(surface)
    seconds = time.perf_counter() - begin
    done = finished.asset
    grid = grid_of(true.mesh)
    known, found = cavity(true, grid), cavity(done, grid)
    faults = [len({f.split(":")[0] for f in drive(a.mesh, a.segmentation, a.joints, STEPS)}) for a in (surface, done)]
    if pictures:
        (pictures / f"{truth.name}_{change}.png").write_bytes(picture(true, surface, finished))
    count = len(surface.segmentation.parts)
    return Row(
        truth.name,
        iou(known, found) if known.mean() > LEAST else float("nan"),
        moved(surface.mesh, done.mesh),
        count,
        (count - len(open_parts(surface)), count - len(open_parts(done))),
        sum(j.type is not JointType.FIXED for j in done.joints),
        (faults[0], faults[1]),
        len(done.mesh.faces) - len(surface.mesh.faces),
        seconds,
    )


def table(title: str, rows: Sequence[Row]) -> str:
    lines = [f"## {title}", "", "| object | cavity IoU | moved | parts watertight | joints with faults | new faces | seconds |"]
    lines.append("|---|---|---|---|---|---|---|")
    known = [r.cavity for r in rows if np.isfinite(r.cavity)]
    for r in rows:
        cell = f"{r.cavity:.3f}" if np.isfinite(r.cavity) else "-"
        tight, faults = f"{r.tight[0]} -> {r.tight[1]} of {r.parts}", f"{r.faults[0]} -> {r.faults[1]} of {r.joints}"
        lines.append(f"| {r.name} | {cell} | {r.moved:.3%} | {tight} | {faults} | {r.new} | {r.seconds:.1f} |")
    parts, joints = sum(r.parts for r in rows), sum(r.joints for r in rows)
    tight = " -> ".join(f"{sum(r.tight[k] for r in rows) / parts:.1%}" for k in (0, 1))
    faults = " -> ".join(str(sum(r.faults[k] for r in rows)) for k in (0, 1))
    mean = f"mean {np.mean(known):.3f}, least {min(known):.3f}" if known else "-"
    most, new, seconds = max(r.moved for r in rows), sum(r.new for r in rows), sum(r.seconds for r in rows)
    lines.append(f"| **all** | {mean} | most {most:.3%} | {tight} | {faults} of {joints} | {new} | {seconds:.1f} |")
    return "\n".join([*lines, ""])


def main() -> None:
    parser = argparse.ArgumentParser(description="What the built-in shape completer gives back.")
    parser.add_argument("--markdown", type=Path, help="file to write the tables to")
    parser.add_argument("--pictures", type=Path, help="folder for a picture an object")
    parser.add_argument("--only", nargs="*", help="names of objects")
    parser.add_argument("--changes", nargs="*", default=CHANGES, help="how they are made into surfaces")
    options = parser.parse_args()
    packages = ", ".join(f"{name} {version(name)}" for name in PACKAGES)
    done = [HEAD.format(date=date.today().isoformat(), python=platform.python_version(), packages=packages)]
    if options.pictures:
        options.pictures.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        examples = [t for t in example_truths(EXAMPLES) if not t.name.endswith("_fused")]
        sets = {"examples": examples, "scene-synthesizer": [synthesize(c, Path(folder)) for c in CLASSES]}
        for change in options.changes:
            for title, truths in sets.items():
                rows = []
                for truth in truths:
                    if truth.joints and (not options.only or truth.name in options.only):
                        rows.append(measure(truth, change, options.pictures))
                        print(rows[-1], flush=True)
                if rows:
                    done.append(table(f"{title}, {change}", rows))
                    print(done[-1], flush=True)
    if options.markdown:
        options.markdown.write_text("\n".join(done), encoding="utf-8")


if __name__ == "__main__":
    main()
