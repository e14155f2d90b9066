"""Distance between two patches, whether they cross, and the area in which they touch."""

from __future__ import annotations

import numpy as np
from scipy.spatial.distance import cdist

from anymesh.geometry.boxes import within
from anymesh.geometry.triangle_set import TriangleSet, spread_points
from anymesh.types.triangles import meet_box, normals_and_areas, quartered

PROBES = 160  # sample points per patch for the distance to another patch
COARSE = 6  # every how many of these points are measured first
AREA_POINTS = 500  # sample points of a patch near another one, for the area in contact
MAX_DIVIDED = 2000  # triangles of a patch, up to which those near another patch are divided until they are as small as it
ROUNDING = 1e-9  # of the reach: tolerance of bounds of distances


def gap_within(a: TriangleSet, b: TriangleSet, reach: float, enough: float = 0.0) -> float:
    """Return the smallest distance from a to b [m], from a's corners and samples within reach of b's box.

    A result below `enough` or from `reach` on is an upper bound of the smallest distance.

    Every sixth point is measured first. The distance of another point differs by at most its distance to that point, and those
    that cannot be the closest are not measured.
    """
    low, high = b.bounds[0] - reach, b.bounds[1] + reach
    points = [p[within(p, low, high)] for p in (a.corners, a.samples.points)]
    points = [p[:: max(1, len(p) // PROBES)] for p in points]
    probe = np.concatenate(points)
    if len(probe) == 0:
        return np.inf
    rough = probe[::COARSE]
    distance = b.tree.distance(rough)
    gap = float(distance.min())
    if gap < enough:
        return gap
    bound = (distance - cdist(probe, rough)).max(1)
    bound[::COARSE] = np.inf
    closer = probe[bound < min(gap, reach) + ROUNDING * reach]
    return min(gap, float(b.tree.distance(closer).min())) if len(closer) else gap


def crosses(a: TriangleSet, b: TriangleSet) -> bool:
    """Return whether edges of one shape pass through faces of the other."""
    for one, other in ((a, b), (b, a)):
        start = one.triangles.reshape(-1, 3)
        span = one.triangles[:, [1, 2, 0]].reshape(-1, 3) - start
        step = max(1, len(start) // 3000)
        start, span = start[::step], span[::step]
        face = other.scene.first_hit(start, span, 1.0).face
        hit = np.flatnonzero(face >= 0)
        if len(hit) == 0:
            continue
        slope = np.abs(np.einsum("ij,ij->i", span[hit], other.normals[face[hit]]))
        # a ray in the plane of a face gives no reliable hit
        if (slope > 0.02 * np.linalg.norm(span[hit], axis=1)).any():
            return True
    return False


def area_in_contact(a: TriangleSet, b: TriangleSet, tolerance: float) -> float:
    """Return the area of a within the tolerance of b [m^2], from samples of a near b."""
    low, high = b.bounds[0] - tolerance, b.bounds[1] + tolerance
    triangles = a.triangles[meet_box(a.triangles, low, high)]
    areas = normals_and_areas(triangles)[1]
    while 0 < len(triangles) <= MAX_DIVIDED and areas.sum() > b.area:
        parts = quartered(triangles)
        triangles = parts[meet_box(parts, low, high)]
        areas = normals_and_areas(triangles)[1]
    points, _ = spread_points(triangles, areas, AREA_POINTS, a.seed)
    gap = b.tree.distance(points[within(points, low, high)])
    return float(areas.sum()) * float((gap < tolerance).sum()) / max(len(points), 1)
