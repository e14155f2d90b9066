"""Where the errors of joints come from: what was not proposed, what was not chosen, a wrong context, wrong limits."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from anymesh.evaluation.record import Record
from anymesh.evaluation.score import JointScore
from anymesh.types import JointType
from training import motion_rows, part_rows
from training.collect_rows import open_object
from training.part_scores import RIGHT

CAUSES = (
    "part not proposed", "part not chosen", "motion not proposed", "motion not chosen", "wrong part context",
    "wrong side or limits", "right",
)  # fmt: skip
MIN_RANGE_IOU = 0.5  # of a range that counts as right
Proposed = Mapping[str, tuple[bool, bool]]  # by part: whether it is among the candidates, and its motion if the parts are given


def proposed_parts(spec: str, name: str, form: str) -> Proposed:
    """Return what is proposed for each part of an object with a joint."""
    sample = open_object(spec, name, form)
    parts = part_rows.rows_of(sample, "", form)
    motions = {r.part: bool((r.right > 0).any()) for r in motion_rows.rows_of(sample, "", form)}
    names = [part.name for part in sample.truth.parts]
    best = {names[k]: bool((parts.iou_with(k) > RIGHT).any()) for k in parts.moving}
    return {part: (found, motions.get(part, False)) for part, found in best.items()}


def moves_right(joint: JointScore) -> bool:
    """Return whether the motion is right, to whichever side: within 5 degrees and .08 of half the diagonal."""
    if not joint.type_right or joint.angle is None or joint.angle > motion_rows.ANGLE:
        return False
    return joint.type_true is JointType.PRISMATIC or (joint.at_part is not None and joint.at_part <= motion_rows.FAR)


def cause(found: JointScore, given: JointScore, proposed: tuple[bool, bool]) -> str:
    """Return the first cause, of CAUSES, that a joint is not right. found: end to end; given: with the true parts."""
    part, motion = proposed
    if found.type_found is None:
        return "part not chosen" if part else "part not proposed"
    if not moves_right(found):
        if moves_right(given):
            return "wrong part context"
        return "motion not chosen" if motion else "motion not proposed"
    limited = found.range_iou is not None and found.range_iou < MIN_RANGE_IOU
    return "wrong side or limits" if found.opens_right is False or limited else "right"


def causes_table(groups: Iterable[tuple[str, Sequence[tuple[Record, Record, Proposed]]]]) -> list[str]:
    """Return lines of a table with the share of joints by cause.

    groups: title, and for each object its record end to end, that with parts given, and what is proposed for it.
    """
    lines = [f"| | joints | {' | '.join(CAUSES)} |", "|---" * (2 + len(CAUSES)) + "|"]
    for title, some in groups:
        count: Counter[str] = Counter()
        for found, given, proposed in some:
            by_part = {j.part: j for j in given.score.joints}
            count.update(cause(j, by_part[j.part], proposed.get(j.part, (False, False))) for j in found.score.joints)
        total = count.total()
        lines.append(f"| {title} | {total} | {' | '.join(f'{count[c] / max(total, 1):.2f}' for c in CAUSES)} |")
    return lines
