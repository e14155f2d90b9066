"""Compare the answers of two viewers on which regions move with the classifier of parts.

python -m training.part_answers [FOLDER]      FOLDER: of `part_marks.py`; otherwise the one kept here, training/part_marks_data

Reads FOLDER/truth.json and the answers FOLDER/viewer_1.json and viewer_2.json, {"K": {"moves": [numbers], "unsure": [numbers]}}
with K the number of a picture.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import numpy as np
from jaxtyping import Bool

KEPT = Path(__file__).parent / "part_marks_data"


def f1_of(said: Bool[np.ndarray, " n"], moves: Bool[np.ndarray, " n"]) -> float:
    """Return the F1 of answers on which regions move."""
    return 2 * float((said & moves).sum()) / max(float(said.sum() + moves.sum()), 1.0)


def table(folder: Path) -> str:
    """Return how well the classifier and two viewers tell what moves, and where the viewers agree.

    differ, both wrong, unsure: shares of the regions; corrected: of the classifier's errors, where both viewers are right.
    """
    truth, *told = (
        json.loads((folder / f"{name}.json").read_text(encoding="utf-8")) for name in ("truth", "viewer_1", "viewer_2")
    )
    lines = [
        "| objects | regions | movable | F1, classifier | F1, viewer 1 | F1, viewer 2 "
        "| differ | both wrong | unsure | corrected |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for group in ("worst", "random"):
        mine = {key: o["regions"] for key, o in truth.items() if o["group"] == group}
        keys = [(key, int(k)) for key, of in mine.items() for k in of]
        moves, found = np.array([flags for of in mine.values() for flags in of.values()]).T
        said, unsure = (np.array([[k in t[key][what] for key, k in keys] for t in told]) for what in ("moves", "unsure"))
        shares = [f1_of(s, moves) for s in (found, *said)]
        right = said == moves
        shares += [float(share.mean()) for share in (said[0] != said[1], ~right.any(0), unsure, right.all(0)[found != moves])]
        figures = " | ".join(f"{share:.2f}" for share in shares)
        lines.append(f"| {len(mine)} {group} | {len(keys)} | {int(moves.sum())} | {figures} |")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description="Compare viewers with the classifier of parts.")
    parser.add_argument("folder", type=Path, nargs="?", default=KEPT)
    print(table(parser.parse_args().folder))


if __name__ == "__main__":
    main()
