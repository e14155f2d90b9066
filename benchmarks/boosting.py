"""Train classifiers (`anymesh.scoring.classifier`) by lightgbm, and score what was left out of training."""

from __future__ import annotations

import json
import os
import subprocess
from collections import Counter
from collections.abc import Callable, Hashable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import lightgbm
import numpy as np
from jaxtyping import Bool, Float

from anymesh.scoring.boosted_trees import NO_FEATURE, BoostedTrees
from anymesh.scoring.classifier import STEPS

SETTINGS = {
    "objective": "cross_entropy", "learning_rate": 0.1, "num_leaves": 15, "min_data_in_leaf": 25, "feature_fraction": 0.5,
    "bagging_fraction": 0.7, "bagging_freq": 1, "lambda_l2": 5.0, "verbose": -1, "num_threads": 1,
    "deterministic": True,
}  # fmt: skip
FOLDS = 4
Scores = list[Float[np.ndarray, " n"]]
Context = Callable[[int, Scores], Float[np.ndarray, "n c"]]  # of a sample, from the first scores of all


@dataclass(frozen=True)
class Model:
    """One model of an ensemble, whose scores are averaged in each step.

    rounds: trees of each step; extra_trees: whether thresholds are random (Geurts et al., 2006).
    """

    rounds: tuple[int, ...]
    seed: int = 0
    extra_trees: bool = False


@dataclass(frozen=True, eq=False)
class Sample:
    """The candidates of one choice. target: (n,) 1 right to 0 wrong, NaN not trained on; weight: of each candidate."""

    source: str
    kind: str
    features: Float[np.ndarray, "n k"]
    target: Float[np.ndarray, " n"]
    weight: float


def folds_of(groups: Sequence[Hashable], seed: int, count: int = FOLDS) -> np.ndarray:
    """Return a fold per sample; a group lies in one fold."""
    known = sorted(set(groups), key=str)
    order = np.random.default_rng(seed).permutation(len(known))
    fold = {group: int(order[k]) % count for k, group in enumerate(known)}
    return np.array([fold[group] for group in groups])


class Steps:
    """Trees in one step or, with a context, in two. The second is trained on first scores of kinds left out of the first."""

    def __init__(
        self, samples: Sequence[Sample], chosen: Sequence[int], models: Sequence[Model], context: Context | None = None
    ) -> None:
        self._samples, self._context, self._models = samples, context, models
        self.trees = [self._fit(chosen)]
        if context is None:
            return
        fold = folds_of([(samples[i].source, samples[i].kind) for i in chosen], 1)
        first: Scores = [np.zeros(0)] * len(samples)
        for k in range(FOLDS):
            step = self._fit([i for i, f in zip(chosen, fold, strict=True) if f != k])
            for i, f in zip(chosen, fold, strict=True):
                if f == k:
                    first[i] = step.score(samples[i].features)
        self.trees.append(self._fit(chosen, first))

    def _fit(self, chosen: Sequence[int], first: Scores | None = None) -> BoostedTrees:
        samples = [self._samples[i] for i in chosen]
        tables = [self._samples[i].features if first is None else self._joined(i, first) for i in chosen]
        target = np.concatenate([s.target for s in samples])
        weight = np.concatenate([np.full(len(s.target), s.weight) for s in samples])
        known = ~np.isnan(target)
        table, weights = np.concatenate(tables)[known], weight[known] / weight[known].mean()
        step = 0 if first is None else 1

        def trained(model: Model) -> BoostedTrees:
            data = lightgbm.Dataset(table, target[known], weight=weights)
            settings = SETTINGS | {"seed": model.seed, "extra_trees": model.extra_trees}
            return trees_of(lightgbm.train(settings, data, model.rounds[step]))

        with ThreadPoolExecutor(os.cpu_count()) as threads:  # each model uses one thread, for reproducibility
            return BoostedTrees.mean(list(threads.map(trained, self._models)))

    def _joined(self, k: int, first: Scores) -> Float[np.ndarray, "n k"]:
        assert self._context is not None
        return np.concatenate([self._samples[k].features, self._context(k, first)], 1)

    def scores(self, chosen: Sequence[int]) -> Scores:
        """Return the log-odds of the candidates of some samples; nothing for the others."""
        first: Scores = [np.zeros(0)] * len(self._samples)
        for k in chosen:
            first[k] = self.trees[0].score(self._samples[k].features)
        if self._context is None:
            return first
        second: Scores = [np.zeros(0)] * len(self._samples)
        for k in chosen:
            second[k] = self.trees[1].score(self._joined(k, first))
        return second


def held_out(
    samples: Sequence[Sample], left: Sequence[Bool[np.ndarray, " s"]], models: Sequence[Model], context: Context | None = None
) -> Scores:
    """Return the scores of each sample by a classifier that was trained without all that is left out with it."""
    found: Scores = [np.zeros(0)] * len(samples)
    for mask in left:
        model = Steps(samples, [int(k) for k in np.flatnonzero(~mask)], models, context)
        out = [int(k) for k in np.flatnonzero(mask)]
        scores = model.scores(out)
        for k in out:
            found[k] = scores[k]
    return found


def leave_sources_out(samples: Sequence[Sample]) -> list[Bool[np.ndarray, " s"]]:
    """Return which samples are left out, one source at a time."""
    return [np.array([s.source == source for s in samples]) for source in sorted({s.source for s in samples})]


def leave_kinds_out(samples: Sequence[Sample]) -> list[Bool[np.ndarray, " s"]]:
    """Return which samples are left out, a fold of kinds at a time."""
    fold = folds_of([(s.source, s.kind) for s in samples], 0)
    return [fold == k for k in range(FOLDS)]


def trees_of(model: lightgbm.Booster) -> BoostedTrees:
    """Return the trees of a trained model as arrays."""
    nodes: list[tuple[int, float, int, int, float]] = []

    def add(node: dict) -> int:
        at = len(nodes)
        if "leaf_value" in node:
            nodes.append((NO_FEATURE, 0.0, at, at, node["leaf_value"]))
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


def _commit() -> str:
    """Return the commit of the working tree, with + if files differ from it."""
    run = [subprocess.run(["git", *a], cwd=Path(__file__).parent, capture_output=True, text=True, check=True).stdout.strip()
           for a in (("rev-parse", "HEAD"), ("status", "--porcelain", "--untracked-files=no"))]  # fmt: skip
    return run[0] + ("+" if run[1] else "")


def write(
    path: Path,
    model: Steps,
    models: Sequence[Model],
    names: Sequence[str],
    objects: Sequence[tuple[str, str, str]],
    **more: Any,
) -> None:
    """Write a classifier with its manifest. objects: source, kind and name of each that it was trained on."""
    counts = Counter(source for source, _, _ in objects)
    manifest = {
        "features": list(names),
        "sources": {s: {"objects": counts[s], "kinds": sorted({k for t, k, _ in objects if t == s})} for s in sorted(counts)},
        "objects": sorted(f"{source}/{name}" for source, _, name in objects),
        "settings": SETTINGS,
        "models": [asdict(m) for m in models],
        "commit": _commit(),
        "lightgbm": lightgbm.__version__,
        **more,
    }
    arrays = {"manifest": np.frombuffer(json.dumps(manifest).encode(), np.uint8)}
    for name, trees in zip(STEPS, model.trees, strict=False):  # one or two
        arrays |= trees.arrays(name)
    np.savez_compressed(path, **arrays)
    print(f"{path}: {path.stat().st_size / 1e6:.2f} MB")
