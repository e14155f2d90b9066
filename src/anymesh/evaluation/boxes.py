"""Overlap of boxes, axis-aligned or rotated."""

from __future__ import annotations

import itertools

import numpy as np
from jaxtyping import Float
from scipy.stats import qmc

THIN = 1e-3  # minimum thickness of a box, if the object's longest side is 1
DEPTH = 12  # 2 ** DEPTH points per box to estimate the overlap of rotated boxes
Box = Float[np.ndarray, "2 3"]  # lower and upper corner


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
    return float(np.prod(np.ptp(np.concatenate([_corners(a) @ T[:3, :3].T + T[:3, 3], b]), axis=0)))


def _common(a: Box, b: Box) -> float:
    return float(np.prod(np.clip(np.minimum(a[1], b[1]) - np.maximum(a[0], b[0]), 0, None)))


def _volume(box: Box) -> float:
    return float(np.prod(box[1] - box[0]))


def _corners(box: Box) -> Float[np.ndarray, "8 3"]:
    return np.array([[box[i, 0], box[j, 1], box[k, 2]] for i, j, k in itertools.product((0, 1), repeat=3)])


def _inside(a: Box, T: Float[np.ndarray, "4 4"], b: Box) -> float:
    """Estimate the share of box a, moved by T, that lies in box b."""
    points = (a[0] + _UNIT * (a[1] - a[0])) @ T[:3, :3].T + T[:3, 3]
    return float(np.all((points >= b[0]) & (points <= b[1]), axis=1).mean())


_UNIT = qmc.Sobol(3, scramble=False).random_base2(DEPTH) + 0.5 ** (DEPTH + 1)  # evenly spread in the unit cube
