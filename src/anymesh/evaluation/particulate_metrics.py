"""Similarity of two articulated objects at rest and in motion: the measures of Particulate (Li et al., arXiv 2512.11798).

As in the authors' released evaluation, lengths are relative to the object's longest side. Parts, including the base, are paired
one to one with the smallest sum of distances of their centroids (Hungarian). Each measure is the average of its mean over the
found parts and its mean over the true parts, so that surplus and missing parts cost the same.

- gIoU: of the parts' boxes (axis-aligned at rest, moved with the part), -1 for an unpaired part.
- mIoU: IoU of axis-aligned boxes, computed at each pose; 0 if unpaired.
- Chamfer: mean squared distance of a part's points to the nearest of its partner's, summed over both directions; half the
  object's diagonal if unpaired.

Joints take five states, evenly from lower to upper limit, all together. `posed` is the mean over the states, `opened` the last
state, which is the one in the authors' tables.

Our choices, where the original is unspecified or misleading:
- The enclosing box of gIoU for two moved boxes is aligned with either of them in their moved poses. The original encloses the
  boxes at rest, so that a door with a wrong motion scores up to 1.
- The IoU of rotated boxes is computed at fixed points of both boxes instead of random ones.
- Both objects are the same mesh and are sampled at the same points, so a perfect result has distance 0.
- Boxes enclose the parts' corners, not points on them, and are at least THIN thick, so that a sheet equals itself.
- Continuous joints make half a turn. Without known ranges, motion is not compared.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.optimize import linear_sum_assignment
from scipy.spatial import ConvexHull, KDTree, QhullError
from scipy.stats import qmc

from anymesh.evaluation.ground_truth import EvalSample, TrueJoint
from anymesh.geometry.kinematics import joint_motion
from anymesh.geometry.triangle_set import sample_surface
from anymesh.types import Brief, Joint, JointType, Mesh, Segmentation

THIN = 1e-3  # minimum thickness of a box, if the object's longest side is 1
DEPTH = 12  # 2 ** DEPTH points per box to estimate the overlap of rotated boxes
Box = Float[np.ndarray, "2 3"]  # lower and upper corner
_UNIT = qmc.Sobol(3, scramble=False).random_base2(DEPTH) + 0.5 ** (DEPTH + 1)  # evenly spread in the unit cube
POINTS = 10_000  # number of surface points for distances
FEW = 16  # minimum number of points on each part
STATES = 5
ENDLESS = (0.0, np.pi)  # [rad] range used for continuous joints


def as_box(points: Float[np.ndarray, "n 3"]) -> Box:
    """Return the axis-aligned box of points, at least `THIN` thick."""
    low, high = points.min(0), points.max(0)
    grow = np.maximum(THIN - (high - low), 0) / 2
    return np.array([low - grow, high + grow])


def box_iou(a: Box, b: Box) -> float:
    """Compute the intersection over union of two axis-aligned boxes."""
    common = _common(a, b)
    return common / (_volume(a) + _volume(b) - common)


def box_giou(a: Box, A: Float[np.ndarray, "4 4"], b: Box, B: Float[np.ndarray, "4 4"]) -> float:
    """Compute the generalized IoU (Rezatofighi et al. 2019) of rigidly moved boxes: -1 (far apart) to 1 (equal).

    The enclosing box is aligned with a or b, whichever gives the smaller one. The overlap of relatively rotated boxes is
    accurate to about .01.
    """
    there, back = np.linalg.inv(B) @ A, np.linalg.inv(A) @ B
    if np.allclose(there[:3, :3], np.eye(3), atol=1e-9):
        common = _common(a + there[:3, 3], b)
    else:
        common = (_volume(a) * _inside(a, there, b) + _volume(b) * _inside(b, back, a)) / 2
    union = _volume(a) + _volume(b) - common
    hull = max(min(_hull(a, there, b), _hull(b, back, a)), union)
    return common / union - (hull - union) / hull


def _hull(a: Box, T: Float[np.ndarray, "4 4"], b: Box) -> float:
    """Compute the volume of the box aligned with b that encloses b, and a moved by T."""
    return float(np.prod(np.ptp(np.concatenate([_box_corners(a) @ T[:3, :3].T + T[:3, 3], b]), axis=0)))


def _common(a: Box, b: Box) -> float:
    return float(np.prod(np.clip(np.minimum(a[1], b[1]) - np.maximum(a[0], b[0]), 0, None)))


def _volume(box: Box) -> float:
    return float(np.prod(box[1] - box[0]))


def _box_corners(box: Box) -> Float[np.ndarray, "8 3"]:
    return np.array([[box[i, 0], box[j, 1], box[k, 2]] for i, j, k in itertools.product((0, 1), repeat=3)])


def _inside(a: Box, T: Float[np.ndarray, "4 4"], b: Box) -> float:
    """Estimate the share of box a, moved by T, that lies in box b."""
    points = (a[0] + _UNIT * (a[1] - a[0])) @ T[:3, :3].T + T[:3, 3]
    return float(np.all((points >= b[0]) & (points <= b[1]), axis=1).mean())


@dataclass(frozen=True)
class ParticulateMetrics:
    """Similarity of two sets of parts: gIoU of their boxes (-1..1), IoU of their boxes, Chamfer distance."""

    giou: float
    miou: float
    chamfer: float


@dataclass(frozen=True)
class PoseMetrics:
    """Metrics by pose. opened: at the upper ends of all ranges; posed, opened: None if the true ranges are unknown."""

    rest: ParticulateMetrics
    posed: ParticulateMetrics | None
    opened: ParticulateMetrics | None


@dataclass(frozen=True, eq=False)
class _Side(Brief):
    """One of the two objects. corners, points: of each part at rest; T: of each part at each state."""

    corners: list[Float[np.ndarray, "_ 3"]]
    points: list[Float[np.ndarray, "_ 3"]]
    T: Float[np.ndarray, "S P 4 4"]

    @cached_property
    def trees(self) -> list[KDTree]:
        return [KDTree(p) for p in self.points]

    @cached_property
    def centroids(self) -> Float[np.ndarray, "P 3"]:
        return np.array([p.mean(0) for p in self.points])

    @cached_property
    def boxes(self) -> Float[np.ndarray, "P 2 3"]:
        return np.array([as_box(c) for c in self.corners])


def particulate_metrics(sample: EvalSample, segmentation: Segmentation, joints: tuple[Joint, ...]) -> PoseMetrics:
    """Compare the found parts and joints of the sample's mesh with the true ones."""
    mesh, truth = sample.mesh, sample.truth
    size = float(mesh.extents.max())
    true_joints = [sample.joint(j) for j in truth.joints]
    labels = (segmentation.face_part, sample.labels)
    names = [[p.name for p in segmentation.parts], [p.name for p in truth.parts]]
    at = _points(mesh, labels)
    predicted, true = (
        _side(mesh, label, at, _poses(name, joint), size)
        for label, name, joint in zip(labels, names, (joints, true_joints), strict=True)
    )
    cost = np.linalg.norm(predicted.centroids[:, None] - true.centroids[None], axis=2)
    pairs = [(int(p), int(t)) for p, t in zip(*linear_sum_assignment(cost), strict=True)]
    lost = mesh.diagonal / 2 / size
    every = [_at_state(predicted, true, pairs, state, lost) for state in range(STATES + 1)]
    if not all(j.range_known for j in truth.joints):
        return PoseMetrics(every[0], None, None)
    return PoseMetrics(every[0], _mean(every[1:]), every[-1])


def _points(mesh: Mesh, labels: tuple[Int[np.ndarray, " F"], ...]) -> tuple[np.ndarray, np.ndarray]:
    """Sample points (n, 3) on the surface, with their faces; every part of either side gets some."""
    spread = sample_surface(mesh.triangles, POINTS, 0)
    points, faces = [spread.points], [spread.faces]
    for label in labels:
        count = np.bincount(label[spread.faces], minlength=int(label.max()) + 1)
        for part in np.flatnonzero(count < FEW):
            mine = np.flatnonzero(label == part)
            few = mine[np.argsort(-mesh.face_areas[mine], kind="stable")[:FEW]]
            points.append(mesh.triangles[few].mean(1))
            faces.append(few)
    return np.concatenate(points), np.concatenate(faces)


def _side(mesh: Mesh, labels: np.ndarray, at: tuple[np.ndarray, np.ndarray], T: np.ndarray, size: float) -> _Side:
    points, faces = at
    T = T.copy()
    T[..., :3, 3] /= size
    parts = range(T.shape[1])
    return _Side(
        [_corners(mesh, labels == k) / size for k in parts],
        [points[labels[faces] == k] / size for k in parts],
        T,
    )


def _corners(mesh: Mesh, faces: Bool[np.ndarray, " F"]) -> Float[np.ndarray, "c 3"]:
    """Return the corners of faces; for solids only those on the convex hull, for speed."""
    used = np.zeros(len(mesh.vertices), bool)
    used[mesh.faces[faces]] = True
    corners = mesh.vertices[used]
    try:
        return corners[ConvexHull(corners).vertices]
    except (QhullError, ValueError):  # flat, or too few
        return corners


def _poses(names: Sequence[str], joints: Sequence[Joint] | Sequence[TrueJoint]) -> Float[np.ndarray, "S P 4 4"]:
    """Return the pose of each part: at rest, then at each state. Parts without a joint are static."""
    by_child = {j.child: j for j in joints}
    shares = np.linspace(0, 1, STATES)
    poses: dict[str, np.ndarray] = {}

    def of(name: str) -> np.ndarray:
        if name not in poses:
            own = np.tile(np.eye(4), (STATES + 1, 1, 1))
            joint = by_child.get(name)
            if joint is not None:
                own[1:] = _moved(joint, shares)
                own = of(joint.parent) @ own
            poses[name] = own
        return poses[name]

    return np.stack([of(n) for n in names], axis=1)


def _moved(joint: Joint | TrueJoint, shares: np.ndarray) -> Float[np.ndarray, "S 4 4"]:
    if joint.type is JointType.FIXED:
        return np.tile(np.eye(4), (len(shares), 1, 1))
    low, high = joint.limits or ENDLESS
    return joint_motion(joint).transforms(low + (high - low) * shares)


def _at_state(predicted: _Side, true: _Side, pairs: list[tuple[int, int]], state: int, lost: float) -> ParticulateMetrics:
    values = np.array([_pair(predicted, true, p, t, state) for p, t in pairs])
    counts = np.array([len(predicted.corners), len(true.corners)])
    nothing = np.array([-1.0, 0.0, lost])
    both = [(values.sum(0) + (count - len(pairs)) * nothing) / count for count in counts]
    return ParticulateMetrics(*(float(v) for v in np.mean(both, axis=0)))


def _pair(predicted: _Side, true: _Side, p: int, t: int, state: int) -> tuple[float, float, float]:
    A, B = predicted.T[state, p], true.T[state, t]
    giou = box_giou(predicted.boxes[p], A, true.boxes[t], B)
    iou = box_iou(as_box(_apply(A, predicted.corners[p])), as_box(_apply(B, true.corners[t])))
    there, back = np.linalg.inv(B) @ A, np.linalg.inv(A) @ B
    forth = true.trees[t].query(_apply(there, predicted.points[p]))[0]
    home = predicted.trees[p].query(_apply(back, true.points[t]))[0]
    return giou, iou, float((forth**2).mean() + (home**2).mean())


def _apply(T: Float[np.ndarray, "4 4"], points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    return points @ T[:3, :3].T + T[:3, 3]


def _mean(values: Sequence[ParticulateMetrics]) -> ParticulateMetrics:
    return ParticulateMetrics(*(float(np.mean([getattr(v, name) for v in values])) for name in ("giou", "miou", "chamfer")))
