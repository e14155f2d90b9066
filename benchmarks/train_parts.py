"""Train the classifier of parts (`anymesh.segmentation.part_classifier`) and measure it on what it was not trained on.

python benchmarks/train_parts.py FOLDER            benchmarks/parts.md: leave one source out, leave kinds out
python benchmarks/train_parts.py FOLDER --write    trains on all and writes part_classifier.npz with its manifest

FOLDER: rows as `benchmarks/part_rows.py` writes them. Needs lightgbm, which nothing else here does. For the shipped classifier:
    python benchmarks/kinds.py KINDS --seed 11 --count 5
    python benchmarks/part_rows.py FOLDER urdf:KINDS@kinds labelled:INFINIGEN@infinigen sweethome3d metaworld libero examples \
        scene-synthesizer
    python benchmarks/part_rows.py FOLDER urdf:KINDS@kinds labelled:INFINIGEN@infinigen --change fused --most 24
The kinds were still being written while their rows were measured: the same commands give other objects of the same kinds.
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

import lightgbm
import numpy as np
from jaxtyping import Bool, Float
from part_rows import PartRows, read_rows
from part_scores import Counts, overlap_of, scored

from anymesh.reasoning.boosted_trees import LEAF, BoostedTrees
from anymesh.segmentation.part_assignment import assign_parts
from anymesh.segmentation.part_context import context_features

SETTINGS = {
    "objective": "binary", "learning_rate": 0.1, "num_leaves": 15, "min_data_in_leaf": 25, "feature_fraction": 0.5,
    "bagging_fraction": 0.7, "bagging_freq": 1, "lambda_l2": 5.0, "verbose": -1, "num_threads": 1, "seed": 0,
    "deterministic": True,
}  # fmt: skip
ROUNDS = (150, 100)  # trees of the first and of the second step
RIGHT, WRONG = 0.6, 0.35  # IoU from which a candidate is a part, and below which it is none; between, it is not trained on
OBJECT, SOURCE = 0.5, 0.3  # powers by which candidates of an object, and objects of a source, count less the more they are
FOLDS = 4
HERE = Path(__file__).parent
WRITTEN = HERE.parent / "src" / "anymesh" / "segmentation" / "part_classifier.npz"


def fit(rows: Sequence[PartRows], tables: Sequence[Float[np.ndarray, "n k"]], rounds: int) -> lightgbm.Booster:
    """Train one step on the features of all candidates."""
    sources = Counter(r.source for r in rows)
    iou = np.concatenate([r.iou() for r in rows])
    weight = np.concatenate(
        [np.full(len(t), len(t) ** -OBJECT * sources[r.source] ** -SOURCE) for r, t in zip(rows, tables, strict=True)]
    )
    known = (iou > RIGHT) | (iou < WRONG)
    data = lightgbm.Dataset(np.concatenate(tables)[known], iou[known] > RIGHT, weight=weight[known] / weight[known].mean())
    return lightgbm.train(SETTINGS, data, rounds)


def folds_of(rows: Sequence[PartRows], seed: int) -> np.ndarray:
    """Return a fold per object; a kind lies in one fold."""
    kinds = sorted({(r.source, r.kind) for r in rows})
    order = np.random.default_rng(seed).permutation(len(kinds))
    fold = {kind: int(order[k]) % FOLDS for k, kind in enumerate(kinds)}
    return np.array([fold[r.source, r.kind] for r in rows])


class Classifier:
    """Both steps. The second is trained on first scores of kinds that the first was not trained on."""

    def __init__(self, rows: Sequence[PartRows]) -> None:
        own = [r.features for r in rows]
        fold = folds_of(rows, 1)
        first: list[np.ndarray] = [np.zeros(0)] * len(rows)
        for k in range(FOLDS):
            chosen = [i for i in range(len(rows)) if fold[i] != k]
            step = fit([rows[i] for i in chosen], [own[i] for i in chosen], ROUNDS[0])
            for i in np.flatnonzero(fold == k):
                first[i] = trees_of(step).score(own[i])
        self.first = trees_of(fit(rows, own, ROUNDS[0]))
        self.second = trees_of(fit(rows, [joined(r, s) for r, s in zip(rows, first, strict=True)], ROUNDS[1]))

    def score(self, rows: PartRows) -> Float[np.ndarray, " n"]:
        """Return the log-odds of the candidates of an object."""
        return self.second.score(joined(rows, self.first.score(rows.features)))


def joined(rows: PartRows, first: Float[np.ndarray, " n"]) -> Float[np.ndarray, "n k"]:
    """Return the features with those of the context."""
    return np.concatenate([rows.features, np.stack(list(context_features(overlap_of(rows), first).values()), 1)], 1)


def trees_of(model: lightgbm.Booster) -> BoostedTrees:
    """Return the trees of a trained model as arrays."""
    nodes: list[tuple[int, float, int, int, float]] = []

    def add(node: dict) -> int:
        at = len(nodes)
        if "leaf_value" in node:
            nodes.append((LEAF, 0.0, at, at, node["leaf_value"]))
            return at
        nodes.append((0, 0.0, 0, 0, 0.0))
        left, right = add(node["left_child"]), add(node["right_child"])
        nodes[at] = node["split_feature"], node["threshold"], left, right, node["internal_value"]
        return at

    root = [add(tree["tree_structure"]) for tree in model.dump_model()["tree_info"]]
    feature, threshold, left, right, value = zip(*nodes, strict=True)
    return BoostedTrees(
        np.array(feature, np.int16), np.array(threshold, np.float32), np.array(left, np.int32), np.array(right, np.int32),
        np.array(value, np.float32), np.array(root, np.int32),
    )  # fmt: skip


def held_out(rows: Sequence[PartRows], left: Sequence[Bool[np.ndarray, " r"]]) -> list[Float[np.ndarray, " n"]]:
    """Return the scores of each object by a classifier that was trained without all that is left out with it."""
    found: list[np.ndarray] = [np.zeros(0)] * len(rows)
    for mask in left:
        model = Classifier([r for r, out in zip(rows, mask, strict=True) if not out])
        for k in np.flatnonzero(mask):
            found[k] = model.score(rows[k])
    return found


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


def called(rows: PartRows) -> str:
    """Return the source and the form of an object, as in tables."""
    return f"{rows.source}, {rows.form}" if rows.form else rows.source


def main(argv: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description="Train the classifier of parts.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args(argv)
    rows = read_rows(options.folder)
    if options.write:
        write(rows)
        return
    sources = sorted({r.source for r in rows})
    by_source = held_out(rows, [np.array([r.source == s for r in rows]) for s in sources])
    fold = folds_of(rows, 0)
    by_kind = held_out(rows, [fold == k for k in range(FOLDS)])
    text = [
        "# Parts found by the classifier, on objects that it was not trained on", "",
        "`python benchmarks/train_parts.py ROWS`; stage A alone, parts at IoU .5, no names of nodes and materials.", "",
        "## Trained on all other sources", "", *table(rows, by_source, called), "",
        f"## Trained on other kinds ({FOLDS} folds, a kind in one fold)", "",
        *table(rows, by_kind, called), "",
    ]  # fmt: skip
    (HERE / "parts.md").write_text("\n".join(text), encoding="utf-8")
    print("\n".join(text))


def write(rows: Sequence[PartRows]) -> None:
    """Train on all rows and write the classifier with its manifest."""
    model = Classifier(rows)
    sources = {
        s: {"objects": len({r.name for r in rows if r.source == s}), "kinds": sorted({r.kind for r in rows if r.source == s})}
        for s in sorted({r.source for r in rows})
    }
    objects = sorted({f"{r.source}/{r.name}" for r in rows})
    manifest = {
        "features": list(rows[0].names), "sources": sources, "objects": objects, "settings": SETTINGS, "rounds": ROUNDS,
        "lightgbm": lightgbm.__version__, "candidates": sum(len(r.features) for r in rows),
    }  # fmt: skip
    arrays = {"manifest": np.frombuffer(json.dumps(manifest).encode(), np.uint8)}
    np.savez_compressed(WRITTEN, **arrays, **model.first.arrays("first"), **model.second.arrays("second"))
    print(f"{WRITTEN}: {WRITTEN.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
