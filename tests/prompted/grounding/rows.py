"""Small hand-made clouds, and counts of points in masks."""

from collections.abc import Sequence

import numpy as np

from anymesh.prompted.grounding.cloud import Cloud
from anymesh.prompted.grounding.fuse import Counts


def row_cloud(places: Sequence[float], each: int = 20, diagonal: float = 1.0) -> Cloud:
    """Return a cloud with one superpoint per place on the x axis, of points within 0.02 of it."""
    points = np.zeros((each * len(places), 3))
    points[:, 0] = np.repeat(places, each) + np.tile(np.linspace(-0.02, 0.02, each), len(places))
    superpoint = np.repeat(np.arange(len(places)), each)
    normals = np.tile([0.0, 0, 1], (len(points), 1))
    boxes = np.stack([[points[superpoint == s].min(0), points[superpoint == s].max(0)] for s in range(len(places))])
    colors = np.zeros((len(points), 3), np.uint8)
    none = np.zeros((0, 2), np.int64)
    return Cloud(points, normals, colors, superpoint.copy(), superpoint, none, boxes, diagonal)


def counts_of(top: Sequence[Sequence[int]], labels: Sequence[str], instances: Sequence[int] | None = None) -> Counts:
    """Return the counts of a view from its visible points per (superpoint, mask), without overlapping masks.

    The last column counts points in no mask.
    """
    table = np.array(top)
    box = np.full((len(table), 4), np.inf)
    box[:, 2:] = -np.inf
    for s in np.flatnonzero(table.sum(1)):
        box[s] = [10 * s, 0, 10 * s + 9, 9]
    masks = []
    for m in range(len(labels)):
        mine = np.flatnonzero(table[:, m])
        masks.append([10 * mine.min(), 0, 10 * mine.max() + 9, 9] if len(mine) else [0.0, 0, 0, 0])
    return Counts(
        table.sum(1), table[:, :-1], table, box, np.array(masks, float).reshape(-1, 4), tuple(labels),
        tuple(instances or range(1, len(labels) + 1)),
    )  # fmt: skip
