"""Train the classifier of parts (`anymesh.segmentation.part_classifier`) and measure it on what it was not trained on.

python -m training.train_parts FOLDER            benchmarks/reports/parts.md: leave one source out, leave kinds out
python -m training.train_parts FOLDER --write    also trains on all and writes part_classifier.npz with its manifest

FOLDER: rows as `training/part_rows.py` writes them; `training/train.sh` lists those of the shipped file. Needs lightgbm and
torch.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path

import numpy as np
from jaxtyping import Bool

from anymesh.scoring.classifier import Classifier
from anymesh.segmentation.part_classifier import combined, is_cut, relations
from anymesh.segmentation.segment import assign_parts, conflicts, likely_parts
from training.boosting import FOLDS, Model, Sample, Scores, fit, leave_kinds_out, leave_sources_out, manifest_of, write
from training.calibration import Scored, calibration_table, fit_confidence
from training.collect_rows import called
from training.part_rows import PartRows, read_rows
from training.part_scores import RIGHT as RIGHT_IOU
from training.part_scores import Counts, overlap_of, scored
from training.set_training import CandidateSet, train_all
from training.splits import ATTRIBUTION, VALIDATION, Use, used_for

MODELS = (Model(150, 0), Model(250, 1, True), Model(150, 2), Model(250, 3, True))
EPOCHS, SEEDS = 16, 3  # of the networks
HELD_OUT_SEEDS = 1  # of the networks that are trained without what is left out, to save time
SMALL = frozenset({"examples", "libero", "metaworld", "scene-synthesizer", "sweethome3d"})  # left out at once, to save time
WRONG, RIGHT = 0.35, 0.95  # IoU below which a candidate is no part, and from which it is one; between, it is partly right
OBJECT, SOURCE = 0.5, 0.3  # powers by which candidates of an object, and objects of a source, count less the more they are
ADDED = ("detailed", "furnished", "misplaced")  # changes that are trained on, besides fused surfaces and tight parts
ADDED_WEIGHT = 0.25  # of objects with these changes, chosen on what was left out; at 1 more is lost on unchanged objects
SCORES = Path("held_out") / "scores.npz"  # below the folder of the rows
ROOT = Path(__file__).parents[1]
WRITTEN = ROOT / "src" / "anymesh" / "segmentation" / "part_classifier.npz"


def samples_of(rows: Sequence[PartRows]) -> list[Sample]:
    """Return the candidates of each object as samples."""
    sources = Counter(r.source for r in rows)
    found = []
    for r in rows:
        iou = r.iou()
        target = np.clip((iou - WRONG) / (RIGHT - WRONG), 0, 1)  # a door without its handle is less right than with it
        weight = len(iou) ** -OBJECT * sources[r.source] ** -SOURCE * (ADDED_WEIGHT if r.form in ADDED else 1.0)
        found.append(Sample(r.source, r.kind, r.features, target, weight))
    return found


def sets_of(rows: Sequence[PartRows], samples: Sequence[Sample]) -> list[CandidateSet]:
    """Return the candidates of each object as a set, for the networks."""
    return [
        CandidateSet(s.features, r.place, relations(overlap_of(r), r.members, r.contact, r.near, r.place), s.target, s.weight)
        for r, s in zip(rows, samples, strict=True)
    ]


def classifiers(
    rows: Sequence[PartRows], samples: Sequence[Sample], sets: Sequence[CandidateSet], chosen: Sequence[Sequence[int]]
) -> list[Classifier]:
    """Train a classifier on each choice of objects."""
    networks = train_all(sets, chosen, EPOCHS, HELD_OUT_SEEDS)
    trees = [fit([samples[k] for k in some], MODELS) for some in chosen]
    return [Classifier(t, tuple(n), rows[0].names, {}) for t, n in zip(trees, networks, strict=True)]


def held_out(
    rows: Sequence[PartRows],
    samples: Sequence[Sample],
    sets: Sequence[CandidateSet],
    left: Sequence[Bool[np.ndarray, " s"]],
    what: str,
) -> dict[str, Scores]:
    """Return the scores of each object by trees and by networks that were trained without all that is left out with it.

    what: is left out, the start of the two keys.
    """
    trees: Scores = [np.zeros(0)] * len(rows)
    networks: Scores = [np.zeros(0)] * len(rows)
    for mask, classifier in zip(left, classifiers(rows, samples, sets, [np.flatnonzero(~m) for m in left]), strict=True):
        for k in np.flatnonzero(mask):
            trees[k] = classifier.score(sets[k].own)
            networks[k] = classifier.score_together(sets[k].own, sets[k].place, sets[k].relations)
    return {f"{what} trees": trees, f"{what} networks": networks}


def of_both(rows: Sequence[PartRows], trees: Scores, networks: Scores) -> Scores:
    """Return the scores that decide."""
    return [combined(t, n, is_cut(r.features, r.names)) for r, t, n in zip(rows, trees, networks, strict=True)]


def calibrated(rows: Sequence[PartRows], scores: Scores) -> tuple[float, float]:
    """Return slope and offset of the log-odds that make them those of being a part, of all that are not unlikely."""
    return fit_confidence(
        confidences(
            rows, scores, [likely_parts(conflicts(overlap_of(r)), p) for r, p in zip(rows, chances(scores), strict=True)]
        )
    )


def chances(scores: Scores, slope: float = 1.0, offset: float = 0.0) -> Scores:
    """Return the probability that each candidate is a part."""
    return [1 / (1 + np.exp(-slope * s - offset)) for s in scores]


def choices(rows: Sequence[PartRows], probability: Scores) -> list[list[int]]:
    """Return the candidates of each object that are taken for parts."""
    return [assign_parts(overlap_of(r), p) for r, p in zip(rows, probability, strict=True)]


def outcomes(rows: Sequence[PartRows], chosen: Sequence[list[int]]) -> list[Counts]:
    """Return how many parts of each object are true, found and right (IoU .5), if these candidates are taken for parts."""
    return [scored(r, some) for r, some in zip(rows, chosen, strict=True)]


def total(found: Iterable[Counts]) -> Counts:
    return sum(found, Counts())


def table(rows: Sequence[PartRows], found: Sequence[Counts], best: Sequence[Counts]) -> list[str]:
    """Return lines of a table, one for each source and change. best: of the best choice among the candidates."""
    lines = [
        "| | objects | parts | precision | recall | F1 | F1, mean over kinds | F1 of the best choice |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for group in [*sorted({called(r) for r in rows}), "all"]:
        chosen = [k for k, r in enumerate(rows) if group in (called(r), "all")]
        c, mine = total(found[k] for k in chosen), over_kinds([rows[k] for k in chosen], [found[k] for k in chosen])
        shares = c.precision, c.recall, c.f1, mine, total(best[k] for k in chosen).f1
        lines.append(f"| {group} | {len(chosen)} | {c.true} | {' | '.join(f'{share:.2f}' for share in shares)} |")
    return lines


def over_kinds(rows: Sequence[PartRows], found: Sequence[Counts]) -> float:
    """Return the mean over the kinds that have parts of the F1 of each."""
    of: dict[str, Counts] = {}
    for r, c in zip(rows, found, strict=True):
        of[r.kind] = of.get(r.kind, Counts()) + c
    return float(np.mean([c.f1 for c in of.values() if c.true]))


def f1_of(rows: Sequence[PartRows], found: Sequence[Counts]) -> dict[str, float]:
    """Return the F1 of each group of objects, as in tables."""
    groups = sorted({called(r) for r in rows})
    return {g: round(total(c for r, c in zip(rows, found, strict=True) if called(r) == g).f1, 3) for g in groups}


def save_scores(folder: Path, scores: dict[str, Scores]) -> None:
    """Keep the scores of `held_out`, in the order of the rows."""
    (folder / SCORES.parent).mkdir(exist_ok=True)
    np.savez_compressed(folder / SCORES, **{name: np.concatenate(some) for name, some in scores.items()})


def read_scores(folder: Path, rows: Sequence[PartRows]) -> dict[str, Scores]:
    """Return the scores of held-out objects.

    "source trees" and "source networks", trained on other sources; "kind trees" and "kind networks", trained on other kinds;
    "source" and "kind", which decide.
    """
    ends = np.cumsum([len(r.features) for r in rows])[:-1]
    with np.load(folder / SCORES) as file:
        found = {name: np.split(file[name], ends) for name in file.files}
    return found | {left: of_both(rows, found[f"{left} trees"], found[f"{left} networks"]) for left in ("source", "kind")}


def confidences(rows: Sequence[PartRows], scores: Scores, chosen: Sequence[Sequence[int]]) -> Scored:
    """Return the scores of the chosen candidates, and whether they are parts."""
    all_chosen = [(r, s[k], r.iou()[k] > RIGHT_IOU) for r, s, some in zip(rows, scores, chosen, strict=True) for k in some]
    odds, right = np.array([s for _, s, _ in all_chosen]), np.array([y for _, _, y in all_chosen])
    return Scored(odds, right, [called(r) for r, _, _ in all_chosen])


def write_page(
    rows: Sequence[PartRows], scores: Mapping[str, Scores], slope: float, offset: float, kept: Sequence[str]
) -> dict[str, dict[str, float]]:
    """Write parts.md, and return the F1 of each group of objects.

    scores: "source" and "kind", of objects left out of training by source and by kind; slope, offset: their calibration; kept:
    the table of the kinds for validation.
    """
    taken = {left: choices(rows, chances(scores[left], slope, offset)) for left in ("source", "kind")}
    found = {left: outcomes(rows, some) for left, some in taken.items()}
    best = outcomes(rows, choices(rows, [np.where((iou := r.iou()) > RIGHT_IOU, iou, 0.0) for r in rows]))
    still = [k for k, r in enumerate(rows) if not r.moving]
    wrong = total(found["kind"][k] for k in still).found
    right = {left: confidences(rows, scores[left], some) for left, some in taken.items()}
    text = [
        "# Parts found by the classifier, on objects that it was not trained on", "",
        "`python -m training.train_parts ROWS`; stage A only, parts matched at IoU .5, without names of nodes and materials.",
        "The last column is what the best choice among the candidates would reach. These classifiers have one network each;",
        "the shipped one has three. Networks score each object in four quarter turns.", "",
        "## Trained on all other sources", "", "The five small sets are left out together.", "",
        *table(rows, found["source"], best), "",
        f"## Trained on other kinds ({FOLDS} folds, a kind in one fold)", "",
        *table(rows, found["kind"], best), "",
        f"On {len(still)} objects without movable parts, {wrong} parts were found.", "",
        f"## The {len(VALIDATION)} kinds of Articraft for validation, by the classifier trained on all others", "", *kept, "",
        "## Confidence", "",
        f"Fitted to other kinds, over all sources: slope {slope:.2f}, offset {offset:.2f}, in the classifier's manifest.", "",
        *calibration_table(right["kind"], slope, offset), "",
        "The same on other sources:", "",
        *calibration_table(right["source"], slope, offset), "",
    ]  # fmt: skip
    (ROOT / "benchmarks" / "reports" / "parts.md").write_text("\n".join(text), encoding="utf-8")
    print("\n".join(text))
    return {f"F1, other {left}s": f1_of(rows, some) for left, some in found.items()}


def validation_table(rows: Sequence[PartRows], classifier: Classifier, slope: float, offset: float) -> list[str]:
    """Return the table of the kinds for validation, scored by a classifier that was trained on all others."""
    samples = samples_of(rows)
    sets = sets_of(rows, samples)
    networks = [classifier.score_together(s.own, s.place, s.relations) for s in sets]
    scores = of_both(rows, [classifier.score(s.own) for s in sets], networks)
    best = outcomes(rows, choices(rows, [np.where((iou := r.iou()) > RIGHT_IOU, iou, 0.0) for r in rows]))
    return table(rows, outcomes(rows, choices(rows, chances(scores, slope, offset))), best)


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description="Train the classifier of parts.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args(argv)
    every = read_rows(options.folder)
    rows = used_for(Use.TRAIN, every)
    samples = samples_of(rows)
    sets = sets_of(rows, samples)
    by_sources = held_out(rows, samples, sets, leave_sources_out(samples, SMALL), "source")
    save_scores(options.folder, by_sources | held_out(rows, samples, sets, leave_kinds_out(samples), "kind"))
    scores = read_scores(options.folder, rows)
    slope, offset = calibrated(rows, scores["kind"])
    (networks,) = train_all(sets, [range(len(rows))], EPOCHS, SEEDS)
    confidence = {"slope": round(slope, 2), "offset": round(offset, 2)}
    trained = Classifier(fit(samples, MODELS), tuple(networks), rows[0].names, {"confidence": confidence})
    kept = used_for(Use.VALIDATION, every)
    f1 = write_page(rows, scores, slope, offset, validation_table(kept, trained, slope, offset))
    if not options.write:
        return
    told = {
        "scores": f1,
        "confidence": confidence,
        "networks": {"epochs": EPOCHS, "seeds": SEEDS, "objects": len(rows)},
        "validation": sorted(VALIDATION),
        "attribution": ATTRIBUTION,
    }
    objects = sorted({(r.source, r.kind, r.name) for r in rows})
    models = [asdict(m) for m in MODELS]
    candidates = sum(len(r.features) for r in rows)
    manifest = manifest_of(rows[0].names, objects, models=models, candidates=candidates, **told)
    write(WRITTEN, manifest, trained.trees, networks)


if __name__ == "__main__":
    main()
