"""Points on an object's surface, their superpoints, and which of them a view sees (paper, 3.2)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8
from scipy.spatial import KDTree

from anymesh.geometry.superpoints import superpoints
from anymesh.geometry.surface import ObjectShape
from anymesh.geometry.topology import label_connected, strongest
from anymesh.geometry.triangle_set import SurfacePoints, sample_surface
from anymesh.rendering.render import View, face_colors
from anymesh.types import Brief, Mesh

CUT_POINTS = 40_000  # points used for the cut; 800k points would take 20 s and give the same borders
NEIGHBOURS = 10  # points that each point is connected to
STRENGTH = 0.05  # of l0 cut pursuit on [normal, COLOR_WEIGHT * colour]
COLOR_WEIGHT = 0.3
MIN_SUPERPOINT_POINTS = 10  # smaller superpoints join a neighbour
FOOTPRINT = 1.5  # [px] a point is visible if its depth is this close to that of its pixel and the normals agree
MIN_NORMAL_COSINE = 0.7  # minimum cosine between these normals: separates the back of a door from the rim beside it
SIMILAR = 0.9  # minimum cosine between normals of one surface
NORMAL_WEIGHT = 4.0  # a difference of 60 degrees between normals counts as a distance of this many spacings


@dataclass(frozen=True, eq=False)
class Cloud(Brief):
    """Points on the surface of an object.

    colors: sRGB; faces: mesh face of each point; superpoint: superpoint index per point, where no superpoint spans two patches;
    borders: (m, 2) pairs of adjacent superpoints; boxes: (S, 2, 3) bounds of each superpoint; diagonal: of the object [m].
    """

    points: Float[np.ndarray, "n 3"]
    normals: Float[np.ndarray, "n 3"]
    colors: UInt8[np.ndarray, "n 3"]
    faces: Int[np.ndarray, " n"]
    superpoint: Int[np.ndarray, " n"]
    borders: Int[np.ndarray, "m 2"]
    boxes: Float[np.ndarray, "S 2 3"]
    diagonal: float

    @property
    def count(self) -> int:
        """Return the number of superpoints."""
        return len(self.boxes)

    def __len__(self) -> int:
        return len(self.points)


@dataclass(frozen=True, eq=False)
class Sight(Brief):
    """Points of a cloud that a view sees.

    points: indices of the points; pixels: row * width + column of each.
    """

    points: Int[np.ndarray, " k"]
    pixels: Int[np.ndarray, " k"]


def sample_cloud(mesh: Mesh, whole: ObjectShape, count: int, seed: int = 0) -> Cloud:
    """Sample about `count` points evenly by area, at least one per face, and cut them into superpoints by normal and colour.

    The superpoints come from l0 cut pursuit.
    """
    s = sample_surface(mesh.triangles, count, seed, at_least=1)
    colors = point_colors(mesh, s)
    label, borders = find_superpoints(s, colors, whole.mesh_patch[s.faces])
    boxes = np.stack([np.full((int(label.max()) + 1, 3), np.inf), np.full((int(label.max()) + 1, 3), -np.inf)], 1)
    np.minimum.at(boxes[:, 0], label, s.points)
    np.maximum.at(boxes[:, 1], label, s.points)
    return Cloud(s.points, s.normals, colors, s.faces, label, borders, boxes, whole.diagonal)


def point_colors(mesh: Mesh, s: SurfacePoints) -> UInt8[np.ndarray, "n 3"]:
    """Return the sRGB colour at every point, sampled from the texture where a face has one."""
    if mesh.corner_color is None and (mesh.corner_uv is None or not any(m.textures for m in mesh.materials)):
        return face_colors(mesh)[s.faces]
    weights = _barycentric(mesh.triangles[s.faces], s.points)

    def at_points(corners: np.ndarray | None) -> np.ndarray | None:
        if corners is None:
            return None
        value = np.einsum("nk,nkc->nc", weights, corners[s.faces].astype(np.float64))
        value = np.rint(value) if corners.dtype == np.uint8 else value
        return np.repeat(value[:, None], 3, 1).astype(corners.dtype)

    dots = replace(  # a mesh with one degenerate face per point, so that its face colours are those of the points
        mesh, vertices=np.zeros((1, 3)), faces=np.zeros((len(s), 3), np.int64), face_node=mesh.face_node[s.faces],
        face_material=mesh.face_material[s.faces], corner_uv=at_points(mesh.corner_uv),
        corner_color=at_points(mesh.corner_color), corner_normal=None, corner_more_uv=None,
    )  # fmt: skip
    return face_colors(dots)


def _barycentric(t: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Return the barycentric weights of the three corners (n, 3)."""
    a, b, p = t[:, 1] - t[:, 0], t[:, 2] - t[:, 0], points - t[:, 0]
    aa, ab, bb, pa, pb = (np.einsum("ij,ij->i", x, y) for x, y in ((a, a), (a, b), (b, b), (p, a), (p, b)))
    below = np.maximum(aa * bb - ab * ab, 1e-300)
    u, v = (bb * pa - ab * pb) / below, (aa * pb - ab * pa) / below
    return np.clip(np.stack([1 - u - v, u, v], 1), 0, 1)


def find_superpoints(
    s: SurfacePoints, colors: UInt8[np.ndarray, "n 3"], patch: Int[np.ndarray, " n"]
) -> tuple[Int[np.ndarray, " n"], Int[np.ndarray, "m 2"]]:
    """Return a superpoint index per point, and the pairs of adjacent superpoints.

    The cut runs on CUT_POINTS of the points, within each patch. Every other point takes the superpoint of the nearest of these
    in its patch that has a similar normal.
    """
    chosen = np.arange(0, len(s), max(1, len(s) // CUT_POINTS))
    first = np.unique(patch, return_index=True)[1]
    chosen = np.union1d(chosen, first)  # at least one point per patch
    beyond = 10 * float(np.ptp(s.points, axis=0).max())
    own = np.c_[s.points, beyond * patch][chosen]  # a coordinate that keeps neighbours within a patch, however thin a gap is
    near = KDTree(own).query(own, k=min(NEIGHBOURS + 1, len(chosen)), workers=-1)[1]
    near = near.reshape(len(chosen), -1)
    edges = np.sort(np.stack([np.repeat(np.arange(len(chosen)), near.shape[1]), near.reshape(-1)], 1), 1)
    edges = edges[(edges[:, 0] != edges[:, 1]) & (patch[chosen[edges[:, 0]]] == patch[chosen[edges[:, 1]]])]
    key = np.unique(edges @ np.array([len(chosen), 1]))
    edges = np.stack([key // len(chosen), key % len(chosen)], 1)
    signal = np.concatenate([s.normals, COLOR_WEIGHT * colors / 255.0], 1)[chosen]
    ones = np.ones(len(chosen))
    label = superpoints(signal, ones, edges, np.ones(len(edges)), STRENGTH)
    nearest = _nearest_alike(s, patch, chosen)
    label = _absorb_small(label, np.bincount(nearest, minlength=len(chosen)), edges, MIN_SUPERPOINT_POINTS)
    pairs = np.sort(label[edges], 1)
    return label[nearest], np.unique(pairs[pairs[:, 0] != pairs[:, 1]], axis=0)


def _nearest_alike(s: SurfacePoints, patch: np.ndarray, chosen: np.ndarray) -> Int[np.ndarray, " n"]:
    """Return for every point the nearest chosen point of the same patch with a similar normal, as an index into `chosen`."""
    gap, nearest = KDTree(s.points[chosen]).query(s.points, workers=-1)
    neighbours = chosen[nearest]
    alike = np.einsum("ij,ij->i", s.normals, s.normals[neighbours]) > SIMILAR
    wrong = np.flatnonzero((patch != patch[neighbours]) | ~alike)
    spacing = float(np.median(gap[gap > 0])) if (gap > 0).any() else 1.0
    # greater than any distance within a patch
    apart = 10 * float(np.ptp(s.points, axis=0).max()) / spacing + 10 * NORMAL_WEIGHT

    def feature(index: np.ndarray) -> np.ndarray:
        return np.c_[s.points[index] / spacing, NORMAL_WEIGHT * s.normals[index], apart * patch[index]]

    if len(wrong):
        nearest[wrong] = KDTree(feature(chosen)).query(feature(wrong), workers=-1)[1]
    return nearest


def _absorb_small(label: np.ndarray, weight: np.ndarray, edges: np.ndarray, min_points: int) -> Int[np.ndarray, " n"]:
    """Join superpoints of fewer than `min_points` points (weight: points per node) to the neighbour with the longest border."""
    while True:
        count = int(label.max()) + 1
        small = np.bincount(label, weight, count) < min_points
        a, b = label[edges].T
        source, target = np.r_[a, b], np.r_[b, a]
        use = small[source] & (source != target)
        if not use.any():
            return label
        label = label_connected(count, np.stack(strongest(source[use], target[use], None, count), 1))[label]


def seen_points(cloud: Cloud, views: Sequence[View]) -> Bool[np.ndarray, " n"]:
    """Return which points of the cloud some view shows."""
    shown = np.zeros(len(cloud), bool)
    for view in views:
        shown[sight(cloud, view).points] = True
    return shown


def sight(cloud: Cloud, view: View) -> Sight:
    """Return the points that the view shows and the pixel of each.

    A point is visible if its pixel shows its face. Since faces may be smaller than pixels, a point is also visible if its depth
    is within FOOTPRINT pixels of the depth at its pixel and the normals there agree.
    """
    camera = view.camera
    pixel, depth = camera.project(cloud.points)
    column, row = pixel.T
    inside = np.flatnonzero((depth > 0) & (column >= 0) & (column < camera.width) & (row >= 0) & (row < camera.height))
    at = row[inside].astype(np.int64) * camera.width + column[inside].astype(np.int64)
    seen = view.face.reshape(-1)[at] == cloud.faces[inside]
    off = np.abs(view.depth.reshape(-1)[at] - depth[inside])
    near = np.flatnonzero(~seen & (off < FOOTPRINT * depth[inside] / camera.focal))
    facing = np.einsum("ij,ij->i", view.normal.reshape(-1, 3)[at[near]], cloud.normals[inside[near]])
    seen[near] = np.abs(facing) > MIN_NORMAL_COSINE
    return Sight(inside[seen], at[seen])
