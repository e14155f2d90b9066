"""Openings of a surface: the largest balls that fit between its walls, inside its hull, and what convex shapes leave of them.

A ball stands for the free space around its center, as in the local thickness of Hildebrand and Ruegsegger (1997). It grows at
a point of the surface until it touches a second one (the shrinking ball of Ma, Bae and Choi, 2012). A convex shape must leave
most of each ball free, whatever the size of the opening: an absolute distance would fill narrow bores, and one measured at the
hull ranks all cuts through a ring alike.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.geometry.distance_ import TriangleTree, distance_to_triangles
from anymesh.geometry.topology import label_connected
from anymesh.geometry.triangle_set import sample_surface, spread_directions
from anymesh.physics.convex import planes, volume
from anymesh.types import Brief, Hull
from anymesh.types.triangles import face_cross, normals_and_areas

CONVEX = 1 - 1e-6  # of the volume of its hull: a solid that fills more has no openings
WIDTH = 0.15  # of the second largest extent of a surface: radius from which round openings count, between gap / 4 and gap
SAMPLES, MOST_FACES = 200, 600  # points by area, and faces whose centers are points too
KERF = 2e-5  # half the width of a cut, relative to the diagonal; a cut without width leaves thin layers where it meets a face
ROUNDS = 12  # of shrinking a ball
COARSE, FINE = (1.0,) * 6 + (0.5, 0.5), (0.25, 0.1, 0.05, 0.02, 0.01)  # steps of a center towards the middle, in radii
SMALLER = 0.85  # a ball with its center in another one stands for a corner if its radius is a smaller share
DEEP = 1e-4  # of the diagonal: minimum depth of a center in the hull
APART = 0.25  # of the radius: balls that are closer stand for one place
MAX_BALLS = 192  # balls, the largest first
KEPT, KEPT_ROUND, KEPT_MOST = 0.91, 0.905, 0.985  # share of the radius to keep; of that to the corners, of a polygon; at most
POLYGON = 1.11  # radius to the corners over that to the sides, for polygons of 7 sides and more
SAME_WAY_DEG, BEND_DEG = 30.0, 25.0  # [deg] between axes of neighbours in one channel; in a channel that is cut across
BENT_LESS = 0.7  # of the bend, as 1 - cosine: what a cut across a channel leaves at most
LOOKS, LEAN = 32, 0.35  # directions in which walls are looked for; mean of those with walls, from which they are on one side
ROUND_WALL, ALL_AROUND = 0.62, 0.9  # of the radius: distance of walls halfway to them; share of directions that have such walls
FACING, BESIDE = 0.7, 0.3  # cosine from which a wall faces a center, and maximum cosine to the axis of walls beside it
HALVED = 0.2  # mean of the directions to a piece, from which it lies on one side
UNUSUAL = 0.8  # of what is lost after the best of the usual cuts: at most this must be lost after another one
TOUCHED = 1.1  # of the radius, for a hull that touches a ball
PLACES, ANGLES = 3, 8  # balls whose planes are tried per cut, and planes through the axis of each
Plane = tuple[np.ndarray, float]  # unit normal and offset
Balls = tuple[np.ndarray, np.ndarray]  # centers and radii


@dataclass(frozen=True, eq=False)
class Openings(Brief):
    """Balls in the openings of a surface [its unit].

    centers, radii; kept: distance that convex shapes must keep from each center; axes: unit direction of the opening there;
    corner: a corner of the wall nearest to the center; round: whether walls are all around, in a circle or a polygon with many
    sides.
    """

    centers: Float[np.ndarray, "m 3"]
    radii: Float[np.ndarray, " m"]
    kept: Float[np.ndarray, " m"]
    axes: Float[np.ndarray, "m 3"]
    corner: Float[np.ndarray, "m 3"]
    round: Bool[np.ndarray, " m"]

    def __len__(self) -> int:
        return len(self.radii)

    def distances(self, hull: Hull) -> Float[np.ndarray, " m"]:
        """Return the distance of each center from a hull, negative inside, exact where it matters."""
        sides = planes(hull)
        height = (self.centers @ sides[:, :3].T + sides[:, 3]).max(1)
        unsure = np.flatnonzero((height > 0) & (height < self.kept))
        if len(unsure):
            height[unsure] = distance_to_triangles(self.centers[unsure], hull.vertices[hull.faces])
        return height

    def lost(self, hull: Hull) -> Float[np.ndarray, " m"]:
        """Return how far a hull reaches into the balls beyond what is allowed, in radii; 0 for most."""
        return np.maximum(self.kept - self.distances(hull), 0) / self.radii if len(self) else np.zeros(0)

    @staticmethod
    def joined(some: Sequence[Openings]) -> Openings:
        """Concatenate openings."""
        return Openings(*(np.concatenate([getattr(o, f.name) for o in (NONE, *some)]) for f in fields(Openings)))

    def share_kept(self, hulls: Sequence[Hull]) -> float:
        """Return the mean share of the radius that hulls leave free, 1 without openings. Larger balls count more."""
        if not len(self) or not hulls:
            return 1.0
        free = np.min([self.distances(hull) for hull in hulls], axis=0) / self.radii
        return float(np.average(np.clip(free, 0, 1), weights=self.radii))

    def slack(self, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, " n"]:
        """Return how far from the surface a hull may be at some points, by the balls around them; 0 outside of all."""
        away = np.linalg.norm(points[:, None] - self.centers, axis=2)
        return np.where(away <= 1.05 * self.radii, 1.05 * self.radii - self.kept, 0.0).max(1, initial=0.0)

    def near(self, hull: Hull) -> Float[np.ndarray, " m"]:
        """Return 1 for the balls that a hull touches or nearly touches, 0 for others."""
        return (self.distances(hull) < TOUCHED * self.radii).astype(float)

    def taken(self, hull: Hull) -> float:
        """Return how far a hull reaches into the balls in all, weighted by their radius, rounded."""
        return round(float(self.lost(hull) @ self.radii**2), 12)

    def moved(self, by: Float[np.ndarray, " 3"], scale: float) -> Openings:
        """Return the openings after a shift and a scaling about the origin."""
        centers, corner = (self.centers + by) * scale, (self.corner + by) * scale
        return Openings(centers, self.radii * scale, self.kept * scale, self.axes, corner, self.round)

    def _planes(self, lost: Float[np.ndarray, " m"]) -> Iterator[Plane]:
        """Yield planes through the axes of the openings that lose most.

        Only the one across a bend of a channel if there is one.
        """
        if (bend := self._bend(np.flatnonzero(lost * self.radii > self.kept))) is not None:  # centers inside the hull
            yield self.axes[bend], float(self.axes[bend] @ self.centers[bend])
            return
        for k in self._places(lost):
            center, axis = self.centers[k], self.axes[k]
            across, far = (v - np.outer(v @ axis, axis) for v in (self.corner[[k]] - center, self.centers[lost > 0] - center))
            start = across[0] if np.linalg.norm(across) > APART * self.radii[k] else _around(axis[None])[0, 0]
            side = np.cross(axis, start)
            normals = [np.cos(t) * side - np.sin(t) * start for t in np.arange(ANGLES) * np.pi / ANGLES]
            away = np.linalg.norm(far, axis=1)
            if away.max() > self.radii[k]:
                normals.append(np.cross(axis, far[away.argmax()]))
            yield from ((n / np.linalg.norm(n), float(n @ center / np.linalg.norm(n))) for n in normals)

    def halving(self, of: Float[np.ndarray, " m"], points: Float[np.ndarray, "V 3"]) -> Iterator[Plane]:
        """Yield planes across the axes, and planes that halve a piece with some corners as seen from the centers.

        of: positive for the balls in question, the highest first.
        """
        for k in self._places(of):
            center = self.centers[k]
            yield self.axes[k], float(self.axes[k] @ center)
            seen = points - center
            seen /= np.maximum(np.linalg.norm(seen, axis=1), 1e-300)[:, None]
            middle = seen.mean(0)
            if (length := float(np.linalg.norm(middle))) > HALVED:
                beside = seen - np.outer(seen @ middle, middle) / length**2
                yield from ((n, float(n @ center)) for n in np.linalg.eigh(beside.T @ beside)[1].T[:0:-1])

    def cuts(
        self, hull: Hull, outlined: tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "E 2"]], others: Sequence[Plane] = ()
    ) -> list[Plane]:
        """Return planes to divide a piece with a hull that reaches into openings, best first; empty for another hull."""
        lost = self.lost(hull)
        if not lost.any():
            return []
        usual = [*self._planes(lost), *others]
        candidates = [*usual, *self.halving(lost, outlined[0])]
        return [candidates[k] for k in self._best_first(outlined, candidates, lost, len(usual))]

    def _places(self, lost: Float[np.ndarray, " m"]) -> list[int]:
        """Return balls that lose most, without those with their centers in others."""
        places: list[int] = []
        for k in np.argsort(-np.round(lost * self.radii, 9), kind="stable"):
            if lost[k] > 0 and all(np.linalg.norm(self.centers[k] - self.centers[j]) > self.radii[j] for j in places):
                places.append(int(k))
            if len(places) == PLACES:
                break
        return places

    def _bend(self, some: Int[np.ndarray, " k"]) -> int | None:
        """Return the ball at which a cut across a bent channel leaves the least bends; None if all channels are straight."""
        c, r, a = self.centers[some], self.radii[some], self.axes[some]
        cosines = np.abs(a @ a.T)
        joined = (np.linalg.norm(c[:, None] - c, axis=2) < r[:, None] + r) & (cosines > np.cos(np.deg2rad(SAME_WAY_DEG)))
        label = label_connected(len(some), np.argwhere(joined))
        bent = cosines < np.cos(np.deg2rad(BEND_DEG))
        for one in np.unique(label[(bent & (label[:, None] == label)).any(1)]):
            of = np.flatnonzero(label == one)
            side = np.einsum("kni,ki->kn", c[of] - c[of][:, None], a[of]) > 0
            angle = 1 - cosines[np.ix_(of, of)]
            left = [max(float(angle[np.ix_(s, s)].max(initial=0)) for s in (row, ~row)) for row in side]
            best = int(np.argmin(np.round(left, 3)))
            if left[best] < BENT_LESS * float(angle.max()):
                return int(some[of[best]])
        return None

    def _best_first(
        self,
        outlined: tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "E 2"]],
        candidates: Sequence[Plane],
        lost: Float[np.ndarray, " m"],
        usual: int,
    ) -> list[int]:
        """Return the order of planes by what hulls of both sides take of the openings, the least first.

        usual: number of the first planes that are preferred. Planes that leave all of it are left out.

        Distances are lower bounds, by the extent of a side along some directions.
        """
        (points, ends), some = outlined, np.flatnonzero(lost > 0)
        kerf = KERF * float(np.linalg.norm(np.ptp(points, axis=0)))
        ways = _ways(self.axes[some], [normal for normal, _ in candidates])
        centers, kept, radii = self.centers[some] @ ways.T, self.kept[some], self.radii[some]
        along = points @ ways.T
        before = float(np.maximum(kept - (along.min(0) - centers).max(1), 0) @ radii)
        loss = np.zeros(len(candidates))
        for n, (normal, offset) in enumerate(candidates):
            height = points @ normal - offset
            sides = []
            for signed in (height - kerf, -height - kerf):
                start, end = signed[ends.T]
                a, b = ends[start * end < 0].T
                met = along[a] + (along[b] - along[a]) * (signed[a] / (signed[a] - signed[b]))[:, None]
                sides.append(np.minimum(along[signed > 0].min(0, initial=np.inf), met.min(0, initial=np.inf)))
            worst = np.max([kept - (low - centers).max(1) for low in sides], axis=0)
            loss[n] = float(np.maximum(worst, 0) @ radii)
        better = np.flatnonzero(loss < (1 - 1e-4) * before)
        order = np.where(better < usual, UNUSUAL, 1.0) * loss[better] / max(before, 1e-300)
        return better[np.argsort(np.round(order, 6), kind="stable")].tolist()


NONE = Openings(np.zeros((0, 3)), np.zeros(0), np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0, bool))


def _ways(axes: Float[np.ndarray, "m 3"], normals: Sequence[np.ndarray]) -> Float[np.ndarray, "k 3"]:
    """Return directions all around, around and along up to three distinct ones of some axes, and along some normals."""
    kept: list[np.ndarray] = []
    for axis in axes:
        if len(kept) < 3 and all(abs(axis @ other) < 0.95 for other in kept):
            kept.append(axis)
    along = np.unique(np.round([*kept, *normals], 6), axis=0)
    return np.concatenate([spread_directions(48), _around(np.array(kept), 32).reshape(-1, 3), along, -along])


def _around(axes: Float[np.ndarray, "m 3"], count: int = 8) -> Float[np.ndarray, "m k 3"]:
    """Return directions around each axis."""
    u = np.cross(axes, np.eye(3)[np.abs(axes).argmin(1)])
    u /= np.linalg.norm(u, axis=1)[:, None]
    turns = np.arange(count)[:, None] / count * 2 * np.pi
    return np.cos(turns) * u[:, None] + np.sin(turns) * np.cross(axes, u)[:, None]


def openings_of(triangles: Float[np.ndarray, "n 3 3"], hull: Hull, gap: float, *, solid: bool) -> Openings:
    """Return the openings of a surface, given its hull, with a radius of at least `gap`, and smaller ones if they are round.

    solid: closed, and wound outwards. Of another surface, which both sides of its sheets look into, only the round ones.
    """
    t = triangles - triangles[0, 0]
    if solid and float(np.einsum("ij,ij->", t[:, 0], face_cross(t))) / 6 >= CONVEX * volume(hull):
        return NONE
    least = min(max(WIDTH * float(np.sort(np.ptp(hull.vertices, axis=0))[1]), gap / 4), gap)
    tree = TriangleTree(triangles)
    normals, areas = normals_and_areas(triangles)
    sampled = sample_surface(triangles, SAMPLES, 0)
    faces = np.flatnonzero(areas > 0)
    faces = faces[np.unique(np.linspace(0, len(faces) - 1, MOST_FACES).astype(int))]
    points = np.concatenate([triangles[faces].mean(1), sampled.points])
    facing = np.concatenate([normals[faces], normals[sampled.faces]])
    if not solid:
        points, facing = np.tile(points, (2, 1)), np.concatenate([facing, -facing])
    size = float(np.linalg.norm(np.ptp(triangles.reshape(-1, 3), axis=0)))
    sides = planes(hull)
    sides[:, 3] += DEEP * size  # centers lie inside by more than rounding
    c, r = _inside(sides, *_balls(tree, points, facing, size, least / 4), least / 4)
    for steps in (COARSE, FINE):
        c, r = _widest(tree, sides, *_distinct(c, r, 2 * MAX_BALLS), steps)
    c, r = _distinct(*_inside(sides, c, r, least), MAX_BALLS)
    if not len(c):
        return NONE
    walls = triangles[tree.nearest(c)[1]]
    axes = _axes(c, r, _free_axes(_around_centers(tree, c, r)[0])[0], points, facing)
    halfway = c[:, None] + 0.5 * r[:, None, None] * _around(axes, LOOKS)
    walled = tree.distance(halfway.reshape(-1, 3)).reshape(len(c), -1) < ROUND_WALL * r[:, None]
    round_ = walled.mean(1) > ALL_AROUND
    corner = _corners(c, walls, axes)
    to_corner = np.linalg.norm(corner - c, axis=1)
    keep = np.where(round_, np.clip(KEPT_ROUND * to_corner, KEPT * r, KEPT_MOST * r), KEPT * r)
    keep = np.where(to_corner <= POLYGON * r, keep, KEPT * r)
    kept = round_ | (solid & (r >= gap))
    return Openings(*(some[kept] for some in (c, r, keep, axes, corner, round_)))


def _corners(c: np.ndarray, walls: np.ndarray, axes: np.ndarray) -> np.ndarray:
    """Return the point nearest to each center on the line of the edge of a wall that is closest to an axis in direction."""
    edges = np.roll(walls, -1, axis=1) - walls
    edges /= np.maximum(np.linalg.norm(edges, axis=2, keepdims=True), 1e-300)
    rows = np.arange(len(c))
    most = np.abs((edges * axes[:, None]).sum(2)).argmax(1)
    start, edge = walls[rows, most], edges[rows, most]
    return start + ((c - start) * edge).sum(1)[:, None] * edge


def _inside(sides: np.ndarray, centers: np.ndarray, radii: np.ndarray, least: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the balls with a center between the planes of a hull, and a radius of at least `least`."""
    inside = (centers @ sides[:, :3].T + sides[:, 3]).max(1, initial=-np.inf) < 0
    return centers[inside & (radii >= least)], radii[inside & (radii >= least)]


def _distinct(c: np.ndarray, r: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Return balls, the largest first, without those in corners beside larger ones, and one at each place."""
    order = np.argsort(-np.round(r / max(float(r.max(initial=0)), 1e-300), 4), kind="stable")
    c, r = c[order], r[order]
    x, y, z = (column[:, None] - column for column in c.T)
    away = np.sqrt(x * x + y * y + z * z)  # in a third of the time of `norm`
    left = ~((away < r) & (r[:, None] < SMALLER * r)).any(1)
    chosen: list[int] = []
    while len(chosen) < most and left.any():
        chosen.append(int(left.argmax()))
        left &= away[chosen[-1]] > APART * r
    return c[chosen], r[chosen]


def _balls(tree: TriangleTree, points: np.ndarray, normals: np.ndarray, size: float, least: float) -> Balls:
    """Return the largest empty ball that touches the surface at each point, up to `size`; any or 0 below `least`."""
    radii = np.full(len(points), size)
    left = np.arange(len(points))
    for _ in range(ROUNDS):
        distance, _, touched = tree.nearest(points[left] + normals[left] * radii[left, None])
        inner = distance < (1 - 1e-3) * radii[left]
        left, touched = left[inner], touched[inner]
        if not len(left):
            break
        chord = touched - points[left]
        along = np.einsum("ij,ij->i", chord, normals[left])
        squared = (chord**2).sum(1)
        real = (along > 0) & (squared > (1e-5 * size) ** 2)
        radii[left] = np.where(real, squared / np.where(real, 2 * along, 1.0), 0.0)
        left = left[radii[left] >= least]
    radii[left], radii[radii == size] = 0.0, 0.0  # what touches nothing else has its center outside of the hull
    return points + normals * radii[:, None], radii


def _axes(c: np.ndarray, r: np.ndarray, rough: np.ndarray, points: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Return the axis at each center across which the walls beside it face, near a rough one."""
    to = c[:, None] - points
    away = np.linalg.norm(to, axis=2)
    beside = (away < 1.3 * r[:, None]) & (np.einsum("mnk,nk->mn", to, normals) >= FACING * away)
    beside &= np.abs(rough @ normals.T) < BESIDE
    axes = np.linalg.eigh(np.einsum("mn,ni,nj->mij", beside.astype(float), normals, normals))[1][:, :, 0]
    return np.where(np.abs((axes * rough).sum(1)) > 1 - BESIDE, axes.T, rough.T).T


def _widest(tree: TriangleTree, sides: np.ndarray, c: np.ndarray, r: np.ndarray, steps: Sequence[float]) -> Balls:
    """Return the balls after each has moved to the widest place at each of some steps, if there is a wider one in the hull.

    No place is wider than its distance from a known point of a wall, and a ball that did not move finds none at the same step.
    """
    c, r = c.copy(), r.copy()
    near, walls = np.zeros((len(c), LOOKS)), np.zeros((len(c), LOOKS, 3))
    moved, before = np.arange(len(c)), np.inf
    for step in steps:
        near[moved], walls[moved] = _around_centers(tree, c[moved], r[moved])
        some = moved if step == before else np.arange(len(c))
        ways, before = _free_ways(near)[some], step
        tried = c[some, None] + step * r[some, None, None] * ways
        to = (walls[some] - c[some, None]) / r[some, None, None]
        squared = to @ (-2 * step * ways).transpose(0, 2, 1) + (to * to).sum(2)[:, :, None]  # distances, less that of the step
        asked = squared.min(1) + step**2 > 1 - 1e-9
        asked[asked] = (tried[asked] @ sides[:, :3].T + sides[:, 3]).max(1, initial=-np.inf) < 0
        wider = np.zeros(asked.shape)
        wider[asked] = tree.distance(tried[asked])
        best, rows = wider.argmax(1), np.arange(len(some))
        better = wider[rows, best] > r[some]
        moved = some[better]
        c[moved], r[moved] = tried[rows, best][better], wider[rows, best][better]
    return c, r


def _around_centers(tree: TriangleTree, c: np.ndarray, r: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return how near walls are to places around each center (0..1), and the nearest point of a wall to each of these."""
    distance, _, wall = tree.nearest((c[:, None] + 0.5 * r[:, None, None] * spread_directions(LOOKS)).reshape(-1, 3))
    near = np.clip(3 - 4 * distance.reshape(-1, LOOKS) / np.maximum(r, 1e-300)[:, None], 0, 1)
    return near, wall.reshape(-1, LOOKS, 3)


def _free_axes(near: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the direction in which there are least walls around each center, and by how much they are on one side (0..1)."""
    ways = spread_directions(LOOKS)
    axes = np.linalg.eigh(np.einsum("mk,ki,kj->mij", near, ways, ways))[1][:, :, 0]
    return axes, np.linalg.norm(near @ ways, axis=1) / np.maximum(near.sum(1), 1e-300)


def _free_ways(near: np.ndarray) -> np.ndarray:
    """Return directions in which to move each center: across the axis of an opening, all around where walls are on one side."""
    axes, lean = _free_axes(near)
    ways = np.tile(spread_directions(LOOKS), (len(near), 1, 1))
    ways -= np.where(lean > LEAN, 0.0, (ways * axes[:, None]).sum(2).T).T[:, :, None] * axes[:, None]
    return ways / np.maximum(np.linalg.norm(ways, axis=2, keepdims=True), 1e-300)
