"""Answers from known parts and joints, by the same marks, points and arrows as a model.

With ground truth as reference it is the oracle (evaluation only), which shows the loss of the geometric half of the method.
With the geometry answerer's result as reference it is the fallback of a model without a valid answer.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import Any, cast

import numpy as np
from jaxtyping import Float, Int

from anymesh.prompted.questions.grounding import MarkedPart, MarksAnswer, WhichMarks, WhichViews
from anymesh.prompted.questions.prompting import (
    JointAppearance,
    KindAnswer,
    MotionPick,
    MotionTable,
    PartShown,
    PointTable,
    WhichArrows,
    WhichKinds,
    WhichMotions,
    WhichPoints,
)
from anymesh.prompted.questions.recognition import Recognize, RecognizeRegions
from anymesh.types import Brief, Exchange, Joint, JointType, KnownJoint, Mesh, Motion, Segmentation
from anymesh.types.motion import BASE, Recognition, RecognizedLabel
from anymesh.types.questions import Answer, Question

MIN_VISIBLE_PIXELS = 40  # [px] minimum visible size of a part
MIN_MARK_OVERLAP = 0.5  # minimum share of a mark's pixels on the part that the mark is given to
MIN_SPLIT_OVERLAP = 0.02  # share of a mark's pixels on another part above which the mark is split
MAX_AXIS_DISTANCE_RATIO = 0.05  # of the part's size: contact points closer to the axis lie on it
# of the part's extent along the axis: minimum extent of the points on the axis of a visible hinge
MIN_HINGE_SPREAD_RATIO = 0.25
# minimum cosine between the contact plane's normal and an axis that enters the surface
MIN_NORMAL_COSINE = np.cos(np.deg2rad(20.0))
MIN_OPENING_COSINE = 0.7  # minimum cosine between the opening direction and a slide out of the object
# of the displacement: maximum distance of the moved part from its true place for a motion to be recognized
MAX_MOTION_ERROR_RATIO = 0.5


@dataclass(frozen=True, eq=False)
class Reference(Brief):
    """Known parts and joints.

    face_part: (F,) part of each face, 0 for the base. The other fields have one entry per part, the base first.
    """

    category: str
    size: float  # longest side [m]
    face_part: Int[np.ndarray, " F"]
    face_area: Float[np.ndarray, " F"]
    labels: tuple[str, ...]
    parents: tuple[int, ...]
    joints: tuple[KnownJoint | None, ...]

    @cached_property
    def kinds(self) -> tuple[str, ...]:
        """Return a label per part that also states its motion if parts of one label move differently."""
        moves = [None if j is None else j.type for j in self.joints]
        ways = {label: {m for other, m in zip(self.labels, moves, strict=True) if other == label} for label in self.labels}
        word = {JointType.PRISMATIC: "sliding", JointType.CONTINUOUS: "spinning", JointType.REVOLUTE: "hinged"}
        return tuple(
            f"{word[m]} {label}" if m in word and (len(ways[label]) > 1 or label == "part") else label
            for label, m in zip(self.labels, moves, strict=True)
        )


def reference_of(mesh: Mesh, segmentation: Segmentation, joints: tuple[Joint, ...], category: str) -> Reference:
    """Build a reference from parts and joints."""
    number = {p.name: k for k, p in enumerate(segmentation.parts)}
    by_child = {j.child: j for j in joints}
    made = [by_child.get(p.name) for p in segmentation.parts]
    return Reference(
        category=category,
        size=float(mesh.extents.max()),
        face_part=segmentation.face_part,
        face_area=mesh.face_areas,
        labels=tuple(p.label for p in segmentation.parts),
        parents=tuple(0 if j is None else number[j.parent] for j in made),
        joints=tuple(None if j is None else KnownJoint(j.type, j.origin, j.axis, j.limits) for j in made),
    )


class ReferenceAnswerer:
    """Answerer that uses a reference, built on first use."""

    exchanges: tuple[Exchange, ...] = ()
    warnings: tuple[str, ...] = ()

    def __init__(self, name: str, reference: Callable[[], Reference]) -> None:
        self.name, self._make = name, reference

    @cached_property
    def _known(self) -> Reference:
        return self._make()

    def ask(self, question: Question[Answer]) -> Answer:
        answer: Any
        match question:
            case Recognize():
                answer = self._recognition()
            case RecognizeRegions():
                answer = question.known
            case WhichViews():
                answer = self._views(question)
            case WhichMarks():
                answer = self._marks(question)
            case WhichKinds():
                answer = tuple(self._kind(p, question.labels) for p in question.parts)
            case WhichPoints():
                answer = tuple(self._points(t) for t in question.tables)
            case WhichArrows():
                answer = tuple(self._arrow(t.part, t.directions) for t in question.tables)
            case WhichMotions():
                answer = tuple(self._pick(question, t) for t in question.tables)
            case _:
                raise TypeError(f"no answer is known to {type(question).__name__}")
        return cast(Answer, answer)

    def _recognition(self) -> Recognition:
        known, labels = self._known, {}
        for part, (label, joint) in enumerate(zip(known.kinds, known.joints, strict=True)):
            if joint is not None and self._moves(part):
                parent = self._parent(part)
                if label not in labels or parent == label:  # a part on another one of its own label makes the label a chain
                    labels[label] = RecognizedLabel(label, joint.type, parent, joint.opening_range)
        return Recognition(known.category, known.size, tuple(labels.values()))

    def _parent(self, part: int) -> str:
        """Return the label of the movable part that a part is mounted on."""
        over = self._known.parents[part]
        while over and not self._moves(over):
            over = self._known.parents[over]
        return self._known.kinds[over] if over else BASE

    def _moves(self, part: int) -> bool:
        joint = self._known.joints[part]
        return joint is not None and joint.type is not JointType.FIXED

    def _pixels(self, faces: np.ndarray) -> np.ndarray:
        """Return the part per pixel, -1 for none."""
        return np.where(faces >= 0, self._known.face_part[faces], -1)

    def _views(self, question: WhichViews) -> dict[str, tuple[int, ...]]:
        kinds = self._known.kinds
        seen = [np.bincount(self._pixels(f)[f >= 0], minlength=len(kinds)) for f in question.faces]
        most = {label: [max(n[p] * (kinds[p] == label) for p in range(len(kinds))) for n in seen] for label in question.labels}
        return {
            label: tuple(v for v, pixels in enumerate(counts) if pixels >= MIN_VISIBLE_PIXELS) for label, counts in most.items()
        }

    def _marks(self, question: WhichMarks) -> MarksAnswer:
        parts = [self._pixels(f) for f in question.faces]
        if question.consistent:
            views = [(None, np.concatenate([r.ravel() for r in question.regions]), np.concatenate([p.ravel() for p in parts]))]
        else:
            views = [(v, r.ravel(), p.ravel()) for v, (r, p) in enumerate(zip(question.regions, parts, strict=True))]
        part_marks: dict[tuple[int, int | None], list[int]] = {}
        split = []
        for view, region, part in views:
            on = (region >= 0) & (part >= 0)
            for mark in np.unique(region[on]):
                counts = np.bincount(part[on & (region == mark)])
                best = int(counts.argmax())
                second = int(np.sort(counts)[-2]) if len(counts) > 1 else 0
                if question.splittable and second > max(MIN_SPLIT_OVERLAP * counts.sum(), MIN_VISIBLE_PIXELS):
                    split.append(int(mark))
                elif best > 0 and counts[best] > MIN_MARK_OVERLAP * counts.sum() and self._known.kinds[best] in question.labels:
                    part_marks.setdefault((best, view), []).append(int(mark))
        marked = tuple(
            MarkedPart(self._known.kinds[part], self._instance(part), view, tuple(marks))
            for (part, view), marks in sorted(part_marks.items(), key=lambda item: (item[0][0], item[0][1] or 0))
        )
        return MarksAnswer(marked, split=tuple(split))

    def _instance(self, part: int) -> int:
        return sum(kind == self._known.kinds[part] for kind in self._known.kinds[1 : part + 1])

    def _number(self, part: PartShown) -> int:
        """Return the known part that this one covers most, 0 if that is fixed."""
        known = self._known
        area = np.bincount(known.face_part[part.faces], known.face_area[part.faces], len(known.labels))
        moving = int(area[1:].argmax()) + 1 if len(area) > 1 and area[1:].max() > 0 else 0
        return moving if moving and self._moves(moving) else 0

    def _joint(self, part: PartShown) -> KnownJoint | None:
        return self._known.joints[self._number(part)]

    def _kind(self, part: PartShown, labels: tuple[str, ...]) -> KindAnswer:
        joint = self._joint(part)
        label = self._known.kinds[self._number(part)]
        answered = label if label in labels else None
        if joint is None:
            return KindAnswer(JointAppearance.FIXED, label=answered)
        endless = joint.type is JointType.CONTINUOUS
        return KindAnswer(self._kind_of(part, joint), endless, answered)

    def _kind_of(self, part: PartShown, joint: KnownJoint) -> JointAppearance:
        axis = joint.opening_motion.axis
        if joint.type is JointType.PRISMATIC:
            return (
                JointAppearance.SLIDE_OUT
                if abs(float(axis @ part.outward)) > MIN_OPENING_COSINE
                else JointAppearance.SLIDE_ALONG
            )
        on = part.contact[joint.opening_motion.distance(part.contact) < MAX_AXIS_DISTANCE_RATIO * _size(part)]
        along = np.ptp(on @ axis) if len(on) > 1 else 0.0
        if along > MIN_HINGE_SPREAD_RATIO * np.ptp(part.points @ axis):
            return JointAppearance.HINGE_ALONG
        return (
            JointAppearance.HINGE_INTO if abs(float(axis @ part.normal)) > MIN_NORMAL_COSINE else JointAppearance.HINGE_HIDDEN
        )

    def _points(self, table: PointTable) -> tuple[int, ...]:
        """Return the point with the best axis, or the two points with the best line.

        The best line takes the part closest to where the joint takes it.
        """
        joint = self._joint(table.part)
        if joint is None:
            return tuple(range(table.min_points))
        size = _size(table.part)
        normals = np.broadcast_to(table.part.normal, table.points.shape)
        if table.axes is not None:
            normals = np.where(np.isnan(table.axes), normals, table.axes)
        off = joint.opening_motion.distance(table.points)
        single = np.array([_turned_by(n, joint) for n in normals]) * size + off
        best = (int(single.argmin() if table.axes is not None else off.argmin()),)
        least = float(single[best[0]]) if table.min_points == 1 else np.inf
        for a, b in combinations(range(len(table.points)), 2) if table.max_points > 1 else ():
            apart = table.points[b] - table.points[a]
            length = float(np.linalg.norm(apart))
            if length < 1e-9:
                continue
            error = _turned_by(apart / length, joint) * size + float(off[[a, b]].mean())
            if error < least:
                best, least = (a, b), error
        return best if len(best) >= table.min_points else (0, 1)

    def _arrow(self, part: PartShown, directions: np.ndarray) -> int:
        joint = self._joint(part)
        return 0 if joint is None else int((directions @ joint.opening_motion.axis).argmax())

    def _pick(self, question: WhichMotions, table: MotionTable) -> MotionPick:
        attached = self._kind(table.part, question.labels) if question.ask_kind else None
        return MotionPick(self._motion(table.part, table.motions, table.amounts), attached=attached)

    def _motion(self, part: PartShown, motions: tuple[Motion, ...], amounts: tuple[float, ...]) -> int | None:
        joint = self._joint(part)
        if joint is None:
            return None
        true = joint.opening_motion
        both = joint.opening_range is None or -joint.opening_range[0] > 0.5 * joint.opening_range[1]
        off = np.full(len(motions), np.inf)
        for k, (motion, amount) in enumerate(zip(motions, amounts, strict=True)):
            if motion.kind is true.kind:
                goal = [_moved(part.points, true, s * abs(amount)) for s in ((1, -1) if both else (1,))]
                here = _moved(part.points, motion, amount)
                way = float(np.linalg.norm(here - part.points, axis=1).mean())
                off[k] = min(float(np.linalg.norm(here - g, axis=1).mean()) for g in goal) / max(way, 1e-12)
        return int(off.argmin()) if off.min(initial=np.inf) < MAX_MOTION_ERROR_RATIO else None


def _turned_by(direction: np.ndarray, joint: KnownJoint) -> float:
    """Return the sine of the angle between a unit direction and the axis."""
    return float(np.linalg.norm(np.cross(direction, joint.opening_motion.axis)))


def _size(part: PartShown) -> float:
    return float(np.linalg.norm(np.ptp(part.points, axis=0)))


def _moved(points: np.ndarray, motion: Motion, amount: float) -> np.ndarray:
    T = motion.transform(amount)
    return points @ T[:3, :3].T + T[:3, 3]
