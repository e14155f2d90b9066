"""Convex decomposition of closed solids by exact cuts along planes, with manifold3d (Apache-2.0).

A solid is cut into closed solids until each is close to its hull. Pieces whose common hull is also close to them are merged.
Call it in a child process, since it is native code (docs/decisions/0025).
"""

from __future__ import annotations

import heapq
import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Float, Int

from anymesh.errors import MissingExtraError
from anymesh.geometry.distance_ import distance_to_triangles
from anymesh.geometry.triangle_set import sample_surface
from anymesh.physics.convex import hull_of, volume
from anymesh.physics.openings import KERF, NONE, Openings
from anymesh.physics.split import SAMPLES, Plane, concave_planes, cutting_planes, hull_volume, least_volume_first, outline
from anymesh.types import Brief, Hull
from anymesh.types.triangles import normals_and_areas

if TYPE_CHECKING:
    from manifold3d import Manifold

SPLIT_RATIO = 2  # pieces before merging, per piece after it
FACETED_PLANES = 32  # distinct planes at concave edges; a solid with more is smooth, and other planes are tried too
PLANES_PER_CUT = 16  # planes at concave edges tried per cut, those with the longest edges first
SMOOTH_PLANES = 8  # the same for a smooth solid
CONVEX = 1e-6  # relative difference between the volumes of a solid and its hull below which it is convex
FEW = 12  # faces of a hull whose centers are tested first
TOUCH = 3 * KERF  # distance between the bounds of touching pieces, relative to the diagonal
MAX_WORK = 1_500_000  # faces of the pieces that are cut or compared with their hulls, plus FACES_PER_CUT for each cut
FACES_PER_CUT = 3000  # faces that take as long to compare with a hull as a cut takes


class _Budget:
    """Limit of the work for one solid. Unlike a limit of time, it gives the same result on any machine."""

    def __init__(self, work: int = MAX_WORK) -> None:
        self._work = self._left = work

    @property
    def half_left(self) -> bool:
        """Whether at least half of the work is left."""
        return 2 * self._left >= self._work

    def spend(self, work: int) -> None:
        """Subtract some work; raise TimeoutError if none is left."""
        self._left -= work
        if self._left < 0:
            raise TimeoutError(f"cutting takes more than {self._work:,} faces")


@dataclass(frozen=True, eq=False)
class _SolidPiece(Brief):
    """Surfaces, their common hull, and the maximum distance of the hull from them. The diagonal of the whole solid is 1.

    solid: None for merged pieces.
    """

    triangles: Float[np.ndarray, "n 3 3"]
    hull: Hull
    gap: float
    solid: Manifold | None = None


def decompose_solid(
    vertices: Float[np.ndarray, "V 3"],
    faces: Int[np.ndarray, "F 3"],
    *,
    gap: float,
    wall: float,
    max_pieces: int,
    openings: Openings = NONE,
) -> list[Hull]:
    """Return hulls of pieces of a closed solid that are within `gap` of it, or of `max_pieces` pieces.

    Empty if the surface is not manifold. The same input gives the same hulls.

    gap: maximum distance of a hull from the surface [m]; wall: minimum spacing of cutting planes [m]; openings: that must stay.

    Raise TimeoutError if that takes too much work, MissingExtraError without manifold3d.
    """
    low = vertices.min(0)
    size = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    unit = (vertices - low) / size
    solid = _manifold(unit, faces)
    if solid is None:
        return []
    budget, planes = _Budget(), concave_planes(unit[faces], FACETED_PLANES)
    open_ = openings.moved(-low, 1 / size)
    pieces = _cut(solid, planes, gap / size, wall / size, SPLIT_RATIO * max_pieces, budget, open_)
    merged = _merge_pieces(pieces, gap / size, max_pieces, budget, open_)
    return [Hull(p.hull.vertices * size + low, p.hull.faces) for p in merged]


def _manifold(vertices: np.ndarray, faces: np.ndarray) -> Manifold | None:
    try:
        from manifold3d import Error, Manifold, Mesh64
    except ImportError:
        raise MissingExtraError("manifold3d is missing; it is a dependency of articulate-anymesh; reinstall that") from None
    solid = Manifold(Mesh64(np.ascontiguousarray(vertices, np.float64), np.ascontiguousarray(faces, np.uint64)))
    return solid if solid.status() == Error.NoError and solid.volume() > 0 else None


def _cut(
    solid: Manifold,
    planes: Sequence[Plane],
    gap: float,
    wall: float,
    most: int,
    budget: _Budget,
    openings: Openings = NONE,
) -> list[_SolidPiece]:
    """Cut the piece with the largest gap until all are within `gap` or there are `most` pieces."""
    done: list[_SolidPiece] = []
    waiting = [(-piece.gap, k, piece) for k, piece in enumerate(_pieces(solid, gap, openings))]
    number = itertools.count(len(waiting))
    heapq.heapify(waiting)
    while waiting:
        piece = heapq.heappop(waiting)[2]
        few = len(done) + len(waiting) + 1 < most and (budget.half_left or not len(openings))
        halves = _halves(piece, planes, gap, wall, budget, openings) if piece.gap > gap and few else []
        if not halves:
            done.append(piece)
        for half in halves:
            heapq.heappush(waiting, (-half.gap, next(number), half))
    return done


def _pieces(solid: Manifold, gap: float = 0.0, openings: Openings = NONE) -> list[_SolidPiece]:
    """Return the connected pieces of a solid, without those that are flat."""
    return [piece for part in solid.decompose() if (piece := _piece(part, gap, openings)) is not None]


def _piece(solid: Manifold, gap: float, openings: Openings) -> _SolidPiece | None:
    if solid.volume() <= KERF * solid.surface_area():
        return None
    mesh = solid.to_mesh64()
    triangles = np.asarray(mesh.vert_properties)[:, :3][np.asarray(mesh.tri_verts, np.int64)]
    hull = hull_of(triangles.reshape(-1, 3))
    if hull is None:
        return None
    convex = solid.volume() >= (1 - CONVEX) * volume(hull)
    return _SolidPiece(triangles, hull, 0.0 if convex else _excess(hull, triangles, gap, openings), solid)


def _excess(hull: Hull, triangles: np.ndarray, gap: float, openings: Openings, limit: float = np.inf) -> float:
    """Return `_gap`, or more than `gap` for a hull that reaches into openings."""
    lost = float(openings.lost(hull).max(initial=0.0))
    return gap + lost if lost > 0 else _gap(hull, triangles, limit, openings)


def _gap(hull: Hull, triangles: np.ndarray, limit: float = np.inf, openings: Openings = NONE) -> float:
    """Return the maximum distance of sample points of a hull from surfaces inside it, or any distance above `limit`.

    In openings, what their balls allow is subtracted.
    """
    sides = hull.vertices[hull.faces]
    largest = np.argsort(-normals_and_areas(sides)[1], kind="stable")[:FEW]
    middle = sides[largest].mean(1)
    first = float((distance_to_triangles(middle, triangles) - openings.slack(middle)).max())
    if first > limit:
        return first
    points = np.concatenate([sample_surface(sides, SAMPLES, 0).points, sides.mean(1)])
    return float((distance_to_triangles(points, triangles) - openings.slack(points)).max())


def _halves(
    piece: _SolidPiece, planes: Sequence[Plane], gap: float, wall: float, budget: _Budget, openings: Openings
) -> list[_SolidPiece]:
    """Return the pieces on both sides of the plane that leaves the least volume in their hulls; empty if no plane divides.

    If the piece's hull reaches into openings, the plane is used by which they lose least.
    """
    assert piece.solid is not None  # only merged pieces have none
    outlined = outline(piece.triangles)
    # of a smooth solid, the other planes at concave edges are those of its many sides
    main = planes[:SMOOTH_PLANES] if len(planes) > FACETED_PLANES else planes
    ordered = openings.cuts(piece.hull, outlined, list(_concave(piece, main)))
    if not ordered:
        candidates = [*_candidates(piece, planes, wall), *openings.halving(openings.near(piece.hull), outlined[0])]
        ordered = [candidates[k] for k in least_volume_first(outlined, candidates)]
    for normal, offset in ordered:
        budget.spend(FACES_PER_CUT + 2 * len(piece.triangles))
        above = piece.solid.trim_by_plane(tuple(normal.tolist()), offset + KERF)
        below = piece.solid.trim_by_plane(tuple((-normal).tolist()), KERF - offset)
        sides = [_pieces(above, gap, openings), _pieces(below, gap, openings)]
        if all(sides):
            return sides[0] + sides[1]
    return []


def _candidates(piece: _SolidPiece, planes: Sequence[Plane], wall: float) -> Iterator[Plane]:
    """Yield planes at concave edges of the whole solid that pass through a piece, and others if it has few or is smooth."""
    through = list(_concave(piece, planes))
    yield from through
    if len(planes) > FACETED_PLANES or not through:
        yield from cutting_planes(piece.triangles, wall)


def _concave(piece: _SolidPiece, planes: Sequence[Plane]) -> Iterator[Plane]:
    """Yield the first planes at concave edges of the whole solid that pass through a piece."""
    points = piece.hull.vertices
    most = SMOOTH_PLANES if len(planes) > FACETED_PLANES else PLANES_PER_CUT
    for normal, offset in planes:
        along = points @ normal
        if most and along.min() < offset - KERF and along.max() > offset + KERF:
            yield normal, offset
            most -= 1


def _merge_pieces(
    pieces: Sequence[_SolidPiece], gap: float, most: int, budget: _Budget, openings: Openings = NONE
) -> list[_SolidPiece]:
    """Merge touching pieces while their common hull is within `gap` of them, or there are more than `most`.

    Pairs whose common hull adds the least volume are merged first; beyond `gap`, those that take the least of the openings.
    """
    kept = dict(enumerate(pieces))
    number = itertools.count(len(kept))
    queue: list[tuple[float, int, int]] = []
    refused: list[tuple[float, float, int, int]] = []
    for a, b in itertools.combinations(kept, 2):
        _queue_pair(queue, kept, a, b)
    while queue or (refused and len(kept) > most):
        forced = not queue
        pair = heapq.heappop(refused)[1:] if forced else heapq.heappop(queue)
        _, a, b = pair
        both = _joined(kept[a], kept[b], gap, openings) if a in kept and b in kept else None
        if both is None:
            continue
        budget.spend(len(both.triangles))
        if both.gap > gap and not forced:
            heapq.heappush(refused, (openings.taken(both.hull), *pair))
            continue
        del kept[a], kept[b]
        new = next(number)
        kept[new] = both
        for other in kept:
            if other != new:
                _queue_pair(queue, kept, other, new)
    return list(kept.values())


def _queue_pair(queue: list[tuple[float, int, int]], pieces: dict[int, _SolidPiece], a: int, b: int) -> None:
    """Queue a pair of pieces by the volume that their common hull adds, if their bounds touch."""
    first, second = pieces[a].hull, pieces[b].hull
    near = (first.vertices.min(0) <= second.vertices.max(0) + TOUCH) & (second.vertices.min(0) <= first.vertices.max(0) + TOUCH)
    if not near.all():
        return
    common = hull_volume(np.concatenate([first.vertices, second.vertices]))
    heapq.heappush(queue, (common - volume(first) - volume(second), a, b))


def _joined(first: _SolidPiece, second: _SolidPiece, limit: float, openings: Openings) -> _SolidPiece | None:
    hull = hull_of(np.concatenate([first.hull.vertices, second.hull.vertices]))
    if hull is None:
        return None
    triangles = np.concatenate([first.triangles, second.triangles])
    return _SolidPiece(triangles, hull, _excess(hull, triangles, limit, openings, limit))
