"""Train the classifier of motions (`anymesh.articulation.rank_motions`) and measure it on what it was not trained on.

python -m training.train_motions FOLDER            benchmarks/reports/motions.md: leave one source out, leave kinds out
python -m training.train_motions FOLDER --write    also trains on all and writes motion_classifier.npz and
                                                     unswept_classifier.npz with their manifests

FOLDER: rows as `training/motion_rows.py` writes them; `training/train.sh` lists those of the shipped file. Needs lightgbm.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
from jaxtyping import Bool

from anymesh.articulation.estimate import MAX_COPIES, MAX_SWEPT
from anymesh.articulation.motion_features import SWEPT_FEATURES
from anymesh.articulation.part_contexts import ScoredMotions, mean_over_copies
from anymesh.articulation.rank_motions import highest, share_of_best
from anymesh.scoring.by_hand import BLOCKED_SCORE
from training.boosting import Model, Sample, Scores, fit, held_out, leave_kinds_out, leave_sources_out, manifest_of, write
from training.calibration import Scored, calibration_table, fit_confidence, log_odds
from training.collect_rows import called
from training.motion_rows import MotionRows, read_rows
from training.splits import ATTRIBUTION, VALIDATION, Use, used_for

MODELS = tuple(Model(800, seed, extra_trees=True) for seed in range(3))
UNSWEPT_MODELS = (Model(100, 0, extra_trees=True),)
OBJECT, SOURCE = 0.5, 0.6  # powers by which parts of an object, and parts of a source, count less the more they are
ROOT = Path(__file__).parents[1]
WRITTEN = ROOT / "src" / "anymesh" / "articulation"


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


def unswept_names(rows: Sequence[MotionRows]) -> list[str]:
    """Return the features that are known of a part at rest."""
    return [name for name in rows[0].names if name not in SWEPT_FEATURES]


def unswept_samples(rows: Sequence[MotionRows]) -> list[Sample]:
    """Return the motions of each part as samples, each once, with the features that are known of a part at rest."""
    columns = [rows[0].names.index(name) for name in unswept_names(rows)]
    return [replace(s, features=s.features[::2, columns], target=s.target.reshape(-1, 2).max(1)) for s in samples_of(rows)]


def of_swept(
    rows: Sequence[MotionRows], scores: Scores, left: Sequence[Bool[np.ndarray, " s"]]
) -> tuple[list[MotionRows], Scores]:
    """Return the rows and scores of the motions that are swept, chosen by classifiers trained without what is left out."""
    before = held_out(unswept_samples(rows), left, UNSWEPT_MODELS)
    chosen = [highest(score, MAX_SWEPT) for score in before]
    swept = [r.of_motions(k) for r, k in zip(rows, chosen, strict=True)]
    return swept, over_copies(swept, [s.reshape(-1, 2)[k].reshape(-1) for s, k in zip(scores, chosen, strict=True)])


def over_copies(rows: Sequence[MotionRows], scores: Scores) -> Scores:
    """Return the mean of the scores of each part and of its copies."""
    number = {(r.source, r.form, r.name, r.number): k for k, r in enumerate(rows)}
    motions = [ScoredMotions.of(r.names, r.features, r.axes, s) for r, s in zip(rows, scores, strict=True)]
    found = []
    for own, r in zip(motions, rows, strict=True):
        keys = [(r.source, r.form, r.name, twin) for twin in r.twins[:MAX_COPIES]]
        found.append(mean_over_copies(own, [motions[number[key]] for key in keys if key in number]))
    return found


def table(
    rows: Sequence[MotionRows], swept: Sequence[MotionRows], scores: Scores, of: Callable[[MotionRows], str]
) -> list[str]:
    """Return lines of a table, one for each group of parts. scores: of the swept motions."""
    lines = [
        "| | joints | offered | swept | right motion | and right side | mean over kinds |",
        "|---|---|---|---|---|---|---|",
    ]
    best = [int(s.argmax()) for s in scores]
    for group in [*sorted({of(r) for r in rows}), "all"]:
        chosen = [k for k, r in enumerate(rows) if group in (of(r), "all")]
        offered = np.mean([bool(right_side(rows[k]).any()) for k in chosen])
        among = np.mean([bool(right_side(swept[k]).any()) for k in chosen])
        right = np.mean([swept[k].right[best[k]] > 0 for k in chosen])
        side = np.mean([right_side(swept[k])[best[k]] for k in chosen])
        of_kind: dict[str, list[bool]] = {}
        for k in chosen:
            of_kind.setdefault(rows[k].kind, []).append(bool(right_side(swept[k])[best[k]]))
        mean = np.mean([np.mean(some) for some in of_kind.values()])
        lines.append(f"| {group} | {len(chosen)} | {offered:.2f} | {among:.2f} | {right:.2f} | {side:.2f} | {mean:.2f} |")
    return lines


def right_of(rows: Sequence[MotionRows], scores: Scores) -> dict[str, float]:
    """Return the share of joints with the right motion and side, for each group of parts."""
    right: dict[str, list[bool]] = {}
    for r, s in zip(rows, scores, strict=True):
        right.setdefault(called(r), []).append(bool(right_side(r)[int(s.argmax())]))
    return {group: round(float(np.mean(some)), 3) for group, some in sorted(right.items())}


def confidences(rows: Sequence[MotionRows], scores: Scores) -> Scored:
    """Return the share of the best motion of each part before calibration, and whether the motion and its side are right."""
    ranked = [s + np.where(r.free, 0.0, BLOCKED_SCORE) for r, s in zip(rows, scores, strict=True)]
    best = [int(s.argmax()) for s in ranked]
    shares = [share_of_best(s, r.same[k]) for r, s, k in zip(rows, ranked, best, strict=True)]
    right = np.array([right_side(r)[k] for r, k in zip(rows, best, strict=True)])
    return Scored(log_odds(np.array(shares)), right, [called(r) for r in rows])


def kept_table(rows: Sequence[MotionRows], kept: Sequence[MotionRows]) -> list[str]:
    """Return the table of the parts `kept` by classifiers trained on the rows."""
    trees, before = fit(samples_of(rows), MODELS), fit(unswept_samples(rows), UNSWEPT_MODELS)
    chosen = [highest(before.score(s.features), MAX_SWEPT) for s in unswept_samples(kept)]
    swept = [r.of_motions(k) for r, k in zip(kept, chosen, strict=True)]
    scores = over_copies(swept, [trees.score(r.features) for r in swept])
    return table(kept, swept, scores, called)


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description="Train the classifier of motions.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args(argv)
    every = read_rows(options.folder)
    rows = used_for(Use.TRAIN, every)
    samples = samples_of(rows)
    left = leave_sources_out(samples), leave_kinds_out(samples)
    scores_of_all = [held_out(samples, masks, MODELS) for masks in left]
    by_source, by_kind = (of_swept(rows, s, masks) for s, masks in zip(scores_of_all, left, strict=True))
    answers = confidences(*by_kind)
    slope, offset = fit_confidence(answers)
    slope_of_all, _ = fit_confidence(confidences(rows, over_copies(rows, scores_of_all[1])))
    text = [
        "# Motions chosen by the classifier, on objects that it was not trained on", "",
        "`python -m training.train_motions ROWS`; parts given, no names. Right: within 5 degrees and .08 of half the",
        "diagonal; right side: it opens in the direction of the true joint. Swept: among the likeliest of the part at rest,",
        "which alone are swept.", "",
        "## Trained on all other sources", "", *table(rows, *by_source, called), "",
        "## Trained on other kinds (4 folds, a kind in one fold)", "", *table(rows, *by_kind, called), "",
        f"## The {len(VALIDATION)} kinds of Articraft for validation, by the classifier trained on all others", "",
        *kept_table(rows, used_for(Use.VALIDATION, every)), "",
        "## Confidence", "",
        f"Fitted to other kinds, over all sources: slope {slope:.2f}, offset {offset:.2f}. Where a model answers, all motions",
        f"are swept: slope {slope_of_all:.2f}. Both are in the manifest of the classifier.",
        "", *calibration_table(answers, slope, offset), "", "The same on other sources:", "",
        *calibration_table(confidences(*by_source), slope, offset), "",
    ]  # fmt: skip
    (ROOT / "benchmarks" / "reports" / "motions.md").write_text("\n".join(text), encoding="utf-8")
    print("\n".join(text))
    if options.write:
        scores = {"right, other sources": right_of(*by_source), "right, other kinds": right_of(*by_kind)}
        objects = sorted({(r.source, r.kind, r.name) for r in rows})
        confidence = {"slope": round(slope, 2), "offset": round(offset, 2), "slope, all swept": round(slope_of_all, 2)}
        for file, names, some, models, more in (
            ("motion_classifier.npz", rows[0].names, samples, MODELS, {"confidence": confidence}),
            ("unswept_classifier.npz", unswept_names(rows), unswept_samples(rows), UNSWEPT_MODELS, {}),
        ):
            settings = [asdict(m) for m in models]
            manifest = manifest_of(
                names, objects, models=settings, joints=len(rows), scores=scores, validation=sorted(VALIDATION),
                attribution=ATTRIBUTION, **more,
            )  # fmt: skip
            write(WRITTEN / file, manifest, fit(some, models))


if __name__ == "__main__":
    main()
