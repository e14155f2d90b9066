"""Points that move past a surface, and where the surface stops them: see `sweep`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Float32, Int

from anymesh.geometry.triangle_set import TriangleSet

LOOK_AHEAD = 2  # further steps used to decide whether a point continues behind a hit surface
ONWARD = np.float32(1e-4)  # share of a segment between the first hit and the start of the second pass
TOUCH = np.float32(1e-2)  # of the tolerance: a path that begins this near to a surface touches it
TURNED_AWAY = np.float32(-1e-3)  # cosine between a path and the outward normal at its point: below, the solid moves off there
MARGIN = 1e-5  # of the target's longest side: margin of its bounds in the test of segments


@dataclass(frozen=True, eq=False)
class Passage:
    """Points that move past a target along T motions, in the unit frame of the target's ray scene.

    points: homogeneous; normals: of the closed solids that points lie on, outward, 0 for points of open surfaces: a point is
    stopped only where its solid moves forward; poses: rigid transforms of the points at each of k steps, the first at rest;
    amounts: of the motions at these steps; off: returns the directions in which points (indices) move off faces of the target
    (indices) that they touch, None if contact at rest stops them.
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
        (count, known), n, steps = poses.shape[1:3], self.points.shape[1], end - begin
        # not by BLAS, whose own threads would compete with those of the sweeps
        path = np.einsum("rk,kn->rn", poses.reshape(-1, 4), self.points).reshape(3, count, known, n)
        t, k, i = self._near(path, passing, steps)
        path = path.reshape(3, -1)  # column (t * known + k) * n + i: point i at step k of motion t
        live = self._forward(path, poses, (t * known + k) * n + i)
        t, k, i = np.unravel_index(live, (count, known, n))
        ends = (t * known + known - 1) * n + i  # the last known step
        start = _rows(path, live)
        span = _rows(path, live + n) - start
        done = np.zeros(len(live), np.float32)  # share of each segment that is already checked
        stop = np.full((count, n), np.inf)
        for _ in range(2):  # the second pass checks behind surfaces that were only left
            if len(live) == 0:
                break
            hits = self.target.scene.first_hit_unit(start + span * done[:, None], span * (1 - done)[:, None])
            struck = np.flatnonzero(hits.face >= 0)
            start, span, live, ends, done = start[struck], span[struck], live[struck], ends[struck], done[struck]
            where = done + (1 - done) * hits.distance[struck]
            ahead = [_rows(path, np.minimum(live + a * n, ends)) for a in range(1, LOOK_AHEAD + 2)]
            counts = self._counts(ahead, start, span, done, where, hits.face[struck])
            t, k, i = np.unravel_index(live, (count, known, n))
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

    def _near(self, path: np.ndarray, passing: np.ndarray, steps: int) -> tuple[np.ndarray, ...]:
        """Return the segments that come within the target's bounds: motion, step and point of each."""
        half = self.target.scene.unit_half + MARGIN
        above, below = path[0] >= -half[0], path[0] <= half[0]
        near = (above[:, :steps] | above[:, 1 : steps + 1]) & (below[:, :steps] | below[:, 1 : steps + 1])
        t, k, i = np.nonzero(near & passing[:, None])
        for axis in (1, 2):
            a, b = path[axis][t, k, i], path[axis][t, k + 1, i]
            kept = np.flatnonzero((np.maximum(a, b) >= -half[axis]) & (np.minimum(a, b) <= half[axis]))
            t, k, i = t[kept], k[kept], i[kept]
        return t, k, i

    def _forward(self, path: np.ndarray, poses: np.ndarray, live: Int[np.ndarray, " s"]) -> Int[np.ndarray, " f"]:
        """Return the segments (columns of the path) along which the solid of the point moves forward at that point."""
        n = self.points.shape[1]
        normals = np.einsum("rk,kn->rn", poses[..., :3].reshape(-1, 3), self.normals).reshape(3, -1)
        normal, span = normals.take(live, axis=1), path.take(live + n, axis=1) - path.take(live, axis=1)
        length = np.sqrt(np.einsum("ij,ij->j", span, span))
        return live[np.einsum("ij,ij->j", normal, span) >= TURNED_AWAY * length]

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
        u = np.cross(along, helper)
        u /= np.linalg.norm(u, axis=1, keepdims=True)
        v = np.cross(along, u)
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


def _rows(path: Float32[np.ndarray, "3 k"], columns: Int[np.ndarray, " m"]) -> Float32[np.ndarray, "m 3"]:
    return np.ascontiguousarray(path.take(columns, axis=1).T)
