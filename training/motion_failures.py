"""Draw the joints on which stage B does worst, by classifiers that were not trained on their kind; the parts are given.

python -m training.motion_failures ROWS OUT.jpg SPEC@SOURCE ... [--most 50] [--of-kind 1]

ROWS: as for `training/train_motions.py`; SPEC: the data sets of these rows. One model of the ensemble is trained, which takes
5 minutes of processor time. A joint is worse the surer the classifier prefers a wrong motion to the right one. OUT.txt lists
the joints.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, UInt8

from anymesh.articulation.estimate import estimate_joint, part_motions
from anymesh.evaluation.drawing import contact_sheet, draw_joint
from anymesh.evaluation.ground_truth import EvalSample
from anymesh.evaluation.record import what_is_off
from anymesh.evaluation.score import score
from anymesh.segmentation.divide import object_shape
from training.boosting import held_out, leave_kinds_out
from training.collect_rows import called
from training.motion_rows import MotionRows, read_rows
from training.train_motions import MODELS, over_copies, right_side, samples_of
from training.worst_rows import sheet_options, with_objects, write_sheet

COLUMNS, WIDTH = 5, 420  # of the sheet, and of a picture [px]


@dataclass(frozen=True, eq=False)
class Failure:
    """A joint with a wrong motion. scores: (n,) log-odds of its motions; lead: of the chosen one over the best right one."""

    rows: MotionRows
    scores: Float[np.ndarray, " n"]
    lead: float


def failures(rows: Sequence[MotionRows]) -> list[Failure]:
    """Return the joints whose right motion is offered and not chosen, the largest lead first."""
    samples = samples_of(rows)
    scores = over_copies(rows, held_out(samples, leave_kinds_out(samples), MODELS[:1]))
    wrong = []
    for r, s in zip(rows, scores, strict=True):
        right = right_side(r)
        if right.any() and not right[s.argmax()]:
            wrong.append(Failure(r, s, float(s.max() - s[right].max())))
    return sorted(wrong, key=lambda f: -f.lead)


def picture(failure: Failure, sample: EvalSample) -> tuple[UInt8[np.ndarray, "H W 3"], str]:
    """Draw the joint with the motion that the held-out classifier chooses, and describe its errors."""
    rows = failure.rows
    segmentation = sample.segmentation()
    whole = object_shape(sample.mesh, labels=sample.labels)
    names = [part.name for part in segmentation.parts]
    joints = tuple(
        estimate_joint(context, names[i], names[over], replace(m, scores=failure.scores) if i == rows.number else m)
        for i, over, context, m in part_motions(whole, segmentation)
    )
    result = next(j for j in score(sample, segmentation, joints).joints if j.part == rows.part)
    true = next(j for j in sample.truth.joints if j.child == rows.part)
    predicted = next(j for j in joints if j.child == rows.part)
    line = f"{called(rows)} {rows.name} / {rows.part}: {what_is_off(result)}"
    return draw_joint(sample, segmentation, sample.joint(true), predicted, result), line


def main(argv: Sequence[str] | None = None) -> None:
    options = sheet_options("A contact sheet of the worst joints.", 1, argv)
    pictures, lines = [], []
    for failure, sample in with_objects(failures(read_rows(options.rows)), options):
        drawn, line = picture(failure, sample)
        pictures.append(drawn)
        lines.append(f"{len(lines) + 1} {line}, lead {failure.lead:.1f}")
        print(lines[-1], flush=True)
    write_sheet(options.out, contact_sheet(pictures, COLUMNS, WIDTH), lines)


if __name__ == "__main__":
    main()
