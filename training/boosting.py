"""Train classifiers (`anymesh.scoring.classifier`) by lightgbm, and score what was left out of training."""

from __future__ import annotations

import json
import os
import subprocess
from collections import Counter
from collections.abc import Hashable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import lightgbm
import numpy as np
from jaxtyping import Bool, Float

from anymesh.scoring.classifier import NETWORK, NO_FEATURE, TREES, BoostedTrees, SetNetwork

SETTINGS = {
    "objective": "cross_entropy", "learning_rate": 0.1, "num_leaves": 15, "min_data_in_leaf": 25, "feature_fraction": 0.5,
    "bagging_fraction": 0.7, "bagging_freq": 1, "lambda_l2": 5.0, "verbose": -1, "num_threads": 1,
    "deterministic": True,
}  # fmt: skip
FOLDS = 4
Scores = list[Float[np.ndarray, " n"]]


@dataclass(frozen=True)
class Model:
    """One model of an ensemble, whose scores are averaged.

    rounds: number of trees; extra_trees: whether thresholds are random (Geurts et al., 2006).
    """

    rounds: int
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


def fit(samples: Sequence[Sample], models: Sequence[Model]) -> BoostedTrees:
    """Train an ensemble on all samples."""
    target = np.concatenate([s.target for s in samples])
    weight = np.concatenate([np.full(len(s.target), s.weight) for s in samples])
    known = ~np.isnan(target)
    table, weights = np.concatenate([s.features for s in samples])[known], weight[known] / weight[known].mean()

    def trained(model: Model) -> BoostedTrees:
        data = lightgbm.Dataset(table, target[known], weight=weights)
        settings = SETTINGS | {"seed": model.seed, "extra_trees": model.extra_trees}
        return trees_of(lightgbm.train(settings, data, model.rounds))

    with ThreadPoolExecutor(os.cpu_count()) as threads:  # each model uses one thread, for reproducibility
        return BoostedTrees.mean(list(threads.map(trained, models)))


def held_out(samples: Sequence[Sample], left: Sequence[Bool[np.ndarray, " s"]], models: Sequence[Model]) -> Scores:
    """Return the scores of each sample by trees that were trained without all that is left out with it."""
    found: Scores = [np.zeros(0)] * len(samples)
    for mask in left:
        trees = fit([samples[k] for k in np.flatnonzero(~mask)], models)
        for k in np.flatnonzero(mask):
            found[k] = trees.score(samples[k].features)
    return found


def leave_sources_out(samples: Sequence[Sample], together: frozenset[str] = frozenset()) -> list[Bool[np.ndarray, " s"]]:
    """Return which samples are left out, one source at a time. together: sources that are left out at once."""
    left = [{source} for source in sorted({s.source for s in samples} - together)] + ([together] if together else [])
    return [np.array([s.source in some for s in samples]) for some in left]


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


def manifest_of(names: Sequence[str], objects: Sequence[tuple[str, str, str]], **more: Any) -> dict[str, Any]:
    """Return what a classifier was trained on and how. objects: source, kind and name of each; more: further entries."""
    counts = Counter(source for source, _, _ in objects)
    return {
        "features": list(names),
        "sources": {s: {"objects": counts[s], "kinds": sorted({k for t, k, _ in objects if t == s})} for s in sorted(counts)},
        "objects": sorted(f"{source}/{name}" for source, _, name in objects),
        "settings": SETTINGS,
        "commit": _commit(),
        "lightgbm": lightgbm.__version__,
        **more,
    }


def write(path: Path, manifest: dict[str, Any], trees: BoostedTrees, networks: Sequence[SetNetwork] = ()) -> None:
    """Write a classifier with its manifest."""
    arrays = {"manifest": np.frombuffer(json.dumps(manifest).encode(), np.uint8)} | trees.arrays(TREES)
    for k, network in enumerate(networks):
        arrays |= network.arrays(f"{NETWORK}{k}")
    np.savez_compressed(path, **arrays)
    print(f"{path}: {path.stat().st_size / 1e6:.2f} MB")
