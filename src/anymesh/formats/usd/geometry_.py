"""Geometry of one USD prim, in its own coordinates: triangles of meshes and of primitives, and values at their corners."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from anymesh.formats.polygons_ import fans, recut
from anymesh.types import Brief

SEGMENTS = 32  # of a full turn of a primitive
ALONG = {"X": [2, 0, 1], "Y": [1, 2, 0], "Z": [0, 1, 2]}  # columns of a primitive along Z that become x, y and z
PRIMITIVES = ("Cube", "Sphere", "Cylinder", "Cylinder_1", "Cone", "Capsule", "Capsule_1", "Plane")


def value(attribute: Any) -> Any:
    """Return the value of an attribute without animation, or else the first of its animation; None if it has none."""
    stated = attribute.Get()
    if stated is None:
        times = attribute.GetTimeSamples()
        stated = attribute.Get(times[0]) if times else None
    return stated


def array(stated: Any, width: int, kind: type = np.float64) -> np.ndarray:
    """Return a list of values as (n, width), or (n,) for width 0; empty if there are none."""
    shape = (-1, width) if width else (-1,)
    return np.array(() if stated is None else stated, kind).reshape(shape)


@dataclass(frozen=True, eq=False)
class UsdTriangles(Brief):
    """Triangles of one prim.

    vertices: (V, 3) [units of the stage]; faces: (F, 3) into them; polygon: (F,) face of the file that a triangle is a part of;
    corner: (F, 3) which of all corners of the file's faces a corner is; polygons, corners: how many the file has.
    """

    vertices: Float[np.ndarray, "V 3"]
    faces: Int[np.ndarray, "F 3"]
    polygon: Int[np.ndarray, " F"]
    corner: Int[np.ndarray, "F 3"]
    polygons: int
    corners: int

    def spread(self, values: np.ndarray, interpolation: str) -> np.ndarray | None:
        """Return the values of a primvar at the corners, (F, 3, k); None if their number does not fit the interpolation."""
        count = len(self.faces)
        match interpolation:
            case "constant":
                return np.broadcast_to(values[:1], (count, 3, values.shape[1])) if len(values) == 1 else None
            case "uniform":
                return np.repeat(values[self.polygon][:, None], 3, 1) if len(values) == self.polygons else None
            case "faceVarying":
                return values[self.corner] if len(values) == self.corners else None
            case _:
                return values[self.faces] if len(values) == len(self.vertices) else None


def polygon_mesh(pxr: Any, prim: Any, warn: Callable[[str], None]) -> UsdTriangles | None:
    """Return the triangles of a Mesh; None if there are none. Faces without finite points are left out, with a warning."""
    mesh = pxr.UsdGeom.Mesh(prim)
    points = array(value(mesh.GetPointsAttr()), 3)
    indices = array(value(mesh.GetFaceVertexIndicesAttr()), 0, np.int64)
    counts = np.maximum(array(value(mesh.GetFaceVertexCountsAttr()), 0, np.int64), 0)
    fits = np.cumsum(counts) <= len(indices)
    whole, counts = len(counts), counts[fits]
    if not len(points) or not counts.sum():
        return None
    finite = np.asarray(np.isfinite(points).all(1))
    points = np.where(finite[:, None], points, 0.0)
    used = indices[: counts.sum()]
    wrong = (used < 0) | (used >= len(points))
    wrong[~wrong] = ~finite[used[~wrong]]
    good = np.bincount(np.repeat(np.arange(len(counts)), counts), wrong, len(counts)) == 0
    if not good.all() or whole > len(counts):
        warn(f"{int((~good).sum()) + whole - len(counts)} faces of {prim.GetName()!r} left out: their points are missing")
    holes = array(value(mesh.GetHoleIndicesAttr()), 0, np.int64)
    good[holes[(holes >= 0) & (holes < len(good))]] = False
    corner, polygon = fans(counts)
    corner = recut(corner, polygon, counts, points, used)
    corner, polygon = corner[good[polygon]], polygon[good[polygon]]
    if not len(corner):
        return None
    if value(mesh.GetOrientationAttr()) == "leftHanded":
        corner = np.ascontiguousarray(corner[:, [0, 2, 1]])
    return UsdTriangles(points, used[corner], polygon, corner, whole, len(indices))


def primitive(pxr: Any, prim: Any) -> UsdTriangles:
    """Return the triangles of a Cube, Sphere, Cylinder, Cone, Capsule or Plane."""

    def number(name: str, usual: float) -> float:
        stated = value(prim.GetAttribute(name)) if prim.HasAttribute(name) else None
        return usual if stated is None or not np.isfinite(stated) else float(stated)

    axis = str(value(prim.GetAttribute("axis"))) if prim.HasAttribute("axis") else "Z"
    radius, height = number("radius", 1.0), number("height", 2.0)
    match kind_of(prim):
        case "Cube":
            points, faces = _box(number("size", 2.0))
        case "Plane":
            w, h = number("width", 2.0) / 2, number("length", 2.0) / 2
            w, h = (w, h) if axis == "Z" else (h, w)
            points, faces = np.array([[-w, -h, 0], [w, -h, 0], [w, h, 0], [-w, h, 0]]), np.array([[0, 1, 2], [0, 2, 3]])
        case "Sphere":
            angles = np.linspace(-math.pi / 2, math.pi / 2, SEGMENTS // 2 + 1)
            points, faces = _turned(radius * np.cos(angles), radius * np.sin(angles))
        case "Cone":
            points, faces = _turned(np.array([0, radius, 0]), np.array([-1, -1, 1]) * height / 2)
        case "Cylinder" | "Cylinder_1":
            low, high = number("radiusBottom", radius), number("radiusTop", radius)
            points, faces = _turned(np.array([0, low, high, 0]), np.array([-1, -1, 1, 1]) * height / 2)
        case _:
            low, high = number("radiusBottom", radius), number("radiusTop", radius)
            angles = np.linspace(0, math.pi / 2, SEGMENTS // 4 + 1)
            bottom = np.stack([low * np.sin(angles), -height / 2 - low * np.cos(angles)])
            top = np.stack([high * np.cos(angles), height / 2 + high * np.sin(angles)])
            points, faces = _turned(*np.concatenate([bottom, top], 1))
    points = points[:, ALONG.get(axis, ALONG["Z"])]
    each = np.arange(len(faces))
    return UsdTriangles(points, faces, each, np.arange(3 * len(faces)).reshape(-1, 3), len(faces), 3 * len(faces))


def kind_of(prim: Any) -> str:
    """Return the schema of a prim."""
    return str(prim.GetTypeName())


def _box(size: float) -> tuple[np.ndarray, np.ndarray]:
    points = size * (np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) - 0.5)
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    return points, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def _turned(radii: np.ndarray, heights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the surface of a profile from bottom to top that is turned about Z; triangles at a radius of 0 are left out."""
    turn = 2 * math.pi * np.arange(SEGMENTS) / SEGMENTS
    rings = np.stack(
        [np.outer(radii, np.cos(turn)), np.outer(radii, np.sin(turn)), np.repeat(heights[:, None], SEGMENTS, 1)], 2
    )
    lower, k = np.meshgrid(np.arange(len(radii) - 1), np.arange(SEGMENTS), indexing="ij")
    following = (k + 1) % SEGMENTS
    a, b = lower * SEGMENTS + k, lower * SEGMENTS + following
    c, d = b + SEGMENTS, a + SEGMENTS
    flat = np.isclose(radii, 0, atol=1e-9 * max(float(np.abs(radii).max()), 1e-30))
    first = np.stack([a, b, c], 2)[~flat[:-1]].reshape(-1, 3)
    second = np.stack([a, c, d], 2)[~flat[1:]].reshape(-1, 3)
    points = rings.reshape(-1, 3)
    number = np.arange(len(points)) - np.where(np.repeat(flat, SEGMENTS), np.tile(np.arange(SEGMENTS), len(radii)), 0)
    return points, number[np.concatenate([first, second])]
