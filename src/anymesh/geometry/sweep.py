"""Sweeps of a part against the rest of the object, which give its free range.

A point of the part is stopped if its path crosses the surface of the rest and continues behind it by more than a tolerance. The
same applies to a point of the rest whose path, relative to the part, crosses the part. Paths are cut into short segments and
cast as rays, so open shells, thin boards and bad winding count like solids. Leaving a closed solid is free, and so is leaving a
surface that the part touches at rest, to the side of the part's own shape. A point of a closed solid is stopped only where the
solid moves forward, since its other points follow those.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Float32, Int

from anymesh.geometry.boxes import within
from anymesh.geometry.passage import Passage
from anymesh.geometry.sampling import SurfacePoints, spread_points
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.runtime import usable_cores
from anymesh.types import JointType, Motion, Sweep
from anymesh.types.triangles import boxes_meet, normals_and_areas, pieces_within

CHUNKS = (3, 6, 9, 18)  # steps cast at a time, where the last size repeats; most blocked motions are blocked early
AT_ONCE = 8  # motions swept together; more do not fit into a core's cache
REACH_RATIO = 0.75  # of the diagonal of the part's bounds: distance from them within which the rest has sample points
CLOSE_RATIO = 0.1  # of this distance: the nearest regions, which have as many again
OVERSAMPLED = 3  # points drawn for each that is used, since some lie beyond the region
SHARE_STOPPED = 0.006  # minimum share of stopped points; fewer may be stopped by mesh flaws


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

        def off_rest(point: np.ndarray, face: np.ndarray) -> np.ndarray:
            return -outward[mine.faces[point]]

        def off_part(point: np.ndarray, face: np.ndarray) -> np.ndarray:
            return outward[face]

        ways = (mine, self.part, there, self.rest, off_rest), (theirs, self.rest, back, self.part, off_part)
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
