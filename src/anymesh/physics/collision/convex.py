"""Convex hulls of surfaces, and cuts of both by planes."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float
from scipy.spatial import ConvexHull, QhullError

from anymesh.geometry.triangle_set import spread_directions
from anymesh.types import Hull
from anymesh.types.triangles import face_cross

MIN_VOLUME = 1e-12  # [m^3] MuJoCo refuses smaller meshes, also in a URDF
MAX_CORNERS = 64  # corners of a hull; GPU engines accept no more
MIN_THICKNESS_RATIO = 1e-4  # of the diagonal: no engine accepts thinner hulls


DIRECTIONS = spread_directions(MAX_CORNERS)


def hull_of(points: Float[np.ndarray, "n 3"], wall: float = 0.0, inward: np.ndarray | None = None) -> Hull | None:
    """Return the convex hull of points; flat ones are made `wall` [m] thick along `inward` (unit; None: evenly both ways).

    Return None if there are fewer than three points off a line, or if they are flat and `wall` is 0.
    """
    points = np.unique(points + 0.0, axis=0)
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
        hull = ConvexHull(points)
    except QhullError:
        return None
    used, inverse = np.unique(hull.simplices, return_inverse=True)
    vertices, faces = points[used], inverse.reshape(-1, 3)
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
    return float(np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() / 6)


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
    parts = [triangles[~above & ~crossing]], [triangles[above]]
    for t, h in zip(triangles[crossing], height[crossing], strict=True):
        for side, sign in zip(parts, (-1, 1), strict=True):
            polygon = _clipped(t, h * sign)
            side.append(np.stack([polygon[[0, k, k + 1]] for k in range(1, len(polygon) - 1)]))
    return np.concatenate(parts[0]), np.concatenate(parts[1])


def _clipped(triangle: np.ndarray, height: np.ndarray) -> np.ndarray:
    """Return the polygon of a triangle where `height` >= 0."""
    polygon = []
    for k in range(3):
        a, b = height[k], height[(k + 1) % 3]
        if a >= 0:
            polygon.append(triangle[k])
        if (a > 0 > b) or (a < 0 < b):
            polygon.append(triangle[k] + (triangle[(k + 1) % 3] - triangle[k]) * (a / (a - b)))
    return np.array(polygon)


def trimmed(hull: Hull, normal: Float[np.ndarray, " 3"], offset: float) -> Hull | None:
    """Return the part of a hull with normal . x <= offset; None if nothing is left."""
    below, _ = cut(hull.vertices[hull.faces], normal, offset)
    return hull_of(below.reshape(-1, 3)) if len(below) else None
