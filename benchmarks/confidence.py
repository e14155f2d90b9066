"""How sure a joint is that somebody chose, fitted to answers that are wrong on purpose (`articulation/confidence.py`).

python benchmarks/confidence.py DATASET... [--step 1] [--rounds 2] [--markdown FILE]      data sets as `anymesh eval` names them

Every question is answered from the truth, each item wrong with a probability from 0 to .5, or all of it at random. A logistic
regression over what speaks for each joint is fitted to half of the objects and measured on the other half.
"""

from __future__ import annotations

import argparse
import itertools
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from anymesh.articulation import offers
from anymesh.articulation.confidence import WEIGHTS, Agreement
from anymesh.articulation.evidence import sweep_candidates
from anymesh.articulation.motion_question import Candidate
from anymesh.articulation.prompted import Questions, prompt_joints
from anymesh.config import Config
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.ground_truth import EvalSample
from anymesh.evaluation.oracle import Noisy, Random, oracle
from anymesh.evaluation.protocols import prepared
from anymesh.evaluation.score import JointScore, score
from anymesh.pipeline.solving import Solver
from anymesh.rendering.visual_prompts import VisualPrompts
from anymesh.types import MOVING
from anymesh.types.recognition import Recognition, RecognizedLabel

WRONG = (0.0, 0.1, 0.25, 0.5, 1.0)  # probabilities of a wrong item; the last: all answers at random
BINS = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)
PENALTY, STEPS, RATE = 0.02, 4000, 0.5


@dataclass(frozen=True, eq=False)
class Sample:
    """The joint of one part: what speaks for it, that for the others of its object, and whether it is right."""

    agreement: Agreement
    others: float
    right: bool
    wrong: float


def right(j: JointScore) -> bool:
    """Type, axis within 10 degrees, line within .1 of half the diagonal at the part, opening side."""
    near = (j.angle or 0.0) <= 10 and (j.at_part or 0.0) <= 0.1
    return j.type_right and near and j.opens_right is not False


class Swept:
    """Sweeps each motion of each part once, however often it is answered otherwise."""

    def __init__(self) -> None:
        self._known: dict[tuple[object, ...], tuple[Candidate, ...]] = {}

    def __call__(self, around, proposed) -> tuple[Candidate, ...]:
        place = around.part.bounds.tobytes()
        keys = [(place, role, m.kind, m.axis.tobytes(), m.origin.tobytes()) for role, m in proposed]
        new = [k for k, key in enumerate(keys) if key not in self._known]
        found = sweep_candidates(around, [proposed[k] for k in new])
        self._known.update((keys[k], found[2 * n : 2 * n + 2]) for n, k in enumerate(new))  # opening one way and the other
        return tuple(c for key in keys for c in self._known[key])


def recognized(sample: EvalSample, wrong: float, rng: np.random.Generator) -> Recognition:
    """A label for each part, of which the way it moves is wrong with a probability; labels state nothing else."""
    moves = [j.type for j in sample.truth.joints]
    answered = [MOVING[int(rng.integers(3))] if rng.random() < wrong else m for m in moves]
    names = [f"thing {j.child}" for j in sample.truth.joints]
    return Recognition("object", None, tuple(RecognizedLabel(n, m, None, None) for n, m in zip(names, answered, strict=True)))


def samples(sample: EvalSample, rounds: int, rng: np.random.Generator) -> Iterator[Sample]:
    """The joints of one object, answered with errors of every probability."""
    solver, plain = Solver(sample.mesh), sample.segmentation()
    parts = [replace(p, label=f"thing {p.name}") if k else p for k, p in enumerate(plain.parts)]
    segmentation = replace(plain, parts=tuple(parts))
    offers.sweep_candidates = Swept()  # ty: ignore[invalid-assignment]
    whole = solver.geometry.ready_for(segmentation)
    numbers = {p.name: k - 1 for k, p in enumerate(parts)}
    for wrong in WRONG:
        for n in range(1 if wrong == 0 else rounds):
            answerer = Random(oracle(sample), rng) if wrong == 1 else Noisy(oracle(sample), wrong, rng)
            recognition = recognized(sample, wrong, rng) if n % 2 else None
            made = prompt_joints(
                Questions(VisualPrompts(sample.mesh, Config()), answerer, Config(), recognition), lambda _: whole, segmentation
            )
            own = [a.own for a in made.agreements]
            for j in score(sample, segmentation, made.joints).joints:
                k = numbers[j.part]
                others = float(np.mean(own[:k] + own[k + 1 :])) if len(own) > 1 else own[k]
                yield Sample(made.agreements[k], others, right(j), wrong)


def fit(found: Sequence[Sample]) -> dict[str, float]:
    """Weights of a logistic regression, by gradient descent."""
    X, y = design(found), np.array([s.right for s in found], float)
    weights = np.zeros(X.shape[1])
    for _ in range(STEPS):
        error = 1 / (1 + np.exp(-X @ weights)) - y
        weights -= RATE * (X.T @ error / len(y) + PENALTY * weights * (np.arange(len(weights)) > 0) / 10)
    return {name: round(float(w), 2) for name, w in zip(WEIGHTS, weights, strict=True)}


def design(found: Sequence[Sample]) -> np.ndarray:
    """A row a sample, a column a weight."""
    rows = [{"constant": 1.0, **s.agreement.features, "others": s.others} for s in found]
    return np.array([[row.get(name, 0.0) for name in WEIGHTS] for row in rows])


def sure(found: Sequence[Sample], weights: dict[str, float]) -> np.ndarray:
    return 1 / (1 + np.exp(-design(found) @ np.array([weights[name] for name in WEIGHTS])))


def table(found: Sequence[Sample], weights: dict[str, float]) -> str:
    """Mean confidence and share right, by how often answers are wrong and by confidence."""
    confidence, y = sure(found, weights), np.array([s.right for s in found])
    lines = ["| answers wrong | joints | right | mean confidence |", "|---|---|---|---|"]
    for wrong in WRONG:
        mine = np.array([s.wrong == wrong for s in found])
        name = "at random" if wrong == 1 else f"{wrong:.2f}"
        lines.append(f"| {name} | {mine.sum()} | {y[mine].mean():.2f} | {confidence[mine].mean():.2f} |")
    lines += ["", "| confidence | joints | right | mean confidence |", "|---|---|---|---|"]
    for low, high in itertools.pairwise(BINS):
        mine = (confidence >= low) & (confidence < high)
        if mine.any():
            lines.append(f"| {low:.1f}-{high:.1f} | {mine.sum()} | {y[mine].mean():.2f} | {confidence[mine].mean():.2f} |")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description="Fits and measures the confidence of joints that somebody chose.")
    parser.add_argument("sets", nargs="+", help="data sets, as `anymesh eval` names them")
    parser.add_argument("--step", type=int, default=1, help="every so-manieth object")
    parser.add_argument("--rounds", type=int, default=2, help="of errors of one probability")
    parser.add_argument("--markdown", type=Path, help="file to write the tables to")
    options = parser.parse_args()
    rng, halves = np.random.default_rng(0), ([], [])
    with tempfile.TemporaryDirectory() as folder:
        for spec in options.sets:
            dataset = open_dataset(spec)
            for k, name in enumerate(dataset.objects()[:: options.step]):
                sample = prepared(dataset.truth(name, Path(folder)))
                halves[k % 2].extend(samples(sample, options.rounds, rng))
                print(name, sum(map(len, halves)), flush=True)
    weights = fit(halves[0])
    print(weights)
    report = f"Fitted to {len(halves[0])} joints, measured on {len(halves[1])} of other objects.\n\n{table(halves[1], weights)}"
    print(f"{report}\n\nWith the weights as they stand:\n\n{table(halves[1], WEIGHTS)}\n")
    print(f"Fitted to all: {fit([*halves[0], *halves[1]])}")
    if options.markdown:
        options.markdown.write_text(f"# Confidence\n\n{report}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
