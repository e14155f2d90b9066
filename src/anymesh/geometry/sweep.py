"""Sweeps of a part against the rest of the object, which give its free range.

A point of the part is stopped if its path crosses the surface of the rest and continues behind it by more than a tolerance. The
same applies to a point of the rest whose path, relative to the part, crosses the part. Paths are cut into short segments and
cast as rays, so open shells, thin boards and bad winding count like solids. Leaving a closed solid is free, and so is leaving a
surface that the part touches at rest, to the side of the part's own shape. A point of a closed solid is stopped only where the
solid moves forward, since its other points follow those.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Float32, Int

from anymesh.geometry.boxes import within
from anymesh.geometry.triangle_set import SurfacePoints, TriangleSet, spread_points
from anymesh.runtime import usable_cores
from anymesh.types import Brief, JointType, Motion, Sweep
from anymesh.types.triangles import boxes_meet, crosses, normals_and_areas, pieces_within

LOOK_AHEAD = 2  # further steps used to decide whether a point continues behind a hit surface
ONWARD = np.float32(1e-4)  # share of a segment between the first hit and the start of the second pass
TOUCH = np.float32(1e-2)  # of the tolerance: a path that begins this near to a surface touches it
TURNED_AWAY = np.float32(-1e-3)  # cosine between a path and the outward normal at its point: below, the solid moves off there
MARGIN = 1e-5  # of the target's longest side: margin of its bounds in the test of segments
MIN_COSINE = 0.2  # of half the arc of a chunk of steps; the bounds of longer ones say little
CHUNKS = (3, 6, 9, 18)  # steps cast at a time, where the last size repeats; most blocked motions are blocked early
AT_ONCE = 8  # motions swept together; more do not fit into a core's cache
REACH_RATIO = 0.75  # of the diagonal of the part's bounds: distance from them within which the rest has sample points
CLOSE_RATIO = 0.1  # of this distance: the nearest regions, which have as many again
OVERSAMPLED = 3  # points drawn for each that is used, since some lie beyond the region
SHARE_STOPPED = 0.006  # minimum share of stopped points; fewer may be stopped by mesh flaws


@dataclass(frozen=True, eq=False)
class Passage(Brief):
    """Points that move past a target along T motions, in the unit frame of the target's ray scene.

    points: homogeneous; normals: of the closed solids that points lie on, outward, 0 for points of open surfaces: a point is
    stopped only where its solid moves forward; poses: rigid transforms of the points at each of k equal steps, the first at
    rest; amounts: of the motions at these steps; off: returns the directions in which points (indices) move off faces of the
    target (indices) that they touch, None if contact at rest stops them.
    """

    points: Float32[np.ndarray, "4 n"]
    normals: Float32[np.ndarray, "3 n"]
    poses: Float32[np.ndarray, "3 T k 4"]
    amounts: Float[np.ndarray, "T k"]
    target: TriangleSet
    tolerance: float
    off: Callable[[np.ndarray, np.ndarray], np.ndarray] | None = None

    @classmethod
    def of(
        cls,
        points: Float[np.ndarray, "n 3"],
        normals: Float[np.ndarray, "n 3"],
        poses: Float[np.ndarray, "T k 4 4"],
        amounts: Float[np.ndarray, "T k"],
        target: TriangleSet,
        tolerance: float,
        off: Callable[[np.ndarray, np.ndarray], np.ndarray] | None = None,
    ) -> Passage:
        """Build the passage from points and transforms in the asset frame [m]."""
        scene = target.scene
        unit = poses[:, :, :3].copy()
        unit[..., 3] = (poses[:, :, :3, :3] @ scene.center + poses[:, :, :3, 3] - scene.center) * scene.scale
        homogeneous = np.concatenate([scene.to_unit(points).T, np.ones((1, len(points)), np.float32)])
        placed = unit.astype(np.float32).transpose(2, 0, 1, 3)
        return cls(homogeneous, normals.T.astype(np.float32), placed, amounts, target, tolerance * scene.scale, off)

    def stops(
        self, motions: Int[np.ndarray, " t"], passing: Bool[np.ndarray, "t n"], begin: int, end: int
    ) -> Float[np.ndarray, "t n"]:
        """Return the amount at which each point is stopped between two steps of some motions, infinite if it is not.

        Points that are not passing are left out.
        """
        poses = np.ascontiguousarray(self.poses[:, motions, begin : end + LOOK_AHEAD + 1])
        n, known, steps = self.points.shape[1], poses.shape[2], end - begin
        of_motion, of_point = np.nonzero(passing & self._may_meet(poses, steps))
        columns = len(of_motion)  # column k * columns + c of the path: the point of column c at step k of its motion
        groups = np.searchsorted(of_motion, np.arange(len(motions) + 1))
        path = _moved(poses, self.points[:, of_point], groups)
        live = self._near(path.reshape(3, known, columns), steps)
        live = live[self._forward(path, _moved(poses[..., :3], self.normals[:, of_point], groups), live, columns)]
        ends = (known - 1) * columns + live % columns  # the last known step
        start = _rows(path, live)
        span = _rows(path, live + columns) - start
        done = np.zeros(len(live), np.float32)  # share of each segment that is already checked
        stop = np.full((len(motions), n), np.inf)
        for _ in range(2):  # the second pass checks behind surfaces that were only left
            if len(live) == 0:
                break
            hits = self.target.scene.first_hit_unit(start + span * done[:, None], span * (1 - done)[:, None])
            struck = np.flatnonzero(hits.face >= 0)
            start, span, live, ends, done = start[struck], span[struck], live[struck], ends[struck], done[struck]
            where = done + (1 - done) * hits.distance[struck]
            ahead = [_rows(path, np.minimum(live + a * columns, ends)) for a in range(1, LOOK_AHEAD + 2)]
            counts = self._counts(ahead, start, span, done, where, hits.face[struck])
            k, c = np.divmod(live, max(columns, 1))
            t, i = of_motion[c], of_point[c]
            if begin == 0:
                counts &= (k > 0) | ~self._leaves_contact(i, span, where, hits.face[struck])
            t, k, i = t[counts], k[counts], i[counts]
            amounts = self.amounts[motions[t], begin + k]
            met = amounts + where[counts] * (self.amounts[motions[t], begin + k + 1] - amounts)
            point, first = np.unique(t * n + i, return_index=True)  # steps ascend, so the first one is the earliest
            stop.reshape(-1)[point] = np.minimum(stop.reshape(-1)[point], met[first])
            start, span, live, ends = start[~counts], span[~counts], live[~counts], ends[~counts]
            done = np.minimum(where[~counts] + ONWARD, np.float32(1.0))
        return stop

    def _may_meet(self, poses: np.ndarray, steps: int) -> Bool[np.ndarray, "t n"]:
        """Return which points may come within the target's bounds along some motions; the others do not.

        An arc lies in the triangle of its ends and of the point where the tangents at them meet, and the path of a slide or
        a screw as well, if the rest of it is straight.
        """
        half_way = -(-steps // 2)
        near = np.ones((poses.shape[1], self.points.shape[1]), bool)
        if 2 * half_way >= poses.shape[2]:
            return near
        knots = poses[:, :, [0, half_way, 2 * half_way]]
        turned = np.einsum("rtc,rtc->t", knots[:, :, 0, :3], knots[:, :, 1, :3]) / 2 - np.float32(0.5)  # cosine of half the arc
        placed = np.einsum("rk,kn->rn", knots.reshape(-1, 4), self.points)
        begin, middle, end = placed.reshape(3, len(turned), 3, -1).transpose(2, 0, 1, 3)
        chord = (begin + end) / 2
        tangents = chord + ((1 + turned) / np.maximum(turned, MIN_COSINE))[:, None] * (middle - chord)
        margin = MARGIN * (2 + np.abs(knots[..., 3]).max() + np.abs(self.points).max())  # rounding
        for axis, half in enumerate(self.target.scene.unit_half + margin):
            corners = begin[axis], end[axis], tangents[axis]
            near &= (np.maximum.reduce(corners) >= -half) & (np.minimum.reduce(corners) <= half)
        return near | (turned < MIN_COSINE)[:, None]

    def _near(self, path: Float32[np.ndarray, "3 k c"], steps: int) -> Int[np.ndarray, " s"]:
        """Return the segments (columns of their first ends) that come within the target's bounds."""
        half = self.target.scene.unit_half + MARGIN
        above, below = path[0] >= -half[0], path[0] <= half[0]
        near = (above[:steps] | above[1 : steps + 1]) & (below[:steps] | below[1 : steps + 1])
        live = np.flatnonzero(near)
        for axis in (1, 2):
            along = path[axis].reshape(-1)
            a, b = along[live], along[live + path.shape[2]]
            live = live[(np.maximum(a, b) >= -half[axis]) & (np.minimum(a, b) <= half[axis])]
        return live

    def _forward(
        self, path: Float32[np.ndarray, "3 m"], normals: Float32[np.ndarray, "3 m"], live: Int[np.ndarray, " s"], columns: int
    ) -> Bool[np.ndarray, " s"]:
        """Return along which segments (columns of the path) the solid of the point moves forward at that point."""
        normal, span = normals.take(live, axis=1), path.take(live + columns, axis=1) - path.take(live, axis=1)
        length = np.sqrt(np.einsum("ij,ij->j", span, span))
        return np.einsum("ij,ij->j", normal, span) >= TURNED_AWAY * length

    def _counts(
        self,
        ahead: Sequence[np.ndarray],
        start: np.ndarray,
        span: np.ndarray,
        done: np.ndarray,
        where: np.ndarray,
        face: np.ndarray,
    ) -> np.ndarray:
        """Return which hits stop their point.

        A point is stopped if it enters squarely and continues behind the surface by more than the tolerance.
        """
        point = start + span * where[:, None]
        normal = self.target.normals[face].astype(np.float32)
        counts = ~self._leaves(face, span)
        behind = [np.einsum("ij,ij->i", later - point, normal) for later in ahead]
        counts &= np.abs(behind).max(0) > self.tolerance
        chosen = np.flatnonzero(counts)
        left = (1 - done[chosen])[:, None]
        counts[chosen] = self._squarely(start[chosen] + span[chosen] * done[chosen, None], span[chosen] * left)
        return counts

    def _leaves_contact(
        self, point: Int[np.ndarray, " h"], span: np.ndarray, where: np.ndarray, face: Int[np.ndarray, " h"]
    ) -> np.ndarray:
        """Return which hits on a path from rest are of points that touch this surface at rest and move off it.

        Where two surfaces coincide, rounding decides on which side of the surface a point begins.
        """
        if self.off is None:
            return np.zeros(len(face), bool)
        depth = np.abs(np.einsum("ij,ij->i", span, self.target.normals[face].astype(np.float32))) * where
        return (depth <= self.tolerance) & (np.einsum("ij,ij->i", span, self.off(point, face)) > 0)

    def _squarely(self, start: np.ndarray, span: np.ndarray) -> np.ndarray:
        """Return whether paths still hit when moved sideways by the tolerance; grazing a surface or an edge is no stop."""
        if len(start) == 0:
            return np.zeros(0, bool)
        n = len(start)
        along = span / np.maximum(np.linalg.norm(span, axis=1, keepdims=True), 1e-12)
        helper = np.eye(3, dtype=np.float32)[np.abs(along).argmin(1)]
        u = crosses(along, helper)
        u /= np.linalg.norm(u, axis=1, keepdims=True)
        v = crosses(along, u)
        offset = np.float32(self.tolerance) * np.concatenate([u, -u, v, -v])
        origin, reach = np.tile(start, (4, 1)), np.tile(span + along * np.float32(2 * self.tolerance), (4, 1))
        hits = self.target.scene.first_hit_unit(origin, offset)
        struck = (hits.face >= 0) & ~((hits.distance < TOUCH) & self._leaves(hits.face, offset))  # a path may begin on a face
        todo = np.flatnonzero(~struck)
        face = self.target.scene.first_hit_unit(origin[todo] + offset[todo], reach[todo]).face
        leaves = self._leaves(face, span[todo % n])
        struck[todo] = (face >= 0) & ~leaves
        return np.logical_and.reduce(struck.reshape(4, n))

    def _leaves(self, face: Int[np.ndarray, " h"], span: Float32[np.ndarray, "h 3"]) -> Bool[np.ndarray, " h"]:
        """Return which paths through a face of the target leave a closed solid there."""
        return self.target.solid[face] & (np.einsum("ij,ij->i", span, self.target.normals[face]) >= 0)


def _moved(
    poses: Float32[np.ndarray, "3 T k c"], points: Float32[np.ndarray, "c n"], groups: Int[np.ndarray, " t"]
) -> np.ndarray:
    """Return points at each step of their motion, in columns by step, then point. groups: first point of each motion, and n."""
    path = np.empty((3, poses.shape[2], points.shape[1]), np.float32)
    for motion, (a, b) in enumerate(itertools.pairwise(groups)):
        # not by BLAS, whose own threads would compete with those of the sweeps
        np.einsum("rkc,cn->rkn", poses[:, motion], points[:, a:b], out=path[:, :, a:b])
    return path.reshape(3, -1)


def _rows(path: Float32[np.ndarray, "3 k"], columns: Int[np.ndarray, " m"]) -> Float32[np.ndarray, "m 3"]:
    return np.ascontiguousarray(path.take(columns, axis=1).T)


@dataclass(frozen=True, eq=False)
class Obstacles:
    """The static geometry around a part, with the sample points of both.

    tolerance: penetration at which a point is stopped [m].
    """

    part: TriangleSet
    rest: TriangleSet
    tolerance: float
    count: int = 350

    @cached_property
    def part_points(self) -> SurfacePoints:
        """Return sample points of the part."""
        return _spread(self.part, self.part.samples, np.arange(len(self.part.triangles)), self.count)

    @cached_property
    def part_normals(self) -> Float32[np.ndarray, "F 3"]:
        """Return the normal of each face of the part, out of it: away from its middle if the surface is open."""
        arms = self.part.triangles.mean(1) - self.part.centroid
        turned = ~self.part.solid & (np.einsum("ij,ij->i", arms, self.part.normals) < 0)
        return np.where(turned[:, None], -self.part.normals, self.part.normals).astype(np.float32)

    @cached_property
    def rest_points(self) -> SurfacePoints:
        """Return sample points of the static geometry near the part, denser in the nearest regions."""
        low, high = self.part.bounds
        reach = REACH_RATIO * float(np.linalg.norm(high - low))
        near, close = (_spread_within(self.rest, low - r, high + r, self.count) for r in (reach, CLOSE_RATIO * reach))
        return near.joined(close)

    def prepare(self) -> None:
        """Compute the cached values before threads use them."""
        _ = self.part_points, self.rest_points, self.part_normals, self.part.scene
        if len(self.rest.triangles):
            _ = self.rest.scene

    def passages(
        self, motions: Sequence[Motion], signed: Float[np.ndarray, "T k"], amounts: Float[np.ndarray, "T k"]
    ) -> list[Passage]:
        """Return the passages of the part's points past the rest, and of the rest's points, moved inversely, past the part."""
        there = np.array([m.transforms(a) for m, a in zip(motions, signed, strict=True)])
        back = np.array([m.transforms(-a) for m, a in zip(motions, signed, strict=True)])
        outward, mine, theirs = self.part_normals, self.part_points, self.rest_points
        ways = (
            (mine, self.part, there, self.rest, lambda point, face: -outward[mine.faces[point]]),
            (theirs, self.rest, back, self.part, lambda point, face: outward[face]),
        )
        return [
            Passage.of(at.points, at.normals * own.solid[at.faces, None], poses, amounts, target, self.tolerance, off)
            for at, own, poses, target, off in ways
            if len(at) and len(target.triangles)
        ]


def _spread(shape: TriangleSet, samples: SurfacePoints, faces: Int[np.ndarray, " m"], count: int) -> SurfacePoints:
    """Return at most `count` of the samples of a shape, and as many points a thousandth inside of corners of some faces."""
    corner = _evenly(3 * len(faces), count)
    face = faces[corner // 3]
    triangles = shape.triangles[face]
    inside = 0.999 * triangles[np.arange(len(face)), corner % 3] + 0.001 * triangles.mean(1)
    return samples.take(_evenly(len(samples), count)).joined(SurfacePoints(inside, shape.normals[face], face))


def _spread_within(shape: TriangleSet, low: np.ndarray, high: np.ndarray, count: int) -> SurfacePoints:
    """Return such points of the surface within a box, however large its triangles are."""
    near = np.flatnonzero(boxes_meet(shape.lowest, shape.highest, low, high))
    pieces, piece_face = pieces_within(shape.triangles[near], low, high)
    face = near[piece_face]
    points, piece = spread_points(pieces, normals_and_areas(pieces)[1], OVERSAMPLED * count, shape.seed)
    inside = within(points, low, high)
    samples = SurfacePoints(points, shape.normals[face[piece]], face[piece]).take(inside)
    faces = np.unique(face)
    corners = shape.triangles[faces]
    met = within(corners.reshape(-1, 3), low, high).reshape(-1, 3).any(1)
    spread = _spread(shape, samples, faces[met], count)
    return spread.take(within(spread.points, low, high))


def _evenly(available: int, count: int) -> Int[np.ndarray, " n"]:
    """Return at most `count` indices, evenly spread over those available."""
    return np.linspace(0, max(available - 1, 0), min(available, count)).astype(int)


def free_amounts(
    obstacles: Obstacles, motions: Sequence[Motion], signs: Sequence[int], max_amounts: Sequence[float], steps: int
) -> list[tuple[float, bool]]:
    """Compute how far the part moves along each sign * motion before it is stopped, and whether the whole range is free.

    max_amounts: the range tested per motion [rad or m].

    The motions are independent and are distributed over threads.
    """
    if not motions:
        return []
    obstacles.prepare()

    def free(group: np.ndarray) -> list[tuple[float, bool]]:
        return _free(obstacles, [motions[m] for m in group], [signs[m] for m in group], [max_amounts[m] for m in group], steps)

    groups = np.array_split(np.arange(len(motions)), -(-len(motions) // AT_ONCE))
    if len(groups) == 1:
        return free(groups[0])
    with ThreadPoolExecutor(usable_cores()) as threads:  # numpy and Embree release the interpreter lock
        return [amount for some in threads.map(free, groups) for amount in some]


def _free(
    obstacles: Obstacles, motions: Sequence[Motion], signs: Sequence[int], max_amounts: Sequence[float], steps: int
) -> list[tuple[float, bool]]:
    amounts = np.array([np.linspace(0, far, steps + 1) for far in max_amounts])
    ways = obstacles.passages(motions, np.array(signs)[:, None] * amounts, amounts)
    quorum = max(2, int(SHARE_STOPPED * sum(way.points.shape[1] for way in ways)))
    free_ranges: list[tuple[float, bool]] = [(far, True) for far in max_amounts]
    stops = [np.full((len(motions), way.points.shape[1]), np.inf) for way in ways]
    live, begin = np.arange(len(motions)), 0
    for size in itertools.chain(CHUNKS, itertools.repeat(CHUNKS[-1])):  # stops are found in the order of the steps
        end = min(begin + size, steps)
        for way, stop in zip(ways, stops, strict=True):
            stop[live] = np.minimum(stop[live], way.stops(live, np.isinf(stop[live]), begin, end))
        met = np.concatenate([np.isfinite(stop[live]) for stop in stops], axis=1).sum(1) if stops else np.zeros(len(live))
        for m in live[met >= quorum]:
            every = np.concatenate([stop[m] for stop in stops])
            free_ranges[m] = float(np.partition(every, quorum - 1)[quorum - 1]), False
        live, begin = live[met < quorum], end
        if begin == steps or len(live) == 0:
            break
    return free_ranges


def free_amount(obstacles: Obstacles, motion: Motion, sign: int, max_amount: float, steps: int) -> tuple[float, bool]:
    """Compute `free_amounts` for one motion."""
    return free_amounts(obstacles, [motion], [sign], [max_amount], steps)[0]


def sweep_all(obstacles: Obstacles, motions: Sequence[Motion], steps: int = 36, max_amount: float | None = None) -> list[Sweep]:
    """Compute the free range in both directions of each motion.

    max_amount: the range tested in each direction [rad or m]; default half a turn, or 2 diagonals of the part.
    """
    slide = 2 * obstacles.part.box.diagonal
    reach = [(np.pi if m.kind is JointType.REVOLUTE else slide) if max_amount is None else max_amount for m in motions]
    free = free_amounts(obstacles, [*motions, *motions], [1] * len(motions) + [-1] * len(motions), reach + reach, steps)
    pairs = zip(free[: len(motions)], free[len(motions) :], strict=True)
    return [Sweep(forward, backward, clear, clear_back) for (forward, clear), (backward, clear_back) in pairs]


def sweep(obstacles: Obstacles, motion: Motion, max_amount: float | None = None, steps: int = 36) -> Sweep:
    """Compute `sweep_all` for one motion."""
    return sweep_all(obstacles, [motion], steps, max_amount)[0]
