"""Candidate points of a hinge, and the motions that picked points, normals and arrows stand for (paper, 3.3).

Candidates are clusters of the connecting area, superpoints if the hinge is hidden, and axes from the part's own shape, which
complement those of `candidate_motions.propose`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from jaxtyping import Float
from scipy.spatial import KDTree

from anymesh.articulation.candidate_motions import CONTACT_RATIO, ProposedMotion, Role, distinct, hinge_about
from anymesh.config import ALONG_COSINE
from anymesh.geometry.circles import MIN_CIRCLE_ROUNDNESS, outline_about
from anymesh.geometry.superpoints import superpoints
from anymesh.geometry.surface import ObjectShape
from anymesh.geometry.triangle_set import SurfacePoints, TriangleSet
from anymesh.motion.part_context import PartContext
from anymesh.prompted.grounding.cloud import COLOR_WEIGHT, MIN_SUPERPOINT_POINTS, NEIGHBOURS, STRENGTH
from anymesh.prompted.pictures.drawing import labels_apart
from anymesh.types import JointType, Motion

Project = Callable[[Float[np.ndarray, "n 3"]], Float[np.ndarray, "n d"]]  # points [m] to x and y [px] in each picture shown
MAX_POINTS = 20  # maximum number of candidate points, and of k-means clusters
MIN_LABEL_DISTANCE = 35.0  # [px] minimum distance between the numbers of candidate points
MAX_CONTACT_POINTS = 4000  # maximum number of points of a connecting area for clustering
VIEW_POINTS = 100  # about how many points of a contact choose the views
TRIALS = 200  # planes tried by RANSAC
MAX_CIRCLES = 4  # round patches per part, the largest first; and as many in contact, as a pin is small
MAX_PATCHES = 40  # patches examined, the largest first
# roles of axes that the shape of a part gives
CENTRAL: tuple[Role, ...] = ("round", "center", "hub", "circle", "pivot", "pin", "two_pivot", "barrel")
MAX_DISTINCT_COSINE = 0.98  # maximum cosine between two axes through the contact
MAX_OBJECT_COSINE = float(np.cos(np.deg2rad(3)))  # an axis of the object nearer to one of them is not tried; an estimate
MIN_POINTS = 24  # minimum number of points of a contact ring


def cluster_points(contact: Float[np.ndarray, "n 3"], project: Project, most: int = MAX_POINTS) -> Float[np.ndarray, "k 3"]:
    """Return the centers of the connecting area's clusters, as many as fit in the picture without overlapping numbers."""
    from scipy.cluster.vq import kmeans2  # import on use: it takes 0.1 s, and only questions to models need it

    points = contact[:: max(1, len(contact) // MAX_CONTACT_POINTS)]
    order = _farthest(points, min(most, len(points)))
    best = points.mean(0)[None]
    for k in range(2, len(order) + 1):
        centres, label = kmeans2(points, points[order[:k]], iter=20, minit="matrix", missing="warn")
        if len(np.unique(label)) == k and labels_apart(project(centres), MIN_LABEL_DISTANCE):
            best = centres
    return best


def axis_points(
    context: PartContext,
    axes: Sequence[Motion],
    project: Project,
    most: int = MAX_POINTS,
    ends: Sequence[tuple[Motion, int]] = (),
) -> tuple[Float[np.ndarray, "k 3"], Float[np.ndarray, "k 3"]]:
    """Return the points where axes leave the part on its outer side, and the directions of these axes.

    Only axes that enter the surface are used, up to half of the points. If the numbers of two would overlap, the first is kept.

    ends: axes in any direction, of which the outer end (1) or both ends (2) are added.
    """
    points, directions = np.zeros((0, 3)), np.zeros((0, 3))
    for motion, count in [*((m, 0) for m in axes), *ends]:
        outward = float(motion.axis @ context.opening_direction)
        if not count and (abs(outward) < ALONG_COSINE or len(points) >= most // 2):
            continue
        along = (context.part.corners - motion.origin) @ motion.axis
        for reach in (along.max(), along.min())[:: 1 if outward >= 0 else -1][: max(count, 1)]:
            more = np.concatenate([points, (motion.origin + reach * motion.axis)[None]])
            if labels_apart(project(more), MIN_LABEL_DISTANCE / 2):
                points, directions = more, np.concatenate([directions, motion.axis[None]])
    return points, directions


def hinge_candidates(context: PartContext, pins: Sequence[Motion]) -> Float[np.ndarray, "k 3"]:
    """Return points [m] that views of a part's hinge should show: some of its contact, and the ends of axes of round parts."""
    contact, corners = context.contact, context.part.corners
    along = [(m, (corners - m.origin) @ m.axis) for m in pins]
    ends = [m.origin + reach * m.axis for m, on in along for reach in (on.min(), on.max())]
    return np.concatenate([contact[:: max(1, len(contact) // VIEW_POINTS)], np.array(ends).reshape(-1, 3)])


def superpoint_centres(points: SurfacePoints, colors: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "s 3"]:
    """Return the sample nearest to the center of each superpoint of a part, the largest superpoint first.

    colors: 0..1, one per sample.
    """
    count = len(points)
    nearest = KDTree(points.points).query(points.points, range(1, min(NEIGHBOURS + 1, count) + 1), workers=-1)[1]
    neighbours = nearest[:, 1:]
    edges = np.stack([np.repeat(np.arange(count), neighbours.shape[1]), neighbours.reshape(-1)], 1)
    signal = np.concatenate([points.normals, COLOR_WEIGHT * colors], 1)
    label = superpoints(signal, np.ones(count), edges, np.ones(len(edges)), STRENGTH)
    size = np.bincount(label)
    centres = []
    for s in np.argsort(-size, kind="stable"):
        if size[s] >= min(MIN_SUPERPOINT_POINTS, count):
            mine = points.points[label == s]
            centres.append(mine[np.linalg.norm(mine - mine.mean(0), axis=1).argmin()])
    return np.array(centres).reshape(-1, 3)


def with_more(
    first: Float[np.ndarray, "k 3"], more: Float[np.ndarray, "s 3"], project: Project, most: int = MAX_POINTS
) -> Float[np.ndarray, "m 3"]:
    """Return some of the first points, and as many others as fit without overlapping numbers, in their order.

    The first points take at most half of the places.
    """
    few = first[_farthest(first, min(len(first), most // 2))] if len(first) else first
    return followed(few, more, project, most)


def followed(
    first: Float[np.ndarray, "k 3"], more: Float[np.ndarray, "s 3"], project: Project, most: int = MAX_POINTS
) -> Float[np.ndarray, "m 3"]:
    """Return all first points, and as many others as fit without overlapping numbers, in their order."""
    chosen = list(first)
    for point in more:
        if len(chosen) < most and labels_apart(project(np.array([*chosen, point])), MIN_LABEL_DISTANCE):
            chosen.append(point)
    return np.array(chosen)


def _farthest(points: np.ndarray, count: int) -> np.ndarray:
    """Return indices of points far from each other, in a fixed order that starts with the point farthest from the center."""
    off = np.linalg.norm(points - points.mean(0), axis=1)
    chosen = [int(off.argmax())]
    nearest = np.linalg.norm(points - points[chosen[0]], axis=1)
    while len(chosen) < count and nearest.max() > 0:
        chosen.append(int(nearest.argmax()))
        nearest = np.minimum(nearest, np.linalg.norm(points - points[chosen[-1]], axis=1))
    return np.array(chosen)


def plane_normal(points: Float[np.ndarray, "n 3"], tolerance: float, seed: int) -> Float[np.ndarray, " 3"]:
    """Fit a plane to points by RANSAC with `tolerance` [m]; return its unit normal."""
    rng = np.random.default_rng(seed)
    best, most = np.arange(len(points)), 2
    for trio in rng.integers(0, len(points), (TRIALS, 3)) if len(points) > 3 else ():
        a, b, c = points[trio]
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal)
        if length < 1e-12:
            continue
        on = np.flatnonzero(np.abs((points - a) @ (normal / length)) < tolerance)
        if len(on) > most:
            best, most = on, len(on)
    mine = points[best]
    normal = np.linalg.svd(mine - mine.mean(0), full_matrices=True)[2][2]
    return normal / np.linalg.norm(normal)


def hinge(
    picked: Float[np.ndarray, "k 3"], normal: Float[np.ndarray, " 3"], axis: Float[np.ndarray, " 3"] | None = None
) -> Motion:
    """Return the line through two or more points, or through one point along its axis.

    axis: axis of a single picked point. If it is None or NaN, the normal of the connecting area's plane is used.
    """
    if len(picked) == 1:
        own = axis is not None and not np.isnan(axis).any()
        along, source = (axis, "axis at the point picked") if own else (normal, "normal at the point picked")
        return Motion(JointType.REVOLUTE, along / np.linalg.norm(along), picked[0], source)
    middle = picked.mean(0)
    axis = np.linalg.svd(picked - middle, full_matrices=False)[2][0]
    return Motion(JointType.REVOLUTE, axis / np.linalg.norm(axis), middle, f"line through the {len(picked)} points picked")


def surface_directions(context: PartContext) -> Float[np.ndarray, "4 3"]:
    """Return both directions along the two sides of the part that are parallel to the surface."""
    a, b = (context.body_obb.axes[k] for k in context.face_axes)
    return np.stack([a, -a, b, -b])


def prismatic(direction: Float[np.ndarray, " 3"], context: PartContext, source: str) -> Motion:
    """Return the prismatic motion of a part along a direction."""
    return Motion(JointType.PRISMATIC, direction / np.linalg.norm(direction), context.part.box.center, source)


def round_patches(whole: ObjectShape, part: TriangleSet, parent: TriangleSet) -> tuple[tuple[Motion, ...], tuple[Motion, ...]]:
    """Return the axes of round patches of a part, and of round patches of its parent that it encloses or sits on (pins).

    The first ones are those of the largest; the second ones those of the largest in contact with the other, of any size.
    """
    circles: list[tuple[float, bool, Motion]] = []
    reach = CONTACT_RATIO * part.box.diagonal
    low, high = part.bounds
    for own, shape in ((True, part), (False, parent)):
        numbers, count = np.unique(whole.patch[shape.faces], return_counts=True)
        if own and len(numbers) < 2:
            continue
        for number in numbers[np.argsort(-count, kind="stable")][:MAX_PATCHES]:
            corners = shape.triangles[whole.patch[shape.faces] == number].reshape(-1, 3)
            meets = (corners.max(0) >= low).all() and (corners.min(0) <= high).all()
            if len(corners) < MIN_POINTS or not (own or meets):
                continue
            patch = shape.take(np.flatnonzero(whole.patch[shape.faces] == number))
            if own or patch.box.diagonal < part.box.diagonal:
                points = np.concatenate([corners, patch.samples.points])
                outlines = [outline_about(points, axis) for axis in patch.box.axes]
                best = max(outlines, key=lambda o: o.roundness)
                if best.roundness > MIN_CIRCLE_ROUNDNESS:
                    held = bool((parent if own else part).nearest(points[::4])[0].min() <= reach)
                    circles.append((best.radius, held, hinge_about(best.axis, best.center, "axis of a round patch")))
    circles.sort(key=lambda item: -item[0])
    pins = distinct([("circle", motion) for _, held, motion in circles if held], part.box.diagonal)
    return tuple(motion for *_, motion in circles[:MAX_CIRCLES]), tuple(motion for _, motion in pins[:MAX_CIRCLES])


def pivots(
    context: PartContext, normal: Float[np.ndarray, " 3"], frame: Float[np.ndarray, "3 3"] | None = None
) -> list[ProposedMotion]:
    """Return lines through the center of the contact, and the axis of its ring.

    normal: unit normal of the contact's plane; frame: rows are the object's axes, which a turned part does not have.
    """
    contact = context.contact
    middle = (contact.min(0) + contact.max(0)) / 2
    directions: list[np.ndarray] = []
    for d in (normal, context.opening_direction, *context.body_obb.axes):
        if all(abs(float(d @ other)) < MAX_DISTINCT_COSINE for other in directions):
            directions.append(d)
    others = [d for d in (() if frame is None else frame) if np.abs(np.array(directions) @ d).max() < MAX_OBJECT_COSINE]
    lines: list[ProposedMotion] = []
    if len(contact) >= MIN_POINTS:
        rings = [outline_about(contact, d) for d in directions]
        best = max(rings, key=lambda o: o.roundness)
        if best.roundness > MIN_CIRCLE_ROUNDNESS:
            lines.append(("hub", hinge_about(best.axis, best.center, "axis of the ring where it is held")))
    lines += [("pivot", hinge_about(d, middle, "line through the middle of the contact")) for d in directions]
    lines.append(("pivot", hinge_about(normal, context.body_obb.center, "middle line along the contact's normal")))
    return lines + [("pivot", hinge_about(d, middle, "axis of the object through the contact")) for d in others]
