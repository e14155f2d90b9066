"""Scores of an asset against ground truth. Missing parts count as failures. Lengths are relative to a diagonal of 2.

The published position error is the distance of two lines in space. It has two flaws. It is ill-conditioned for nearly parallel
lines: hinges a door's width apart that cross far away score 0. Below `NEARLY_PARALLEL` they are therefore compared at the part,
as is common, which makes the error discontinuous there.
And it is insensitive: any two lines in a plane score 0. It is kept because others publish it; `distance_at` and `displacement`
are continuous and capture all errors.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from jaxtyping import Float, Int
from scipy.optimize import linear_sum_assignment

from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, TrueJoint
from anymesh.evaluation.particulate_metrics import ParticulateMetrics, particulate_metrics
from anymesh.geometry.kinematics import joint_transform
from anymesh.geometry.triangle_set import sample_surface
from anymesh.types import MOVING, Joint, JointType, Mesh, Mimic, Segmentation
from anymesh.types.motion import leaders

TURNED = np.pi / 6  # [rad] by which rotating joints are opened
TRAVEL = 0.5  # share of the travel by which slides are opened
NEARLY_PARALLEL = np.deg2rad(1.0)  # below this angle, the distance of skew lines is ill-defined
BOTH_WAYS = 0.5  # a range opens both ways if its smaller side is more than this share of the larger
Vector = Float[np.ndarray, " 3"]
Limits = tuple[float, float] | None
MIN_MATCH_IOU = 0.5  # IoU from which a part counts as found
RIGHT_ANGLE, RIGHT_PLACE = 10.0, 0.1  # [deg], half the object's diagonal
RIGHT_RATIO = 0.05  # relative error of a follower's ratio
POINTS = 1000  # points per part for the mean displacement


def displacement(points: Float[np.ndarray, "N 3"], predicted: Joint, true: TrueJoint, size: float) -> float:
    """Compute the mean distance of the true part's points between the poses of the found and the true joint.

    Hinges are opened by 30 degrees, slides by half the true travel, each joint towards its own opening side, so that a wrong
    side adds to the distance.
    A found joint of another type moves by 30 degrees, or half its own travel. If the true joint opens both ways, is continuous,
    or has no known range, the better of both directions counts.
    `size` of the part replaces an unknown travel. `true`: in the frame of the points, with a unit axis.
    """
    true = true if true.range_known else replace(true, limits=None)
    sides = (1, -1) if opens_both_ways(true.limits) else (opening_side(true.limits),)
    return min(_apart(points, predicted, true, side, size) for side in sides)


def _apart(points: Float[np.ndarray, "N 3"], predicted: Joint, true: TrueJoint, side: int, size: float) -> float:
    ours = opening_side(predicted.limits)
    amount = _amount(true, side, size)
    own = amount if same_motion(predicted.type, true.type) else _amount(predicted, ours, size)
    T = joint_transform(true, side * amount) - joint_transform(predicted, ours * own)
    return float(np.linalg.norm(points @ T[:3, :3].T + T[:3, 3], axis=1).mean())


def _amount(joint: Joint | TrueJoint, side: int, size: float) -> float:
    """Return the amount by which a joint is opened [rad or m], without sign."""
    if joint.type is not JointType.PRISMATIC:
        return TURNED
    return TRAVEL * (size if joint.limits is None else side * joint.limits[0 if side < 0 else 1])


def part_ious(
    predicted: Int[np.ndarray, " F"], true: Int[np.ndarray, " F"], areas: Float[np.ndarray, " F"]
) -> Float[np.ndarray, "P T"]:
    """Compute the IoU by surface area of predicted (rows) and true parts (columns), including the bases (0)."""
    inside = np.zeros((int(predicted.max()) + 1, int(true.max()) + 1))
    np.add.at(inside, (predicted, true), areas)
    union = inside.sum(1, keepdims=True) + inside.sum(0, keepdims=True) - inside
    return np.divide(inside, union, out=np.zeros_like(inside), where=union > 0)


def match_parts(ious: Float[np.ndarray, "P T"]) -> list[tuple[int, int, float]]:
    """Match movable parts (predicted, true, IoU) to maximize the sum of IoUs (Hungarian); omit pairs without overlap."""
    rows, columns = linear_sum_assignment(-ious[1:, 1:])
    return [
        (int(r) + 1, int(c) + 1, float(ious[r + 1, c + 1]))
        for r, c in zip(rows, columns, strict=True)
        if ious[r + 1, c + 1] > 0
    ]


def angle_error(a: Vector, b: Vector) -> float:
    """Compute the angle between two axes [deg], ignoring their signs."""
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), abs(float(a @ b)))))


def line_distance(p: Vector, a: Vector, q: Vector, b: Vector, center: Vector | None = None) -> float:
    """Compute the distance of the lines p + s a and q + t b.

    For nearly parallel lines: the mean of their distances from each other, level with `center` (None: between p and q).
    """
    normal = np.cross(a, b)
    sine = float(np.linalg.norm(normal))
    if sine < np.sin(NEARLY_PARALLEL):
        at = (p + q) / 2 if center is None else center
        return (distance_at(at, p, a, q, b) + distance_at(at, q, b, p, a)) / 2
    return abs(float((q - p) @ normal)) / sine


def point_distance(point: Vector, q: Vector, b: Vector) -> float:
    """Compute the distance of a point from the line q + t b."""
    return float(np.linalg.norm(np.cross(point - q, b)))


def distance_at(center: Vector, p: Vector, a: Vector, q: Vector, b: Vector) -> float:
    """Compute the distance of the line p + s a from the true line q + t b, at the point of the true line level with `center`.

    Unlike the distance of the lines, it detects an axis that only crosses the true one somewhere.
    """
    return point_distance(q + float((center - q) @ b) * b, p, a)


def range_iou(a: Limits, b: Limits) -> float:
    """Compute the overlap of two ranges over their union; 1 if both are endless."""
    if a is None or b is None:
        return float(a is None and b is None)
    overlap = max(0.0, min(a[1], b[1]) - max(a[0], b[0]))
    union = max(a[1], b[1]) - min(a[0], b[0])
    return overlap / union if union > 0 else 1.0


def same_motion(a: JointType, b: JointType) -> bool:
    """Return whether two types have the same kind of motion: continuous joints rotate as revolute ones do."""
    turning = (JointType.REVOLUTE, JointType.CONTINUOUS, JointType.SCREW)
    return a is b or (a in turning and b in turning)


def opening_side(limits: Limits) -> int:
    """Return the opening direction of a joint along its axis, 1 or -1: the side with the larger range, or positive."""
    return -1 if limits is not None and limits[0] + limits[1] < 0 else 1


def opens_both_ways(limits: Limits) -> bool:
    """Return whether neither side of the range is the opening one, as for continuous joints."""
    return limits is None or min(limits[1], -limits[0]) > BOTH_WAYS * max(limits[1], -limits[0])


@dataclass(frozen=True)
class JointScore:
    """Score of one true joint. If no part was found, the fields that need one are None. Lengths in half diagonals."""

    part: str
    iou: float
    type_true: JointType
    type_found: JointType | None = None
    angle: float | None = None  # [deg], ignoring the sign of the axis
    line_distance: float | None = None  # distance of the two axes; None unless both joints rotate
    at_part: float | None = None  # distance of the found axis from the true one, level with the part
    displacement: float | None = None  # mean distance of the part's points from their true positions, half open
    opens_right: bool | None = None  # None for a continuous joint, or if the range is unknown
    range_iou: float | None = None  # None if the range is unknown
    parent_right: bool | None = None
    confidence: float | None = None  # reported by the found joint
    part_size: float = 0.0  # diagonal of the true part
    origin: float | None = None  # distance of the found joint's origin from the true axis; None unless both joints rotate
    range_known: bool = True  # if False, neither opening side nor range is scored
    found: str = field(default="", compare=False)  # name of the found part

    @property
    def type_right(self) -> bool:
        """Whether the joint was found and has the right kind of motion."""
        return self.type_found is not None and same_motion(self.type_true, self.type_found)

    @property
    def right(self) -> bool:
        """Whether a user need not correct the joint but for its limits.

        Right type, axis within 10 degrees and, level with the part, within .1 of half the diagonal, and it opens to the true
        side.
        """
        line = self.type_true is JointType.PRISMATIC or (self.at_part is not None and self.at_part <= RIGHT_PLACE)
        turned = self.angle is not None and self.angle <= RIGHT_ANGLE
        return self.type_right and turned and line and self.opens_right is not False


@dataclass(frozen=True)
class FoundJoint:
    """A joint of the result: the confidences of its part and of the joint, and its other articulations.

    true: name of the true part that it moves, "" for none; right: whether it needs no correction but for its limits; weights:
    of its articulations, its own first; true_one: which of these is right, None if none is.
    """

    name: str
    part_confidence: float
    confidence: float
    true: str = ""
    right: bool = False
    weights: tuple[float, ...] = ()
    true_one: int | None = None


@dataclass(frozen=True)
class FollowerScore:
    """Counts of followers: the true ones, those that are coupled with their true leader, those of them with the right ratio
    (or one that is not known), and those of the result that are coupled with nothing in the truth.
    """

    true: int = 0
    found: int = 0
    right: int = 0
    invented: int = 0


@dataclass(frozen=True)
class ObjectScore:
    """Score of one object: its joints, and the counts of predicted, true and matched parts (IoU of at least 0.5)."""

    name: str
    joints: tuple[JointScore, ...]
    predicted: int
    true: int
    matched: int
    part_miou: float = 1.0  # mean over the true movable parts of the IoU with the matched part; 0 if unmatched
    tree_right: bool = True  # all true joints were found, no others, each with the right parent
    rest: ParticulateMetrics | None = None
    posed: ParticulateMetrics | None = None  # mean over poses along the range
    executable: bool | None = None  # None if not tested
    faults: tuple[str, ...] = ()  # of joints that were driven
    opened: ParticulateMetrics | None = None  # at the upper ends of all ranges
    found: tuple[FoundJoint, ...] = ()  # all joints of the result that move
    followers: FollowerScore = field(default_factory=FollowerScore)

    @property
    def f1(self) -> float:
        """F1 score of the movable parts at IoU .5; 1 if nothing moves and nothing was found."""
        return 2 * self.matched / (self.predicted + self.true) if self.predicted + self.true else 1.0


def score(sample: EvalSample, segmentation: Segmentation, joints: tuple[Joint, ...]) -> ObjectScore:
    """Compare the result on the sample's mesh with the ground truth."""
    truth = sample.truth
    pairs = match_parts(part_ious(segmentation.face_part, sample.labels, sample.mesh.face_areas))
    by_child = {j.child: j for j in joints}
    matched = {truth.parts[t].name: (segmentation.parts[p].name, iou) for p, t, iou in pairs}
    counterparts = {true: part for true, (part, iou) in matched.items() if iou >= MIN_MATCH_IOU}
    parents = {truth.parts[0].name: segmentation.parts[0].name, **counterparts}
    scores = []
    for joint in truth.joints:
        own = by_child.get(counterparts.get(joint.child, ""))
        iou = matched.get(joint.child, ("", 0.0))[1]
        scores.append(_joint(sample, joint, own, iou, parents.get(joint.parent)))
    movable, predicted = len(truth.parts) - 1, len(segmentation.parts) - 1
    alike = particulate_metrics(sample, segmentation, joints)
    return ObjectScore(
        name=truth.name,
        joints=tuple(scores),
        predicted=predicted,
        true=movable,
        matched=len(counterparts),
        part_miou=sum(iou for _, _, iou in pairs) / movable if movable else 1.0,
        tree_right=len(counterparts) == movable == predicted and all(j.parent_right for j in scores),
        rest=alike.rest,
        posed=alike.posed,
        opened=alike.opened,
        found=tuple(_found(sample, segmentation, joint, counterparts) for joint in joints if joint.type is not JointType.FIXED),
        followers=_followers(sample, joints, counterparts),
    )


def _followers(sample: EvalSample, joints: tuple[Joint, ...], counterparts: Mapping[str, str]) -> FollowerScore:
    """Score what follows what. counterparts: found part of each true one."""
    true = {j.child: sample.joint(j) for j in sample.truth.joints}
    ours, led = {j.child: j for j in joints}, leaders(joints)
    ways = {j.child: led.get(j.name, Mimic(j.name)) for j in joints}
    coupled = right = 0
    of_true = {own: name for name, own in counterparts.items()}
    for name, joint in true.items():
        if joint.follows is None:
            continue
        own, lead = (counterparts.get(n, "") for n in (name, joint.follows.leader))
        if own not in ours or lead not in ours or own == lead or ways[own].joint != ways[lead].joint:
            continue
        sign = np.sign(ours[own].axis @ joint.axis) * np.sign(ours[lead].axis @ true[joint.follows.leader].axis)
        ratio, coupled = sign * ways[own].ratio / ways[lead].ratio, coupled + 1
        right += joint.follows.ratio is None or bool(abs(ratio / joint.follows.ratio - 1) < RIGHT_RATIO)
    group = {name: _group(name, true) for name in true}
    names = {j.name: of_true.get(j.child, "") for j in joints}
    invented = sum(group.get(names[n], n) != group.get(names[way.joint], way.joint) for n, way in led.items())
    return FollowerScore(sum(j.follows is not None for j in true.values()), coupled, right, invented)


def _group(name: str, joints: Mapping[str, TrueJoint]) -> str:
    """Return the part at the end of the chain of leaders of a part, itself if it follows none."""
    while (follows := joints[name].follows) is not None and follows.leader:
        name = follows.leader
    return name


def _found(sample: EvalSample, segmentation: Segmentation, joint: Joint, counterparts: Mapping[str, str]) -> FoundJoint:
    """Score a joint of the result and its other articulations. counterparts: found part of each true one."""
    part = next(p for p in segmentation.parts if p.name == joint.child)
    name = next((true for true, own in counterparts.items() if own == joint.child), "")
    known = next((j for j in sample.truth.joints if j.child == name), None)
    scores = [] if known is None else [_joint(sample, known, own, 1.0, None) for own in (joint, *joint.others)]
    true_one = next((k for k, own in enumerate(scores) if own.right), None)
    weights = (joint.confidence, *(other.confidence for other in joint.others))
    return FoundJoint(joint.child, part.confidence, joint.confidence, name, true_one == 0, weights, true_one)


def failed(truth: GroundTruth) -> ObjectScore:
    """Return the score of an object without a result: everything is missing."""
    joints = tuple(JointScore(j.child, 0.0, j.type, range_known=j.range_known) for j in truth.joints)
    movable = len(truth.parts) - 1
    return ObjectScore(truth.name, joints, 0, movable, 0, part_miou=0.0 if movable else 1.0, tree_right=False)


def _joint(sample: EvalSample, joint: TrueJoint, predicted: Joint | None, iou: float, parent: str | None) -> JointScore:
    """Score one joint. parent: found part that corresponds to the true joint's parent, None if there is none."""
    true, mesh, unit = sample.joint(joint), sample.mesh, sample.unit
    if joint.freedoms > 1 and predicted is not None and predicted.type in MOVING and not same_motion(true.type, predicted.type):
        true = replace(true, type=predicted.type, limits=None, range_known=False)
    number = next(k for k, p in enumerate(sample.truth.parts) if p.name == joint.child)
    faces = np.flatnonzero(sample.labels == number)
    size = float(np.linalg.norm(np.ptp(mesh.triangles[faces].reshape(-1, 3), axis=0)))
    if predicted is None:
        return JointScore(joint.child, iou, joint.type, part_size=size / unit, range_known=joint.range_known)
    same = same_motion(true.type, predicted.type)
    turning = true.type is not JointType.PRISMATIC and same
    points, center = _points(mesh, faces)
    at = (predicted.origin, predicted.axis, true.origin, true.axis)
    flip = float(predicted.axis @ true.axis) < 0
    ours = predicted.limits if predicted.limits is None or not flip else (-predicted.limits[1], -predicted.limits[0])
    return JointScore(
        part=joint.child,
        iou=iou,
        type_true=true.type,
        type_found=predicted.type,
        angle=angle_error(predicted.axis, true.axis),
        line_distance=line_distance(*at, center) / unit if turning else None,
        at_part=distance_at(center, *at) / unit if turning else None,
        displacement=displacement(points, predicted, true, size) / unit,
        opens_right=_opens_alike(predicted, true),
        range_iou=None if not true.range_known else range_iou(ours, true.limits) if same else 0.0,
        parent_right=predicted.parent == parent,
        confidence=predicted.confidence,
        part_size=size / unit,
        origin=point_distance(predicted.origin, true.origin, true.axis) / unit if turning else None,
        range_known=true.range_known,
        found=predicted.child,
    )


def _points(mesh: Mesh, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Sample points on faces, and return them with the centroid; without area, of the corners."""
    triangles, areas = mesh.triangles[faces], mesh.face_areas[faces]
    if areas.sum() <= 0:
        corners = triangles.reshape(-1, 3)
        return corners, corners.mean(0)
    return sample_surface(triangles, POINTS, 0).points, np.average(triangles.mean(1), axis=0, weights=areas)


def _opens_alike(predicted: Joint, true: TrueJoint) -> bool | None:
    """Return whether both joints open to the same side; None if the true joint is continuous or its range is unknown."""
    if true.limits is None or not true.range_known:
        return None
    if not same_motion(true.type, predicted.type) or predicted.limits is None:
        return False
    way = opening_side(predicted.limits) * opening_side(true.limits) * float(predicted.axis @ true.axis)
    return opens_both_ways(true.limits) or way > 0
