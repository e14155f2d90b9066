"""Accuracy on objects with known joints: parts given, and end to end from the mesh alone.

python benchmarks/accuracy.py [-v] [NAME ...]      examples and scene-synthesizer's classes; -v prints every joint that is off
python benchmarks/accuracy.py --markdown FILE      also writes the tables
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path

from anymesh.evaluation.datasets.scene_synthesizer_ import CLASSES, synthesize
from anymesh.evaluation.protocols import evaluate
from anymesh.evaluation.score import table
from anymesh.evaluation.truth import Truth, example_truths
from anymesh.solving import solve

HEAD = """# Accuracy

`python benchmarks/accuracy.py --markdown benchmarks/accuracy.md`. Answerer: geometry alone. Position: the diagonal
is 2; opens: share of joints that open to the right side; range: IoU of the ranges.
"""
EXAMPLES = Path(__file__).parents[1] / "examples"


def report(title: str, truths: list[Truth], verbose: bool) -> str:
    """Both protocols on one set, as Markdown."""
    lines = []
    for given in (True, False):
        begin = time.perf_counter()
        scores = [evaluate(t, solve, given=given) for t in truths]
        protocol = "parts given" if given else "end to end"
        lines += [f"## {title}, {protocol} ({time.perf_counter() - begin:.0f} s)", "", table(scores), ""]
        print("\n".join(lines[-4:]))
        for s in scores:
            for j in s.joints:
                bad = j.type_found is None or (j.angle or 0) > 2 or (j.line_distance or 0) > 0.04 or j.opens_right is False
                if verbose and (bad or j.iou < 0.8 or not j.parent_right):
                    print(s.name, j)
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description="Accuracy on objects with known joints.")
    parser.add_argument("names", nargs="*", help="objects; all when none is named")
    parser.add_argument("-v", "--verbose", action="store_true", help="print every joint that is off")
    parser.add_argument("--markdown", type=Path, help="file to write the tables to")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        wanted = [c for c in CLASSES if not options.names or c in options.names]
        sets = {
            "Examples": [t for t in example_truths(EXAMPLES) if not options.names or t.name in options.names],
            "scene-synthesizer": [synthesize(c, Path(folder)) for c in wanted],
        }
        done = [report(title, truths, options.verbose) for title, truths in sets.items() if truths]
    if options.markdown:
        options.markdown.write_text("\n".join([HEAD, *done]), encoding="utf-8")


if __name__ == "__main__":
    main()
