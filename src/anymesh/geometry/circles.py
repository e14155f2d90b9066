"""Fit circles to the outlines of round shapes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from anymesh.types.triangles import cross

BINS = 36
MIN_CIRCLE_ROUNDNESS = 0.8  # minimum roundness of a circle
CHANCE_ROUNDNESS = 0.25  # maximum roundness of the outlines of plates and boxes, of which the roundest is chance
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
    u = cross(axis, helper)
    u /= np.linalg.norm(u)
    v = cross(axis, u)
    flat = np.stack([points @ u, points @ v])
    along = points @ axis
    center = (flat.min(1) + flat.max(1)) / 2
    roundness, radius = 0.0, 0.0
    for _ in range(2):
        x, y = flat - center[:, None]
        r = np.sqrt(x * x + y * y)
        bin_of = np.floor((np.arctan2(y, x) / (2 * np.pi) + 0.5) * BINS).astype(int) % BINS
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
        center, _ = fit_circle(flat[:, _last_per_bin(bin_of, bin_of * (r.max() + 1) + r)[near]].T)
    mid = (along.min() + along.max()) / 2
    return Outline(axis, center[0] * u + center[1] * v + mid * axis, radius, float(along.max() - along.min()), roundness)


def _last_per_bin(bin_of: Int[np.ndarray, " n"], key: Float[np.ndarray, " n"]) -> Int[np.ndarray, " b"]:
    """Return the index of the highest key in each bin, the last one at a tie; -1 for an empty bin."""
    highest = np.full(BINS, -np.inf)
    np.maximum.at(highest, bin_of, key)
    rows = np.flatnonzero(key == highest[bin_of])
    last = np.full(BINS, -1)
    last[bin_of[rows]] = rows  # of equal indices, the last assignment holds
    return last


def roundest(points: Float[np.ndarray, "n 3"], axes: Float[np.ndarray, "k 3"]) -> Outline:
    """Return the roundest outline among those along the given axes; the first one at a tie, and if none is at all round."""
    outlines = [outline_about(points, axis) for axis in axes]
    best = max(outlines, key=lambda o: o.roundness)
    return best if best.roundness > CHANCE_ROUNDNESS else outlines[0]
