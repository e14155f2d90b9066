"""How often joints are right, and how sure, if answers are wrong on purpose (`prompted/motions/verify.py`).

python -m training.confidence DATASET... [--step 1] [--rounds 2] [--markdown FILE]      data sets as `anymesh eval` names them

Parts are given. Every question is answered from the truth, each item wrong with a probability from 0 to .5, or all at random.
"""

from __future__ import annotations

import argparse
import itertools
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from anymesh.articulation.candidate_motions import Candidate
from anymesh.articulation.evidence import sweep_candidates
from anymesh.config import Config
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.ground_truth import EvalSample, prepared
from anymesh.evaluation.oracle import Noisy, Random, oracle
from anymesh.evaluation.score import score
from anymesh.evaluation.summary import right
from anymesh.prompted.motions import offers
from anymesh.prompted.motions.joints import Questions, prompt_joints
from anymesh.prompted.pictures.visual_prompts import VisualPrompts
from anymesh.segmentation.divide import object_shape
from anymesh.types import MOVING
from anymesh.types.motion import Recognition, RecognizedLabel

WRONG = (0.0, 0.1, 0.25, 0.5, 1.0)  # probabilities of a wrong item; the last: all answers at random
BINS = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)


@dataclass(frozen=True)
class Sample:
    """The joint of one part: the confidence in it, whether it is right, and how often answers were wrong."""

    confidence: float
    right: bool
    wrong: float


class Swept:
    """Sweeps each motion of each part once, however often it is answered otherwise."""

    def __init__(self) -> None:
        self._known: dict[tuple[object, ...], tuple[Candidate, ...]] = {}

    def __call__(self, context, proposed) -> tuple[Candidate, ...]:
        place = context.part.bounds.tobytes()
        keys = [(place, role, m.kind, m.axis.tobytes(), m.origin.tobytes()) for role, m in proposed]
        new = [k for k, key in enumerate(keys) if key not in self._known]
        found = sweep_candidates(context, [proposed[k] for k in new])
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
    plain = sample.segmentation()
    parts = [replace(p, label=f"thing {p.name}") if k else p for k, p in enumerate(plain.parts)]
    segmentation = replace(plain, parts=tuple(parts))
    offers.sweep_candidates = Swept()  # ty: ignore[invalid-assignment]
    whole = object_shape(sample.mesh, labels=sample.labels)
    numbers = {p.name: k - 1 for k, p in enumerate(parts)}
    for wrong in WRONG:
        for n in range(1 if wrong == 0 else rounds):
            answerer = Random(oracle(sample), rng) if wrong == 1 else Noisy(oracle(sample), wrong, rng)
            recognition = recognized(sample, wrong, rng) if n % 2 else None
            made = prompt_joints(
                Questions(VisualPrompts(sample.mesh, Config()), answerer, Config(), recognition), lambda _: whole, segmentation
            )
            for j in score(sample, segmentation, made.joints).joints:
                yield Sample(made.joints[numbers[j.part]].confidence, right(j), wrong)


def table(found: Sequence[Sample]) -> str:
    """Mean confidence and share right, by how often answers are wrong and by confidence."""
    confidence, y = np.array([s.confidence for s in found]), np.array([s.right for s in found])
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
    parser = argparse.ArgumentParser(description="Measures joints from answers that are wrong on purpose.")
    parser.add_argument("sets", nargs="+", help="data sets, as `anymesh eval` names them")
    parser.add_argument("--step", type=int, default=1, help="every so-manieth object")
    parser.add_argument("--rounds", type=int, default=2, help="of errors of one probability")
    parser.add_argument("--markdown", type=Path, help="file to write the tables to")
    options = parser.parse_args()
    rng, found = np.random.default_rng(0), []
    with tempfile.TemporaryDirectory() as folder:
        for spec in options.sets:
            dataset = open_dataset(spec)
            for name in dataset.objects()[:: options.step]:
                found.extend(samples(prepared(dataset.truth(name, Path(folder))), options.rounds, rng))
                print(name, len(found), flush=True)
    report = table(found)
    print(report)
    if options.markdown:
        options.markdown.write_text(f"# Confidence\n\n{report}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
