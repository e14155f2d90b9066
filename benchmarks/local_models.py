"""What is lost with models that are often wrong, and whether the confidence says so, with and without a probe of the model.

python -m benchmarks.local_models [--wrong P ...] [--markdown FILE] [NAME ...]

Ground truth answers the questions of `--pictures few` about the shipped examples, end to end. Each item of an answer (a mark,
a motion, a kind of joint, a point) is replaced by a wrong one with probability P, and each recognized kind of part with half
of it. The probe is answered by the same answerer.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.config import Config
from anymesh.evaluation.ground_truth import GroundTruth, example_truths, prepared
from anymesh.evaluation.oracle import Noisy, oracle
from anymesh.evaluation.score import ObjectScore, score
from anymesh.pipeline.solving import solve
from anymesh.prompted.models.reliability import ProbeCount
from anymesh.prompted.probe import KnownQuestion, known_questions, probe
from anymesh.types import Exchange
from anymesh.types.questions import Answer, Question, VisualAnswerer
from benchmarks import EXAMPLES, parser_of, table_head, table_row

WRONG = (0.2, 0.35)
SURE = 0.8
SEEDS = 5  # of the probe, whose few answers are counted by luck: its counts are the mean over these
HEAD = """# Models that are often wrong

`python -m benchmarks.local_models{names} --markdown FILE`: ground truth answers the questions of `--pictures few` about shipped
examples, end to end; each mark, motion, kind of joint and point is wrong with probability P, each recognized kind of part with
half of it. Which P stands for which model is an estimate, as no rates are published for these questions. The nearest that is
published: of questions about several pictures, open models trained on single ones are right on less than 33 %, GPT-4o on 68 %
([MuirBench](https://arxiv.org/abs/2406.09411)); of perceptual questions with marked pictures
([BLINK](https://arxiv.org/abs/2404.12390)), models of 7 to 17 billion parameters of 2023 on 31 to 42 %, where guessing gives
38 % and GPT-4V 51 % ([table of Mantis](https://huggingface.co/TIGER-Lab/Mantis-8B-Idefics2)); of those that count, two of 7 and
8 billion of 2024 on 57 and 67 % ([Phi-3.5-vision](https://huggingface.co/microsoft/Phi-3.5-vision-instruct)).

Probe: right of asked, the mean over five probes. Recall: true parts found with an IoU of .5. Right: joints right but for their
limits. Probability: mean over the joints written, of part and joint. Brier: mean square of probability minus right, 0 is best.
Sure: joints with a probability of .8 or more.
"""
COLUMNS = ("answers", "probe", "recall", "right of true", "right of written", "probability", "Brier", "sure: right of written")


class Known:
    """Answerer that has the answers to the questions of the probe."""

    name = "known"
    exchanges: tuple[Exchange, ...] = ()
    warnings: tuple[str, ...] = ()

    def __init__(self, questions: Sequence[KnownQuestion]) -> None:
        self._answers = {id(asked): answer for q in questions for asked, answer in q.calls}

    def ask(self, question: Question[Answer]) -> Any:
        return self._answers[id(question)]


def noisy(answerer: VisualAnswerer, wrong: float, seed: int) -> Noisy:
    return Noisy(answerer, wrong, np.random.default_rng(seed), wrong / 2)


def counted(asked: Sequence[KnownQuestion], wrong: float) -> tuple[ProbeCount, ...]:
    """Return the counts of a probe of the answerer, the rounded mean over some seeds."""
    made = [probe(asked, noisy(Known(asked), wrong, seed)).counts for seed in range(SEEDS)]
    means = [round(float(np.mean([counts[k][1] for counts in made]))) for k in range(len(made[0]))]
    return tuple((kind, mean, n, chance) for mean, (kind, _, n, chance) in zip(means, made[0], strict=True))


def scored(truths: Sequence[GroundTruth], wrong: float | None, probed: tuple[ProbeCount, ...] = ()) -> list[ObjectScore]:
    """Return the scores of all objects. wrong: None for geometry alone."""
    scores = []
    for number, sample in enumerate(map(prepared, truths)):
        answerer = None if wrong is None else noisy(oracle(sample), wrong, number)
        factory = None if answerer is None else lambda _, made=answerer: made
        config = Config(pictures="few", probed=probed)
        scores.append(score(sample, *solve(sample.mesh, config=config, answerer_factory=factory)))
    return scores


def row(title: str, probed: str, scores: Sequence[ObjectScore]) -> str:
    """Return the row of one setting."""
    written = [j for s in scores for j in s.found]
    right, told = (
        np.array(x, float) for x in zip(*((j.right, j.part_confidence * j.confidence) for j in written), strict=True)
    )
    true, sure = sum(s.true for s in scores), told >= SURE
    means = (sum(s.matched for s in scores) / true, right.sum() / true, right.mean(), told.mean(), ((told - right) ** 2).mean())
    return table_row([title, probed, *(f"{x:.2f}" for x in means), f"{right[sure].sum():.0f} of {sure.sum()}"])


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("names", nargs="*", help="examples; all when none is named")
    parser.add_argument("--wrong", type=float, nargs="+", default=WRONG, metavar="P", help="probabilities of a wrong answer")
    parser.add_argument("--markdown", type=Path, help="file to write the table to")
    options = parser.parse_args()
    truths = [t for t in example_truths(EXAMPLES) if not options.names or t.name in options.names]
    head = HEAD.format(names="".join(f" {name}" for name in options.names))
    lines, asked = [head, *table_head(COLUMNS)], list(known_questions("few"))
    for wrong in (None, *options.wrong):
        for probed in ((),) if wrong is None else ((), counted(asked, wrong)):
            told = ", ".join(f"{kind} {right}/{n}" for kind, right, n, _ in probed)
            title = "geometry alone" if wrong is None else f"P {wrong:g}"
            lines.append(row(title, told or "none", scored(truths, wrong, probed)))
            print(lines[-1], flush=True)
            if options.markdown:
                options.markdown.write_text("\n".join([*lines, ""]), encoding="utf-8")


if __name__ == "__main__":
    main()
