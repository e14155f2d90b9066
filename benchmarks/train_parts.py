"""Train the classifier of parts (`anymesh.segmentation.part_classifier`) and measure it on what it was not trained on.

python benchmarks/train_parts.py FOLDER            benchmarks/parts.md: leave one source out, leave kinds out
python benchmarks/train_parts.py FOLDER --write    also trains on all and writes part_classifier.npz with its manifest

FOLDER: rows as `benchmarks/part_rows.py` writes them. Needs lightgbm, which nothing else here does. For the shipped classifier:
    python benchmarks/kinds.py KINDS --seed 11 --count 6
    python benchmarks/part_rows.py FOLDER urdf:KINDS@kinds labelled:INFINIGEN@infinigen sweethome3d metaworld libero examples \
        scene-synthesizer
    python benchmarks/part_rows.py FOLDER urdf:KINDS@kinds --change fused --most 180
    python benchmarks/part_rows.py FOLDER labelled:INFINIGEN@infinigen --change fused --most 53
    python benchmarks/part_rows.py FOLDER sweethome3d --change fused --most 24
    python benchmarks/part_rows.py FOLDER static:KINDS@kinds --most 72
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from boosting import FOLDS, Model, Sample, Scores, Steps, held_out, leave_kinds_out, leave_sources_out, write
from calibration import Scored, calibration_table, fit_confidence
from jaxtyping import Float
from part_rows import PartRows, read_rows
from part_scores import RIGHT as RIGHT_IOU
from part_scores import Counts, overlap_of, scored
from rows import called

from anymesh.segmentation.candidate_context import context_features
from anymesh.segmentation.part_assignment import assign_parts
from anymesh.segmentation.part_classifier import CUT, CUT_SCORE

MODELS = (Model((150, 90), 0), Model((250, 150), 1, True), Model((150, 90), 2), Model((250, 150), 3, True))
WRONG, RIGHT = 0.35, 0.95  # IoU below which a candidate is no part, and from which it is one; between, it is partly right
OBJECT, SOURCE = 0.5, 0.3  # powers by which candidates of an object, and objects of a source, count less the more they are
SCORES = Path("held_out") / "scores.npz"  # below the folder of the rows
HERE = Path(__file__).parent
WRITTEN = HERE.parent / "src" / "anymesh" / "segmentation" / "part_classifier.npz"


def samples_of(rows: Sequence[PartRows]) -> list[Sample]:
    """Return the candidates of each object as samples."""
    sources = Counter(r.source for r in rows)
    found = []
    for r in rows:
        iou = r.iou()
        target = np.clip((iou - WRONG) / (RIGHT - WRONG), 0, 1)  # a door without its handle is less right than with it
        found.append(Sample(r.source, r.kind, r.features, target, len(iou) ** -OBJECT * sources[r.source] ** -SOURCE))
    return found


class OverlapContext:
    """The features of the context, from what the candidates of an object have in common."""

    def __init__(self, rows: Sequence[PartRows]) -> None:
        self._rows = rows

    def __call__(self, k: int, first: Scores) -> Float[np.ndarray, "n c"]:
        return np.stack(list(context_features(overlap_of(self._rows[k]), first[k]).values()), 1)


def with_cuts(rows: Sequence[PartRows], scores: Scores) -> Scores:
    """Return the scores with what is added for parts that are cut out of a surface."""
    return [s + CUT_SCORE * r.features[:, r.names.index(CUT)] for r, s in zip(rows, scores, strict=True)]


def counts(rows: Sequence[PartRows], scores: Sequence[np.ndarray]) -> Counts:
    """Count parts that are true, found and right (IoU .5)."""
    return sum((scored(r, assign_parts(overlap_of(r), s)) for r, s in zip(rows, scores, strict=True)), Counts())


def table(rows: Sequence[PartRows], scores: Sequence[np.ndarray], of: Callable[[PartRows], str]) -> list[str]:
    """Return lines of a table, one for each group of objects."""
    ideal = [np.where((iou := r.iou()) > 0.5, iou, -1.0) for r in rows]
    lines = [
        "| | objects | parts | precision | recall | F1 | F1, had the best candidates been chosen |",
        "|---|---|---|---|---|---|---|",
    ]
    for group in [*sorted({of(r) for r in rows}), "all"]:
        chosen = [k for k, r in enumerate(rows) if group in (of(r), "all")]
        mine = [rows[k] for k in chosen]
        c, best = counts(mine, [scores[k] for k in chosen]), counts(mine, [ideal[k] for k in chosen])
        lines.append(f"| {group} | {len(mine)} | {c.true} | {c.precision:.2f} | {c.recall:.2f} | {c.f1:.2f} | {best.f1:.2f} |")
    return lines


def f1_of(rows: Sequence[PartRows], scores: Sequence[np.ndarray]) -> dict[str, float]:
    """Return the F1 of each group of objects, as in tables."""
    groups = sorted({called(r) for r in rows})
    of = {g: [k for k, r in enumerate(rows) if called(r) == g] for g in groups}
    return {g: round(counts([rows[k] for k in of[g]], [scores[k] for k in of[g]]).f1, 3) for g in groups}


def save_scores(folder: Path, by_source: Scores, by_kind: Scores) -> None:
    """Keep the scores of held-out objects, in the order of the rows."""
    (folder / SCORES.parent).mkdir(exist_ok=True)
    np.savez_compressed(folder / SCORES, source=np.concatenate(by_source), kind=np.concatenate(by_kind))


def read_scores(folder: Path, rows: Sequence[PartRows]) -> tuple[Scores, Scores]:
    """Return the scores of `save_scores`, by classifiers trained on other sources and on other kinds."""
    ends = np.cumsum([len(r.features) for r in rows])[:-1]
    with np.load(folder / SCORES) as file:
        return np.split(file["source"], ends), np.split(file["kind"], ends)


def confidences(rows: Sequence[PartRows], scores: Sequence[np.ndarray]) -> Scored:
    """Return the scores of the chosen candidates, and whether they are parts."""
    chosen = [
        (r, s[k], r.iou()[k] > RIGHT_IOU) for r, s in zip(rows, scores, strict=True) for k in assign_parts(overlap_of(r), s)
    ]
    return Scored(np.array([s for _, s, _ in chosen]), np.array([y for _, _, y in chosen]), [called(r) for r, _, _ in chosen])


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description="Train the classifier of parts.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args(argv)
    rows = read_rows(options.folder)
    samples, context = samples_of(rows), OverlapContext(rows)
    by_source = with_cuts(rows, held_out(samples, leave_sources_out(samples), MODELS, context))
    by_kind = with_cuts(rows, held_out(samples, leave_kinds_out(samples), MODELS, context))
    save_scores(options.folder, by_source, by_kind)
    still = [k for k, r in enumerate(rows) if not r.moving]
    wrong = counts([rows[k] for k in still], [by_kind[k] for k in still]).found
    chosen = confidences(rows, by_kind)
    slope, offset = fit_confidence(chosen)
    text = [
        "# Parts found by the classifier, on objects that it was not trained on", "",
        "`python benchmarks/train_parts.py ROWS`; stage A only, parts matched at IoU .5, without names of nodes and materials.",
        "",
        "## Trained on all other sources", "", *table(rows, by_source, called), "",
        f"## Trained on other kinds ({FOLDS} folds, a kind in one fold)", "",
        *table(rows, by_kind, called), "",
        f"On {len(still)} objects without movable parts, {wrong} parts were found.", "",
        "## Confidence", "",
        f"Fitted to other kinds, over all sources: slope {slope:.2f}, offset {offset:.2f} (`segmentation/segment.py`).", "",
        *calibration_table(chosen, slope, offset), "", "The same on other sources:", "",
        *calibration_table(confidences(rows, by_source), slope, offset), "",
    ]  # fmt: skip
    (HERE / "parts.md").write_text("\n".join(text), encoding="utf-8")
    print("\n".join(text))
    if options.write:
        model = Steps(samples, range(len(rows)), MODELS, context)
        objects = sorted({(r.source, r.kind, r.name) for r in rows})
        scores = {"F1, other sources": f1_of(rows, by_source), "F1, other kinds": f1_of(rows, by_kind)}
        write(WRITTEN, model, MODELS, rows[0].names, objects, candidates=sum(len(r.features) for r in rows), scores=scores)


if __name__ == "__main__":
    main()
