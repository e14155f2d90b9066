"""Fit circles to the outlines of round shapes, and axes of revolution to surfaces.

The normals of a surface of revolution meet its axis or are parallel to it. Such lines belong to a linear line complex: for the
direction a and the moment m of the axis, n . m + (p x n) . a = 0 at every point p with normal n (Pottmann and Wallner,
Computational Line Geometry, 2001). The left side is the speed of p along n in a turn about the axis.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from anymesh.geometry.triangle_set import SurfacePoints, median
from anymesh.types import Brief
from anymesh.types.triangles import cross, crosses

BINS = 36
MIN_CIRCLE_ROUNDNESS = 0.8  # minimum roundness of a circle
CHANCE_ROUNDNESS = 0.25  # maximum roundness of the outlines of plates and boxes, of which the roundest is chance
ROUND = 0.06  # maximum deviation of a bin's outline radius, relative to the median
IN_PLACE = 0.1  # sine of the angle between surface and motion at which a point counts half
MAX_FLAT = 0.95  # cosine from which a normal is parallel to the axis: flat ends do not show where the axis is
MIN_ROUND = 0.03  # share of the points that must turn in place without being on flat ends
MIN_RADIUS = 1e-3  # of half the extent: points are at least this far from an axis
HYPOTHESES = 400  # axes through three normals
NEAR_SHARE = 0.15  # of all points: half of the hypotheses take their normals from the points nearest to the first
REFINED, ROUNDS = 8, 4  # hypotheses that are refined, the best first, and the most rounds of reweighting


@dataclass(frozen=True, eq=False)
class Outline(Brief):
    """A shape seen along an axis. roundness: 0..1, share of directions in which the outline keeps the median radius."""

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
        radius = median(largest[filled])
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
    outlines = list[Outline]()
    for axis in axes:
        outlines.append(outline_about(points, axis))
        if outlines[-1].roundness == 1:
            break
    best = max(outlines, key=lambda o: o.roundness)
    return best if best.roundness > CHANCE_ROUNDNESS else outlines[0]


Axes = tuple[Float[np.ndarray, "k 3"], Float[np.ndarray, "k 3"]]  # unit directions and origins


@dataclass(frozen=True, eq=False)
class Revolution(Brief):
    """An axis of revolution of a part of a surface, as found by `fit_revolution`."""

    axis: Float[np.ndarray, " 3"]
    origin: Float[np.ndarray, " 3"]  # the point of the axis nearest to the middle of the surface [m]
    share: float  # of the surface, as in `share_in_place`


def fit_revolution(surface: SurfacePoints, min_share: float, seed: int = 0) -> Revolution | None:
    """Return the axis about which the largest share of a surface turns in place, None if it is below `min_share`.

    The best axes through three normals are refined by least squares, iteratively reweighted (Cauchy). An axis passes the middle
    of the surface at less than half its extent, and more than flat ends turn in place about it.
    """
    middle = (surface.points.min(0) + surface.points.max(0)) / 2 if len(surface) else np.zeros(3)
    extent = float(np.linalg.norm(np.ptp(surface.points, axis=0))) / 2 if len(surface) else 0.0
    if extent == 0:
        return None
    local = SurfacePoints((surface.points - middle) / extent, surface.normals, surface.faces)
    axes, origins = _through_normals(local, np.random.default_rng(seed))
    share = _share(local, (axes, origins))
    likely = np.argsort(-share, kind="stable")[:REFINED]
    likely = likely[share[likely] > 0]
    if not len(likely):
        return None
    (axes, origins), share = _refined(local, (axes[likely], origins[likely]), share[likely])
    k = int(share.argmax())
    return Revolution(axes[k], origins[k] * extent + middle, float(share[k])) if share[k] >= min_share else None


def share_in_place(surface: SurfacePoints, axis: Float[np.ndarray, " 3"], origin: Float[np.ndarray, " 3"]) -> float:
    """Return the share of a surface that slides in itself in a turn about a line; 0 for a surface without points.

    A point counts half if its motion has an angle of sine IN_PLACE with the surface, and less with a larger one.
    """
    if not len(surface):
        return 0.0
    return float(_weights(surface, (axis[None], origin[None]), MIN_RADIUS * float(np.ptp(surface.points, axis=0).max())).mean())


def _weights(surface: SurfacePoints, lines: Axes, min_radius: float) -> Float[np.ndarray, "k n"]:
    """Return for each line how far each point turns in place: 1 if it does, towards 0 if it moves along its normal."""
    axes, origins = lines
    normal_speeds = axes @ surface.moments.T + crosses(origins, axes) @ surface.normals.T
    return 1 / (1 + (normal_speeds / (IN_PLACE * _radii(surface, lines, min_radius))) ** 2)


def _radii(surface: SurfacePoints, lines: Axes, least: float) -> Float[np.ndarray, "k n"]:
    """Return the distance of each point from each line, and at least `least`."""
    (axes, origins), p = lines, surface.points
    along = axes @ p.T - (axes * origins).sum(1)[:, None]
    squared = (p**2).sum(1) - 2 * origins @ p.T + (origins**2).sum(1)[:, None] - along**2
    return np.sqrt(np.maximum(squared, least**2))


def _share(surface: SurfacePoints, lines: Axes) -> Float[np.ndarray, " k"]:
    """Return the shares in place; 0 for lines far from the surface and for those about which only flat ends turn in place."""
    axes, origins = lines
    weights = _weights(surface, lines, MIN_RADIUS)
    round_ = (weights * (np.abs(axes @ surface.normals.T) < MAX_FLAT)).mean(1)
    return weights.mean(1) * (round_ >= MIN_ROUND) * (np.linalg.norm(origins, axis=1) < 1)


def _refined(surface: SurfacePoints, lines: Axes, share: Float[np.ndarray, " k"]) -> tuple[Axes, Float[np.ndarray, " k"]]:
    """Return each axis fitted to the points in place about it, as long as its share grows, and the shares."""
    (axes, origins), share, live = lines, share.copy(), np.arange(len(share))
    for _ in range(ROUNDS):
        line = axes[live], origins[live]
        new = _fit(surface, np.sqrt(_weights(surface, line, MIN_RADIUS)) / _radii(surface, line, MIN_RADIUS))
        now = _share(surface, new)
        grown = now > share[live]
        live = live[grown]
        if not len(live):
            break
        axes[live], origins[live], share[live] = new[0][grown], new[1][grown], now[grown]
    return (axes, origins), share


def _through_normals(surface: SurfacePoints, rng: np.random.Generator) -> Axes:
    """Return axes of cylinders and cones through three points each; half of them through points near each other."""
    count = len(surface)
    chosen = rng.integers(0, count, (HYPOTHESES, 3))
    near = min(max(3, int(NEAR_SHARE * count)), count)
    first = chosen[: HYPOTHESES // 2, 0]
    distance = ((surface.points[first][:, None] - surface.points) ** 2).sum(2)
    nearest = np.argpartition(distance, near - 1, axis=1)[:, :near]
    chosen[: len(first), 1:] = np.take_along_axis(nearest, rng.integers(0, near, (len(first), 2)), axis=1)
    a, b, c = surface.normals[chosen].transpose(1, 0, 2)
    axes = crosses(a - b, a - c)  # the normals of a cone have one angle with its axis, those of a cylinder a right one
    length = np.linalg.norm(axes, axis=1)
    kept = length > 1e-3
    axes, chosen = axes[kept] / length[kept, None], chosen[kept]
    p, q, n, m = surface.points[chosen[:, 0]], surface.points[chosen[:, 1]], a[kept], b[kept]
    across = crosses(axes, m)  # the first normal meets the plane of the axis and the second normal on the axis
    slope = (n * across).sum(1)
    origins = p + (((q - p) * across).sum(1) / np.where(np.abs(slope) > 1e-3, slope, np.inf))[:, None] * n
    return axes, origins - (origins * axes).sum(1)[:, None] * axes


def _fit(surface: SurfacePoints, weights: Float[np.ndarray, "k n"]) -> Axes:
    """Return the lines with the least weighted squares of the equation of the complex, one per set of weights."""
    n, moment = weights[:, :, None] * surface.normals, weights[:, :, None] * surface.moments
    n_t = n.transpose(0, 2, 1)
    # a cylinder also slides in itself along its axis; the pseudo-inverse leaves such motions out
    to_moment = -np.linalg.pinv(n_t @ n, rcond=1e-6) @ (n_t @ moment)
    rest = moment + n @ to_moment
    axes = np.linalg.eigh(rest.transpose(0, 2, 1) @ rest)[1][:, :, 0]
    return axes, crosses(axes, (to_moment @ axes[:, :, None])[:, :, 0])
