"""Which new faces of a part enter another part, at rest or on the way, or leave their own surface."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.finishing.scenes import NONE, Growing, scene_of
from anymesh.finishing.sheets import Sheet
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.geometry.kinematics import carried_links, joint_transform
from anymesh.geometry.triangle_set import spread_directions
from anymesh.types import Brief, JointType
from anymesh.types.triangles import box_corners, normals_and_areas, transformed

DEEP = 2e-4  # share of the diagonal: an edge that ends further away on both sides of a face crosses it
WAY = (0.02, 0.06, 0.15, 0.3, 0.5, 0.75, 1.0)  # shares of the way to a limit at which parts must be apart
REACH = 0.03  # share of the diagonal by which a skin reaches beyond the box of its part at most
AROUND = 14  # directions in which surfaces beside a border are searched
ACROSS = 0.2  # minimum cosine between a sheet at its border and the hidden side of another part, which then meet at an angle
PARALLEL = 0.95  # minimum cosine between the normals of faces of two parts that continue each other
CORNERS = ((0, 1), (1, 2), (2, 0))


@dataclass(frozen=True, eq=False)
class Beside(Brief):
    """Surfaces of other parts that meet a sheet at its border, at an angle. vertex: of the sheet; normals: outward."""

    vertex: Int[np.ndarray, " n"]
    normals: Float[np.ndarray, "n 3"]


NOTHING = Beside(np.zeros(0, int), np.zeros((0, 3)))


class Faces:
    """Triangles, for tests of crossing by more than `depth` [m]; surfaces that meet at an edge do not cross."""

    def __init__(self, triangles: Float[np.ndarray, "n 3 3"], depth: float) -> None:
        self.triangles, self.normals, self.depth = triangles, normals_and_areas(triangles)[0], depth
        self.scene = scene_of(_inset(triangles, depth))
        self.bounds = np.stack([triangles.min((0, 1)), triangles.max((0, 1))]) if len(triangles) else np.zeros((2, 3))
        self._low, self._high = triangles.min(1), triangles.max(1)

    def near(self, bounds: Float[np.ndarray, "2 3"]) -> np.ndarray:
        """Return the faces whose boxes meet some bounds."""
        return np.flatnonzero(((self._low <= bounds[1]) & (self._high >= bounds[0])).all(1))

    def crossed(self, start: Float[np.ndarray, "m 3"], end: Float[np.ndarray, "m 3"]) -> tuple[np.ndarray, np.ndarray]:
        """Return the edges that cross a face, and these faces."""
        edges, faces = [np.zeros(0, int)], [np.zeros(0, int)]
        if self.scene is None or not len(start):
            return edges[0], faces[0]
        for origin, way in ((start, end - start), (end, start - end)):
            hits = self.scene.first_hit(origin, way, 1.0)
            met = np.flatnonzero(hits.face >= 0)
            slope = np.abs(np.einsum("ij,ij->i", way[met], self.normals[hits.face[met]]))
            deep = np.minimum(slope * hits.distance[met], slope * (1 - hits.distance[met])) > self.depth
            edges.append(met[deep])
            faces.append(hits.face[met[deep]])
        return np.concatenate(edges), np.concatenate(faces)


def crossing(new: Faces, other: Faces, T: Float[np.ndarray, "4 4"]) -> Bool[np.ndarray, " n"]:
    """Return which new faces cross other faces, which T places in the frame of the new ones."""
    bad = np.zeros(len(new.triangles), bool)
    if not len(bad) or not len(other.triangles):
        return bad
    corners = transformed(box_corners(other.bounds), T)
    mine = new.near(np.stack([corners.min(0), corners.max(0)]))
    corners = transformed(box_corners(new.bounds), np.linalg.inv(T))
    theirs = other.near(np.stack([corners.min(0), corners.max(0)]))
    if not len(mine) or not len(theirs):
        return bad
    back, chosen = np.linalg.inv(T), new.triangles[mine]
    for a, b in CORNERS:
        edges, _ = other.crossed(transformed(chosen[:, a], back), transformed(chosen[:, b], back))
        bad[mine[edges]] = True
        t = other.triangles[theirs]
        _, faces = new.crossed(transformed(t[:, a], T), transformed(t[:, b], T))
        bad[faces] = True
    return bad


@dataclass(frozen=True, eq=False)
class Neighbours(Brief):
    """What the new faces of a part must not cross: the others at rest, and those that move against it."""

    part: int
    growing: Growing
    added: Float[np.ndarray, "n 3 3"] = field(default_factory=lambda: NONE)  # faces that reach further beyond the part

    @property
    def depth(self) -> float:
        return DEEP * self.growing.scenes.diagonal

    @cached_property
    def own(self) -> Faces:
        return Faces(self.growing.scenes.asset.mesh.triangles[self.growing.faces(self.part)], self.depth)

    @property
    def _bounds(self) -> Float[np.ndarray, "2 3"]:
        points = np.concatenate([self.own.triangles, self.added]).reshape(-1, 3)
        return np.stack([points.min(0), points.max(0)])

    @cached_property
    def _ways(self) -> list[tuple[Faces, list[Float[np.ndarray, "4 4"]]]]:
        """Other faces with their poses relative to the part, at rest and on the way; those that cross it without new faces."""
        scenes = self.growing.scenes
        ways = [(Faces(self.growing.others(self.part), self.depth), [np.eye(4)])]
        reach = np.array([[-1.0], [1.0]]) * REACH * scenes.diagonal + self._bounds
        parts: dict[int, Faces] = {}
        for group, poses in self._moving():
            for k in group:
                faces = parts[k] = parts.get(k) or Faces(self.growing.triangles(k), self.depth)
                corners = [transformed(box_corners(faces.bounds), T) for T in poses]
                near = [
                    T
                    for T, c in zip(poses, corners, strict=True)
                    if (c.min(0) <= reach[1]).all() and (c.max(0) >= reach[0]).all() and not crossing(self.own, faces, T).any()
                ]
                ways += [(faces, near)] if near else []
        return ways

    def _moving(self) -> Iterator[tuple[list[int], list[Float[np.ndarray, "4 4"]]]]:
        """Yield parts that a joint moves relative to this one, and their poses on its way."""
        scenes = self.growing.scenes
        for joint in scenes.asset.joints:
            if joint.type is JointType.FIXED:
                continue
            carried = {scenes.number[name] for name in carried_links(scenes.asset, joint)}
            limits = (-np.pi, np.pi) if joint.limits is None else joint.limits
            poses = [joint_transform(joint, share * end) for end in limits if end for share in WAY]
            if self.part in carried:
                yield [k for k in scenes.order if k not in carried], [np.linalg.inv(T) for T in poses]
            else:
                yield sorted(carried), poses

    def beside(self, sheet: Sheet, gap: float) -> Beside:
        """Return the surfaces of other parts within a gap [m] of the border of a sheet that meet it on their hidden side."""
        asset = self.growing.scenes.asset
        others = asset.segmentation.face_part != self.part
        if not others.any() or not sheet.loops:
            return NOTHING
        other, border = asset.mesh.subset(others), np.unique(np.concatenate(sheet.loops)).astype(int)
        away = np.asarray(distance_to_mesh(sheet.points[border], other.vertices, other.faces)[0], float)
        border = border[away < gap]
        if not len(border):
            return NOTHING
        probes = np.concatenate([np.zeros((1, 3)), spread_directions(AROUND) * 2 * gap])
        asked = (sheet.points[border][:, None] + probes).reshape(-1, 3)
        far, face = distance_to_mesh(asked, other.vertices, other.faces)[:2]
        vertex, near = np.repeat(border, len(probes)), np.asarray(far) < 1.9 * gap
        pairs = np.unique(np.stack([vertex[near], np.asarray(face)[near]], 1), axis=0).astype(int)
        normals = other.face_normals[pairs[:, 1]]
        meets = -np.einsum("ij,ij->i", normals, _into(sheet)[pairs[:, 0]]) > ACROSS
        meets &= ~_continues(sheet, pairs[:, 0], normals)
        rows = np.unique(np.column_stack([pairs[meets, 0], np.round(normals[meets], 3)]), axis=0)
        return Beside(rows[:, 0].astype(int), rows[:, 1:])

    def entered(self, new: Float[np.ndarray, "n 3 3"], sheet: Faces | None = None) -> Bool[np.ndarray, " n"]:
        """Return which new faces cross other parts, or the sheet that they belong to, and so leave the part."""
        faces = Faces(new, self.depth)
        bad = np.zeros(len(new), bool) if sheet is None else crossing(faces, sheet, np.eye(4))
        for other, poses in self._ways:
            for T in poses:
                bad |= crossing(faces, other, T)
        return bad


def enters(part: int, growing: Growing, new: Float[np.ndarray, "n 3 3"]) -> bool:
    """Return whether new faces of a part cross another part, at rest or on the way."""
    return bool(Neighbours(part, growing, new).entered(new).any())


def _into(sheet: Sheet) -> Float[np.ndarray, "V 3"]:
    """Return unit vectors from the points of a sheet along its adjacent faces."""
    into = np.zeros((len(sheet.points), 3))
    middle = sheet.triangles.mean(1)
    for k in range(3):
        way = middle - sheet.points[sheet.faces[:, k]]
        np.add.at(into, sheet.faces[:, k], way / np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-300))
    return into / np.maximum(np.linalg.norm(into, axis=1, keepdims=True), 1e-300)


def _continues(sheet: Sheet, vertex: np.ndarray, normals: np.ndarray) -> Bool[np.ndarray, " n"]:
    """Return which normals at vertices of a sheet are also, nearly, those of one of its own faces there."""
    own = [np.abs(sheet.normals[(sheet.faces == v).any(1)] @ n).max(initial=0.0) for v, n in zip(vertex, normals, strict=True)]
    return np.array(own, float) > PARALLEL


def _inset(triangles: Float[np.ndarray, "n 3 3"], depth: float) -> Float[np.ndarray, "n 3 3"]:
    """Move the sides of triangles inwards by `depth` [m], by nine tenths of the inner circle at most."""
    side = np.linalg.norm(np.roll(triangles, 1, axis=1) - np.roll(triangles, -1, axis=1), axis=2)  # opposite to each corner
    around = np.maximum(side.sum(1), 1e-300)
    middle = np.einsum("nk,nkj->nj", side, triangles) / around[:, None]
    radius = 2 * normals_and_areas(triangles)[1] / around
    share = 1 - np.minimum(depth / np.maximum(radius, 1e-300), 0.9)
    return middle[:, None] + share[:, None, None] * (triangles - middle[:, None])
