"""What the geometry half of the visual method loses: ground truth answers every question, without and with errors on purpose.

python -m benchmarks.oracle                     parts given and end to end, with motions verified and without
python -m benchmarks.oracle --noise             also how a wrong answer with probability p shows
python -m benchmarks.oracle --markdown FILE --plot FILE.svg
"""

from __future__ import annotations

import argparse
import tempfile
import time
from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np

from anymesh.config import Config
from anymesh.evaluation.datasets.urdf_ import CLASSES, synthesize
from anymesh.evaluation.ground_truth import GroundTruth, example_truths, prepared
from anymesh.evaluation.oracle import Noisy, oracle
from anymesh.evaluation.record import Record
from anymesh.evaluation.report import markdown
from anymesh.evaluation.score import JointScore, ObjectScore, score
from anymesh.evaluation.summary import group_table
from anymesh.pipeline.solving import solve
from benchmarks import EXAMPLES

HEAD = """# The oracle

`python -m benchmarks.oracle --noise --markdown benchmarks/reports/oracle.md --plot docs/images/noise.svg`. Each question
is answered from the ground truth, with the same marks, points, arrows and motions that a model would see. The remaining error
is that of the geometry.
Position: the diagonal is 2; mIoU is over the movable parts, where a part that is not found counts as 0.
"""
VERIFY = ("motion", "free", "off")
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
    lines += ["| p | " + " | ".join(f"--verify {v}" for v in VERIFY) + " |", "|---|" + "---|" * len(VERIFY)]
    lines += [f"| {p} | " + " | ".join(f"{shares[v][k]:.3f}" for v in VERIFY) + " |" for k, p in enumerate(WRONG)]
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


def main() -> None:
    parser = argparse.ArgumentParser(description="What the geometry half of the visual method loses.")
    parser.add_argument("--noise", action="store_true", help="also with wrong answers")
    parser.add_argument("--markdown", type=Path, help="file to write the tables to")
    parser.add_argument("--plot", type=Path, help="file to write the plot of --noise to")
    options = parser.parse_args()
    examples = example_truths(EXAMPLES)
    with tempfile.TemporaryDirectory() as folder:
        sets = {"Examples": examples, "scene-synthesizer": [synthesize(c, Path(folder)) for c in CLASSES]}
        done = [
            report(t, some, v, given)
            for given in (True, False)
            for t, some in sets.items()
            for v in (VERIFY if given else VERIFY[:1])
        ]
    if options.noise:
        section, shares = noise(examples)
        done.append(section)
        if options.plot:
            options.plot.write_text(plot(shares), encoding="utf-8")
    if options.markdown:
        options.markdown.write_text("\n".join([HEAD, *done]), encoding="utf-8")


if __name__ == "__main__":
    main()
