"""What the geometry half of the visual method loses: ground truth answers every question, without and with errors on purpose.

python -m benchmarks.oracle                     parts given and end to end, with motions verified and without
python -m benchmarks.oracle --noise             also how a wrong answer with probability p shows
python -m benchmarks.oracle --markdown FILE --plot FILE.svg
python -m benchmarks.oracle --cost [--like openai:gpt-4o] [--change fused] [NAME ...]
python -m benchmarks.oracle --between [--against CHECKOUT/src] [NAME ...]

--cost: what a vision-language model is asked for the shipped examples: calls, tokens, dollars, seconds. No model is called:
ground truth says the answers through the road of a model (pictures, schema, JSON, checks, cache). Tokens are estimates by the
provider's formula for pictures and 4 letters a token for words; seconds are this program's own. --change fused takes each
object as one surface of about 50,000 faces, as generators make them.

--between: seconds from an answer in files to the next question or the asset, of a run that waits (the tool `articulate` of
`anymesh mcp`), and of `anymesh articulate` started again after each answer, of this build or of another. The two take turns
question by question, so that both see the same load of the machine.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import zip_longest
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

from anymesh.agents.tools import AgentTools, Places
from anymesh.config import Config
from anymesh.errors import OpenQuestionError
from anymesh.evaluation.changes import CHANGES, changed
from anymesh.evaluation.datasets.urdf_ import CLASSES, synthesize
from anymesh.evaluation.ground_truth import GroundTruth, example_truths, prepared
from anymesh.evaluation.oracle import Noisy, SimulatedVlm, oracle
from anymesh.evaluation.record import Record
from anymesh.evaluation.report import markdown
from anymesh.evaluation.score import JointScore, ObjectScore, score
from anymesh.evaluation.summary import group_table
from anymesh.export.asset_json import usage
from anymesh.pipeline.solving import Solver, solve
from anymesh.prompted.answerers.file_answerer import open_in
from anymesh.prompted.answerers.question_files import CHECK, find_questions
from anymesh.prompted.questions.saved_question import answer_object, unpack_question
from anymesh.types.questions import VisualAnswerer
from benchmarks import EXAMPLES, parser_of, table_head, table_row

HEAD = """# The oracle

`python -m benchmarks.oracle --noise --markdown benchmarks/reports/oracle.md --plot docs/images/noise.svg`. Each question
is answered from the ground truth, with the same marks, points, arrows and motions that a model would see. The remaining error
is that of the geometry.
Position: the diagonal is 2; mIoU is over the movable parts, where a part that is not found counts as 0.
"""
COST_HEAD = """# Cost of a model

`python -m benchmarks.oracle --cost --change {change} --markdown FILE`. Answers are the oracle's, so no question is repeated.
Tokens are estimated as `{like}` counts them, dollars by the table in `prompted/models/budget.py`; seconds are those of this
program, without the model: of the first run (wall and processor), and of a second one, which takes every answer from the cache,
without calls or cost.
"""
COST_COLUMNS = (
    "object", "faces", "parts", "calls", "pictures", "tokens in", "tokens out", "USD", "s", "processor s", "s cached",
)  # fmt: skip
BETWEEN_HEAD = """# From an answer to the next question

`python -m benchmarks.oracle --between --against {against} {names}`. Answers are the oracle's. Seconds from an answer to the
next question, or to the asset: of `anymesh articulate` started again, and of a run that waits; at last the
median of each column.
"""
BETWEEN_COLUMNS = ("object", "to", "s, started again", "s, waiting", "ratio")
VERIFY = ("motion", "free", "off")
SOURCE = Path(__file__).parents[1] / "src"
Step = tuple[str, float]  # what came next, and the seconds that it took
WRONG = (0.0, 0.1, 0.2, 0.35, 0.5)
COLORS = {"motion": "#0a6", "free": "#26c", "off": "#c33"}


def run(truths: Sequence[GroundTruth], verify: str, *, given: bool, wrong: float = 0.0) -> list[ObjectScore]:
    rng = np.random.default_rng(0)
    solver = partial(solve, config=Config(verify=verify))
    scores = []
    for sample in map(prepared, truths):
        answerer = Noisy(oracle(sample), wrong, rng) if wrong else oracle(sample)
        given_parts = sample.segmentation() if given else None
        found = solver(sample.mesh, given_parts, answerer_factory=lambda _, answerer=answerer: answerer)
        scores.append(score(sample, *found))
    return scores


def right(j: JointScore) -> bool:
    """Type, axis within 10 degrees, line within .05 of the diagonal, opening side."""
    near = (j.angle or 0.0) <= 10 and (j.line_distance or 0.0) <= 0.1
    return j.type_found == j.type_true and near and j.opens_right is not False


def report(title: str, truths: Sequence[GroundTruth], verify: str, given: bool) -> str:
    begin = time.perf_counter()
    scores = run(truths, verify, given=given)
    joints = [j for s in scores for j in s.joints]
    protocol = f"{title}, {'parts given' if given else 'end to end'}, --verify {verify}"
    lines = [f"## {protocol} ({time.perf_counter() - begin:.0f} s)", ""]
    exact, iou = np.mean([j.type_found == j.type_true for j in joints]), np.mean([j.iou for j in joints])
    lines += [f"Exact types {exact:.3f}, part mIoU {iou:.3f}, joints right {np.mean([right(j) for j in joints]):.3f}.", ""]
    records = [Record(s) for s in scores]
    lines += [markdown(group_table("Objects", [*((r.title, [r]) for r in records), ("all", records)])), ""]
    print("\n".join(lines), flush=True)
    return "\n".join(lines)


def noise(truths: Sequence[GroundTruth]) -> tuple[str, dict[str, list[float]]]:
    shares: dict[str, list[float]] = {v: [] for v in VERIFY}
    for verify in VERIFY:
        for p in WRONG:
            joints = [j for s in run(truths, verify, given=True, wrong=p) for j in s.joints]
            shares[verify].append(float(np.mean([right(j) for j in joints])))
            print(f"wrong {p:.2f}, verify {verify}: {shares[verify][-1]:.3f} right", flush=True)
    lines = ["## Examples, parts given, each answer wrong with probability p: share of joints right", ""]
    lines += table_head(["p", *(f"--verify {v}" for v in VERIFY)])
    lines += [table_row([p, *(f"{shares[v][k]:.3f}" for v in VERIFY)]) for k, p in enumerate(WRONG)]
    return "\n".join([*lines, ""]), shares


def plot(shares: dict[str, list[float]]) -> str:
    """A line a setting, as SVG."""

    def at(p: float, share: float) -> str:
        return f"{60 + 400 * p / WRONG[-1]:.1f},{260 - 220 * share:.1f}"

    lines = ['<svg xmlns="http://www.w3.org/2000/svg" width="500" height="310" font-family="sans-serif" font-size="13">',
             '<rect width="500" height="310" fill="#fff"/>']  # fmt: skip
    for share in (0, 0.25, 0.5, 0.75, 1):
        y = 260 - 220 * share
        lines.append(
            f'<path d="M60 {y:.1f}H460" stroke="#ddd"/><text x="52" y="{y + 4:.1f}" text-anchor="end">{share:g}</text>'
        )
    for p in WRONG:
        lines.append(f'<text x="{60 + 400 * p / WRONG[-1]:.1f}" y="278" text-anchor="middle">{p:g}</text>')
    for k, (verify, found) in enumerate(shares.items()):
        points = " ".join(at(p, s) for p, s in zip(WRONG, found, strict=True))
        lines.append(f'<polyline points="{points}" fill="none" stroke="{COLORS[verify]}" stroke-width="2.5"/>')
        lines.append(f'<text x="70" y="{220 + 18 * k}" fill="{COLORS[verify]}">--verify {verify}</text>')
    lines.append('<text x="260" y="299" text-anchor="middle">probability that an answer is wrong</text>')
    lines.append('<text x="60" y="22">share of joints right</text></svg>')
    return "\n".join(lines) + "\n"


def cost_row(truth: GroundTruth, change: str, like: str, cache: Path) -> str:
    """Return calls, tokens, dollars and seconds of one object, cold and from the cache. like: the model that is imitated."""
    sample = changed(change, prepared(truth))
    seconds, busy, exchanges, parts = [], [], [], 0
    for _ in range(2):
        begin, start = time.perf_counter(), time.process_time()
        solver = Solver(sample.mesh, answerer_factory=lambda fallback: SimulatedVlm(oracle(sample), fallback, like, cache))
        recognized = solver.answers.recognize()
        segmented = solver.parts("auto", recognized.recognition)
        jointed = solver.joints(segmented.segmentation, recognized.recognition)
        seconds.append(time.perf_counter() - begin)
        busy.append(time.process_time() - start)
        exchanges.append((*recognized.exchanges, *segmented.exchanges, *jointed.exchanges))
        parts = len(segmented.segmentation.parts) - 1
    cold, again = (usage(e) for e in exchanges)
    if again["cached_calls"] != again["calls"] or again["calls"] != cold["calls"]:
        raise SystemExit(f"{truth.name}: the second run asked anew: {cold}, {again}")
    shown = sum(len(e.pictures) for e in exchanges[0])
    counts = (len(sample.mesh.faces), parts, cold["calls"], shown, cold["input_tokens"], cold["output_tokens"])
    times = (f"{t:.1f}" for t in (seconds[0], busy[0], seconds[1]))
    return table_row((truth.name, *counts, f"{cold['cost_usd']:.3f}", *times))


def cost(truths: Sequence[GroundTruth], change: str, like: str) -> list[str]:
    """Return the page about what a model costs for these objects."""
    lines = [COST_HEAD.format(like=like, change=change), *table_head(COST_COLUMNS)]
    with tempfile.TemporaryDirectory() as folder:
        for truth in truths:
            lines.append(cost_row(truth, change, like, Path(folder)))
            print(lines[-1], flush=True)
    return [*lines, ""]


def started_again(mesh: Path, folder: Path, source: Path, answer: Callable[[Path], dict[str, Any]]) -> Iterator[Step]:
    """Answer all questions with a new process after each."""
    out, asked = folder / "out", folder / "questions"
    command = ["-m", "anymesh", "articulate", str(mesh), "-o", str(out), "--answerer", f"files:{asked}", "-q"]
    while True:
        begin = time.perf_counter()
        done = subprocess.run([sys.executable, *command], env={**os.environ, "PYTHONPATH": str(source)}, check=False)
        seconds = time.perf_counter() - begin
        if done.returncode == 0:
            yield "asset", seconds
            return
        if done.returncode != OpenQuestionError.exit_code:
            raise SystemExit(f"{mesh.stem}: anymesh articulate ended with {done.returncode}")
        (question,) = open_in(asked)
        yield question.kind, seconds
        question.write_answer(json.dumps(answer(question.path)))


def waiting(mesh: Path, folder: Path, answer: Callable[[Path], dict[str, Any]]) -> Iterator[Step]:
    """Answer all questions of a run that waits."""
    copied = Path(shutil.copy(mesh, folder / mesh.name))
    tools, answers = AgentTools(Places([folder])), []
    try:
        while True:
            begin = time.perf_counter()
            told = tools.articulate(copied.name, "out", answers=answers).record
            yield told.get("kind", "asset"), time.perf_counter() - begin
            if told["state"] == "done":
                return
            answers = [{"question": told["question"], "answer": answer(folder / told["question"])}]
    finally:
        tools.close()


def known_answer(answerer: VisualAnswerer, folder: Path) -> dict[str, Any]:
    """Return the answer to the question in a folder."""
    (asked,) = (q for q in find_questions(folder) if q.path == folder)
    question = unpack_question((folder / CHECK).read_bytes(), asked.pictures())
    return answer_object(question, answerer.ask(question))


def between(truths: Sequence[GroundTruth], source: Path) -> list[str]:
    """Return the page about the time between questions. source: of the build that is started again after each answer."""
    lines = [
        BETWEEN_HEAD.format(against=source.parent.name, names=" ".join(t.name for t in truths)),
        *table_head(BETWEEN_COLUMNS),
    ]
    pairs = []
    for truth in truths:
        answer = partial(known_answer, oracle(prepared(truth)))
        with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as two:
            steps = zip_longest(
                started_again(truth.mesh, Path(one), source, answer), waiting(truth.mesh, Path(two), answer), fillvalue=None
            )
            for k, (before, now) in enumerate(steps):
                if k and before and now:  # the first question follows no answer
                    pairs.append((before[1], now[1], now[1] / before[1]))
                    cells = (f"{before[1]:.1f}", f"{now[1]:.2f}", f"{now[1] / before[1]:.2f}")
                    lines.append(table_row((truth.name, now[0], *cells)))
                    print(lines[-1], flush=True)
    lines.append(table_row(("median", "", *(f"{median(column):.2f}" for column in zip(*pairs, strict=True)))))
    print(lines[-1], flush=True)
    return [*lines, ""]


def loss(examples: Sequence[GroundTruth], with_noise: bool, plot_file: Path | None) -> list[str]:
    """Return the page about what is lost, without errors and with."""
    with tempfile.TemporaryDirectory() as folder:
        sets = {"Examples": examples, "scene-synthesizer": [synthesize(c, Path(folder)) for c in CLASSES]}
        done = [
            report(t, some, v, given)
            for given in (True, False)
            for t, some in sets.items()
            for v in (VERIFY if given else VERIFY[:1])
        ]
    if with_noise:
        section, shares = noise(examples)
        done.append(section)
        if plot_file:
            plot_file.write_text(plot(shares), encoding="utf-8")
    return [HEAD, *done]


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("names", nargs="*", help="with --cost: examples; all when none is named")
    parser.add_argument("--noise", action="store_true", help="also with wrong answers")
    parser.add_argument("--cost", action="store_true", help="what a model is asked, instead of what is lost")
    parser.add_argument("--between", action="store_true", help="seconds from an answer to the next question")
    parser.add_argument("--against", type=Path, default=SOURCE, help="with --between: src of the build that starts again")
    parser.add_argument("--like", default="openai:gpt-4o", help="with --cost: whose tokens and prices")
    parser.add_argument(
        "--change", default="none", choices=list(CHANGES), help="with --cost: of each mesh, as in `anymesh eval`"
    )
    parser.add_argument("--markdown", type=Path, help="file to write the tables to")
    parser.add_argument("--plot", type=Path, help="file to write the plot of --noise to")
    options = parser.parse_args()
    truths = [t for t in example_truths(EXAMPLES) if not options.names or t.name in options.names]
    if options.between:
        page = between(truths, options.against.resolve())
    else:
        page = cost(truths, options.change, options.like) if options.cost else loss(truths, options.noise, options.plot)
    if options.markdown:
        options.markdown.write_text("\n".join(page), encoding="utf-8")


if __name__ == "__main__":
    main()
