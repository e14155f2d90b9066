"""Convex hulls of surfaces, cuts of both by planes, and boxes and cylinders as replacements of hulls that they fit."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
from jaxtyping import Float
from scipy.spatial import ConvexHull, QhullError

from anymesh.geometry.boxes import dominant_normals, fit_box
from anymesh.geometry.circles import roundest
from anymesh.geometry.triangle_set import spread_directions
from anymesh.types import Box, Cylinder, Hull, Shape
from anymesh.types.triangles import CUBE_CORNERS, crosses, face_cross, normals_and_areas

MIN_VOLUME = 1e-12  # [m^3] MuJoCo refuses smaller meshes, also in a URDF
MAX_CORNERS = 64  # corners of a hull; GPU engines accept no more
MIN_THICKNESS_RATIO = 1e-4  # of the diagonal: no engine accepts thinner hulls
DIRECTIONS = spread_directions(MAX_CORNERS)
EXACT = 1e-6  # for a trimmed hull, which a box must not exceed again
FIT = 0.02  # maximum relative difference between the volumes of a primitive and the hull
ROUND = 0.97  # minimum round share of a cylinder's outline; an octagon has less


def hull_of(points: Float[np.ndarray, "n 3"], wall: float = 0.0, inward: np.ndarray | None = None) -> Hull | None:
    """Return the convex hull of points; flat ones are made `wall` [m] thick along `inward` (unit; None: evenly both ways).

    Return None if there are fewer than three points off a line, or if they are flat and `wall` is 0.
    """
    points = points[np.lexsort(points.T[::-1])] + 0.0  # distinct ones in order, in a fifth of the time of `np.unique`
    points = points[np.append(True, (points[1:] != points[:-1]).any(1))[: len(points)]]
    if len(points) < 3:
        return None
    spread = points - points.mean(0)
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    axes = np.linalg.svd(spread, full_matrices=False)[2] if len(points) > 3 else np.linalg.svd(spread)[2]
    extent = np.ptp(spread @ axes.T, axis=0)
    if size == 0 or extent[1] <= MIN_THICKNESS_RATIO * size:
        return None
    if extent[2] <= max(MIN_THICKNESS_RATIO * size, 1e-9):
        if wall <= 0:
            return None
        normal = axes[2]
        flat = points - np.outer((spread @ normal), normal)  # exactly plane, so that Qhull sees exactly two sheets
        if inward is None:
            points = np.concatenate([flat + normal * wall / 2, flat - normal * wall / 2])
        else:
            points = np.concatenate([flat, flat + normal * wall * (1.0 if inward @ normal > 0 else -1.0)])
    try:
        hull = ConvexHull(points, qhull_options="Q5")  # without a check at the end, which changes nothing
    except QhullError:
        return None
    used = np.bincount(hull.simplices.reshape(-1), minlength=len(points)) > 0
    vertices, faces = points[used], (np.cumsum(used) - 1)[hull.simplices]
    inside = np.einsum("ij,ij->i", face_cross(vertices[faces]), hull.equations[:, :3]) < 0
    faces[inside] = faces[inside][:, ::-1]
    return Hull(vertices, faces)


def thinned(hull: Hull) -> Hull:
    """Reduce a hull with more than MAX_CORNERS corners to its furthest corner in each of as many directions."""
    if len(hull.vertices) <= MAX_CORNERS:
        return hull
    furthest = np.unique((hull.vertices @ DIRECTIONS.T).argmax(0))
    return hull_of(hull.vertices[furthest]) or hull


def volume(hull: Hull) -> float:
    """Return the volume of a hull [m^3]."""
    t = hull.vertices[hull.faces] - hull.vertices.mean(0)
    return float(np.einsum("ij,ij->i", t[:, 0], crosses(t[:, 1], t[:, 2])).sum() / 6)


def planes(hull: Hull) -> Float[np.ndarray, "F 4"]:
    """Return the outward unit normal and offset of every face: inside is normal . x + offset <= 0.

    Faces without area are left out.
    """
    cross = face_cross(hull.vertices[hull.faces])
    length = np.linalg.norm(cross, axis=1)
    real = length > 1e-12 * length.max()
    normal = cross[real] / length[real][:, None]
    return np.c_[normal, -np.einsum("ij,ij->i", normal, hull.vertices[hull.faces[real, 0]])]


def cut(
    triangles: Float[np.ndarray, "n 3 3"], normal: Float[np.ndarray, " 3"], offset: float
) -> tuple[Float[np.ndarray, "a 3 3"], Float[np.ndarray, "b 3 3"]]:
    """Return the triangles below (normal . x <= offset) and above a plane; those that cross it are divided."""
    height = triangles @ normal - offset
    tolerance = 1e-9 * (float(np.abs(height).max(initial=0.0)) + 1e-12)
    height = np.where(np.abs(height) <= tolerance, 0.0, height)
    above = (height >= 0).all(1) & (height > 0).any(1)
    crossing = (height > 0).any(1) & (height < 0).any(1)
    below = np.concatenate([triangles[~above & ~crossing], _clipped(triangles[crossing], -height[crossing])])
    return below, np.concatenate([triangles[above], _clipped(triangles[crossing], height[crossing])])


def _clipped(triangles: np.ndarray, height: np.ndarray) -> np.ndarray:
    """Return the parts of triangles where `height` >= 0, one or two triangles of each; each has corners on both sides of 0."""
    ahead, then = height[:, [1, 2, 0]], triangles[:, [1, 2, 0]]
    met = ((height > 0) & (ahead < 0)) | ((height < 0) & (ahead > 0))
    share = height / np.where(met, height - ahead, 1.0)
    corners = np.stack([triangles, triangles + (then - triangles) * share[:, :, None]], 2).reshape(-1, 6, 3)
    there = np.stack([height >= 0, met], 2).reshape(-1, 6)
    order = np.argsort(~there, axis=1, kind="stable")[:, [0, 1, 2, 0, 2, 3], None]
    return np.take_along_axis(corners, order, 1).reshape(-1, 2, 3, 3)[there.sum(1)[:, None] >= [3, 4]]


def trimmed(hull: Hull, normal: Float[np.ndarray, " 3"], offset: float) -> Hull | None:
    """Return the part of a hull with normal . x <= offset; None if nothing is left."""
    below, _ = cut(hull.vertices[hull.faces], normal, offset)
    return hull_of(below.reshape(-1, 3)) if len(below) else None


def fitted(hull: Hull, fit: float = FIT) -> Shape:
    """Return the box or cylinder that fits a hull within the share `fit` of its volume; else the hull, with few corners."""
    normals, areas = normals_and_areas(hull.vertices[hull.faces])
    exact = volume(hull)
    box = fit_box(hull.vertices, normals, areas)
    size = 2 * box.half
    if abs(float(size.prod()) - exact) <= fit * exact:
        return Box(box.center, box.axes.T.copy(), size)
    return _cylinder(hull, dominant_normals(normals, areas, count=2), exact, fit) or thinned(hull)


def _cylinder(hull: Hull, directions: np.ndarray, exact: float, fit: float) -> Cylinder | None:
    if len(directions) == 0:
        return None
    outline = roundest(hull.vertices, directions)
    if outline.roundness < ROUND:
        return None
    along = (hull.vertices - outline.center) @ outline.axis
    ends = np.abs(np.abs(along) - outline.height / 2) <= 0.02 * outline.height
    ideal = np.pi * outline.radius**2 * outline.height
    if not ends.all() or abs(ideal - exact) > 2 * fit * exact:
        return None
    helper = np.eye(3)[np.abs(outline.axis).argmin()]
    u = np.cross(helper, outline.axis)
    u /= np.linalg.norm(u)
    rotation = np.stack([u, np.cross(outline.axis, u), outline.axis], 1)
    return Cylinder(outline.center, rotation, outline.radius, outline.height)


def engine_shape(shape: Shape) -> Shape:
    """Return the box of a hull whose volume is too small for engines; other shapes as they are."""
    if not isinstance(shape, Hull) or volume(shape) >= MIN_VOLUME:
        return shape
    box = fit_box(shape.vertices, *normals_and_areas(shape.vertices[shape.faces]))
    return Box(box.center, box.axes.T.copy(), 2 * box.half)


def as_hull(shape: Shape) -> Hull:
    """Return a shape as a convex polyhedron; a cylinder becomes its inscribed prism of 32 sides."""
    match shape:
        case Hull():
            return shape
        case Box():
            unit, size = _unit_hulls()[0], shape.size
        case Cylinder():
            unit, size = _unit_hulls()[1], np.array([shape.radius, shape.radius, shape.length])
    return Hull((unit.vertices * size) @ shape.rotation.T + shape.center, unit.faces)


@cache
def _unit_hulls() -> tuple[Hull, Hull]:
    """Return a cube of side 1 and a prism of radius and length 1.

    Scaling them gives faces that do not depend on how thin a shape is.
    """
    angle = np.arange(32) / 32 * 2 * np.pi
    ring = np.c_[np.cos(angle), np.sin(angle)]
    box, prism = hull_of(CUBE_CORNERS - 0.5), hull_of(np.concatenate([np.c_[ring, np.full(32, z)] for z in (-0.5, 0.5)]))
    assert box is not None
    assert prism is not None
    return box, prism


def shifted(shape: Shape, by: Float[np.ndarray, " 3"]) -> Shape:
    """Return a shape moved by a vector [m]."""
    match shape:
        case Hull():
            return Hull(shape.vertices + by, shape.faces)
        case Box() | Cylinder():
            return replace(shape, center=shape.center + by)
