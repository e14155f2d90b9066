"""Fit circles to the outlines of round shapes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

BINS = 36
ROUND = 0.06  # maximum deviation of a bin's outline radius, relative to the median


@dataclass(frozen=True, eq=False)
class Outline:
    """A shape seen along an axis.

    roundness: 0..1, share of directions in which the outline keeps the median radius.
    """

    axis: Float[np.ndarray, " 3"]
    center: Float[np.ndarray, " 3"]  # on the axis, at half the height [m]
    radius: float  # [m]
    height: float  # extent along the axis [m]
    roundness: float


def fit_circle(points: Float[np.ndarray, "n 2"]) -> tuple[Float[np.ndarray, " 2"], float]:
    """Fit a circle by algebraic least squares (Kasa); return center and radius."""
    shift = points.mean(0)
    p = points - shift
    A = np.c_[2 * p, np.ones(len(p))]
    solution = np.linalg.lstsq(A, (p**2).sum(1), rcond=None)[0]
    return solution[:2] + shift, float(np.sqrt(max(solution[2] + solution[:2] @ solution[:2], 0)))


def outline_about(points: Float[np.ndarray, "n 3"], axis: Float[np.ndarray, " 3"]) -> Outline:
    """Return the outline of points along `axis`: the largest radius in each of 36 directions about the fitted center."""
    helper = np.eye(3)[np.abs(axis).argmin()]
    u = np.cross(axis, helper)
    u /= np.linalg.norm(u)
    v = np.cross(axis, u)
    flat = np.c_[points @ u, points @ v]
    along = points @ axis
    center = (flat.min(0) + flat.max(0)) / 2
    roundness, radius = 0.0, 0.0
    for _ in range(2):
        offset = flat - center
        r = np.linalg.norm(offset, axis=1)
        bin_of = np.floor((np.arctan2(offset[:, 1], offset[:, 0]) / (2 * np.pi) + 0.5) * BINS).astype(int) % BINS
        largest = np.full(BINS, -1.0)
        np.maximum.at(largest, bin_of, r)
        filled = largest >= 0
        if filled.sum() < 6:
            break
        radius = float(np.median(largest[filled]))
        near = np.abs(largest - radius) <= ROUND * radius
        roundness = float(near.sum() / BINS)
        if near.sum() < BINS // 2:
            break
        order = np.argsort(bin_of * (r.max() + 1) + r, kind="stable")
        last = order[np.r_[bin_of[order][1:] != bin_of[order][:-1], True]]
        keep = near[bin_of[last]]
        center, _ = fit_circle(flat[last][keep])
    mid = (along.min() + along.max()) / 2
    return Outline(axis, center[0] * u + center[1] * v + mid * axis, radius, float(along.max() - along.min()), roundness)


def roundest(points: Float[np.ndarray, "n 3"], axes: Float[np.ndarray, "k 3"]) -> Outline:
    """Return the roundest outline among those along the given axes; the first one at a tie."""
    found = [outline_about(points, axis) for axis in axes]
    return max(found, key=lambda o: o.roundness)
