"""Directions that may point up in a mesh, and named features of each: how the object would stand.

The features do not depend on the mesh's position, rotation or size (of dense meshes, nearly). Lengths are relative to twice the
distance of the farthest corner from the center of the surface.
"""

from __future__ import annotations

import numpy as np
from jaxtyping import Float
from scipy.spatial import ConvexHull, QhullError

from anymesh.loading.stander import FLAT_COSINE, Stander, distinct
from anymesh.scoring.classifier import MISSING

MAX_FACETS = 14  # largest flat facets of the convex hull on which the object may stand
END_RATIO = 0.02  # of the height: the ends of the object, for samples
STAND_RATIO = 0.01  # of the diagonal: depth of the convex hull's end on which the object would stand
MIN_SIDE = 1e-6  # of an outline
ACROSS_COSINE = 0.1  # maximum cosine of the angle between a mirror plane's normal and up


def up_candidates(shape: Stander) -> Float[np.ndarray, "k 3"]:
    """Return unit directions that may point up: the axes, what the surface faces, opposite to the hull's facets."""
    lines = [*np.eye(3), *shape.flats]
    ways = [sign * line for line in lines for sign in (1.0, -1.0)]
    return distinct([*ways, *-shape.facets[:MAX_FACETS], *shape.main_axes, *-shape.main_axes])


def up_features(shape: Stander, candidates: Float[np.ndarray, "k 3"]) -> list[dict[str, float]]:
    """Return the features of each candidate; the keys are the same for all."""
    return [_features(shape, up) for up in candidates]


def _features(shape: Stander, up: Float[np.ndarray, " 3"]) -> dict[str, float]:
    ground = _ground_axes(up)
    heights, outline = shape.corners @ up, shape.corners @ ground.T
    low, height = float(heights.min()), max(float(np.ptp(heights)), 1e-9)
    share = (shape.points @ up - low) / height
    facing = shape.normals @ up
    area, width, length = _outline(outline)
    spread = np.linalg.norm(shape.points @ ground.T, axis=1) / np.sqrt(area)
    normals, residuals = shape.mirrors
    upright = residuals[np.abs(normals @ up) < ACROSS_COSINE]
    upside_down = shape.asymmetry(up)
    values = {
        "height over length": float(np.log2(height / length)),
        "height over width": float(np.log2(height / width)),
        "height of the center": -low / height,
        "center off the outline's middle": float(np.linalg.norm(_middle(outline)) / np.sqrt(area)),
        "level": float((np.abs(facing) > 0.95).mean()),
        "upright": float((np.abs(facing) < ACROSS_COSINE).mean()),
        "faces up": float((facing > 0.95).mean()),
        "faces down": float((facing < -0.95).mean()),
        "hull below": float(shape.facet_areas[-shape.facets @ up > FLAT_COSINE].sum()),
        "hull above": float(shape.facet_areas[shape.facets @ up > FLAT_COSINE].sum()),
        "mirrored": float(upright.min()) if len(upright) else MISSING,
        "upside down": upside_down,
        "mirrored rather than upside down": upside_down - float(upright.min()) if len(upright) else MISSING,
    }
    for name, at, stands in (
        ("bottom", share < END_RATIO, heights - low < STAND_RATIO),
        ("top", share > 1 - END_RATIO, low + height - heights < STAND_RATIO),
    ):
        values |= {f"{name} area": float(at.mean()), f"{name} level": float((at & (np.abs(facing) > 0.95)).mean())}
        values |= {f"{name} {key}": value for key, value in _stand(outline[stands], area).items()}
    for name, part in (("low", share < 0.25), ("high", share > 0.75)):
        rms = float(np.sqrt((spread[part] ** 2).mean())) if part.any() else MISSING
        values |= {f"{name} quarter": float(part.mean()), f"{name} spread": rms}
    return values


def _ground_axes(up: Float[np.ndarray, " 3"]) -> Float[np.ndarray, "2 3"]:
    x = np.cross(up, np.eye(3)[np.abs(up).argmin()])
    x /= np.linalg.norm(x)
    return np.array([x, np.cross(up, x)])


def _hull(points: Float[np.ndarray, "n 2"]) -> ConvexHull | None:
    try:
        return ConvexHull(points) if len(points) > 2 else None
    except QhullError:
        return None


def _boxes(hull: ConvexHull) -> tuple[Float[np.ndarray, "e 2 2"], Float[np.ndarray, "e 2"], Float[np.ndarray, "e 2"]]:
    """Return axes, lower and upper ends of the rectangles around a hull along each of its edges, the smallest first."""
    normals = hull.equations[:, :2]
    axes = np.stack([normals, np.stack([-normals[:, 1], normals[:, 0]], 1)], 1)
    along = axes @ hull.points[hull.vertices].T
    low, high = along.min(2), along.max(2)
    order = np.argsort((high - low).prod(1), kind="stable")
    return axes[order], low[order], high[order]


def _outline(points: Float[np.ndarray, "n 2"]) -> tuple[float, float, float]:
    """Return the area of the convex hull of points in a plane, and the sides of the smallest rectangle around it."""
    hull = _hull(points)
    if hull is None:
        return MIN_SIDE**2, MIN_SIDE, max(float(np.linalg.norm(np.ptp(points, axis=0))), MIN_SIDE)
    _, low, high = _boxes(hull)
    width, length = sorted(high[0] - low[0])
    return float(hull.volume), float(width), float(length)


def _middle(points: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, " 2"]:
    """Return the center of the smallest rectangle around points."""
    hull = _hull(points)
    if hull is None:
        return points.mean(0)
    axes, low, high = _boxes(hull)
    return (low[0] + high[0]) / 2 @ axes[0]


def _stand(stand: Float[np.ndarray, "n 2"], area: float) -> dict[str, float]:
    """Return features of the corners on which the object would stand with its center above 0. area: of its outline."""
    hull = _hull(stand)
    if hull is None:
        return {"share": 0.0, "margin": -1.0, "off": 1.0}
    return {
        "share": float(hull.volume) / area,
        "margin": max(float(-hull.equations[:, 2].max() / np.sqrt(area)), -1.0),  # of the center inside it, if positive
        "off": float(np.linalg.norm(_middle(stand)) / np.sqrt(area)),
    }
