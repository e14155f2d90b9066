"""Open sheets of a part: consistently wound surfaces with borders, each vertex on at most one border."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int

from anymesh.finishing.protocol import ShapeConfig
from anymesh.finishing.scenes import GRAZE, Scenes, escapes
from anymesh.geometry.boxes import OrientedBox, fit_box
from anymesh.geometry.surface import earlier_equals, number_rows, open_surface
from anymesh.geometry.topology import EdgePairs, edge_pairs, label_connected, weld
from anymesh.geometry.triangle_set import SurfacePoints, sample_surface
from anymesh.types import Brief
from anymesh.types.triangles import normals_and_areas

PROBES = 120  # sample points on a sheet


@dataclass(frozen=True, eq=False)
class Sheet(Brief):
    """A connected surface with a border.

    points: (V, 3) [m]; faces: (F, 3) into them, as wound; own: (F,) indices of the source faces; loops: vertices of each
    border, in the direction of the adjacent faces.
    """

    points: Float[np.ndarray, "V 3"]
    faces: Int[np.ndarray, "F 3"]
    own: Int[np.ndarray, " F"]
    loops: tuple[Int[np.ndarray, " _"], ...]

    @property
    def triangles(self) -> Float[np.ndarray, "F 3 3"]:
        return self.points[self.faces]

    @cached_property
    def normals(self) -> Float[np.ndarray, "F 3"]:
        """Unit normals as wound; zero for faces without area."""
        return normals_and_areas(self.triangles)[0]

    @cached_property
    def areas(self) -> Float[np.ndarray, " F"]:
        return normals_and_areas(self.triangles)[1]

    @property
    def size(self) -> float:
        """Diagonal of its axis-aligned box [m]."""
        return float(np.linalg.norm(np.ptp(self.points, axis=0)))

    def with_faces(self, points: Float[np.ndarray, "k 3"], faces: Int[np.ndarray, "m 3"]) -> Sheet:
        """Return the sheet with further points, and with faces over all points; new faces have the index -1."""
        own = np.concatenate([self.own, np.full(len(faces), -1)])
        return Sheet(np.concatenate([self.points, points]), np.concatenate([self.faces, faces]), own, self.loops)

    def without(self, loops: Collection[int]) -> Sheet:
        """Return the sheet without these loops, which have been closed."""
        return replace(self, loops=tuple(loop for k, loop in enumerate(self.loops) if k not in loops))


def open_sheets(vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], diagonal: float) -> list[Sheet]:
    """Return all sheets among some faces, in the order of their first face; closed surfaces and copies of faces are excluded.

    diagonal: of the object [m].

    Surfaces are cut where their winding flips, and vertices are split where surfaces only meet in a point. Faces with two
    corners in one place enclose nothing and are left out.
    """
    vertices, kept = open_surface(vertices, faces, diagonal)
    number = weld(vertices)
    kept = kept[(number[faces[kept]] != np.roll(number[faces[kept]], -1, axis=1)).all(1)]
    if len(kept) == 0:
        return []
    faces, welded = faces[kept], number[faces[kept]]
    half, mate = _joined_halves(welded, number, edge_pairs(vertices, faces))
    label = label_connected(len(faces), np.stack([half // 3, mate // 3], 1))
    corner = _corners(len(faces), half, mate)
    border = np.ones(3 * len(faces), bool)
    border[half] = border[mate] = False
    edges = np.flatnonzero(border)
    sheets = []
    for k in np.unique(label[edges // 3]):
        mine = np.flatnonzero(label == k)
        _, first, inverse = np.unique(corner[mine], return_index=True, return_inverse=True)
        own, along = inverse.reshape(-1, 3), edges[label[edges // 3] == k]
        row = np.searchsorted(mine, along // 3)
        loops = _loops(own[row, along % 3], own[row, (along % 3 + 1) % 3])
        sheets.append(Sheet(vertices[faces[mine].reshape(-1)[first]], own, kept[mine], loops))
    return sheets


def _joined_halves(welded: np.ndarray, number: np.ndarray, pairs: EdgePairs) -> tuple[np.ndarray, np.ndarray]:
    """Return pairs of half edges (3 * face + index of the first corner) joined with consistent winding."""
    ends = number[pairs.vertices[pairs.aligned]]
    left, right = pairs.faces[pairs.aligned].T
    return tuple(
        3 * face + (welded[face] == start[:, None]).argmax(1) for face, start in ((left, ends[:, 0]), (right, ends[:, 1]))
    )


def _corners(count: int, half: np.ndarray, mate: np.ndarray) -> Int[np.ndarray, "F 3"]:
    """Return a vertex per corner; corners are merged where the faces around them are connected."""

    def end(h: np.ndarray) -> np.ndarray:
        return h - h % 3 + (h % 3 + 1) % 3

    pairs = np.concatenate([np.stack([half, end(mate)], 1), np.stack([end(half), mate], 1)])
    return label_connected(3 * count, pairs).reshape(-1, 3)


def _loops(start: np.ndarray, end: np.ndarray) -> tuple[Int[np.ndarray, " _"], ...]:
    """Return closed chains of border edges, each from its first vertex in the file."""
    follows = dict(zip(start.tolist(), end.tolist(), strict=True))
    loops = []
    for vertex in sorted(follows):
        chain = []
        while vertex in follows:
            chain.append(vertex)
            vertex = follows.pop(vertex)
        if len(chain) > 2:
            loops.append(np.array(chain))
    return tuple(loops)


@dataclass(frozen=True, eq=False)
class SheetVisibility:
    """Visibility of a sheet. faces_out: whether its faces are wound to the visible side; both: both sides are visible."""

    sheet: Sheet
    probe: SurfacePoints
    faces_out: bool
    both: bool

    @property
    def sign(self) -> float:
        return 1.0 if self.faces_out else -1.0

    @cached_property
    def box(self) -> OrientedBox:
        return fit_box(self.sheet.points, self.sheet.normals, self.sheet.areas)

    @property
    def inward(self) -> Float[np.ndarray, " 3"]:
        """Thin direction of its box, away from the visible side."""
        axis = self.box.axes[2]
        mean = self.sign * self.sheet.areas @ self.sheet.normals
        return -axis if mean @ axis > 0 else axis

    def is_plate(self, most: float) -> bool:
        return bool(self.box.half[2] < most * self.box.half[1])


def sheet_visibility(sheet: Sheet, scenes: Scenes, config: ShapeConfig) -> SheetVisibility:
    """Determine from which sides a sheet is visible at rest."""
    probe = sample_surface(sheet.triangles, PROBES, 0)
    front, back = scenes.seen(probe.points, probe.normals).mean(0) if len(probe) else (1.0, 0.0)
    inside_out = back > config.shown and back > 2 * front  # a sheet that is hardly visible keeps its winding
    return SheetVisibility(sheet, probe, not inside_out, bool(min(front, back) > config.shown))


def is_laid_open(seen: SheetVisibility, part: int, scenes: Scenes, config: ShapeConfig) -> bool:
    """Return whether the side of a sheet that is hidden at rest is visible when all joints are open."""
    root = scenes.order[0]
    T, probe = scenes.opened(root)[part], seen.probe
    points, normals = probe.points @ T[:3, :3].T + T[:3, 3], probe.normals @ T[:3, :3].T
    shown = escapes(scenes.scene_opened(root), points, -seen.sign * normals, scenes.diagonal)[:, 0] >= GRAZE
    return bool(shown.mean() > config.shown) if len(shown) else False


def covers_itself(faces: Int[np.ndarray, "F 3"], new: Int[np.ndarray, "m 3"]) -> bool:
    """Return whether a new face coincides with an existing one, so that the two would enclose nothing."""
    known = {tuple(sorted(f)) for f in faces.tolist()}
    return any(tuple(sorted(f)) in known for f in new.tolist())


def without_folds(new: Float[np.ndarray, "n 3 3"], beside: Float[np.ndarray, "m 3 3"]) -> Float[np.ndarray, "k 3 3"]:
    """Remove new faces that enclose nothing: those with two corners in one place, or in pairs of opposite faces.

    beside: adjacent faces, which determine the weld tolerance. Closed surfaces stay closed, because each edge loses its faces
    in pairs.
    """
    number = weld(np.concatenate([beside, new]).reshape(-1, 3))[3 * len(beside) :].reshape(-1, 3)
    whole = (number != np.roll(number, 1, axis=1)).all(1)
    new, number = new[whole], number[whole]
    if len(new) == 0:
        return new
    turn = (number.argmin(1)[:, None] + np.arange(3)) % 3
    _, b, c = np.take_along_axis(number, turn, 1).T
    side = np.where(b < c, 1, -1)
    kind = number_rows(np.sort(number, axis=1))
    excess = np.bincount(kind, side)
    return new[(side * excess[kind] > 0) & (earlier_equals(2 * kind + (side > 0)) < np.abs(excess[kind]))]
