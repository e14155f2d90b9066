"""Every committed report of `anymesh eval`, made anew, and one table over all of them.

python -m benchmarks.reports WORK               all; WORK keeps what is done, so a stopped run goes on
python -m benchmarks.reports WORK NAME ...      some of them, such as sweethome3d-parts; the table is of those in WORK
python -m benchmarks.reports WORK --place sweethome3d=FILE.deb     a set that lies elsewhere
"""

from __future__ import annotations

import re
import shlex
import shutil
from collections.abc import Sequence
from pathlib import Path

from anymesh.cli import run
from anymesh.evaluation.record import Record, record_of
from anymesh.evaluation.report import markdown
from anymesh.evaluation.summary import group_table
from benchmarks import REPORTS, parser_of

SETS = ("examples", "scene-synthesizer", "sweethome3d", "metaworld", "libero")
HARSH = "none,turned,spun,lying,noise.0005,half-faces,unseen-gone,joined,fused,fused-coarse"
CARELESS = "none,doubled,two-sided,inside-out,mixed,cracked"  # what careless exports do to the faces
ADDED = "none,detailed,furnished,floored,misplaced"  # what artists add or place by eye
MOVING = ("sweethome3d", "metaworld", "libero")  # sets all of whose objects are known to move
RUNS = {
    **{f"{name}-parts": f"{name} --protocol parts" for name in SETS},
    **{f"{name}-end-to-end": f"{name} --protocol executability{' --at-least 1' * (name in MOVING)}" for name in SETS},
    **{f"{name}-fused": f"{name} --protocol end-to-end --changes fused{' --at-least 1' * (name in MOVING)}" for name in SETS},
    **{f"{name}-views": f"{name} --protocol views --views 2" for name in ("examples", "scene-synthesizer", "sweethome3d")},
    "scene-synthesizer-random-parts": "scene-synthesizer --split random --protocol parts",
    "examples-robustness": f"examples --protocol end-to-end --changes {HARSH}",
    **{
        f"{name}-{what}": f"{name} --protocol end-to-end --changes {changes}"
        for what, changes in (("careless", CARELESS), ("added", ADDED))
        for name in ("examples", "sweethome3d")
    },
    "sweethome3d-robustness": "sweethome3d --protocol parts --changes none,turned,spun,noise.0005,half-faces,unseen-gone",
}
TABLES = {
    "Parts given": [f"{name}-parts" for name in SETS],
    "End to end, multi-component mesh": [f"{name}-end-to-end" for name in SETS],
    "End to end, fused surface": [f"{name}-fused" for name in SETS],
    "One view": [f"{name}-views" for name in ("examples", "scene-synthesizer", "sweethome3d")],
}
HEAD = """# Reports

Made by `python -m benchmarks.reports WORK`; each report begins with its command. Answerer: geometry (no key, no network).
The columns are explained in [docs/evaluation.md](../../docs/evaluation.md); "all" is over all sets together.

The shipped classifiers were trained on these sets (each report says on how many of its objects). These figures therefore show
that the components work together, not the accuracy on new objects; for that see [parts.md](parts.md) and
[motions.md](motions.md). Other jobs ran on the same two cores, so seconds are upper limits.
"""


def command(name: str, work: Path, places: dict[str, str]) -> list[str]:
    """The arguments of the command line for one report."""
    words = shlex.split(RUNS[name])
    words[0] = f"{words[0]}:{places[words[0]]}" if words[0] in places else words[0]
    return ["eval", *words, "-o", str(work / name)]


def records(folder: Path) -> list[Record]:
    lines = (line for path in sorted((folder / "objects").glob("*.jsonl")) for line in path.read_text().splitlines())
    return [record_of(line) for line in lines]


def summary(work: Path) -> str:
    """The tables over all sets."""
    text = [HEAD]
    for title, names in TABLES.items():
        groups = [(name, records(work / name)) for name in names if (work / name / "report.md").is_file()]
        if groups:
            groups.append(("all", [r for _, some in groups for r in some]))
            text.append(f"## {title}\n\n{markdown(group_table(title, groups))}")
    links = (f"- [{path.stem}]({path.name})" for path in sorted(REPORTS.glob("*.md")) if path.stem != "README")
    return "\n".join([*text, "\n## All reports\n", *links, ""])


def make(names: Sequence[str], work: Path, places: dict[str, str]) -> int:
    """Runs what is left of these, and copies the reports. Returns the last exit code that was not 0."""
    failed = 0
    for name in names:
        print(f"{name}: anymesh eval {RUNS[name]}", flush=True)
        code = run([*command(name, work, places), "--quiet"])
        failed = code or failed
        if code == 0:
            text = (work / name / "report.md").read_text(encoding="utf-8")
            for known, place in places.items():
                text = re.sub(rf"\b{known}:\S+", known, text).replace(place, known)  # where it lies is nobody's business
            text = text.replace("\n\n![The worst joints](worst.png)", "")  # the picture is not committed
            (REPORTS / f"{name}.md").write_text(f"`anymesh eval {RUNS[name]} -o DIR`\n\n{text}", encoding="utf-8")
    return failed


def main() -> int:
    parser = parser_of(__doc__)
    parser.add_argument("work", type=Path, metavar="WORK")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(RUNS)}")
    parser.add_argument("--place", action="append", default=[], metavar="SET=PLACE", help="where a set lies")
    parser.add_argument("--anew", action="store_true", help="remove what was done of these before")
    options = parser.parse_args()
    unknown = sorted(set(options.names) - set(RUNS))
    if unknown:
        parser.error(f"found {', '.join(unknown)}; valid are {', '.join(RUNS)}")
    names = options.names or list(RUNS)
    if options.anew:
        for name in names:
            shutil.rmtree(options.work / name, ignore_errors=True)
    code = make(names, options.work, dict(place.split("=", 1) for place in options.place))
    (REPORTS / "README.md").write_text(summary(options.work), encoding="utf-8")
    return code


if __name__ == "__main__":
    raise SystemExit(main())
