"""Compare kinds of classifiers of parts on sources and kinds left out of training: log-linear, trees, networks, and both.

python -m training.model_classes ROWS

ROWS: as for `training/train_parts.py`, which must have measured them.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float
from scipy.optimize import minimize

from anymesh.scoring.classifier import scaled
from training.boosting import Sample, Scores, leave_kinds_out, leave_sources_out
from training.part_rows import PartRows, read_rows
from training.set_training import knots_of
from training.train_parts import calibrated, chances, choices, f1_of, of_both, outcomes, read_scores, samples_of, sets_of, total

PENALTY = 1e-3  # of the squared weights of a log-linear score


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


def log_linear_without(
    samples: Sequence[Sample], knots: Float[np.ndarray, "q k"], left: Sequence[Bool[np.ndarray, " s"]]
) -> Scores:
    """Return the log-linear scores, each fitted without all that is left out with an object."""
    found: Scores = [np.zeros(0)] * len(samples)
    for mask in left:
        weights = log_linear([samples[k] for k in np.flatnonzero(~mask)], knots)
        for k in np.flatnonzero(mask):
            found[k] = _terms(samples[k].features, knots) @ weights
    return found


def best_f1(rows: Sequence[PartRows], scores: Scores) -> str:
    """Return the F1 of all objects with calibrated scores, and in brackets its mean over sources and forms."""
    found = outcomes(rows, choices(rows, chances(scores, *calibrated(rows, scores))))
    return f"{total(found).f1:.3f} ({np.mean(list(f1_of(rows, found).values())):.3f})"


def main() -> None:
    parser = argparse.ArgumentParser(description="Compare kinds of classifiers of parts.")
    parser.add_argument("folder", type=Path)
    rows = read_rows(parser.parse_args().folder)
    samples = samples_of(rows)
    knots = knots_of(sets_of(rows, samples))
    saved = read_scores(rows=rows, folder=parser.parse_args().folder)
    print("| | log-linear | trees | networks | both, as they decide |\n|---|---|---|---|---|")
    for title, name, left in (
        ("sources left out", "source", leave_sources_out(samples)),
        ("kinds left out", "kind", leave_kinds_out(samples)),
    ):
        trees, networks = saved[f"{name} trees"], saved[f"{name} networks"]
        each = (of_both(rows, s, s) for s in (log_linear_without(samples, knots, left), trees, networks))
        figures = [best_f1(rows, s) for s in (*each, saved[name])]
        print(f"| {title} | {' | '.join(figures)} |", flush=True)


if __name__ == "__main__":
    main()
