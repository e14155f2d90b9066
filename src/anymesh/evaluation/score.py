"""An asset against the truth. What is missing counts as a failure."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from anymesh.evaluation.matching import match_parts, part_ious
from anymesh.evaluation.metrics import angle_error, distance_at, line_distance, range_iou, same_motion
from anymesh.evaluation.truth import TrueJoint, Truth
from anymesh.types import Joint, JointType, Mesh, Segmentation

FOUND = 0.5  # IoU from which a part counts as found


@dataclass(frozen=True)
class JointScore:
    """One true joint. iou 0 and the rest None when no part was found for it. position, at_part: shares of the diagonal."""

    part: str
    iou: float
    type_true: JointType
    type_found: JointType | None = None
    angle: float | None = None  # [deg]
    position: float | None = None  # None for a slide
    at_part: float | None = None
    opens_right: bool | None = None
    range_iou: float | None = None
    parent_right: bool | None = None


@dataclass(frozen=True)
class ObjectScore:
    """One object: its joints, and how many parts were predicted, are true, and match with an IoU of at least a half."""

    name: str
    joints: tuple[JointScore, ...]
    predicted: int
    true: int
    matched: int

    @property
    def f1(self) -> float:
        """Of the movable parts at IoU .5; 1 when nothing moves and nothing was found."""
        return 2 * self.matched / (self.predicted + self.true) if self.predicted + self.true else 1.0


def score(
    truth: Truth, mesh: Mesh, T_asset_source: np.ndarray, segmentation: Segmentation, joints: tuple[Joint, ...]
) -> ObjectScore:
    """Compares in the asset frame; `mesh` is the placed one, T_asset_source (4, 4) takes the truth there."""
    ious = part_ious(segmentation.face_part, truth.labels, mesh.face_areas)
    pairs = match_parts(ious)
    by_child = {j.child: j for j in joints}
    found = {truth.parts[t].name: (segmentation.parts[p].name, iou) for p, t, iou in pairs}
    scores = []
    for joint in truth.joints:
        part, iou = found.get(joint.child, ("", 0.0))
        if iou < FOUND or part not in by_child:
            scores.append(JointScore(joint.child, iou, joint.type))
            continue
        number = next(k for k, p in enumerate(truth.parts) if p.name == joint.child)
        center = mesh.triangles[truth.labels == number].reshape(-1, 3).mean(0)
        parent = found.get(joint.parent, (segmentation.parts[0].name, 1.0))[0]
        scores.append(_joint(joint, by_child[part], iou, T_asset_source, center, mesh.diagonal, parent))
    matched = sum(iou >= FOUND for _, _, iou in pairs)
    return ObjectScore(truth.name, tuple(scores), len(segmentation.parts) - 1, len(truth.parts) - 1, matched)


def _joint(
    true: TrueJoint, found: Joint, iou: float, T: np.ndarray, center: np.ndarray, diagonal: float, parent: str
) -> JointScore:
    axis = T[:3, :3] @ true.axis
    scale = float(np.linalg.norm(axis))
    axis, origin = axis / scale, T[:3, :3] @ true.origin + T[:3, 3]
    sliding = true.type is JointType.PRISMATIC
    limits = true.limits
    if limits is not None and sliding:
        limits = (limits[0] * scale, limits[1] * scale)
    same = same_motion(true.type, found.type)
    flip = float(found.axis @ axis) < 0
    ours = found.limits if found.limits is None or not flip else (-found.limits[1], -found.limits[0])
    turning = not sliding and same
    endless = true.type is JointType.CONTINUOUS
    return JointScore(
        part=true.child,
        iou=iou,
        type_true=true.type,
        type_found=found.type,
        angle=angle_error(found.axis, axis),
        position=line_distance(found.origin, found.axis, origin, axis) / diagonal if turning else None,
        at_part=distance_at(center, found.origin, found.axis, origin, axis) / diagonal if turning else None,
        opens_right=None if endless else _opens_alike(ours, limits) if same else False,
        range_iou=range_iou(ours, limits) if same else 0.0,
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
    positions = [j.position for j in joints if j.position is not None]
    types = [float(j.type_found is not None and same_motion(j.type_true, j.type_found)) for j in joints]
    opens = [float(j.opens_right) for j in joints if j.opens_right is not None]
    ranges = [j.range_iou or 0.0 for j in joints]
    angle = f"{np.mean(angles):.2f} / {max(angles):.2f}" if angles else "-"
    position = f"{np.mean(positions):.4f} / {max(positions):.4f}" if positions else "-"
    return (
        f"| {name} | {matched} / {true} / {predicted} | {f1:.2f} | {mean(types)} | {angle} | {position} | "
        f"{mean(opens)} | {mean(ranges)} |"
    )
