"""An asset against the truth. What is missing counts as a failure. Lengths as the field has them: the diagonal is 2."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from anymesh.evaluation.matching import match_parts, part_ious
from anymesh.evaluation.metrics import angle_error, distance_at, line_distance, range_iou, same_motion
from anymesh.evaluation.truth import Subject, TrueJoint
from anymesh.types import Joint, JointType, Segmentation

FOUND = 0.5  # IoU from which a part counts as found


@dataclass(frozen=True)
class JointScore:
    """One true joint. iou 0 and the rest None when no part was found for it. Lengths in units of half the diagonal."""

    part: str
    iou: float
    type_true: JointType
    type_found: JointType | None = None
    angle: float | None = None  # [deg], whatever the axis' sign
    line_distance: float | None = None  # of the two axes; None unless both joints turn
    at_part: float | None = None  # of the found axis from the true one, level with the part
    displacement: float | None = None  # mean distance of the part's points from where they belong, half way open
    opens_right: bool | None = None  # None for a joint that turns endlessly
    range_iou: float | None = None
    parent_right: bool | None = None
    confidence: float | None = None  # that the joint itself tells
    part_size: float = 0.0  # diagonal of the true part

    @property
    def type_right(self) -> bool:
        """Whether the joint was found and moves in the right way."""
        return self.type_found is not None and same_motion(self.type_true, self.type_found)


@dataclass(frozen=True)
class Likeness:
    """How alike two sets of parts are (Particulate's measures): mean box IoU in -1..1, mean IoU, Chamfer distance."""

    giou: float
    miou: float
    chamfer: float


@dataclass(frozen=True)
class ObjectScore:
    """One object: its joints, and how many parts were predicted, are true, and match with an IoU of at least a half."""

    name: str
    joints: tuple[JointScore, ...]
    predicted: int
    true: int
    matched: int
    part_miou: float = 1.0  # over the true movable parts, 0 for one that was not found
    tree_right: bool = True  # every true joint was found, no other, each with the right parent
    rest: Likeness | None = None
    posed: Likeness | None = None  # mean over poses along the range
    executable: bool | None = None  # None: not tried
    faults: tuple[str, ...] = ()  # of joints that were driven

    @property
    def f1(self) -> float:
        """Of the movable parts at IoU .5; 1 when nothing moves and nothing was found."""
        return 2 * self.matched / (self.predicted + self.true) if self.predicted + self.true else 1.0


def score(subject: Subject, segmentation: Segmentation, joints: tuple[Joint, ...]) -> ObjectScore:
    """Compares what was found on the subject's mesh with the truth."""
    truth, mesh = subject.truth, subject.mesh
    pairs = match_parts(part_ious(segmentation.face_part, subject.labels, mesh.face_areas))
    by_child = {j.child: j for j in joints}
    found = {truth.parts[t].name: (segmentation.parts[p].name, iou) for p, t, iou in pairs}
    scores = []
    for joint in truth.joints:
        part, iou = found.get(joint.child, ("", 0.0))
        if iou < FOUND or part not in by_child:
            scores.append(JointScore(joint.child, iou, joint.type))
            continue
        number = next(k for k, p in enumerate(truth.parts) if p.name == joint.child)
        center = mesh.triangles[subject.labels == number].reshape(-1, 3).mean(0)
        parent = found.get(joint.parent, (segmentation.parts[0].name, 1.0))[0]
        scores.append(_joint(subject.joint(joint), by_child[part], iou, center, subject.unit, parent))
    matched = sum(iou >= FOUND for _, _, iou in pairs)
    return ObjectScore(truth.name, tuple(scores), len(segmentation.parts) - 1, len(truth.parts) - 1, matched)


def _joint(true: TrueJoint, found: Joint, iou: float, center: np.ndarray, unit: float, parent: str) -> JointScore:
    same = same_motion(true.type, found.type)
    flip = float(found.axis @ true.axis) < 0
    ours = found.limits if found.limits is None or not flip else (-found.limits[1], -found.limits[0])
    turning = true.type is not JointType.PRISMATIC and same
    endless = true.type is JointType.CONTINUOUS
    at = (found.origin, found.axis, true.origin, true.axis)
    return JointScore(
        part=true.child,
        iou=iou,
        type_true=true.type,
        type_found=found.type,
        angle=angle_error(found.axis, true.axis),
        line_distance=line_distance(*at) / unit if turning else None,
        at_part=distance_at(center, *at) / unit if turning else None,
        opens_right=None if endless else _opens_alike(ours, true.limits) if same else False,
        range_iou=range_iou(ours, true.limits) if same else 0.0,
        parent_right=found.parent == parent,
    )


def _opens_alike(ours: tuple[float, float] | None, true: tuple[float, float] | None) -> bool:
    """Whether the larger part of both ranges lies on the same side of rest (about the true axis)."""
    if ours is None or true is None:
        return ours is None and true is None
    if min(true[1], -true[0]) > 0.5 * max(true[1], -true[0]):
        return True  # opens both ways
    return bool((ours[0] + ours[1] > 0) == (true[0] + true[1] > 0))


def table(scores: list[ObjectScore]) -> str:
    """A Markdown table, an object a row, and the totals."""
    columns = "object, parts found / true / predicted, F1, type, angle mean / worst [deg], position mean / worst, opens, range"
    head = f"| {columns.replace(', ', ' | ')} |"
    lines = [head, "|---|---|---|---|---|---|---|---|"]
    lines += [_row(s.name, list(s.joints), s.matched, s.true, s.predicted, s.f1) for s in scores]
    joints = [j for s in scores for j in s.joints]
    matched, true, predicted = (sum(getattr(s, k) for s in scores) for k in ("matched", "true", "predicted"))
    lines.append(_row("**all**", joints, matched, true, predicted, 2 * matched / max(true + predicted, 1)))
    return "\n".join(lines)


def _row(name: str, joints: list[JointScore], matched: int, true: int, predicted: int, f1: float) -> str:
    def mean(values: list[float]) -> str:
        return f"{np.mean(values):.3f}" if values else "-"

    angles = [j.angle for j in joints if j.angle is not None]
    positions = [j.line_distance for j in joints if j.line_distance is not None]
    types = [float(j.type_right) for j in joints]
    opens = [float(j.opens_right) for j in joints if j.opens_right is not None]
    ranges = [j.range_iou or 0.0 for j in joints]
    angle = f"{np.mean(angles):.2f} / {max(angles):.2f}" if angles else "-"
    position = f"{np.mean(positions):.4f} / {max(positions):.4f}" if positions else "-"
    return (
        f"| {name} | {matched} / {true} / {predicted} | {f1:.2f} | {mean(types)} | {angle} | {position} | "
        f"{mean(opens)} | {mean(ranges)} |"
    )
