"""Geometric features at a click on the mesh: edge, plane, round surface or patch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from anymesh.correcting.corrections import CorrectionError
from anymesh.geometry.circles import outline_about
from anymesh.geometry.superpoints import superpoints
from anymesh.geometry.topology import EdgePairs, edge_pairs, label_connected
from anymesh.types import Asset, Brief
from anymesh.types.triangles import face_cross

FLAT = np.deg2rad(5)  # [rad] maximum angle between faces of one plane
SMOOTH = np.deg2rad(40)  # [rad] maximum angle between neighbours on a round surface
STRAIGHT = np.cos(np.deg2rad(3))  # minimum cosine between edges of one line
ON_LINE = 0.002  # share of the diagonal: maximum distance of a line's edges from it
ROUND = 0.4  # minimum roundness of an outline with an axis
BENT = 0.05  # minimum spread of the normals of a round surface, 0 flat .. 0.5
DENSE = 40_000  # number of a part's faces above which patches end only at creases
STRENGTH = 0.05  # strength of l0 cut pursuit on normals (`creases.CREASE_STRENGTH`)


@dataclass(frozen=True, eq=False)
class Line(Brief):
    """A snapped line. axis: unit; origin [m], asset frame; how: in words."""

    axis: Float[np.ndarray, " 3"]
    origin: Float[np.ndarray, " 3"]
    how: str


class PickedPart:
    """The part of a picked face, prepared for queries about the click."""

    def __init__(self, asset: Asset, face: int) -> None:
        number = int(asset.segmentation.face_part[face])
        self.faces = asset.segmentation.faces(number)
        self.name = asset.segmentation.parts[number].name
        self._mesh, self._diagonal = asset.mesh, asset.mesh.diagonal
        self._at = int(np.searchsorted(self.faces, face))
        self._normals = asset.mesh.face_normals[self.faces]
        self._pairs: EdgePairs = edge_pairs(asset.mesh.vertices, asset.mesh.faces[self.faces])

    def edge(self, point: Float[np.ndarray, " 3"]) -> Line:
        """Return the straight border of the picked plane nearest to the point [m]."""
        ends = self._border(self._region(FLAT, of_first=True))
        if len(ends) == 0:
            raise CorrectionError("the surface picked has no edge; pick a flat face, or snap to its round axis")
        along = ends[:, 1] - ends[:, 0]
        length = np.linalg.norm(along, axis=1)
        ends, along = ends[length > 0], along[length > 0] / length[length > 0, None]
        t = np.clip(((point - ends[:, 0]) * along).sum(1), 0, np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1))
        nearest = int(np.linalg.norm(ends[:, 0] + t[:, None] * along - point, axis=1).argmin())
        axis, start = along[nearest], ends[nearest, 0]
        off = np.linalg.norm(np.cross(ends - start, axis), axis=2).max(1)
        one = (np.abs(along @ axis) > STRAIGHT) & (off < ON_LINE * self._diagonal)
        reach = ((ends[one] - start) @ axis).reshape(-1)
        return Line(_signed(axis), start + (reach.min() + reach.max()) / 2 * axis, "snapped to an edge")

    def normal(self, point: Float[np.ndarray, " 3"]) -> Line:
        """Return the normal of the picked plane, through the point [m]."""
        plane = self.faces[self._region(FLAT, of_first=True)]
        total = face_cross(self._mesh.triangles[plane]).sum(0)
        if np.linalg.norm(total) == 0:
            raise CorrectionError("the face picked has no area; pick another")
        return Line(total / np.linalg.norm(total), point, "snapped to a plane's normal")

    def symmetry(self) -> Line:
        """Return the axis of the picked round surface (a barrel, a rim, a knob)."""
        patch = self._region(SMOOTH)
        corners = self._mesh.triangles[self.faces[patch]].reshape(-1, 3)
        normals, area = self._normals[patch], self._mesh.face_areas[self.faces[patch]]
        spread = (normals * (area / max(area.sum(), 1e-300))[:, None]).T @ normals
        value, direction = np.linalg.eigh(spread)
        if value[1] < BENT:
            raise CorrectionError("the surface picked is flat; pick a round one, or snap to an edge or a plane's normal")
        seen = max((outline_about(corners, axis) for axis in direction.T), key=lambda o: o.roundness)
        if seen.roundness < ROUND:
            raise CorrectionError(f"the surface picked is round about no axis (at best {100 * seen.roundness:.0f} %)")
        return Line(_signed(seen.axis), seen.center, "snapped to a symmetry axis")

    def patch(self) -> Int[np.ndarray, " n"]:
        """Return the face indices of the picked superpoint; if the part is dense, of the surface up to its creases."""
        if len(self.faces) > DENSE:
            return self.faces[self._region(SMOOTH)]
        label = self.patches()
        return self.faces[label == label[self._at]]

    def patches(self) -> Int[np.ndarray, " n"]:
        """Return the patch of each face of the part: superpoints, or if the part is dense, the surface up to its creases."""
        if len(self.faces) > DENSE:
            return self._connected(SMOOTH)
        ends = self._mesh.vertices[self._mesh.faces[self.faces]].reshape(-1, 3, 3)
        length = np.linalg.norm(
            self._mesh.vertices[self._pairs.vertices[:, 0]] - self._mesh.vertices[self._pairs.vertices[:, 1]], axis=1
        )
        area = np.maximum(self._mesh.face_areas[self.faces], 1e-300)
        return superpoints(self._normals, area, self._pairs.faces, length, STRENGTH) if len(ends) > 1 else np.zeros(1, int)

    def _region(self, most: float, *, of_first: bool = False) -> np.ndarray:
        """Return which faces are connected to the picked one across edges that bend by less than `most` [rad].

        of_first: also require normals within `most` of the picked face's, so that a plane does not continue around a corner.
        """
        label = self._connected(most, of_first=of_first)
        return label == label[self._at]

    def _connected(self, most: float, *, of_first: bool = False) -> np.ndarray:
        a, b = self._pairs.faces.T
        level = np.einsum("ij,ij->i", self._normals[a], self._normals[b]) > np.cos(most)
        if of_first:
            like = self._normals @ self._normals[self._at] > np.cos(most)
            like[self._at] = True
            level &= like[a] & like[b]
        return label_connected(len(self.faces), self._pairs.faces[level])

    def _border(self, region: np.ndarray) -> np.ndarray:
        """Return the end points (m, 2, 3) of the edges between a region and its complement."""
        corners = self._mesh.faces[self.faces[region]]
        sides = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
        inner = self._pairs.vertices[region[self._pairs.faces].all(1)]
        ends = self._mesh.vertices[sides]
        key, gone = _key(ends), _key(self._mesh.vertices[inner])
        return ends[~np.isin(key, gone)]


def _key(ends: np.ndarray) -> np.ndarray:
    """Return a key per edge, independent of its direction and of which of several equal vertices it uses."""
    flat = np.round(ends, 9) + 0.0
    order = np.lexsort(flat.transpose(2, 0, 1)[::-1], axis=1) if len(flat) else np.zeros((0, 2), int)
    ordered = np.ascontiguousarray(np.take_along_axis(flat, order[:, :, None], 1).reshape(len(flat), 6))
    return ordered.view([("", ordered.dtype)] * 6).reshape(-1)


def _signed(axis: np.ndarray) -> np.ndarray:
    """Flip the direction so that its largest component is positive."""
    return (-axis if axis[np.abs(axis).argmax()] < 0 else axis) + 0.0
