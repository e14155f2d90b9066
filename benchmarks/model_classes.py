"""Compare kinds of classifiers of parts on sources and kinds left out of training: log-linear, trees, networks, and their mean.

python benchmarks/model_classes.py ROWS

ROWS: as for `benchmarks/train_parts.py`, which must have measured them: the scores of the networks are what its saved scores,
means of trees and networks, leave when the trees are trained again.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from boosting import Sample, Scores, fit, leave_kinds_out, leave_sources_out
from jaxtyping import Bool, Float
from part_rows import PartRows, read_rows
from scipy.optimize import minimize
from set_training import knots_of
from train_parts import CUT, CUT_SCORE, MODELS, counts, read_scores, samples_of, sets_of, with_cuts

from anymesh.scoring.set_network import scaled

PENALTY = 1e-3  # of the squared weights of a log-linear score
SHIFTS = (-0.5, -0.25, 0.0, 0.25, 0.5)  # [log-odds] added to all scores; each kind of classifier has the best for it


def log_linear(samples: Sequence[Sample], knots: Float[np.ndarray, "q k"]) -> Float[np.ndarray, " w"]:
    """Fit weights of features, of their squares and a constant, by maximum likelihood."""
    table = _terms(np.concatenate([s.features for s in samples]), knots)
    target = np.concatenate([s.target for s in samples])
    weight = np.concatenate([np.full(len(s.target), s.weight) for s in samples])
    weight /= weight.sum()

    def loss(w: np.ndarray) -> tuple[float, np.ndarray]:
        score = table @ w
        probability = 1 / (1 + np.exp(-score))
        value = weight @ (np.logaddexp(0, score) - target * score) + PENALTY * w @ w
        return float(value), table.T @ (weight * (probability - target)) + 2 * PENALTY * w

    return minimize(loss, np.zeros(table.shape[1]), jac=True, method="L-BFGS-B", options={"maxiter": 300}).x


def _terms(features: Float[np.ndarray, "n k"], knots: Float[np.ndarray, "q k"]) -> Float[np.ndarray, "n w"]:
    own = scaled(features, knots).astype(float)
    return np.concatenate([own, own**2, np.ones((len(own), 1))], 1)


def scores_without(
    samples: Sequence[Sample], knots: Float[np.ndarray, "q k"], left: Sequence[Bool[np.ndarray, " s"]]
) -> tuple[Scores, Scores]:
    """Return the log-linear scores and those of trees, each trained without all that is left out with an object."""
    linear: Scores = [np.zeros(0)] * len(samples)
    trees: Scores = [np.zeros(0)] * len(samples)
    for mask in left:
        known = [samples[k] for k in np.flatnonzero(~mask)]
        weights, ensemble = log_linear(known, knots), fit(known, MODELS)
        for k in np.flatnonzero(mask):
            linear[k] = _terms(samples[k].features, knots) @ weights
            trees[k] = ensemble.score(samples[k].features)
    return linear, trees


def best_f1(rows: Sequence[PartRows], scores: Scores) -> str:
    """Return the F1 of all objects, and in brackets its mean over sources and forms."""
    groups = sorted({(r.source, r.form) for r in rows})
    of = [[k for k, r in enumerate(rows) if (r.source, r.form) == g] for g in groups]

    def f1(shift: float) -> tuple[float, float]:
        shifted = [s + shift for s in scores]
        some = [counts([rows[k] for k in ks], [shifted[k] for k in ks]).f1 for ks in of]
        return counts(rows, shifted).f1, float(np.mean(some))

    return "{:.3f} ({:.3f})".format(*max(f1(shift) for shift in SHIFTS))


def main() -> None:
    parser = argparse.ArgumentParser(description="Compare kinds of classifiers of parts.")
    parser.add_argument("folder", type=Path)
    rows = read_rows(parser.parse_args().folder)
    samples = samples_of(rows)
    knots = knots_of(sets_of(rows, samples))
    saved = read_scores(rows=rows, folder=parser.parse_args().folder)
    print("| | log-linear | trees | networks | mean of trees and networks |\n|---|---|---|---|---|")
    for title, left, mean in (
        ("sources left out", leave_sources_out(samples), saved[0]),
        ("kinds left out", leave_kinds_out(samples), saved[1]),
    ):
        linear, trees = scores_without(samples, knots, left)
        cut = [CUT_SCORE * r.features[:, r.names.index(CUT)] for r in rows]
        networks = [2 * (m - c) - t for m, c, t in zip(mean, cut, trees, strict=True)]
        figures = [best_f1(rows, s) for s in (with_cuts(rows, linear), with_cuts(rows, trees), with_cuts(rows, networks), mean)]
        print(f"| {title} | {' | '.join(figures)} |", flush=True)


if __name__ == "__main__":
    main()
