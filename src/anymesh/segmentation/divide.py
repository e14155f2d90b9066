"""Divide a surface into patches: connected components, divided at concave creases, and at panels on fused surfaces."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Int
from scipy.spatial import KDTree

from anymesh.config import SAME_SIZE
from anymesh.entry_points import DRAWN_OUT, SEALED, resolve
from anymesh.geometry.creases import MIN_CREASE_DEG, convex_regions, divide_at_seams
from anymesh.geometry.distance_ import TriangleTree
from anymesh.geometry.surface import DividedSurface, MeshSurface, ObjectShape, mesh_surface
from anymesh.geometry.topology import label_connected, strongest
from anymesh.geometry.triangle_set import spread_points
from anymesh.segmentation.handles import region_sizes
from anymesh.segmentation.panels import split_panels
from anymesh.types import Mesh
from anymesh.types.triangles import boxes_meet, centers_of, label_bounds, lengths

# lengths are relative to the object's diagonal
FUSED_SIZE_RATIO = 0.35  # smaller components are not cut along their creases
MAX_SHARP_FACES = 3000  # components with at most this many faces have sharp creases only
CRUMB_RATIO = 0.02  # regions smaller than this, left by a cut, join their neighbour
MAX_PATCHES = 1500  # number of patches above which small ones join their nearest larger one
MAX_MEETING_PAIRS = 20_000  # number of pairs of patches with meeting boxes above which they do so too
SEAM_POINTS = 40_000  # samples of the dense components for their seams
MIN_SEAM_POINTS = 500  # of these, below which a region is not divided


def object_shape(
    mesh: Mesh, seed: int = 0, labels: Int[np.ndarray, " F"] | None = None, *, seams: bool = False, soft: bool = True
) -> ObjectShape:
    """Orient, split and simplify a mesh; the mesh is not modified.

    labels: (F,) parts that are kept apart; seams, soft: as in `split_patches`.
    """
    return divide_surface(mesh, seed, seams=seams, soft=soft).simplified(labels)


def divide_surface(mesh: Mesh, seed: int, *, seams: bool = False, soft: bool = True) -> DividedSurface:
    """Orient a mesh and divide it into patches, as `split_patches` does; the mesh is not modified."""
    surface = resolve(SEALED)(mesh_surface(mesh, seed))
    drawn = resolve(DRAWN_OUT)(surface)
    # a cut through the front of a body would otherwise go through what is sunk into it
    patch = split_patches(surface if drawn is None else replace(surface, shape=drawn), seams=seams, soft=soft)
    pairs = patch.take(surface.components.edges.faces)
    shared = np.unique(np.sort(pairs[pairs[:, 0] != pairs[:, 1]], 1), axis=0)
    shape = surface.shape
    if len(patch) < len(mesh.faces):  # otherwise none is a copy
        shape, patch = shape.take(surface.row), patch[surface.row]
    return DividedSurface(shape, surface.copy, patch, shared, surface.diagonal, mesh.face_pivot)


def split_patches(surface: MeshSurface, *, seams: bool, soft: bool) -> Int[np.ndarray, " F"]:
    """Return a patch index per face, from 0.

    Components that are large enough to contain a fused part are cut along their concave creases, sharp or (soft) rounded, and
    (seams) at creases that are closed in places. Crumbs left by the cut join the neighbour with the longest common edge.
    """
    component = surface.components.label
    large = region_sizes(surface, component) > FUSED_SIZE_RATIO * surface.diagonal
    edges = surface.components.edges
    pairs = edges.faces
    concave = _concave(surface, MIN_CREASE_DEG)
    convex = _soft_regions(surface, component, large) if soft else component
    cut = (concave & edges.aligned & large[component[pairs[:, 0]]]) | (convex[pairs[:, 0]] != convex[pairs[:, 1]])
    region = split_panels(surface, label_connected(len(component), pairs[~cut]))
    if seams:
        region = _split_at_seams(surface, region, large & (np.bincount(component) > MAX_SHARP_FACES))
    cut |= region[pairs[:, 0]] != region[pairs[:, 1]]
    ends = surface.vertices[edges.vertices[cut]]
    region = _absorb_crumbs(surface, region, pairs[cut], lengths(ends[:, 0] - ends[:, 1]))
    region = _fill_voids(surface, region)
    region = _limit_count(surface, region, MAX_PATCHES)
    return _limit_pairs(surface, region, MAX_MEETING_PAIRS)


def _soft_regions(surface: MeshSurface, component: np.ndarray, large: np.ndarray) -> np.ndarray:
    """Return regions bounded by soft concave creases on large and dense components; other components are one region each."""
    region = component.copy()
    count = np.bincount(component)
    for c in np.flatnonzero(large & (count > MAX_SHARP_FACES)):
        mine = np.flatnonzero(component == c)
        convex_region = convex_regions(surface.shape.triangles[mine], surface.diagonal)
        region[mine] = np.where(convex_region > 0, int(region.max()) + convex_region, c)
    return region


def _split_at_seams(surface: MeshSurface, region: np.ndarray, dense: Bool[np.ndarray, " c"]) -> np.ndarray:
    """Divide the regions of some components at seams.

    dense: which components.
    """
    if not dense.any():
        return region
    divided, component = region.copy(), surface.components.label
    mine = np.flatnonzero(dense[component])
    points, at = spread_points(surface.shape.triangles[mine], surface.shape.areas[mine], SEAM_POINTS, surface.shape.seed)
    faces = mine[at]
    for r, count in zip(*np.unique(region[faces], return_counts=True), strict=True):
        if count < MIN_SEAM_POINTS:
            continue
        inside = region[faces] == r
        outside = (component[faces] == component[faces[inside][0]]) & ~inside
        finer = divide_at_seams(points[inside], surface.shape.normals[faces[inside]], points[outside])
        if finer.any():
            all_ = np.flatnonzero(region == r)
            nearest = KDTree(points[inside]).query(centers_of(surface.shape.triangles[all_]), workers=-1)[1]
            divided[all_] = np.where(finer[nearest] > 0, int(divided.max()) + finer[nearest], r)
    return np.unique(divided, return_inverse=True)[1]  # coarse faces may leave numbers unused


def _concave(surface: MeshSurface, min_angle: float) -> np.ndarray:
    """Return which edge pairs fold inwards by more than `min_angle` [deg]."""
    f, g = surface.components.edges.faces.T
    centers = centers_of(surface.shape.triangles)
    away = centers.take(g, axis=0) - centers.take(f, axis=0)
    normals, others = (surface.shape.normals.take(faces, axis=0) for faces in (f, g))
    inward = np.einsum("ij,ij->i", away, normals) - np.einsum("ij,ij->i", away, others)
    cosine = np.einsum("ij,ij->i", normals, others)
    return (inward > 0) & (cosine < np.cos(np.deg2rad(min_angle)))


def _absorb_crumbs(surface: MeshSurface, region: np.ndarray, pairs: np.ndarray, length: np.ndarray) -> np.ndarray:
    """Join regions that are too small to the neighbour with the longest common border; three rounds resolve chains."""
    for _ in range(3):
        small = region_sizes(surface, region) < CRUMB_RATIO * surface.diagonal
        small |= np.bincount(region, surface.shape.areas) < (CRUMB_RATIO * surface.diagonal) ** 2  # slivers along a groove
        a, b = region[pairs[:, 0]], region[pairs[:, 1]]
        source, target = np.r_[a, b], np.r_[b, a]
        weight = np.r_[length, length]
        use = small[source] & (source != target)
        if not use.any():
            break
        joined = strongest(source[use], target[use], weight[use], len(small))
        region = label_connected(len(small), np.stack(joined, 1))[region]
    return region


def _fill_voids(surface: MeshSurface, region: np.ndarray) -> np.ndarray:
    """Assign the walls of closed cavities to the nearest other region, since nothing inside moves."""
    hidden = surface.void[surface.components.label]
    if not hidden.any():
        return region
    centers = centers_of(surface.shape.triangles)
    nearest = KDTree(centers[~hidden]).query(centers[hidden], workers=-1)[1]
    target = region.copy()
    for r in np.unique(region[hidden]):
        inside = region[hidden] == r
        target[region == r] = np.bincount(region[~hidden][nearest[inside]]).argmax()
    return np.unique(target, return_inverse=True)[1].reshape(-1)


def _limit_count(surface: MeshSurface, region: np.ndarray, max_count: int) -> np.ndarray:
    """Limit the number of patches to about `max_count`: the smallest join their nearest larger one.

    All copies of one size are treated alike.
    """
    count = int(region.max()) + 1
    if count <= max_count:
        return region
    size = region_sizes(surface, region)
    order = np.argsort(-size, kind="stable")
    larger = order[size[order] > (1 + SAME_SIZE) * size[order[max_count]]]
    return _keep(surface, region, larger if len(larger) > 1 else order[:max_count])


def _keep(surface: MeshSurface, region: np.ndarray, keep: np.ndarray) -> np.ndarray:
    """Join all other regions to the nearest of those that are kept."""
    count = int(region.max()) + 1
    centers = centers_of(surface.shape.triangles)
    lost = np.setdiff1d(np.arange(count), keep)
    middle = np.zeros((count, 3))
    np.add.at(middle, region, centers)
    middle /= np.bincount(region, minlength=count)[:, None]
    faces = np.flatnonzero(np.isin(region, keep))
    nearest = region[faces[TriangleTree(surface.shape.triangles[faces]).nearest(middle[lost])[1]]]
    target = np.arange(count)
    target[lost] = nearest
    return np.unique(target[region], return_inverse=True)[1].reshape(-1)


def _limit_pairs(surface: MeshSurface, region: np.ndarray, max_pairs: int) -> np.ndarray:
    """Limit the number of pairs of patches whose boxes meet, each of which is measured later.

    The smallest patches join their nearest larger one.
    """
    while True:
        count, pairs = int(region.max()) + 1, _meeting_boxes(surface, region)
        if pairs <= max_pairs:
            return region
        largest = np.argsort(-region_sizes(surface, region), kind="stable")
        region = _keep(surface, region, largest[: int(count * np.sqrt(max_pairs / pairs))])


def _meeting_boxes(surface: MeshSurface, region: np.ndarray) -> int:
    """Return the number of pairs of regions whose axis-aligned boxes meet."""
    low, high = label_bounds(region, surface.shape.lowest, surface.shape.highest)
    return sum(int(boxes_meet(low[k + 1 :], high[k + 1 :], low[k], high[k]).sum()) for k in range(len(low)))
