"""Train the classifier of motions (`anymesh.articulation.motion_classifier`) and measure it on what it was not trained on.

python benchmarks/train_motions.py FOLDER            benchmarks/motions.md: leave one source out, leave kinds out
python benchmarks/train_motions.py FOLDER --write    also trains on all and writes motion_classifier.npz with its manifest

FOLDER: rows as `benchmarks/motion_rows.py` writes them. Needs lightgbm. For the shipped classifier:
    python benchmarks/kinds.py KINDS --seed 11 --count 4
    python benchmarks/motion_rows.py FOLDER urdf:KINDS@kinds labelled:INFINIGEN@infinigen sweethome3d metaworld libero \
        examples scene-synthesizer mjcf:ROBOSUITE/models/assets/robots@robosuite mjcf:ROBOSUITE/models/assets/grippers@robosuite
    python benchmarks/motion_rows.py FOLDER urdf:KINDS@kinds labelled:INFINIGEN@infinigen --change fused --most 40
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np
from boosting import Model, Sample, Scores, fit, held_out, leave_kinds_out, leave_sources_out, manifest_of, write
from calibration import Scored, calibration_table, fit_confidence, log_odds
from collect_rows import called
from jaxtyping import Bool
from motion_rows import MotionRows, read_rows

from anymesh.articulation.estimate import MAX_COPIES
from anymesh.articulation.rank_motions import BLOCKED, share_of_best
from anymesh.articulation.repeated_parts import ScoredMotions, mean_over_copies

MODELS = tuple(Model(800, seed, extra_trees=True) for seed in range(3))
OBJECT, SOURCE = 0.5, 0.6  # powers by which parts of an object, and parts of a source, count less the more they are
HERE = Path(__file__).parent
WRITTEN = HERE.parent / "src" / "anymesh" / "articulation" / "motion_classifier.npz"


def right_side(rows: MotionRows) -> Bool[np.ndarray, " n"]:
    """Whether each motion is right and opens to the true side, if there is one."""
    return (rows.right > 0) & (rows.opens_right != 0)


def samples_of(rows: Sequence[MotionRows]) -> list[Sample]:
    """Return the motions of each part as samples."""
    parts = Counter((r.source, r.form, r.name) for r in rows)
    sources = Counter(r.source for r in rows)
    found = []
    for r in rows:
        near = np.where(right_side(r), r.right, 0.0)
        target = near / near.max() if near.any() else near  # the nearest to the true motion is right, others the less so
        weight = parts[r.source, r.form, r.name] ** -OBJECT * sources[r.source] ** -SOURCE
        found.append(Sample(r.source, r.kind, r.features, target, weight))
    return found


def over_copies(rows: Sequence[MotionRows], scores: Scores) -> Scores:
    """Return the mean of the scores of each part and of its copies."""
    number = {(r.source, r.form, r.name, r.number): k for k, r in enumerate(rows)}
    motions = [ScoredMotions.of(r.names, r.features, r.axes, s) for r, s in zip(rows, scores, strict=True)]
    found = []
    for own, r in zip(motions, rows, strict=True):
        keys = [(r.source, r.form, r.name, twin) for twin in r.twins[:MAX_COPIES]]
        found.append(mean_over_copies(own, [motions[number[key]] for key in keys if key in number]))
    return found


def table(rows: Sequence[MotionRows], scores: Scores, of: Callable[[MotionRows], str]) -> list[str]:
    """Return lines of a table, one for each group of parts."""
    lines = ["| | joints | offered | right motion | and right side |", "|---|---|---|---|---|"]
    best = [int(s.argmax()) for s in scores]
    for group in [*sorted({of(r) for r in rows}), "all"]:
        chosen = [k for k, r in enumerate(rows) if group in (of(r), "all")]
        offered = np.mean([bool(right_side(rows[k]).any()) for k in chosen])
        right = np.mean([rows[k].right[best[k]] > 0 for k in chosen])
        side = np.mean([right_side(rows[k])[best[k]] for k in chosen])
        lines.append(f"| {group} | {len(chosen)} | {offered:.2f} | {right:.2f} | {side:.2f} |")
    return lines


def right_of(rows: Sequence[MotionRows], scores: Scores) -> dict[str, float]:
    """Return the share of joints with the right motion and side, for each group of parts."""
    right: dict[str, list[bool]] = {}
    for r, s in zip(rows, scores, strict=True):
        right.setdefault(called(r), []).append(bool(right_side(r)[int(s.argmax())]))
    return {group: round(float(np.mean(some)), 3) for group, some in sorted(right.items())}


def confidences(rows: Sequence[MotionRows], scores: Scores) -> Scored:
    """Return the share of the best motion of each part before calibration, and whether the motion and its side are right."""
    ranked = [s + np.where(r.free, 0.0, BLOCKED) for r, s in zip(rows, scores, strict=True)]
    best = [int(s.argmax()) for s in ranked]
    shares = [share_of_best(s, r.same[k]) for r, s, k in zip(rows, ranked, best, strict=True)]
    right = np.array([right_side(r)[k] for r, k in zip(rows, best, strict=True)])
    return Scored(log_odds(np.array(shares)), right, [called(r) for r in rows])


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description="Train the classifier of motions.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args(argv)
    rows = read_rows(options.folder)
    samples = samples_of(rows)
    by_source = over_copies(rows, held_out(samples, leave_sources_out(samples), MODELS))
    by_kind = over_copies(rows, held_out(samples, leave_kinds_out(samples), MODELS))
    answers = confidences(rows, by_kind)
    slope, offset = fit_confidence(answers)
    text = [
        "# Motions chosen by the classifier, on objects that it was not trained on", "",
        "`python benchmarks/train_motions.py ROWS`; parts given, no names. Right: within 5 degrees and .08 of half the",
        "diagonal; right side: it opens in the direction of the true joint.", "",
        "## Trained on all other sources", "", *table(rows, by_source, called), "",
        "## Trained on other kinds (4 folds, a kind in one fold)", "", *table(rows, by_kind, called), "",
        "## Confidence", "",
        f"Fitted to other kinds, over all sources: slope {slope:.2f}, offset {offset:.2f}",
        "(`articulation/rank_motions.py`).",
        "", *calibration_table(answers, slope, offset), "", "The same on other sources:", "",
        *calibration_table(confidences(rows, by_source), slope, offset), "",
    ]  # fmt: skip
    (HERE / "motions.md").write_text("\n".join(text), encoding="utf-8")
    print("\n".join(text))
    if options.write:
        objects = sorted({(r.source, r.kind, r.name) for r in rows})
        scores = {"right, other sources": right_of(rows, by_source), "right, other kinds": right_of(rows, by_kind)}
        models = [asdict(m) for m in MODELS]
        manifest = manifest_of(rows[0].names, objects, models=models, joints=len(rows), scores=scores)
        write(WRITTEN, manifest, fit(samples, MODELS))


if __name__ == "__main__":
    main()
