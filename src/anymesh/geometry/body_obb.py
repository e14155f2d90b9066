"""Oriented box of a shape without its protrusions."""

from __future__ import annotations

import numpy as np

from anymesh.geometry.boxes import OrientedBox, box_in_frame
from anymesh.geometry.triangle_set import TriangleSet

SIDE_LEVEL_RATIO = 0.12  # of the surface that faces along an axis, either way: the outermost share is not the level of a side
MAX_PROTRUSION_RATIO = 0.25  # upper bound on the share of the surface that protrudes


def body_obb(shape: TriangleSet) -> OrientedBox:
    """Return the oriented box of a part without protrusions: a small share of its surface, narrower than the part."""
    frame = shape.box.axes
    local = shape.samples.points @ frame.T
    facing = np.abs(shape.samples.normals @ frame.T) > 0.9
    corners = shape.corners @ frame.T
    low, high = corners.min(0), corners.max(0)
    tolerance = 0.01 * shape.box.diagonal
    for axis in range(3):
        for sign, edge in ((1.0, high), (-1.0, low)):
            at = np.sort(sign * local[facing[:, axis], axis])
            if len(at) < 0.02 * len(local) or len(at) < 3:
                continue
            level = at[-1 - int(SIDE_LEVEL_RATIO * len(at))]
            out = sign * local[:, axis] > level + tolerance / 2
            if level < sign * edge[axis] - tolerance and _protrudes(local, out, axis):
                edge[axis] = sign * level
    if (high - low < 1e-9).any():
        return shape.box
    ends = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    return box_in_frame(ends @ frame, frame)


def _protrudes(local: np.ndarray, beyond: np.ndarray, axis: int) -> bool:
    """Return whether the samples beyond a level are a protrusion: few, and narrower than the part in one direction."""
    if not 0 < beyond.mean() < MAX_PROTRUSION_RATIO:
        return False
    others = [k for k in range(3) if k != axis]
    span = np.ptp(local[beyond][:, others], axis=0) / np.maximum(np.ptp(local[:, others], axis=0), 1e-12)
    return bool(span.min() < 0.6)
