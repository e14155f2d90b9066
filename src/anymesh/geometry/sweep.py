"""Motion against the rest of the object: how far a part is free.

A point of the part is stopped where its path crosses the surface of the rest and goes on behind it by more than a
tolerance; so is a point of the rest whose path, seen from the part, crosses the part. Paths are cut into short segments
and cast as rays, so open shells, thin boards and bad winding count like solids; leaving a closed solid is free.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Float32, Int

from anymesh.geometry.boxes import Box
from anymesh.geometry.shape import Shape
from anymesh.types import Motion, MotionKind, Sweep

CHUNKS = (3, 6, 9, 18)  # steps cast at a time; the last size repeats. Most blocked motions are blocked early
LOOK_AHEAD = 2  # further steps that tell whether a point goes on behind what it struck
SHARE_STOPPED = 0.006  # of the points; fewer may be stopped by flaws of the mesh
ONWARD = np.float32(1e-4)  # share of a segment that the second pass begins behind the first hit
MARGIN = 1e-5  # added to the target's bounds when segments are tested against them, as a share of its longest side


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


@dataclass(frozen=True, eq=False)
class _Passage:
    """Points that move past a target, in the unit frame of the target's ray scene.

    points: homogeneous; poses: rigid transforms of the points at every step; gone: tells where the target does not count,
    in the asset frame.
    """

    points: Float32[np.ndarray, "4 n"]
    poses: Float32[np.ndarray, "3 k 4"]
    target: Shape
    tolerance: float
    gone: Callable[[np.ndarray], np.ndarray] | None

    @classmethod
    def of(
        cls,
        points: Float[np.ndarray, "n 3"],
        poses: Float[np.ndarray, "k 4 4"],
        target: Shape,
        tolerance: float,
        gone: Callable[[np.ndarray], np.ndarray] | None,
    ) -> _Passage:
        """From points and transforms in the asset frame [m]."""
        scene = target.scene
        unit = poses[:, :3].copy()
        unit[:, :, 3] = (poses[:, :3, :3] @ scene.center + poses[:, :3, 3] - scene.center) * scene.scale
        homogeneous = np.concatenate([scene.to_unit(points).T, np.ones((1, len(points)), np.float32)])
        return cls(homogeneous, unit.astype(np.float32).transpose(1, 0, 2), target, tolerance * scene.scale, gone)

    def stops(
        self, index: Int[np.ndarray, " m"], begin: int, end: int, amounts: Float[np.ndarray, " k"]
    ) -> Float[np.ndarray, " m"]:
        """The amount at which each of some points is stopped between two steps, inf where it is not."""
        poses = self.poses[:, begin : end + LOOK_AHEAD + 1]
        n, steps = len(index), end - begin
        path = (poses.reshape(-1, 4) @ self.points[:, index]).reshape(3, -1)  # column k * n + i: point i at step k
        stop = np.full(steps * n, np.inf)
        live = self._near(path, steps * n, n)
        start = _rows(path, live)
        span = _rows(path, live + n) - start
        done = np.zeros(len(live), np.float32)  # share of each segment that has been looked at
        for _ in range(2):  # the second pass looks behind surfaces that were only left
            if len(live) == 0:
                break
            hits = self.target.scene.first_hit_unit(start + span * done[:, None], span * (1 - done)[:, None])
            struck = np.flatnonzero(hits.face >= 0)
            start, span, live, done = start[struck], span[struck], live[struck], done[struck]
            where = done + (1 - done) * hits.distance[struck]
            last = path.shape[1] - n + live % n  # the point at the last step that is known
            ahead = [_rows(path, np.minimum(live + a * n, last)) for a in range(1, LOOK_AHEAD + 2)]
            counts = self._counts(ahead, start, span, done, where, hits.face[struck])
            k = begin + live[counts] // n
            stop[live[counts]] = amounts[k] + where[counts] * (amounts[k + 1] - amounts[k])
            start, span, live = start[~counts], span[~counts], live[~counts]
            done = np.minimum(where[~counts] + ONWARD, np.float32(1.0))
        return stop.reshape(steps, n).min(0)

    def _near(self, path: np.ndarray, count: int, n: int) -> np.ndarray:
        """Which of the first `count` segments come within the target's bounds."""
        kept = None
        for along, half in zip(path, self.target.scene.unit_half + MARGIN, strict=True):
            a = along[:count] if kept is None else along[kept]
            b = along[n : count + n] if kept is None else along[kept + n]
            near = np.flatnonzero(((a >= -half) | (b >= -half)) & ((a <= half) | (b <= half)))
            kept = near if kept is None else kept[near]
        assert kept is not None  # three axes
        return kept

    def _counts(
        self,
        ahead: Sequence[np.ndarray],
        start: np.ndarray,
        span: np.ndarray,
        done: np.ndarray,
        where: np.ndarray,
        face: np.ndarray,
    ) -> np.ndarray:
        """Which hits stop their point: it enters squarely, and goes on behind the surface by more than the tolerance."""
        point = start + span * where[:, None]
        normal = self.target.normals[face].astype(np.float32)
        counts = ~(self.target.solid[face] & (np.einsum("ij,ij->i", span, normal) >= 0))
        if self.gone is not None:
            counts &= ~self.gone(self.target.scene.from_unit(point))
        behind = [np.einsum("ij,ij->i", later - point, normal) for later in ahead]
        counts &= np.abs(behind).max(0) > self.tolerance
        chosen = np.flatnonzero(counts)
        left = (1 - done[chosen])[:, None]
        counts[chosen] = self._squarely(start[chosen] + span[chosen] * done[chosen, None], span[chosen] * left)
        return counts

    def _squarely(self, start: np.ndarray, span: np.ndarray) -> np.ndarray:
        """Whether paths still strike when moved sideways by the tolerance: a graze along a surface or an edge is no stop."""
        if len(start) == 0:
            return np.zeros(0, bool)
        n = len(start)
        along = span / np.maximum(np.linalg.norm(span, axis=1, keepdims=True), 1e-12)
        helper = np.eye(3, dtype=np.float32)[np.abs(along).argmin(1)]
        u = np.cross(along, helper)
        u /= np.linalg.norm(u, axis=1, keepdims=True)
        v = np.cross(along, u)
        offset = np.float32(self.tolerance) * np.concatenate([u, -u, v, -v])
        origin, reach = np.tile(start, (4, 1)), np.tile(span + along * np.float32(2 * self.tolerance), (4, 1))
        struck = self.target.scene.first_hit_unit(origin, offset).face >= 0
        todo = np.flatnonzero(~struck)
        face = self.target.scene.first_hit_unit(origin[todo] + offset[todo], reach[todo]).face
        leaves = self.target.solid[face] & (np.einsum("ij,ij->i", span[todo % n], self.target.normals[face]) >= 0)
        struck[todo] = (face >= 0) & ~leaves
        return np.logical_and.reduce(struck.reshape(4, n))


def _rows(path: Float32[np.ndarray, "3 k"], columns: Int[np.ndarray, " m"]) -> Float32[np.ndarray, "m 3"]:
    return np.ascontiguousarray(path.take(columns, axis=1).T)


def free_amount(obstacles: Obstacles, motion: Motion, sign: int, most: float, steps: int) -> tuple[float, bool]:
    """How far (in 0..most) the part moves along sign * motion before it is stopped, and whether it never was."""
    amounts = np.linspace(0, most, steps + 1)
    there, back = motion.transforms(sign * amounts), motion.transforms(-sign * amounts)
    gone = None if obstacles.hole is None else obstacles.carved
    ways = [
        _Passage.of(points, poses, target, obstacles.tolerance, hole)
        for points, poses, target, hole in (
            (obstacles.part_points, there, obstacles.rest, gone),
            (obstacles.rest_points, back, obstacles.part, None),
        )
        if len(points) and len(target.triangles)
    ]
    quorum = max(2, int(SHARE_STOPPED * sum(way.points.shape[1] for way in ways)))
    free = [np.arange(way.points.shape[1]) for way in ways]
    found = np.zeros(0)
    begin = 0
    for size in itertools.chain(CHUNKS, itertools.repeat(CHUNKS[-1])):  # stops are met in the order of the steps
        if begin == steps:
            return most, True
        end = min(begin + size, steps)
        for k, way in enumerate(ways):
            stops = way.stops(free[k], begin, end, amounts)
            stopped = np.isfinite(stops)
            found, free[k] = np.concatenate([found, stops[stopped]]), free[k][~stopped]
        if len(found) >= quorum:
            return float(np.partition(found, quorum - 1)[quorum - 1]), False
        begin = end
    raise AssertionError  # the sizes never end


def sweep(obstacles: Obstacles, motion: Motion, most: float | None = None, steps: int = 36) -> Sweep:
    """Free range both ways. most: the range tested each way [rad or m]; default half a turn, or 2 diagonals of the part."""
    if most is None:
        most = np.pi if motion.kind is MotionKind.TURN else 2 * obstacles.part.box.diagonal
    forward, clear_forward = free_amount(obstacles, motion, 1, most, steps)
    backward, clear_backward = free_amount(obstacles, motion, -1, most, steps)
    return Sweep(forward, backward, clear_forward, clear_backward)
