"""Oriented box of a shape without its protrusions."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.geometry.boxes import OrientedBox, box_in_frame
from anymesh.geometry.levels import points_above, shares_above
from anymesh.geometry.triangle_set import TriangleSet

SIDE_LEVEL_RATIO = 0.12  # of the surface that faces along an axis, either way: the outermost share is not the level of a side
MAX_PROTRUSION_RATIO = 0.25  # upper bound on the share of the surface that protrudes


def body_obb(shape: TriangleSet) -> OrientedBox:
    """Return the oriented box of a part without protrusions: a small share of its surface, narrower than the part."""
    frame = shape.box.axes
    local, area = shape.triangles @ frame.T, max(shape.area, 1e-300)
    facing = np.abs(shape.normals @ frame.T) > 0.9
    corners = shape.corners @ frame.T
    low, high = corners.min(0), corners.max(0)
    tolerance = 0.01 * shape.box.diagonal
    for axis in range(3):
        for sign, edge in ((1.0, high), (-1.0, low)):
            heights = sign * local[:, :, axis]
            level = _side_level(heights[facing[:, axis]], shape.areas[facing[:, axis]], 0.02 * area)
            if level >= sign * edge[axis] - tolerance:
                continue
            share = float(shape.areas @ shares_above(heights, level + tolerance / 2)) / area
            beyond = points_above(local, heights, level + tolerance / 2)
            if 0 < share < MAX_PROTRUSION_RATIO and _is_narrow(beyond, corners, axis):
                edge[axis] = sign * level
    ends = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    return box_in_frame(ends @ frame, frame)


def _side_level(heights: Float[np.ndarray, "F 3"], areas: Float[np.ndarray, " F"], least: float) -> float:
    """Return the level of the faces that face along an axis, without the outermost; inf if they are smaller than `least`."""
    if areas.sum() <= least:
        return np.inf
    middle = heights.mean(1)
    order = np.argsort(-middle, kind="stable")
    outer = np.cumsum(areas[order])
    return float(middle[order[np.searchsorted(outer, SIDE_LEVEL_RATIO * outer[-1], side="right")]])


def _is_narrow(beyond: Float[np.ndarray, "n 3"], corners: Float[np.ndarray, "m 3"], axis: int) -> bool:
    """Return whether what is beyond a level is narrower than the part in one direction."""
    others = [k for k in range(3) if k != axis]
    span = np.ptp(beyond[:, others], axis=0) / np.maximum(np.ptp(corners[:, others], axis=0), 1e-12)
    return bool(span.min() < 0.6)
