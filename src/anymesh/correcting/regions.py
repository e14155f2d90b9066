"""Regions of a mesh that one click chooses (facet, region up to creases, piece), how they grow, and faces in an outline."""

from __future__ import annotations

from enum import StrEnum
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float, Int
from PIL import Image, ImageDraw

from anymesh.geometry.distance_ import TriangleTree
from anymesh.geometry.surface import mesh_surface
from anymesh.geometry.topology import label_connected
from anymesh.geometry.triangle_set import sample_surface
from anymesh.segmentation.divide import split_patches
from anymesh.types import Mesh
from anymesh.types.camera import Camera

SMOOTH = np.cos(np.deg2rad(5))  # minimum cosine between neighbours of one facet, as for a plane in correcting/picking.py
SAME_FACET = np.cos(np.deg2rad(20))  # estimate: minimum cosine between the clicked face and others of its facet
DENSE = 200_000  # faces of an object above which its regions end at sharp creases only; patches would take seconds
SHARP = 3000  # faces of a piece up to which its regions end at every sharp crease, as in segmentation/divide.py
CREASE = np.cos(np.deg2rad(25))  # cosine of a concave crease that bounds a region, as in geometry/creases.py
TOUCH = 0.005  # share of the diagonal: gap up to which pieces touch (estimate)
NEAR_POINTS = 300  # points of a piece whose distance is measured
MAX_NEIGHBOURS = 60  # pieces near another one that are measured
MASK = 2048  # [px] size of the picture in which an outline is filled
# barycentric coordinates of the points at which a face is tested against an outline
SAMPLES = np.array([[1, 1, 1], [4, 1, 1], [1, 4, 1], [1, 1, 4], [2, 2, 0.5], [2, 0.5, 2], [0.5, 2, 2]])
SAMPLES = SAMPLES / SAMPLES.sum(1, keepdims=True)


class Level(StrEnum):
    """What a click chooses, the smallest first."""

    FACET = "Facet"
    REGION = "Region"
    PIECE = "Piece"


class Regions:
    """The regions of a mesh at each level; they never reach beyond the part of the face that is clicked."""

    def __init__(self, mesh: Mesh) -> None:
        self._mesh = mesh
        self._surface = mesh_surface(mesh)
        self._pairs = self._surface.components.edges.faces
        normals = self._surface.shape.normals
        self._normals = normals
        self._cosine = np.einsum("ij,ij->i", normals[self._pairs[:, 0]], normals[self._pairs[:, 1]])

    def of(self, face: int, level: Level, face_part: Int[np.ndarray, " F"]) -> Int[np.ndarray, " n"]:
        """Return the faces of the region around a face, within its part.

        A piece comes with the smaller pieces that touch nothing else, as a handle on a front, or the blades on a hub.
        """
        mine = face_part == face_part[face]
        if level is Level.FACET:
            return np.flatnonzero(self._facet(face) & mine)
        label = self._labels[level]
        chosen = np.flatnonzero((label == label[face]) & mine)
        if level is Level.REGION:
            return chosen
        return np.unique(np.concatenate([chosen, *self._hanging_on(chosen, mine)]))

    def grown(self, chosen: Int[np.ndarray, " n"], face_part: Int[np.ndarray, " F"]) -> Int[np.ndarray, " m"]:
        """Return the chosen faces with the rest of their regions, at the first level where that adds some.

        Whole pieces grow by the pieces that touch them: by those that are no larger than they are, else by all. All stay within
        the parts of the chosen faces.
        """
        if not len(chosen):
            return chosen
        mine = np.isin(face_part, face_part[chosen])
        for level in Level:
            label = self._labels[level]
            more = np.flatnonzero(np.isin(label, label[chosen]) & mine)
            if len(more) > len(np.unique(chosen)):
                return more
        touching = self._touching(chosen, mine)
        small = [f for f in touching if self._is_smaller(f, chosen)]
        return np.unique(np.concatenate([chosen, *(small or touching)]))

    def _touching(self, chosen: np.ndarray, mine: Bool[np.ndarray, " F"]) -> list[Int[np.ndarray, " n"]]:
        """Return the faces of each piece that touches chosen ones, of those that are candidates (`mine`)."""
        piece, triangles = self._labels[Level.PIECE], self._mesh.triangles
        reach = TOUCH * self._mesh.diagonal
        corners = triangles[chosen].reshape(-1, 3)
        low, high = corners.min(0) - reach, corners.max(0) + reach
        meets = ((triangles.min(1) <= high) & (triangles.max(1) >= low)).all(1) & mine
        others = np.setdiff1d(piece[meets], piece[chosen])[:MAX_NEIGHBOURS]
        tree = TriangleTree(triangles[chosen])
        faces = [np.flatnonzero((piece == k) & mine) for k in others]
        return [f for f in faces if self._touches(tree, f, chosen, reach)]

    def _is_smaller(self, faces: np.ndarray, chosen: np.ndarray) -> bool:
        longest = [float(np.ptp(self._mesh.triangles[f].reshape(-1, 3), axis=0).max()) for f in (faces, chosen)]
        return longest[0] <= longest[1]

    def _hanging_on(self, chosen: np.ndarray, mine: Bool[np.ndarray, " F"]) -> list[Int[np.ndarray, " n"]]:
        """Return the smaller pieces that touch chosen ones, and apart from each other nothing else."""
        piece, others = self._labels[Level.PIECE], mine.copy()
        others[chosen] = False
        hanging = {int(piece[f[0]]): f for f in self._touching(chosen, mine) if self._is_smaller(f, chosen)}
        meets = {k: {int(piece[other[0]]) for other in self._touching(f, others)} for k, f in hanging.items()}
        while held := {k for k in hanging if not meets[k] <= hanging.keys()}:
            hanging = {k: f for k, f in hanging.items() if k not in held}
        return list(hanging.values())

    def _touches(self, tree: TriangleTree, faces: np.ndarray, chosen: np.ndarray, reach: float) -> bool:
        """Return whether a piece comes near the chosen faces: its points near them, or theirs near it."""
        if (tree.distance(self._points(faces)) < reach).any():
            return True
        return bool((TriangleTree(self._mesh.triangles[faces]).distance(self._points(chosen)) < reach).any())

    def _points(self, faces: np.ndarray) -> Float[np.ndarray, "n 3"]:
        """Return corners of faces, and points spread on them."""
        triangles = self._mesh.triangles[faces]
        corners = triangles.reshape(-1, 3)
        spread = sample_surface(triangles, NEAR_POINTS, 0).points
        return np.concatenate([corners[:: max(1, len(corners) // NEAR_POINTS)], spread])

    def _facet(self, face: int) -> Bool[np.ndarray, " F"]:
        row = int(self._surface.row[face])
        like = self._normals @ self._normals[row] > SAME_FACET
        like[row] = True
        level = (self._cosine > SMOOTH) & like[self._pairs].all(1)
        label = label_connected(len(like), self._pairs[level])
        return (label == label[row])[self._surface.row]

    @cached_property
    def _labels(self) -> dict[Level, Int[np.ndarray, " F"]]:
        """The region of each face, at each level."""
        surface, pairs = self._surface, self._pairs
        component = surface.components.label
        f, g = pairs.T
        centers = surface.shape.triangles.mean(1)
        inward = np.einsum("ij,ij->i", centers[g] - centers[f], self._normals[f] - self._normals[g])
        cut = (inward > 0) & (self._cosine < CREASE)
        if len(self._mesh.faces) <= DENSE:
            patch = split_patches(surface, seams=False, soft=True)
            cut &= (np.bincount(component) <= SHARP)[component[f]]
            cut |= patch[f] != patch[g]
        facet = label_connected(len(component), pairs[self._cosine > SMOOTH])
        region = label_connected(len(component), pairs[~cut])
        labels = {Level.FACET: facet, Level.REGION: region, Level.PIECE: component}
        return {level: label[surface.row] for level, label in labels.items()}


def faces_inside(
    triangles: Float[np.ndarray, "F 3 3"], camera: Camera, outline: Float[np.ndarray, "k 2"]
) -> tuple[Int[np.ndarray, " n"], Float[np.ndarray, "n 7 3"], Bool[np.ndarray, "n 7"]]:
    """Return the faces of which at least half lies in an outline drawn on the picture, with points on them.

    outline: corners, 0..1 from the upper left corner of the picture; points: (n, 7, 3) [m], with which of them lie in it.
    """
    mask = Image.new("1", (MASK, MASK))
    ImageDraw.Draw(mask).polygon([(float(x) * MASK, float(y) * MASK) for x, y in outline], fill=1)
    filled = np.asarray(mask)
    points = np.einsum("sk,fkd->fsd", SAMPLES, triangles)
    pixels, depth = camera.project(points.reshape(-1, 3))
    with np.errstate(invalid="ignore"):
        at = np.floor(pixels / (camera.width, camera.height) * MASK)
    shown = (depth > 0) & ((at >= 0) & (at < MASK)).all(1)
    x, y = np.where(shown[:, None], at, 0).astype(np.int64).T
    inside = (shown & filled[y, x]).reshape(points.shape[:2])
    faces = np.flatnonzero(2 * inside.sum(1) >= len(SAMPLES))
    return faces, points[faces], inside[faces]
