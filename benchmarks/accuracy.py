"""Accuracy on the examples: parts given, and end to end from the mesh alone.

python benchmarks/accuracy.py [NAME ...]
"""

from __future__ import annotations

import sys
import time
from pathlib import Path

from anymesh.config import Config
from anymesh.evaluation.score import ObjectScore, score, table
from anymesh.evaluation.truth import Truth, example_truths
from anymesh.loading import load_mesh, place_mesh
from anymesh.pipeline import find_joints, find_parts, make_answerer

EXAMPLES = Path(__file__).parents[1] / "examples"


def evaluate(truth: Truth, given: bool) -> ObjectScore:
    """Runs both stages (the second alone when parts are given) and scores them."""
    placed = place_mesh(load_mesh(truth.mesh))
    who, config = make_answerer("geometry"), Config()
    segmentation = truth.segmentation() if given else find_parts(placed.mesh, "auto", who, config)
    joints = find_joints(placed.mesh, segmentation, who, config)
    return score(truth, placed.mesh, placed.T_asset_source, segmentation, joints)


def main() -> None:
    names = [a for a in sys.argv[1:] if not a.startswith("-")]
    truths = [t for t in example_truths(EXAMPLES) if not names or t.name in names]
    for given in (True, False):
        begin = time.perf_counter()
        scores = [evaluate(t, given) for t in truths]
        print(f"\n## {'Parts given' if given else 'End to end'} ({time.perf_counter() - begin:.0f} s)\n")
        print(table(scores))
        for s in scores:
            for j in s.joints:
                bad = j.type_found is None or (j.angle or 0) > 2 or (j.position or 0) > 0.02 or j.opens_right is False
                if "-v" in sys.argv and (bad or j.iou < 0.8 or not j.parent_right):
                    print(s.name, j)


if __name__ == "__main__":
    main()
