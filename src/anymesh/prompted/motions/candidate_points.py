"""Candidate points of a hinge (paper, 3.3): clusters of the connecting area, and superpoints if the hinge is hidden."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from jaxtyping import Float
from scipy.spatial import KDTree

from anymesh.config import ALONG_COSINE, GroundingConfig, PromptConfig
from anymesh.geometry.superpoints import superpoints
from anymesh.geometry.triangle_set import SurfacePoints
from anymesh.motion.part_context import PartContext
from anymesh.prompted.pictures.points import labels_apart
from anymesh.types import Motion

Project = Callable[[Float[np.ndarray, "n 3"]], Float[np.ndarray, "n 2"]]  # points [m] to pixels of the picture shown
MAX_POINTS = 4000  # maximum number of points of a connecting area for clustering


def cluster_points(contact: Float[np.ndarray, "n 3"], project: Project, config: PromptConfig) -> Float[np.ndarray, "k 3"]:
    """Return the centers of the connecting area's clusters, as many as fit in the picture without overlapping numbers."""
    from scipy.cluster.vq import kmeans2  # import on use: it takes 0.1 s, and only questions to models need it

    points = contact[:: max(1, len(contact) // MAX_POINTS)]
    order = _farthest(points, min(config.most_candidates, len(points)))
    best = points.mean(0)[None]
    for k in range(2, len(order) + 1):
        centres, label = kmeans2(points, points[order[:k]], iter=20, minit="matrix", missing="warn")
        if len(np.unique(label)) == k and labels_apart(project(centres), config.label_apart):
            best = centres
    return best


def axis_points(
    context: PartContext, axes: Sequence[Motion], project: Project, config: PromptConfig
) -> tuple[Float[np.ndarray, "k 3"], Float[np.ndarray, "k 3"]]:
    """Return the points where axes leave the part on its outer side, and the directions of these axes.

    Only axes that enter the surface are used. If the numbers of two would overlap, the first is kept.
    """
    points, directions = np.zeros((0, 3)), np.zeros((0, 3))
    for motion in axes:
        sign = 1.0 if motion.axis @ context.opening_direction >= 0 else -1.0
        if abs(float(motion.axis @ context.opening_direction)) < ALONG_COSINE or len(points) >= config.most_candidates // 2:
            continue
        reach = float(((context.part.corners - motion.origin) @ (sign * motion.axis)).max())
        more = np.concatenate([points, (motion.origin + reach * sign * motion.axis)[None]])
        if labels_apart(project(more), config.label_apart / 2):
            points, directions = more, np.concatenate([directions, motion.axis[None]])
    return points, directions


def superpoint_centres(
    points: SurfacePoints, colors: Float[np.ndarray, "n 3"], config: GroundingConfig
) -> Float[np.ndarray, "s 3"]:
    """Return the sample nearest to the center of each superpoint of a part, the largest superpoint first.

    colors: 0..1, one per sample.
    """
    count = len(points)
    nearest = KDTree(points.points).query(points.points, range(1, min(config.neighbours + 1, count) + 1), workers=-1)[1]
    neighbours = nearest[:, 1:]
    edges = np.stack([np.repeat(np.arange(count), neighbours.shape[1]), neighbours.reshape(-1)], 1)
    signal = np.concatenate([points.normals, config.color_weight * colors], 1)
    label = superpoints(signal, np.ones(count), edges, np.ones(len(edges)), config.strength)
    size = np.bincount(label)
    centres = []
    for s in np.argsort(-size, kind="stable"):
        if size[s] >= min(config.least_points, count):
            mine = points.points[label == s]
            centres.append(mine[np.linalg.norm(mine - mine.mean(0), axis=1).argmin()])
    return np.array(centres).reshape(-1, 3)


def with_more(
    first: Float[np.ndarray, "k 3"], more: Float[np.ndarray, "s 3"], project: Project, config: PromptConfig
) -> Float[np.ndarray, "m 3"]:
    """Return some of the first points, and as many others as fit without overlapping numbers, in their order.

    The first points take at most half of the places.
    """
    few = first[_farthest(first, min(len(first), config.most_candidates // 2))] if len(first) else first
    return followed(few, more, project, config)


def followed(
    first: Float[np.ndarray, "k 3"], more: Float[np.ndarray, "s 3"], project: Project, config: PromptConfig
) -> Float[np.ndarray, "m 3"]:
    """Return all first points, and as many others as fit without overlapping numbers, in their order."""
    chosen = list(first)
    for point in more:
        if len(chosen) < config.most_candidates and labels_apart(project(np.array([*chosen, point])), config.label_apart):
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
