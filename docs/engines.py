"""Which engines move which assets: every joint driven over its range, in each engine that is installed.

python docs/engines.py [--python ENGINE=INTERPRETER ...] [--engine NAME ...] [--page docs/engines.md] [ASSET ...]

ASSET: a folder of an asset, a URDF or an MJCF; without any, the examples named below are made first. Engines do not get on
in one environment, so each may have an interpreter of its own; it needs numpy, scipy and jaxtyping beside the engine. With
--page the table between the page's two marks is replaced.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import anymesh
from anymesh.checking.engines import ENGINES, sweep_in
from anymesh.checking.engines.driving import SweepReport
from anymesh.checking.engines.locate import find_description
from anymesh.errors import AnymeshError, InputError, MissingExtraError

ROOT = Path(__file__).parents[1]
EXAMPLES = ("microwave", "cabinet", "laptop", "stove")
BEGIN, END = "<!-- matrix: begin -->\n", "<!-- matrix: end -->\n"


@dataclass(frozen=True)
class Cell:
    """Outcome of one asset in one engine."""

    engine: str  # with its version where it ran
    asset: str
    shown: str
    seconds: float
    reasons: tuple[str, ...]


def run(engine: str, path: Path, python: str) -> Cell:
    """One engine on one asset, in a process of its own."""
    begin = time.perf_counter()
    try:
        outcome: SweepReport | AnymeshError = sweep_in(engine, path, apart=True, python=python)
    except (InputError, MissingExtraError) as error:
        outcome = error
    seconds = time.perf_counter() - begin
    if isinstance(outcome, MissingExtraError):
        return Cell(engine, path.stem, "not installed", seconds, ())
    if isinstance(outcome, AnymeshError):
        return Cell(engine, path.stem, "not loaded", seconds, (str(outcome),))
    good = sum(j.ok for j in outcome.joints)
    reasons = tuple(f"{j.name}: {fault}" for j in outcome.joints for fault in j.faults)
    return Cell(outcome.engine, path.stem, f"{good}/{len(outcome.joints)}", seconds, reasons)


def table(cells: list[Cell], assets: list[str]) -> str:
    """Engines down, assets across; the gaps below with their reasons."""
    rows: dict[str, list[Cell]] = {}
    for cell in cells:
        rows.setdefault(cell.engine.split()[0], []).append(cell)
    lines = [f"| engine | {' | '.join(assets)} | seconds |", "|---|" + "---|" * (len(assets) + 1)]
    for some in rows.values():
        name = max((c.engine for c in some), key=len)
        ran = [c.seconds for c in some if c.shown != "not installed"]
        shown = f"{ran[0]:.1f}, then {sum(ran[1:]) / max(len(ran) - 1, 1):.1f}" if ran else ""
        lines.append(f"| {name} | {' | '.join(c.shown for c in some)} | {shown} |")
    gaps = [f"- {c.asset} in {c.engine}: {reason}" for c in cells for reason in c.reasons]
    gap_lines = ["Gaps, with the reason that the engine gave:", "", *gaps] if gaps else ["No gap where an engine ran."]
    return "\n".join([*lines, "", *gap_lines]) + "\n"


def made(folder: Path) -> list[Path]:
    """The examples as assets."""
    for name in EXAMPLES:
        anymesh.articulate(ROOT / "examples" / "meshes" / f"{name}.glb", folder / name)
    return [folder / name for name in EXAMPLES]


def main() -> None:
    parser = argparse.ArgumentParser(description="Which engines move which assets.")
    parser.add_argument("assets", nargs="*", type=Path)
    parser.add_argument("--engine", action="append", choices=ENGINES, help="only these; all when none is named")
    parser.add_argument("--python", action="append", default=[], metavar="ENGINE=INTERPRETER")
    parser.add_argument("--page", type=Path, help="a page with the two marks")
    options = parser.parse_args()
    pythons = dict(pair.split("=", 1) for pair in options.python)
    os.environ["PYTHONPATH"] = str(Path(anymesh.__file__).parents[1])
    with tempfile.TemporaryDirectory() as folder:
        paths = [find_description(p) for p in options.assets or made(Path(folder))]
        cells = []
        for engine in options.engine or ENGINES:
            for path in paths:
                cells.append(run(engine, path, pythons.get(engine, sys.executable)))
                print(cells[-1], flush=True)
    text = table(cells, [p.stem for p in paths])
    print(text)
    if options.page:
        before, rest = options.page.read_text(encoding="utf-8").split(BEGIN)
        options.page.write_text(before + BEGIN + text + END + rest.split(END)[1], encoding="utf-8")


if __name__ == "__main__":
    main()
