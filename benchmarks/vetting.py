"""Measure the tests of joints, and labels given by geometry, on objects with known joints and parts.

`python -m benchmarks.vetting SETS... [--count N] [--seed S]`, with data sets as for `anymesh eval`. The parts are given.
Printed are the share of true joints that fail the tests, of chosen joints that fail and are wrong, how often the next motion is
right then, and how often a label by geometry is that of the part's name, by the confidence of its joint. Names of `labelled:`
sets are read from their records.
"""

from __future__ import annotations

import argparse
import json
import random
import tempfile
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from anymesh.articulation.estimate import choose_motion, estimate_joint
from anymesh.articulation.rank_motions import label_of
from anymesh.articulation.vetting import faults, vetted_joints
from anymesh.evaluation.datasets.dataset import Dataset
from anymesh.evaluation.datasets.labelled import RECORD, LabelledFolder
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.ground_truth import EvalSample, prepared
from anymesh.evaluation.score import JointScore, score
from anymesh.geometry.boxes import straight_mesh, turned_back
from anymesh.pipeline.solving import Solver
from anymesh.vocabulary import recognize

MAX_ANGLE_DEG, MAX_DISTANCE = 10.0, 0.1  # of a right axis, in degrees and half diagonals (see docs/evaluation.md)
MAX_FACES = 9000  # larger objects are left out
ALIKE = ({"door", "flap"}, {"lid", "flap"}, {"door", "lid"}, {"door", "window"}, {"handle", "lever"}, {"handle", "bail"})
LEVELS = (0.0, 0.5, 0.8, 1.0)  # confidences between which labels are counted


class Measured(NamedTuple):
    """One joint. failed: what the tests of the chosen joint found; after: whether the joint that the tests leave is right."""

    confidence: float
    right: bool
    failed: str
    after: bool
    true_failed: str
    label: str
    named: str


def measured(sample: EvalSample, names: dict[str, str]) -> Iterator[Measured]:
    """Yield the joints of an object. names: what its parts are called."""
    solver, segmentation = Solver(sample.mesh), sample.segmentation()
    T = straight_mesh(sample.mesh)[1]
    motions = solver.geometry.motions(segmentation)
    parts = [part.name for part in segmentation.parts]
    contexts = {parts[m.part]: m.context for m in motions}
    first = {parts[m.part]: estimate_joint(m.context, parts[m.part], parts[m.parent], m.motions) for m in motions}
    labels = {parts[m.part]: label_of(m.context, choose_motion(m.context, m.motions)[1]) for m in motions}
    failed = faults(contexts, list(first.values()))
    known = {j.child: j for j in sample.asset().joints if j.child in contexts}
    wrong = faults(contexts, [turned_back(j, np.linalg.inv(T)) for j in known.values()])
    scores = [
        {s.part: s for s in score(sample, segmentation, tuple(turned_back(j, T) for j in some)).joints}
        for some in (first.values(), vetted_joints(segmentation, motions).joints)
    ]
    for name in (j.child for j in sample.truth.joints if j.child in first):
        word = recognize(names.get(name, name).replace("_joint", ""))
        yield Measured(
            first[name].confidence, is_right(scores[0][name]), failed.get(name, ""), is_right(scores[1][name]),
            wrong.get(name, ""), labels[name], "" if word is None else word.label,
        )  # fmt: skip


def is_right(joint: JointScore) -> bool:
    near = joint.type_right and (joint.angle or 0.0) <= MAX_ANGLE_DEG and (joint.at_part or 0.0) <= MAX_DISTANCE
    return near and joint.opens_right is not False


def names_of(dataset: Dataset, name: str) -> dict[str, str]:
    """Return what the parts of a labelled object are called in its record; empty for other sets, whose parts have names."""
    if not isinstance(dataset, LabelledFolder):
        return {}
    record: dict[str, Any] = json.loads((dataset.folder / name / RECORD).read_bytes())
    return {f"part_{joint['part']}": str(joint.get("name", "")) for joint in record["joints"]}


def objects(sets: list[str], count: int, seed: int) -> Iterator[Measured]:
    for dataset in map(open_dataset, sets):
        names = list(dataset.objects(None))
        random.Random(seed).shuffle(names)
        for name in names[:count]:
            with tempfile.TemporaryDirectory() as folder:
                sample = prepared(dataset.truth(name, Path(folder)))
            if len(sample.mesh.faces) <= MAX_FACES:
                yield from measured(sample, names_of(dataset, name))


def report(joints: list[Measured]) -> Iterator[str]:
    """Yield the lines of the report."""

    def share(some: list[bool]) -> str:
        return f"{np.mean(some) if some else 0:.2f} of {len(some)}"

    yield f"joints right: {share([j.right for j in joints])}; after the tests: {share([j.after for j in joints])}"
    yield f"true joints that fail: {share([bool(j.true_failed) for j in joints])}"
    for why, count in Counter(" ".join(j.true_failed.split()[:3]) for j in joints if j.true_failed).most_common():
        yield f"  {why} ...: {count}"
    for right in (True, False):
        yield f"{'right' if right else 'wrong'} joints that fail: {share([bool(j.failed) for j in joints if j.right is right])}"
    yield f"of those that fail, right with the next motion: {share([j.after for j in joints if j.failed])}"
    counted = defaultdict[tuple[str, float], list[bool]](list)
    for j in (j for j in joints if j.label not in ("", "part")):
        level = max(low for low in LEVELS[:-1] if j.confidence >= low)
        same = j.label == j.named or {j.label, j.named} in ALIKE
        counted[j.label, level].append(same)
        counted["all", level].append(same)
    for (label, level), some in sorted(counted.items()):
        yield f"label {label}, confidence from {level:.1f}: {share(some)} as named"


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("sets", nargs="+")
    options.add_argument("--count", type=int, default=50)
    options.add_argument("--seed", type=int, default=7)
    given = options.parse_args()
    print("\n".join(report(list(objects(given.sets, given.count, given.seed)))))


if __name__ == "__main__":
    main()
