"""Boxes and cylinders as replacements of hulls that they fit."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
from jaxtyping import Float

from anymesh.geometry.boxes import dominant_normals, fit_box
from anymesh.geometry.circles import roundest
from anymesh.physics.collision.convex import MIN_VOLUME, hull_of, thinned, volume
from anymesh.types import Box, Cylinder, Hull, Shape
from anymesh.types.triangles import normals_and_areas

EXACT = 1e-6  # for a trimmed hull, which a box must not exceed again
FIT = 0.02  # maximum relative difference between the volumes of a primitive and the hull
ROUND = 0.97  # minimum round share of a cylinder's outline; an octagon has less


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
    cube = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) / 2
    angle = np.arange(32) / 32 * 2 * np.pi
    ring = np.c_[np.cos(angle), np.sin(angle)]
    box, prism = hull_of(cube), hull_of(np.concatenate([np.c_[ring, np.full(32, z)] for z in (-0.5, 0.5)]))
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
