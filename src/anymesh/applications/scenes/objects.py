"""Find the separate objects of a scene: a kitchen of cabinets, a room with furniture, a row of equal machines.

The scene graph is read from the top down; pieces that no node holds together are grouped by their distances. What encloses the
others, such as a room or a ground, is an object that does not move.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int

from anymesh.formats.advice import advise
from anymesh.geometry.boxes import box_pairs, within
from anymesh.geometry.distance_ import TriangleTree
from anymesh.geometry.surface import ground_faces
from anymesh.geometry.topology import label_connected, weld
from anymesh.geometry.triangle_set import spread_points
from anymesh.kinds.usual import usual_size
from anymesh.types import Brief, Mesh
from anymesh.types.triangles import bounds_of, corner_bounds, label_bounds, normals_and_areas
from anymesh.vocabulary import is_fixed_name, recognize, words_of

MAX_PIECES = 4000  # above, pieces of one node are not told apart
PROBES = 400  # sample points of a piece for its distance to another
APART = 0.01  # of the smaller diagonal: pieces of one object are closer
BESIDE = 0.1  # of the smaller diagonal: objects that are not alike are farther from each other
COMPARABLE = 0.4  # of the larger diagonal: what stands beside a thing of this size is another object
FAR = 0.1  # of the larger diagonal: an object above another one, with this gap between, does not rest on it
INTERLOCKED = 0.2  # of the smaller box: pieces that share more are of one object
OVER = 0.5  # of the smaller box seen from above: what shares more is above or below the other
SAME_SIZE = 0.02  # relative difference of the sizes and areas of copies
SMALLEST = 0.1  # of the largest object's diagonal: smaller pieces are no objects of their own
STANDING = 0.03  # of the height of the scene: what stands is no higher above the lowest point
STEADY = 0.12  # of its height: the least width of what stands by itself
ROOM_SIDE = 0.05  # of the box: faces within it of a side belong to this side
ROOM_SHARE = 0.7  # of the area, at the sides of its own box, makes a piece a room
ROOM_METRES = (1.5, 1.5, 1.8)  # least width, depth and height of a room
WHOLE_SIDE = 0.8  # of the extent of everything: the least size of a wall or a floor
ROOM_WORDS = frozenset(
    "room wall walls floor ceiling ground terrain environment building interior backdrop skybox sky scenery".split()
)


@dataclass(frozen=True, eq=False)
class SceneObject(Brief):
    """One object of a scene. name: of its node, or ""; faces: indices in the mesh; fixed: a room or a ground, without parts."""

    name: str
    faces: Int[np.ndarray, " n"]
    fixed: bool = False


@dataclass(frozen=True, eq=False)
class _Unit(Brief):
    """Pieces that are held together by a node, or one piece.

    children: names of what is directly below that node; moved: whether joints that the file states move all of it.
    """

    name: str
    pieces: Int[np.ndarray, " p"]
    children: tuple[str, ...]
    triangles: Float[np.ndarray, "F 3 3"]
    ground: float  # [m] what reaches down to here stands
    moved: bool = False

    @cached_property
    def low(self) -> Float[np.ndarray, " 3"]:
        return self._bounds[0]

    @cached_property
    def high(self) -> Float[np.ndarray, " 3"]:
        return self._bounds[1]

    @cached_property
    def _bounds(self) -> Float[np.ndarray, "2 3"]:
        return bounds_of(self.triangles.reshape(-1, 3))

    @cached_property
    def diagonal(self) -> float:
        return float(np.linalg.norm(self.high - self.low))

    @cached_property
    def tree(self) -> TriangleTree:
        return TriangleTree(self.triangles)

    @cached_property
    def probes(self) -> Float[np.ndarray, "n 3"]:
        corners = self.triangles.reshape(-1, 3)
        spread, _ = spread_points(self.triangles, normals_and_areas(self.triangles)[1], PROBES, 0)
        return np.concatenate([corners[:: max(1, len(corners) // PROBES)], spread])

    @cached_property
    def kind(self) -> bool:
        """Whether its name says what object it is, such as "Fridge_02", and not which part of one."""
        return (
            not self.moved
            and usual_size(self.name) is not None
            and recognize(self.name) is None
            and not is_fixed_name(self.name)
        )

    @cached_property
    def stands(self) -> bool:
        """Whether it stands by itself and is not named as a part."""
        named = recognize(self.name) is not None or is_fixed_name(self.name)
        return bool(self.low[2] <= self.ground and not named and not self.moved and self.steady)

    @cached_property
    def steady(self) -> bool:
        """Whether it could stand by itself: wide enough for its height."""
        points = self.triangles.reshape(-1, 3)[:, :2]
        centred = points - points.mean(0)
        across = centred @ np.linalg.svd(centred.T @ centred)[0]
        return bool(min(float(np.ptp(column)) for column in across.T) >= STEADY * (self.high[2] - self.low[2]))


def _closer(a: _Unit, b: _Unit, limit: float) -> bool:
    """Whether the gap between two units is below a limit [m]."""
    for one, other in ((a, b), (b, a)):
        near = other.probes[within(other.probes, one.low - limit, one.high + limit)]
        if len(near) and float(one.tree.distance(near).min()) < limit:
            return True
    return False


def _between_boxes(a: _Unit, b: _Unit) -> float:
    return float(np.linalg.norm(np.maximum(np.maximum(a.low - b.high, b.low - a.high), 0)))


def _shared(a: _Unit, b: _Unit, axes: slice = slice(None)) -> float:
    """Return the share of the smaller box that lies in the other one; both thickened, so that sheets have a volume."""
    thick = APART * min(a.diagonal, b.diagonal)
    sizes = [(u.high - u.low + thick)[axes] for u in (a, b)]
    common = np.clip(np.minimum(a.high, b.high) - np.maximum(a.low, b.low) + thick, 0, None)[axes]
    return float(common.prod() / min(size.prod() for size in sizes))


def _alike(a: _Unit, b: _Unit) -> bool:
    """Whether both are assemblies with the same names below them, such as two cabinets."""
    return len(a.children) > 1 and Counter(a.children) == Counter(b.children)


def _are_one(a: _Unit, b: _Unit) -> bool:
    """Whether two units, close to each other, are parts of one object."""
    if a.kind and b.kind:
        return False
    if (shared := _shared(a, b)) > INTERLOCKED:
        return True
    if _alike(a, b) or all(len(u.children) > 1 and u.stands for u in (a, b)):
        return False
    smaller = min(a.diagonal, b.diagonal)
    if (np.maximum(a.low - b.high, b.low - a.high) > APART * smaller).any():
        return False
    return shared > 0 and _closer(a, b, APART * smaller)


def find_objects(mesh: Mesh) -> tuple[SceneObject, ...]:
    """Return the separate objects of a placed mesh [m, Z up], a room or ground last; one if it is a single object."""
    scene = _Scene(mesh)
    rooms = scene.rooms()
    free = np.setdiff1d(np.arange(scene.count), rooms)
    if len(free) == 0:
        return (SceneObject("", np.arange(len(mesh.faces))),)
    low, high = scene.bounds(free)[:, 2]
    units = list(scene.divided(free, 0, low + STANDING * (high - low)))
    if len(units) < 2:
        return (SceneObject("", np.arange(len(mesh.faces))),)
    units.sort(key=lambda unit: [int(w) if w.isdigit() else w for w in re.split(r"(\d+)", unit.name)])
    objects = [SceneObject(unit.name, scene.faces(unit.pieces)) for unit in units]
    if len(rooms):
        objects.append(SceneObject("room", scene.faces(rooms), fixed=True))
    return tuple(objects)


def scene_warning(mesh: Mesh) -> str | None:
    """Return what to say about a mesh that is a scene of several objects; None for a single object."""
    count = sum(not o.fixed for o in find_objects(mesh))
    return advise("scene", count=count) if count > 1 else None


class _Scene:
    """The pieces of a mesh, each connected and of one node, with the path of names that leads to it."""

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        corner = weld(mesh.vertices).take(mesh.faces)
        links = np.concatenate([corner[:, [0, 1]], corner[:, [1, 2]]])
        connected = label_connected(int(corner.max()) + 1, links)[corner[:, 0]]
        across = int(connected.max()) + 1
        numbers, label = np.unique(mesh.face_node.astype(np.int64) * across + connected, return_inverse=True)
        rows = np.stack(np.divmod(numbers, across), 1)
        if len(rows) > MAX_PIECES:
            rows, label = np.unique(mesh.face_node, return_inverse=True)
            rows = rows[:, None]
        self.label, self.count = label.reshape(-1), len(rows)
        self._order = np.argsort(self.label, kind="stable")
        self._start = np.searchsorted(self.label[self._order], np.arange(self.count + 1))
        self.node = rows[:, 0]
        self.paths = [mesh.nodes[n].path or (mesh.nodes[n].name,) for n in self.node]
        self._below = [(*path[:-1], mesh.nodes[n].geometry) for path, n in zip(self.paths, self.node, strict=True)]
        self.low, self.high = label_bounds(self.label, *corner_bounds(mesh.triangles))

    def faces(self, pieces: Sequence[int] | np.ndarray) -> Int[np.ndarray, " n"]:
        """Return the faces of some pieces, in order."""
        return np.sort(np.concatenate([self._order[self._start[p] : self._start[p + 1]] for p in pieces]))

    def bounds(self, pieces: np.ndarray) -> Float[np.ndarray, "2 3"]:
        """Return the box of some pieces [m]."""
        return np.stack([self.low[pieces].min(0), self.high[pieces].max(0)])

    def rooms(self) -> Int[np.ndarray, " r"]:
        """Return the pieces that are a ground, or a room around the others: named so, or large and made of its own sides."""
        ground = np.unique(self.label[ground_faces(self.mesh)])
        sizes, low, high = self.high - self.low, self.low.min(0), self.high.max(0)
        named = np.array([bool(ROOM_WORDS & {w for name in path[-2:] for w in words_of(name)}) for path in self.paths])
        wide = (sizes[:, :2].max(1) >= 0.5 * (high - low)[:2].max()) | (sizes[:, 2] >= WHOLE_SIDE * (high - low)[2])
        boxy = np.zeros(self.count, bool)
        if (high - low >= ROOM_METRES).all():
            near = ROOM_SIDE * (high - low)
            flat = (self.high < low + near) | (self.low > high - near)  # a slab along a side of everything
            whole = (sizes >= WHOLE_SIDE * (high - low)).sum(1)
            boxy = (flat.any(1) & (whole >= 2)) | (whole == 3)
            boxy[boxy] = [flat[p].any() or self._of_sides(int(p)) for p in np.flatnonzero(boxy)]
        return np.unique(np.concatenate([ground, np.flatnonzero((named & wide) | boxy)]))

    def _of_sides(self, piece: int) -> bool:
        """Whether most of a piece's area lies flat at the sides of its box, as that of a room does."""
        faces = self.faces([piece])
        triangles, areas = self.mesh.triangles[faces], self.mesh.face_areas[faces]
        low, high = self.low[piece], self.high[piece]
        near = ROOM_SIDE * (high - low)
        flat = ((triangles < low + near).all(1) | (triangles > high - near).all(1)).any(1)
        return float(areas[flat].sum()) >= ROOM_SHARE * float(areas.sum())

    def common_name(self, pieces: np.ndarray) -> str:
        """Return the name of the lowest node above all of these pieces; "" if it is above everything."""
        paths = [self.paths[p] for p in pieces]
        shared = [names[0] for names in zip(*paths, strict=False) if len(set(names)) == 1]
        everything = min((len(p) for p in self.paths), default=0)
        top = [names[0] for names in zip(*self.paths, strict=False) if len(set(names)) == 1]
        return shared[-1] if len(shared) > min(len(top), everything) or len(self.paths) == 1 else ""

    def divided(self, pieces: np.ndarray, depth: int, ground: float) -> Iterator[_Unit]:
        """Yield the objects that some pieces make: level by level of the scene graph, in the end piece by piece."""
        deepest = max(len(self.paths[p]) for p in pieces)
        for level in range(depth, deepest + 1):
            units = self._units(pieces, level, ground, single=level == deepest)
            if len(units) == 1:
                continue
            groups = _grouped(units)
            if len(groups) > 1:
                for group in groups:
                    below = np.concatenate([unit.pieces for unit in group])
                    yield from self.divided(below, level + 1, ground)
                return
        yield self._unit(pieces, self.common_name(pieces), deepest, ground)

    def _units(self, pieces: np.ndarray, level: int, ground: float, single: bool) -> list[_Unit]:
        """Return the units at a level of the scene graph; each piece on its own if single."""
        members: dict[object, list[int]] = {}
        for p in pieces.tolist():
            members.setdefault(p if single else self.paths[p][: level + 1], []).append(p)
        per_node = Counter(self.node[pieces].tolist())
        names = [
            self.paths[m[0]][: level + 1][-1] if not single or per_node[self.node[m[0]]] == 1 else "" for m in members.values()
        ]
        return [self._unit(np.array(m), name, level + 1, ground) for m, name in zip(members.values(), names, strict=True)]

    def _unit(self, pieces: np.ndarray, name: str, level: int, ground: float) -> _Unit:
        children = {self._below[p][level : level + 1] for p in pieces}
        names = tuple(sorted(child[0] for child in children if child))
        moved = all(self.mesh.nodes[n].joint >= 0 for n in self.node[pieces])
        return _Unit(name, pieces, names, self.mesh.triangles.take(self.faces(pieces), axis=0), ground, moved)


def _grouped(units: list[_Unit]) -> list[list[_Unit]]:
    """Group units into objects; a group that is none by itself joins the nearest."""
    low, high = np.array([u.low for u in units]), np.array([u.high for u in units])
    pairs = box_pairs(low, high, APART * max(u.diagonal for u in units))
    if any(len(u.children) > 1 for u in units):
        close = [(i, j) for i, j in pairs if _are_one(units[i], units[j])]
    else:
        close = list(_spanning(units, pairs, _are_one))
    between = _connectors(units, close)
    close = [(i, j) for i, j in close if i not in between and j not in between]
    label = label_connected(len(units), np.array(close, np.int64).reshape(-1, 2))
    together = [[units[i] for i in np.flatnonzero(label == g)] for g in range(int(label.max()) + 1)]
    apart = [[units[i]] for i in sorted(between)]
    return [*_joined([_together(some) for some in together if some not in apart]), *apart]


def _spanning(
    units: list[_Unit], pairs: list[tuple[int, int]], are_one: Callable[[_Unit, _Unit], bool]
) -> Iterator[tuple[int, int]]:
    """Yield pairs that are one, as many as connect all that are; those that are connected already are not measured."""
    group = list(range(len(units)))

    def root(i: int) -> int:
        while group[i] != i:
            group[i] = group[group[i]]
            i = group[i]
        return i

    for i, j in pairs:
        if root(i) != root(j) and are_one(units[i], units[j]):
            group[root(i)] = root(j)
            yield i, j


def _connectors(units: list[_Unit], close: list[tuple[int, int]]) -> set[int]:
    """Return the plain pieces that lie on several assemblies, such as a worktop on cabinets: objects of their own."""
    beside: dict[int, list[int]] = {}
    for i, j in close:
        beside.setdefault(i, []).append(j)
        beside.setdefault(j, []).append(i)
    return {
        i
        for i, others in beside.items()
        if len(units[i].children) < 2
        and sum(units[j].steady and len(units[j].children) > 1 and _shared(units[i], units[j]) < INTERLOCKED for j in others)
        > 1
    }


@dataclass(frozen=True, eq=False)
class _Group:
    units: list[_Unit]
    whole: _Unit


def _together(units: list[_Unit]) -> _Group:
    if len(units) == 1:
        return _Group(units, units[0])
    pieces = np.concatenate([u.pieces for u in units])
    return _Group(units, _Unit("", pieces, (), np.concatenate([u.triangles for u in units]), units[0].ground))


def _belong_together(a: _Unit, b: _Unit) -> bool:
    """Whether one of two groups rests on the other one with a small gap, or is close to it and unlike it."""
    if _alike(a, b) or _are_copies(a, b) or (a.kind and b.kind):
        return False
    between = max(a.low[2] - b.high[2], b.low[2] - a.high[2])
    if _shared(a, b, slice(2)) > OVER and between < FAR * max(a.diagonal, b.diagonal):
        return True
    smaller, larger = sorted((a.diagonal, b.diagonal))
    if smaller > COMPARABLE * larger and a.stands and b.stands:
        return False
    near = BESIDE * smaller
    return bool((np.maximum(a.low - b.high, b.low - a.high) < near).all()) and _closer(a, b, near)


def _are_copies(a: _Unit, b: _Unit) -> bool:
    """Whether two groups of several pieces have equal sizes and areas."""
    if min(len(a.pieces), len(b.pieces)) < 2 or len(a.pieces) != len(b.pieces):
        return False
    sizes = np.sort(a.high - a.low), np.sort(b.high - b.low)
    areas = [float(normals_and_areas(u.triangles)[1].sum()) for u in (a, b)]
    return bool(np.allclose(*sizes, rtol=SAME_SIZE, atol=0)) and abs(areas[0] - areas[1]) <= SAME_SIZE * max(areas)


def _joined(groups: list[_Group]) -> list[list[_Unit]]:
    """Join what is no object by itself to the nearest group: what is small, unsteady, in the air, or over another one."""
    largest = max(g.whole.diagonal for g in groups)

    def alone(g: _Group) -> bool:
        unit = g.whole
        if all(u.moved for u in g.units) or (not unit.kind and recognize(unit.name) is not None):
            return False
        made = unit.kind or any(len(u.children) > 1 for u in g.units)
        return bool(unit.diagonal >= SMALLEST * largest and unit.steady and (made or unit.low[2] <= unit.ground))

    standing = np.array([alone(g) for g in groups])
    if standing.sum() < 2:
        return [[u for g in groups for u in g.units]]
    wholes = [g.whole for g in groups]
    boxes = np.array([w.low for w in wholes]), np.array([w.high for w in wholes])
    pairs = list(_spanning(wholes, box_pairs(*boxes, FAR * largest), _belong_together))
    label = label_connected(len(groups), np.array(pairs, np.int64).reshape(-1, 2))
    kept = np.unique(label[standing])
    if len(kept) < 2:
        return [[u for g in groups for u in g.units]]
    members: dict[int, list[_Unit]] = {int(k): [] for k in kept}
    at_home = [k for k in range(len(groups)) if label[k] in members]
    for k, group in enumerate(groups):
        home = k if label[k] in members else min(at_home, key=lambda other: _between_boxes(group.whole, wholes[other]))
        members[int(label[home])] += group.units
    return list(members.values())
