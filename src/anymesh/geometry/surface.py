"""The surface of a mesh as both stages use it: without copies of faces, wound outwards, in connected components.

Copies are faces that lie where other faces lie: doubled surfaces, and the backs of surfaces that were modelled with two sides.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from jaxtyping import Bool, Float, Int, Shaped

from anymesh.geometry.distance_ import TriangleTree, winding_number
from anymesh.geometry.holes import missing_triangles
from anymesh.geometry.simplify_ import simplify, smallest_index_first
from anymesh.geometry.topology import MAX_CRACK_RATIO, Components, components, label_connected, weld, without_cracks
from anymesh.geometry.triangle_set import TriangleSet, spread_directions, spread_points
from anymesh.types import Brief, Mesh
from anymesh.types.triangles import centers_of, corner_bounds, corners_of, label_bounds, normals_and_areas, unshared

BACK_TO_BACK_COSINE = 0.999  # minimum cosine between the normals of a face and one that lies on it, up to the sign
SAME_AREA = 1e-6  # maximum relative difference of the areas of copies
LOOKING_POINTS = 1500  # points on open surfaces from which both sides look outside
LOOKS = 8  # directions in which each point looks
MIN_SEEN_MORE = 0.3  # share of these rays by which one side must see more than the other; less is chance
MIN_GROUND_RATIO = 1.2  # minimum sides of a ground, relative to those of what stands on it
MAX_GROUND_HEIGHT_RATIO = 0.05  # of the diagonal of what stands on it: maximum height of a ground


@dataclass(frozen=True, eq=False)
class MeshSurface(Brief):
    """The faces of an object without copies, and the connected components of its welded surface.

    shape: K faces, wound so that those of a component agree and face outwards; components: of these faces; copy: (F,) face of
    the mesh that each one copies, itself for the K; row: (F,) index of that one among the K.
    """

    shape: TriangleSet
    components: Components
    void: Bool[np.ndarray, " c"]  # components that are walls of a closed cavity in another one
    vertices: Float[np.ndarray, "V 3"]
    diagonal: float
    copy: Int[np.ndarray, " F"]
    row: Int[np.ndarray, " F"]


def mesh_surface(mesh: Mesh, seed: int = 0) -> MeshSurface:
    """Orient the faces of a mesh and find its components; the mesh is not modified.

    Neither winding nor copies of faces count, which careless exports make at will. Open components face the side from which
    more of the outside is seen.
    """
    copy, parts = without_copies(mesh.vertices, mesh.faces)
    kept = originals(copy)
    row = np.searchsorted(kept, copy)
    void = _voids(mesh, kept, parts)
    flip = parts.flip ^ void[parts.label]
    shape = _wound(mesh, kept, flip, parts, seed)
    behind = seen_from_behind(shape, parts.label, ~shape.solid)
    if behind.any():
        flip = flip ^ behind
        shape = _wound(mesh, kept, flip, parts, seed)
    f, g = parts.edges.faces.T
    edges = replace(parts.edges, aligned=parts.edges.aligned ^ flip[f] ^ flip[g])
    return MeshSurface(shape, replace(parts, edges=edges), void, mesh.vertices, mesh.diagonal, copy, row)


def _wound(mesh: Mesh, kept: Int[np.ndarray, " K"], flip: Bool[np.ndarray, " K"], parts: Components, seed: int) -> TriangleSet:
    """Return some faces of a mesh, some of them reversed."""
    triangles = mesh.triangles.take(kept, axis=0)
    triangles[flip] = triangles[flip, ::-1]
    return TriangleSet(triangles, normals_and_areas(triangles)[0], parts.solid[parts.label], kept, seed)


def _voids(mesh: Mesh, kept: Int[np.ndarray, " K"], parts: Components) -> Bool[np.ndarray, " c"]:
    """Return which components of some faces of a mesh are mostly inverted and lie within a solid one: walls of its cavities.

    If all others lie in the bounds of inverted solids, the object is inside out, and these are its cavities. Only the winding
    tells a cavity from a solid inside: if each face is wound by chance, there is none.
    """
    void = np.zeros(parts.count, bool)
    areas = mesh.face_areas[kept]
    turned = np.bincount(parts.label, np.where(parts.flip, areas, -areas), parts.count) > 0
    solid, inverted = np.flatnonzero(parts.solid & ~turned), np.flatnonzero(parts.solid & turned)
    if not (len(solid) and len(inverted)):
        return void
    order = np.argsort(parts.label, kind="stable")
    start = np.searchsorted(parts.label[order], np.arange(parts.count + 1))
    triangles = mesh.triangles.take(kept[order], axis=0)
    triangles = np.where(parts.flip[order][:, None, None], triangles[:, ::-1], triangles)
    low, high = label_bounds(parts.label[order], *corner_bounds(triangles))
    if all(((low[inverted] < low[s]) & (high[inverted] > high[s])).all(1).any() for s in solid):
        solid, inverted = inverted, solid
    points = triangles[start[inverted]].mean(1)  # one on each inverted component
    for s in solid:
        there = np.flatnonzero(~void[inverted] & ((points > low[s]) & (points < high[s])).all(1))
        if len(there):
            corners = triangles[start[s] : start[s + 1]].reshape(-1, 3)
            _, first, index = np.unique(weld(corners), return_index=True, return_inverse=True)
            void[inverted[there]] = winding_number(points[there], corners[first], index.reshape(-1, 3)) > 0.5
    return void


def seen_from_behind(shape: TriangleSet, label: Int[np.ndarray, " F"], asked: Bool[np.ndarray, " F"]) -> Bool[np.ndarray, " F"]:
    """Return the faces of components that see more of the outside behind them than on the side that they face.

    asked: faces of the components in question. Surfaces are modelled to be seen, so the side that sees the outside is the outer
    one, whatever the winding. A sheet that is seen from both sides stays as it is.
    """
    faces = np.flatnonzero(asked)
    if not len(faces):
        return np.zeros(len(label), bool)
    triangles, normals, areas, scene = shape.triangles[faces], shape.normals[faces], shape.areas[faces], shape.scene
    points, at = spread_points(triangles, areas, LOOKING_POINTS, shape.seed)
    largest = _largest(label[faces], areas)[:LOOKING_POINTS]
    points, at = np.concatenate([points, centers_of(triangles[largest])]), np.concatenate([at, largest])
    ways = spread_directions(LOOKS)
    ahead = normals[at] @ ways.T > 0
    # a little off the surface, on the side that the ray leaves from
    start = points[:, None] + 1e-4 / scene.scale * np.where(ahead, 1.0, -1.0)[:, :, None] * normals[at][:, None]
    rays = np.broadcast_to(ways, start.shape)
    outside = scene.first_hit(start.reshape(-1, 3), rays.reshape(-1, 3)).face.reshape(ahead.shape) < 0
    count = int(label.max()) + 1
    lead = np.bincount(label[faces[at]], (outside & ahead).sum(1) - (outside & ~ahead).sum(1), count)
    cast = np.bincount(label[faces[at]], np.full(len(at), LOOKS / 2), count)
    return asked & (lead < -MIN_SEEN_MORE * cast)[label]


def _largest(label: Int[np.ndarray, " n"], areas: Float[np.ndarray, " n"]) -> Int[np.ndarray, " c"]:
    """Return the largest face of each component, the largest first."""
    order = np.lexsort((-areas, label))
    first = order[np.r_[True, np.diff(label[order]) != 0]]
    return first[np.argsort(-areas[first], kind="stable")]


def plain_triangles(
    triangles: Float[np.ndarray, "F 3 3"], diagonal: float
) -> tuple[Float[np.ndarray, "K 3 3"], Int[np.ndarray, " K"]]:
    """Return some triangles without copies and cracks, wound outwards, and which they are.

    Triangles that are missing from closed surfaces are added, each as a copy of one beside it (`missing_triangles`).

    diagonal: of the object that they are part of [m].
    """
    vertices, faces, kept, parts = _plain(*unshared(triangles), diagonal)
    plain = corners_of(vertices, np.where(parts.flip[:, None], faces[:, ::-1], faces))
    missing, beside = (np.zeros((0, 3, 3)), np.zeros(0, np.int64)) if parts.solid.all() else missing_triangles(plain)
    return np.concatenate([plain, missing]), np.concatenate([kept, kept[beside]])


def open_surface(
    vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], diagonal: float
) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, " K"]]:
    """Return vertices without cracks, and the faces that are no copies and belong to no closed surface, however it is wound.

    diagonal: of the object that they are part of [m].
    """
    closed, _, kept, parts = _plain(vertices, faces, diagonal)
    return closed, kept[~parts.solid[parts.label]]


def _plain(
    vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], diagonal: float
) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "K 3"], Int[np.ndarray, " K"], Components]:
    """Return vertices without cracks, the faces that are no copies, their indices, and their components."""
    first, parts = without_copies(vertices, faces)
    kept = originals(first)
    closed, faces = without_cracks(vertices, faces[kept], MAX_CRACK_RATIO * diagonal), faces[kept]
    return closed, faces, kept, parts if closed is vertices else components(closed, faces)


def ground_faces(mesh: Mesh) -> Bool[np.ndarray, " F"]:
    """Return which faces are the ground: the level component below all others, if it reaches beyond them on all sides."""
    parts = components(mesh.vertices, mesh.faces)
    low, high = label_bounds(parts.label, *corner_bounds(mesh.triangles))
    widest = int(np.prod((high - low)[:, :2], axis=1).argmax())
    others = np.arange(len(low)) != widest
    if not others.any():
        return np.zeros(len(parts.label), bool)
    bottom, top = low[others].min(0), high[others].max(0)
    sides, height = high[widest] - low[widest], MAX_GROUND_HEIGHT_RATIO * np.linalg.norm(top - bottom)
    beyond = (low[widest, :2] < bottom[:2]).all() and (high[widest, :2] > top[:2]).all()
    wide = (sides[:2] >= MIN_GROUND_RATIO * (top - bottom)[:2]).all()
    level = sides[2] <= height and bottom[2] >= low[widest, 2] - height
    return (parts.label == widest) & bool(beyond and wide and level)


def without_copies(
    vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"]
) -> tuple[Int[np.ndarray, " F"], Components]:
    """Return for each face the one that it copies, itself for most, and the components of the faces that copy none.

    Copies are all but one of connected surfaces that are there several times, whatever the winding of each face; components
    with the corners and the area of an earlier one, such as backs that are divided along other diagonals; and faces with the
    corners and the winding of an earlier one. Where solids touch, single faces lie on each other, and are no copies.
    """
    corner = weld(vertices).take(faces)
    place = _places(corner)
    first = _several_times(corner, place)
    kept = originals(first)
    parts = components(vertices, faces[kept])
    of_components = _same_components(corner[kept], corners_of(vertices, faces[kept]), parts)
    left = kept[originals(of_components)]
    of_faces = np.arange(len(faces))
    if len(_repeated(place[left])):
        wound = _number_wound(corner[left])
        of_faces[left] = left[np.unique(wound, return_index=True)[1][wound]]
    first = of_faces[kept[of_components]][np.searchsorted(kept, first)]
    last = originals(first)
    return first, parts if len(last) == len(kept) else components(vertices, faces[last])


def originals(first: Int[np.ndarray, " F"]) -> Int[np.ndarray, " K"]:
    """Return the faces that copy none, by what each face copies."""
    return np.flatnonzero(first == np.arange(len(first)))


def _repeated(number: Shaped[np.ndarray, " n"]) -> Shaped[np.ndarray, " m"]:
    """Return the numbers that are there more than once, in order."""
    ordered = np.sort(number)
    return ordered[1:][ordered[1:] == ordered[:-1]]


def _several_times(corner: Int[np.ndarray, "F 3"], place: Int[np.ndarray, " F"]) -> Int[np.ndarray, " F"]:
    """Return the copies of surfaces of which all faces are there equally often.

    The number is the greatest common divisor over a surface, since two solids that touch have two faces at some places.
    place: number of the corners of each face.
    """
    first = np.arange(len(corner))
    count = np.bincount(place)
    if count.max(initial=1) == 1:
        return first
    ends = np.sort(np.stack([corner, np.roll(corner, -1, 1)], 2).reshape(-1, 2), 1)
    owner, edge = np.repeat(first, 3), number_rows(ends)
    surface = label_connected(len(corner) + int(edge.max()) + 1, np.stack([owner, len(corner) + edge], 1))[: len(corner)]
    times = np.zeros(int(surface.max()) + 1, np.int64)
    np.gcd.at(times, surface, count[place])
    wound = _number_wound(corner)
    order = np.lexsort((first, earlier_equals(wound), place))  # at each place one face of each winding, then the others
    rank = np.empty(len(corner), np.int64)
    rank[order] = earlier_equals(place[order])
    kept = np.flatnonzero(rank < count[place] // times[surface])
    stands_for = np.full((2, int(max(place.max(), wound.max())) + 1), -1)
    stands_for[0][place[kept[::-1]]] = kept[::-1]
    stands_for[1][wound[kept[::-1]]] = kept[::-1]
    first = np.where(stands_for[1][wound] >= 0, stands_for[1][wound], stands_for[0][place])
    first[kept] = kept
    return first


def _same_components(
    corner: Int[np.ndarray, "K 3"], triangles: Float[np.ndarray, "K 3 3"], parts: Components
) -> Int[np.ndarray, " K"]:
    """Return the copies of components with the same corners and the same area.

    Where a surface turns back onto itself, as at the rim of a sheet that has a back, it counts as two components.
    """
    normals, areas = normals_and_areas(triangles)
    f, g = parts.edges.faces.T
    cosine = np.einsum("ij,ij->i", normals.take(f, axis=0), normals.take(g, axis=0))
    folded = np.where(parts.edges.aligned, -cosine, cosine) > BACK_TO_BACK_COSINE
    label = label_connected(len(corner), parts.edges.faces[~folded]) if folded.any() else parts.label
    first = np.arange(len(corner))
    if label.max() == 0:
        return first
    order = np.argsort(label, kind="stable")
    start = np.flatnonzero(np.r_[True, np.diff(label[order]) != 0])
    bounds = [np.minimum.reduceat(corner.min(1)[order], start), np.maximum.reduceat(corner.max(1)[order], start)]
    pair = number_rows(np.stack(bounds, 1))
    earlier: dict[bytes, list[int]] = {}
    members = np.split(order, start[1:])
    for c in np.flatnonzero(np.bincount(pair)[pair] > 1).tolist():
        mine, area = members[c], float(areas[members[c]].sum())
        same = earlier.setdefault(np.unique(corner[mine]).tobytes(), [])
        like = next((members[k] for k in same if abs(float(areas[members[k]].sum()) - area) <= SAME_AREA * area), None)
        if like is None:
            same.append(c)
        else:
            first[mine] = like[TriangleTree(triangles[like]).nearest(centers_of(triangles[mine]))[1]]
    return first


def _places(corner: Int[np.ndarray, "n 3"]) -> Int[np.ndarray, " n"]:
    """Number faces by their corners, whatever the winding, by a sum of random numbers, which is faster than sorting rows."""
    weight = np.random.default_rng(0).integers(0, 2**62, int(corner.max()) + 1, dtype=np.uint64)
    total = weight[corner[:, 0]] + weight[corner[:, 1]] + weight[corner[:, 2]]
    if not len(_repeated(total)):
        return np.arange(len(total))
    return np.unique(total, return_inverse=True)[1].reshape(-1)


def _number_wound(corner: Int[np.ndarray, "n 3"]) -> Int[np.ndarray, " n"]:
    """Number faces by their corners and winding, whichever corner is first."""
    return number_rows(smallest_index_first(corner))


def earlier_equals(number: Int[np.ndarray, " n"]) -> Int[np.ndarray, " n"]:
    """Return how many earlier rows have the same number."""
    order = np.argsort(number, kind="stable")
    new = np.r_[True, np.diff(number[order]) != 0]
    rank = np.empty(len(number), np.int64)
    rank[order] = np.arange(len(number)) - np.maximum.accumulate(np.where(new, np.arange(len(number)), 0))
    return rank


def number_rows(rows: Int[np.ndarray, "n k"]) -> Int[np.ndarray, " n"]:
    """Number the distinct rows of indices."""
    number = rows[:, 0]
    for column in rows.T[1:]:
        number = np.unique(number * (int(column.max(initial=0)) + 1) + column, return_inverse=True)[1].reshape(-1)
    return number


MAX_FACES = 8000  # denser meshes are simplified for questions of shape and motion, never in the output
SMALL_PATCH_FACES_RATIO = 3  # maximum number of faces added for small patches, over that of faces kept of a dense mesh
KEPT_PATCH_FACES = 60  # minimum number of faces kept of a patch
MIN_PATCH_FACES = 20  # the same if there are very many patches


@dataclass(frozen=True, eq=False)
class ObjectShape(Brief):
    """The object as both stages use it. Dense meshes are simplified, each patch separately.

    shape: R faces; patch: (R,) patch of each face, numbered from 0; source: (R,) for each face a mesh face in the same
    patch; mesh_patch: (F,) patch of every mesh face; shared: (k, 2) patches that share edges; diagonal [m].
    """

    shape: TriangleSet
    patch: Int[np.ndarray, " R"]
    source: Int[np.ndarray, " R"]
    mesh_patch: Int[np.ndarray, " F"]
    shared: Int[np.ndarray, "k 2"]
    diagonal: float
    pivot: Float[np.ndarray, "R 3"] | None = None  # as `Mesh.face_pivot`

    def of(self, faces: Int[np.ndarray, " n"]) -> TriangleSet:
        """Return some of the R faces."""
        return self.shape.take(faces)


@dataclass(frozen=True, eq=False)
class DividedSurface(Brief):
    """The faces of a mesh, oriented and divided into patches, before dense meshes are simplified.

    shape: all F faces; copy: (F,) face that each one copies, itself for most (`without_copies`); patch, shared, diagonal: as
    in `ObjectShape`.
    """

    shape: TriangleSet
    copy: Int[np.ndarray, " F"]
    patch: Int[np.ndarray, " F"]
    shared: Int[np.ndarray, "k 2"]
    diagonal: float
    pivot: Float[np.ndarray, "F 3"] | None = None  # as `Mesh.face_pivot`

    def simplified(self, labels: Int[np.ndarray, " F"] | None = None) -> ObjectShape:
        """Leave out copies of faces and simplify each patch.

        labels: (F,) parts that are kept apart, each with its own copy of a face.
        """
        label = np.zeros(len(self.patch), np.int64) if labels is None else labels
        rows = np.flatnonzero((self.copy == np.arange(len(self.copy))) | (label != label[self.copy]))
        group = self.patch * (int(label.max()) + 1) + label
        shape, source = _simplified(self.shape.take(rows), group[rows])
        source = rows[source]
        pivot = None if self.pivot is None else self.pivot[source]
        return ObjectShape(shape.prepared(), self.patch[source], source, self.patch, self.shared, self.diagonal, pivot)


def _simplified(shape: TriangleSet, group: Int[np.ndarray, " F"]) -> tuple[TriangleSet, Int[np.ndarray, " R"]]:
    """Simplify each group in proportion to its faces; small groups are left unchanged."""
    count = len(group)
    if count <= MAX_FACES:
        return replace(shape, faces=np.arange(count)), np.arange(count)
    order = np.argsort(group, kind="stable")
    bounds = np.flatnonzero(np.r_[True, np.diff(group[order]) != 0, True])
    least = int(np.clip(SMALL_PATCH_FACES_RATIO * MAX_FACES / (len(bounds) - 1), MIN_PATCH_FACES, KEPT_PATCH_FACES))
    kept, source = [], []
    for a, b in pairwise(bounds):
        mine = order[a:b]
        few = simplify(shape.triangles[mine], max(least, int(MAX_FACES * len(mine) / count)))
        kept.append(few)
        source.append(mine if len(few) == len(mine) else np.full(len(few), mine[0]))
    reduced, where = np.concatenate(kept), np.concatenate(source)
    return TriangleSet(reduced, normals_and_areas(reduced)[0], shape.solid[where], np.arange(len(reduced)), shape.seed), where
