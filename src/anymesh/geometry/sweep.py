"""Motion against the rest of the object: how far a part is free.

A point of the part is stopped where its path crosses the surface of the rest and goes on behind it by more than a
tolerance; so is a point of the rest whose path, seen from the part, crosses the part. Paths are cut into short segments
and cast as rays, so open shells, thin boards and bad winding count like solids; leaving a closed solid is free.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float

from anymesh.geometry.boxes import Box
from anymesh.geometry.shape import Shape
from anymesh.types import Motion, MotionKind, Sweep

CHUNK = 9  # steps cast at a time
LOOK_AHEAD = 2  # further steps that tell whether a point goes on behind what it struck
SHARE_STOPPED = 0.006  # of the points; fewer may be stopped by flaws of the mesh


@dataclass(frozen=True, eq=False)
class Obstacles:
    """The rest of the object around a part, with the points used both ways. tolerance: penetration that counts [m];
    hole: the rest's surface in it is no obstacle."""

    part: Shape
    rest: Shape
    tolerance: float
    hole: Box | None = None
    count: int = 350

    @cached_property
    def part_points(self) -> Float[np.ndarray, "n 3"]:
        """Points of the part, drawn in from the surface by the tolerance where the rest is that near."""
        return _spread(self.part, self.count)

    @cached_property
    def rest_points(self) -> Float[np.ndarray, "m 3"]:
        """Points of the rest near enough to matter, the nearest regions denser."""
        low, high = self.part.bounds
        reach = 0.75 * float(np.linalg.norm(high - low))
        center = self.rest.triangles.mean(1)
        near = np.flatnonzero(((center > low - reach) & (center < high + reach)).all(1))
        close = np.flatnonzero(((center > low - 0.1 * reach) & (center < high + 0.1 * reach)).all(1))
        found = [_spread(self.rest.take(index), self.count) for index in (near, close) if len(index)]
        points = np.concatenate(found) if found else np.zeros((0, 3))
        return points[~self.carved(points)]

    def carved(self, points: Float[np.ndarray, "n 3"]) -> Bool[np.ndarray, " n"]:
        """Which points of the rest lie in the hole."""
        if self.hole is None:
            return np.zeros(len(points), bool)
        return np.all(np.abs(self.hole.local(points)) < self.hole.half + self.tolerance, axis=1)


def _spread(shape: Shape, count: int) -> np.ndarray:
    """Surface points and corners, about `count` of each, a little inside closed surfaces."""
    samples = shape.samples
    step = max(1, len(samples) // count)
    corners = shape.triangles.reshape(-1, 3)
    centers = shape.triangles.mean(1).repeat(3, 0)
    stride = max(1, len(corners) // count)
    inside = corners[::stride] + 1e-3 * (centers[::stride] - corners[::stride])
    return np.concatenate([samples.points[::step], inside])


def _first_stop(
    points: np.ndarray,
    transforms: np.ndarray,
    amounts: np.ndarray,
    target: Shape,
    tolerance: float,
    gone: Callable[[np.ndarray], np.ndarray] | None = None,
) -> np.ndarray:
    """The amount at which each point is stopped by the target, inf when it never is. gone: where the target does not count."""
    if len(points) == 0 or len(target.triangles) == 0:
        return np.full(len(points), np.inf)
    path = points @ transforms[:, :3, :3].transpose(0, 2, 1) + transforms[:, None, :3, 3]
    steps, n = len(amounts) - 1, len(points)
    start = path[:steps].reshape(-1, 3)
    span = path[1 : steps + 1].reshape(-1, 3) - start
    stop = np.full(steps * n, np.inf)
    live, begin = np.arange(len(start)), np.zeros(len(start))
    for _ in range(2):  # the second pass looks behind surfaces that were only left
        rest_of_span = span[live] * (1 - begin)[:, None]
        hits = target.scene.first_hit(start[live] + span[live] * begin[:, None], rest_of_span, 1.0)
        struck = np.flatnonzero(hits.face >= 0)
        if len(struck) == 0:
            break
        at, face = live[struck], hits.face[struck]
        where = begin[struck] + (1 - begin[struck]) * hits.distance[struck]
        point = start[at] + span[at] * where[:, None]
        normal = target.normals[face]
        k, i = at // n, at % n
        counts = ~(target.solid[face] & (np.einsum("ij,ij->i", span[at], normal) >= 0))
        if gone is not None:
            counts &= ~gone(point)
        behind = [np.einsum("ij,ij->i", path[np.minimum(k + a, len(path) - 1), i] - point, normal) for a in (1, 2, 3)]
        counts &= np.abs(behind).max(0) > tolerance
        chosen = np.flatnonzero(counts)
        done = begin[struck[chosen], None]
        counts[chosen] = _squarely(
            start[at[chosen]] + span[at[chosen]] * done, span[at[chosen]] * (1 - done), target, tolerance
        )
        stop[at[counts]] = amounts[k[counts]] + where[counts] * (amounts[k[counts] + 1] - amounts[k[counts]])
        live, begin = at[~counts], np.minimum(where[~counts] + 1e-4, 1.0)
    return stop.reshape(steps, n).min(0)


def _squarely(start: np.ndarray, span: np.ndarray, target: Shape, tolerance: float) -> np.ndarray:
    """Whether paths still strike when moved sideways by the tolerance: a graze along a surface or an edge is no stop."""
    if len(start) == 0:
        return np.zeros(0, bool)
    length = np.maximum(np.linalg.norm(span, axis=1, keepdims=True), 1e-12)
    along = span / length
    helper = np.eye(3)[np.abs(along).argmin(1)]
    u = np.cross(along, helper)
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    v = np.cross(along, u)
    reach = span + along * 2 * tolerance
    squarely = np.ones(len(start), bool)
    for side in (u, -u, v, -v):
        todo = np.flatnonzero(squarely)
        if len(todo) == 0:
            break
        offset = tolerance * side[todo]
        walled = target.scene.first_hit(start[todo], offset, 1.0).face >= 0
        hits = target.scene.first_hit(start[todo] + offset, reach[todo], 1.0)
        entered = hits.face >= 0
        face = np.maximum(hits.face, 0)
        entered &= ~(target.solid[face] & (np.einsum("ij,ij->i", span[todo], target.normals[face]) >= 0))
        squarely[todo] = walled | entered
    return squarely


def free_amount(obstacles: Obstacles, motion: Motion, sign: int, most: float, steps: int) -> tuple[float, bool]:
    """How far (in 0..most) the part moves along sign * motion before it is stopped, and whether it never was."""
    amounts = np.linspace(0, most, steps + 1)
    there, back = motion.transforms(sign * amounts), motion.transforms(-sign * amounts)
    gone = None if obstacles.hole is None else obstacles.carved
    pairs = ((obstacles.part_points, there, obstacles.rest, gone), (obstacles.rest_points, back, obstacles.part, None))
    quorum = max(2, int(SHARE_STOPPED * sum(len(points) for points, *_ in pairs)))
    found = np.zeros(0)
    for begin in range(0, steps, CHUNK):  # stops are met in the order of the steps, so an early quorum is the answer
        end = min(begin + CHUNK, steps)
        reach = slice(begin, min(end + LOOK_AHEAD, steps) + 1)
        stops = [
            _first_stop(points, transforms[reach], amounts[begin : end + 1], target, obstacles.tolerance, hole)
            for points, transforms, target, hole in pairs
        ]
        found = np.concatenate([found, *(s[np.isfinite(s)] for s in stops)])
        if len(found) >= quorum:
            return float(np.partition(found, quorum - 1)[quorum - 1]), False
    return most, True


def sweep(obstacles: Obstacles, motion: Motion, most: float | None = None, steps: int = 36) -> Sweep:
    """Free range both ways. most: the range tested each way [rad or m]; default half a turn, or 2 diagonals of the part."""
    if most is None:
        most = np.pi if motion.kind is MotionKind.TURN else 2 * obstacles.part.box.diagonal
    forward, clear_forward = free_amount(obstacles, motion, 1, most, steps)
    backward, clear_backward = free_amount(obstacles, motion, -1, most, steps)
    return Sweep(forward, backward, clear_forward, clear_backward)
