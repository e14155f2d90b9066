"""Whether more objects, and which of our own kinds, make the trees of the parts' classifier better on sources left out.

python -m training.learning_curve ROWS              benchmarks/reports/curve.md: with 100, 200, 400, ... objects of Articraft
python -m training.learning_curve ROWS --ablation   benchmarks/reports/ablation.md: our own kinds left out, a subject at a time

ROWS: as for `training/train_parts.py`. Trained on: Articraft and our own kinds; measured on Articraft's kinds for validation,
on the sources that are not trained on, and by the parts found on each still model by artists (`held_out.write_still`, measured
into the same folder as `static:WORK/still@still`).
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from benchmarks import REPORTS
from training.boosting import fit
from training.kinds.registry import subject_of
from training.part_rows import PartRows, read_rows
from training.splits import ARTICRAFT, STILL, Use, used_for
from training.train_parts import MODELS, SMALL, chances, choices, outcomes, samples_of, total

OWN, INFINIGEN = "kinds", "infinigen"
SIZES = (100, 200, 400, 800)  # objects of Articraft; then all
SEED = 74  # of the order in which objects are added
COLUMNS = ("validation kinds", "Infinigen", "small sets", "parts found on each still model")


def measured(rows: Sequence[PartRows], tests: Mapping[str, Sequence[PartRows]]) -> list[float]:
    """Train trees on some rows; return the part F1 on each test, and the parts found for each of the still objects."""
    trees = fit(samples_of(rows), MODELS)
    found = []
    for name, some in tests.items():
        counts = total(outcomes(some, choices(some, chances([trees.score(r.features) for r in some]))))
        found.append(counts.found / max(len(some), 1) if name == COLUMNS[-1] else counts.f1)
    return found


def spread_over_kinds(rows: Sequence[PartRows]) -> list[PartRows]:
    """Return the rows in an order in which each kind is as often among the first as any other."""
    order = np.random.default_rng(SEED).permutation(len(rows))
    seen: dict[str, int] = {}
    rank = []
    for k in order:
        seen[rows[k].kind] = seen.get(rows[k].kind, -1) + 1
        rank.append(seen[rows[k].kind])
    return [rows[order[k]] for k in np.argsort(rank, kind="stable")]


def tests_of(rows: Sequence[PartRows]) -> dict[str, list[PartRows]]:
    """Return what is measured, by column."""
    groups = (
        used_for(Use.VALIDATION, rows), [r for r in rows if r.source == INFINIGEN], [r for r in rows if r.source in SMALL],
        [r for r in rows if r.source == STILL],
    )  # fmt: skip
    return {name: [r for r in some if not r.form] for name, some in zip(COLUMNS, groups, strict=True)}


def line(title: str, count: int, figures: Sequence[float]) -> str:
    return f"| {title} | {count} | {' | '.join(f'{f:.3f}' for f in figures)} |"


def head(tests: Mapping[str, Sequence[PartRows]]) -> list[str]:
    return [
        f"| trained on | objects | {' | '.join(f'{name} ({len(some)})' for name, some in tests.items())} |",
        "|---" * (2 + len(tests)) + "|",
    ]


def curve(rows: Sequence[PartRows]) -> list[str]:
    """Return the lines of curve.md."""
    others = spread_over_kinds([r for r in used_for(Use.TRAIN, rows) if r.source == ARTICRAFT and not r.form])
    own = [r for r in rows if r.source == OWN and not r.form]
    tests = tests_of(rows)
    text = ["# Learning curve of the parts' classifier", "",
            "`python -m training.learning_curve ROWS`: trees only, part F1 at IoU .5, without names. Nothing of the",
            "columns is trained on.", "", *head(tests), line("our own kinds", len(own), measured(own, tests))]  # fmt: skip
    for size in [*(s for s in SIZES if s < len(others)), len(others)]:
        some = others[:size]
        text.append(line("Articraft", size, measured(some, tests)))
        text.append(line("Articraft and our own", size + len(own), measured([*some, *own], tests)))
    return [*text, ""]


def ablation(rows: Sequence[PartRows]) -> list[str]:
    """Return the lines of ablation.md: differences to training on all."""
    rows = [r for r in rows if not r.form]
    base = [r for r in used_for(Use.TRAIN, rows) if r.source == ARTICRAFT]
    own = [r for r in rows if r.source == OWN]
    subjects = sorted({subject_of(r.kind) for r in own})
    tests = tests_of(rows)
    all_of = np.array(measured([*base, *own], tests))
    text = ["# What each subject of our own kinds adds", "",
            "`python -m training.learning_curve ROWS --ablation`: trees trained on Articraft and on our own kinds without one",
            "subject, or with one alone; part F1 on what is left out, and its difference.", "",
            *head(tests), line("all", len(base) + len(own), all_of.tolist()),
            line("none of our own", len(base), measured(base, tests))]  # fmt: skip
    for subject in subjects:
        mine = [r for r in own if subject_of(r.kind) == subject]
        rest = [r for r in own if subject_of(r.kind) != subject]
        text.append(
            line(f"without {subject}", len(base) + len(rest), (np.array(measured([*base, *rest], tests)) - all_of).tolist())
        )
        text.append(line(f"only {subject}", len(base) + len(mine), measured([*base, *mine], tests)))
    return [*text, ""]


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description="Learning curve and ablation of the parts' classifier.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--ablation", action="store_true", help="leave out our own kinds, a subject at a time")
    options = parser.parse_args(argv)
    rows = read_rows(options.folder)
    text = ablation(rows) if options.ablation else curve(rows)
    (REPORTS / ("ablation.md" if options.ablation else "curve.md")).write_text("\n".join(text), encoding="utf-8")
    print("\n".join(text))


if __name__ == "__main__":
    main()
