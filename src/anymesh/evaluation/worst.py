"""The joints with the largest errors, and descriptions of their errors."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from anymesh.evaluation.record import Record
from anymesh.evaluation.score import MIN_MATCH_IOU, JointScore

STAYS = 0.25  # share of its size: approximate displacement of a missing part at an opening of 30 degrees


@dataclass(frozen=True)
class Off:
    """A joint with errors, and its picture."""

    record: Record
    joint: JointScore
    picture: str  # path relative to the report's folder

    @property
    def title(self) -> str:
        """The object and the part."""
        return f"{self.record.title} / {self.joint.part}"


def badness(joint: JointScore) -> float:
    """Return the displacement of the part's points when opened, or an estimate if it was not found."""
    return STAYS * joint.part_size if joint.displacement is None else joint.displacement


def worst(records: Sequence[Record], count: int) -> list[Off]:
    """Return the worst joints among those that were drawn.

    The same joint under another change, and further missing joints of the same object, come last, since they seldom show
    anything new.
    """
    seen: Counter[tuple[str, str]] = Counter()
    ranked = []
    for off in sorted(_drawn(records), key=lambda o: -badness(o.joint)):
        key = off.record.score.name, "" if off.joint.type_found is None else off.joint.part
        ranked.append((seen[key], off))
        seen[key] += 1
    return [off for _, off in sorted(ranked, key=lambda r: r[0])][:count]


def what_is_off(j: JointScore) -> str:
    """Describe the errors of a joint in one line."""
    if j.type_found is None:
        parts = f"nearest part has IoU {j.iou:.2f}" if j.iou < MIN_MATCH_IOU else "its part has no joint"
        return f"{j.type_true}, not found: {parts}" if j.iou else f"{j.type_true}, not found"
    errors = [f"{j.type_found} instead of {j.type_true}" if not j.type_right else str(j.type_true)]
    errors += [] if j.angle is None else [f"angle {j.angle:.1f} deg"]
    errors += [] if j.at_part is None else [f"line off {j.at_part:.3f}"]
    errors += [] if j.displacement is None else [f"points off {j.displacement:.3f}"]
    errors += ["opens the wrong way"] if j.opens_right is False and j.type_right else []
    errors += [] if j.range_iou is None else [f"range IoU {j.range_iou:.2f}"]
    errors += ["wrong parent"] if j.parent_right is False else []
    return ", ".join(errors)


def _drawn(records: Sequence[Record]) -> Iterator[Off]:
    for record in records:
        joints = {j.part: j for j in record.score.joints}
        for part, path in record.pictures:
            yield Off(record, joints[part], path)
