"""Fits what each piece of evidence weighs in the choice of a motion (`anymesh.reasoning.weights`).

python benchmarks/fit_weights.py SPEC ...            the choice that is right with the weights as they are, and cross-validated
python benchmarks/fit_weights.py SPEC ... --write    also writes the weights, fitted to all

SPEC: a data set as for `anymesh eval`, with @SPLIT for a subset; parts are given. The model is the conditional logit of
choices: the log-likelihood that one of the right motions is chosen among all of a part, with an L2 penalty. An object
counts as the square root of its joints. Folds hold whole kinds of objects, so that no kind is both fitted and tested.
The penalty is on what differs from PRIOR, so evidence that is rare in the data keeps the weight that it had.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from scipy.optimize import minimize

from anymesh.articulation.estimate import motion_questions
from anymesh.config import Config
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.metrics import angle_error, distance_at
from anymesh.evaluation.protocols import prepared
from anymesh.evaluation.truth import Subject, TrueJoint
from anymesh.geometry.pieces import object_shape
from anymesh.reasoning.weighing import evidence
from anymesh.reasoning.weights import WEIGHTS
from anymesh.types import JointType, Motion, MotionKind

ANGLE, FAR = 5.0, 0.08  # [deg], and the diagonal is 2: a motion that is further off is wrong
NEAR_ANGLE, NEAR = 2.0, 0.03  # of the right ones, those this near count most
PENALTY = 0.3  # on what differs from PRIOR
COUNTS = {"examples": 4.0, "sweethome3d": 4.0, "metaworld": 3.0, "libero": 3.0}  # others: 1
FOLDS = 5
# What was known before any data: what a person who builds furniture would say, in units of one clear piece of evidence.
PRIOR = {
    "hinge": -1.1, "hinge: support": 1.6, "hinge: free side opposite": 1.0, "hinge: opens": 1.5, "hinge: blocked": -4.0,
    "hinge: along another part": -0.8, "hinge: handle opposite": 1.8, "hinge: handle in the middle": -3.0,
    "hinge: handle off the middle, level": -1.5, "hinge: edge of a block": -0.8, "hinge: about the way out": -3.0,
    "hinge: outwards": 1.2, "hinge: buried": -3.0, "hinge: small, no handle": -3.0, "hinge: edge": 0.5,
    "hinge: edge_mid": 0.35, "hinge: contact": 0.3, "hinge: bail": 2.2, "hinge: barrel": 1.6, "hinge: center": -1.2,
    "hinge: both ways about the middle": 1.5, "hinge: upright": 1.0, "hinge: upright, tall": 0.5, "hinge: pair": 1.0,
    "hinge: outer": 0.3, "hinge: reach": -0.3, "hinge: reach beyond its length": -0.5, "hinge: contact near": 0.5,
    "hinge: contact kept": 1.0, "hinge: round lid": 2.0, "round": -1.0, "round: rounder": 4.0, "round: not round": -4.0,
    "round: free": 4.0, "round: small, flat": -3.0, "round: small, flat and seated": -4.0, "round: lid": -6.0,
    "round: lid above": -2.0, "slide": -0.6, "slide: box": 0.3, "slide: contact_slide": -1.2, "slide: guided": 1.4,
    "slide: blocked": -4.0, "slide: out, small": 1.5, "slide: out, small plate": -1.5, "slide: out, deep": 1.0,
    "slide: out, deep and guided": 1.4, "slide: out, buried": 0.8, "slide: out, handle in the middle": 4.0,
    "slide: along": -1.0, "slide: along, guided": 1.6, "slide: along, captured": 0.5,
    "slide: along, captured, small or level": 1.0, "slide: along, passes another": 2.0, "hinge: above, swings": 1.5,
    "hinge: round lid, upright": 1.0, "round: unmarked, high": -2.0,
    "slide: out, unmarked and high": 2.0, "slide: room": 0.5,
}  # fmt: skip
WRITTEN = Path(__file__).parents[1] / "src" / "anymesh" / "reasoning" / "weights.py"
HEAD = '''"""What each piece of evidence weighs in the choice of a motion: written by `benchmarks/fit_weights.py`."""

WEIGHTS: dict[str, float] = {
'''


@dataclass(frozen=True)
class Choice:
    """One part: the evidence for each of its motions, and how right each is (0: wrong)."""

    set: str
    kind: str
    weight: float
    evidence: tuple[dict[str, float], ...]
    right: np.ndarray


def choices(spec: str, name: str) -> list[Choice]:
    """Those of all joints of an object, the true parts given."""
    with tempfile.TemporaryDirectory() as folder:
        data = open_dataset(spec)
        truth = data.truth(name, Path(folder))
        found = list(_parts(prepared(truth)))
    share = COUNTS.get(data.name, 1.0) / np.sqrt(max(len(found), 1))
    kind = name.split("-")[0]
    return [Choice(data.name, kind, share, facts, right) for facts, right in found]


def _parts(subject: Subject):
    config, truth = Config(), subject.truth
    whole = object_shape(subject.mesh, config.seed, config.pieces, subject.labels)
    joints = {j.child: subject.joint(j) for j in truth.joints}
    for i, _, _, question in motion_questions(whole, subject.segmentation(), config):
        if truth.parts[i].name in joints:
            joint, center = joints[truth.parts[i].name], subject.mesh.triangles[subject.labels == i].reshape(-1, 3).mean(0)
            right = [_right(joint, c.motion, center, subject.unit) for c in question.candidates]
            yield tuple(evidence(question.part, c) for c in question.candidates), np.array(right)


def _right(true: TrueJoint, motion: Motion, center: np.ndarray, unit: float) -> float:
    slides = true.type is JointType.PRISMATIC
    if slides != (motion.kind is MotionKind.SLIDE):
        return 0.0
    angle = angle_error(motion.axis, true.axis)
    off = 0.0 if slides else distance_at(center, motion.origin, motion.axis, true.origin, true.axis) / unit
    if angle > ANGLE or off > FAR:
        return 0.0
    return float(np.exp(-((off / NEAR) ** 2 + (angle / NEAR_ANGLE) ** 2) / 2)) + 1e-3


def fit(some: Sequence[Choice], names: Sequence[str]) -> np.ndarray:
    """(names,) the weights that make the right choices of these likeliest."""
    tables = [(_table(c, names), c.right, c.weight) for c in some if c.right.any()]

    known = np.array([PRIOR.get(name, 0.0) for name in names])

    def loss(w: np.ndarray) -> tuple[float, np.ndarray]:
        off = w - known
        total, slope = PENALTY * float(off @ off), 2 * PENALTY * off
        for table, right, weight in tables:
            worth = table @ w
            likely = np.exp(worth - worth.max())
            chosen, good = likely / likely.sum(), likely * right
            total -= weight * float(np.log(good.sum() / likely.sum() / right.max()))
            slope = slope - weight * (table.T @ (good / good.sum() - chosen))
        return total, slope

    return minimize(loss, known, jac=True, method="L-BFGS-B", options={"maxiter": 500}).x


def _table(choice: Choice, names: Sequence[str]) -> np.ndarray:
    return np.array([[e.get(name, 0.0) for name in names] for e in choice.evidence])


def is_right(choice: Choice, names: Sequence[str], w: np.ndarray) -> bool:
    return bool(choice.right[int((_table(choice, names) @ w).argmax())] > 0)


def crossed(some: Sequence[Choice], names: Sequence[str]) -> list[bool]:
    """For each choice, whether weights fitted to other kinds of objects make it right."""
    kinds = np.random.default_rng(0).permutation(sorted({c.kind for c in some}))
    fold = {kind: k % FOLDS for k, kind in enumerate(kinds)}
    found = [False] * len(some)
    for k in range(FOLDS):
        w = fit([c for c in some if fold[c.kind] != k], names)
        for i, c in enumerate(some):
            if fold[c.kind] == k:
                found[i] = is_right(c, names, w)
    return found


def report(some: Sequence[Choice], names: Sequence[str]) -> str:
    """A Markdown table: how often the choice is right, a set a row."""
    columns = {
        "held": [bool(c.right.any()) for c in some],
        "as they are": [is_right(c, names, np.array([WEIGHTS.get(n, 0.0) for n in names])) for c in some],
        "fitted to all": [is_right(c, names, w) for w in [fit(some, names)] for c in some],
        "fitted to other kinds": crossed(some, names),
    }
    lines = [f"| set | joints | {' | '.join(columns)} |", "|" + "---|" * (2 + len(columns))]
    for name in (*dict.fromkeys(c.set for c in some), "all"):
        rows = [i for i, c in enumerate(some) if name in (c.set, "all")]
        shares = " | ".join(f"{np.mean([found[i] for i in rows]):.3f}" for found in columns.values())
        lines.append(f"| {name} | {len(rows)} | {shares} |")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description="Fits what each piece of evidence weighs.")
    parser.add_argument("specs", nargs="+", metavar="SPEC")
    parser.add_argument("--write", action="store_true", help="write the weights, fitted to all")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    todo = []
    for spec, _, split in (s.partition("@") for s in options.specs):
        todo += [(spec, name) for name in open_dataset(spec).objects(split or None)]
    with ProcessPoolExecutor(options.jobs, get_context("spawn")) as pool:
        some = [c for found in pool.map(choices, *zip(*todo, strict=True)) for c in found]
    names = sorted({name for c in some for e in c.evidence for name in e})
    print(report(some, names))
    if options.write:
        lines = (f'    "{name}": {value:.2f},\n' for name, value in zip(names, fit(some, names), strict=True))
        WRITTEN.write_text(HEAD + "".join(lines) + "}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
