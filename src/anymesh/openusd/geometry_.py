"""Meshes and collision shapes in USD."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, assert_never

import numpy as np
from jaxtyping import Bool, Float, Float32, Int
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from anymesh.export.links import Primitive
from anymesh.export.meshes import painted
from anymesh.export.notation import quaternion
from anymesh.types import Box, Cylinder, Hull, Mesh, Shape
from anymesh.types.mesh import to_linear
from anymesh.types.triangles import face_cross

NOISE = 1e-12  # [m, kg m^2] smaller values are rounding


def vec(pxr: Any, values: np.ndarray) -> Any:
    """Return a Vec3f without rounding noise."""
    return pxr.Gf.Vec3f(*(float(v) if abs(v) > NOISE else 0.0 for v in values))


def quat(pxr: Any, rotation: np.ndarray) -> Any:
    """Return the Quatf of a (3, 3) rotation."""
    return pxr.Gf.Quatf(*(float(v) for v in quaternion(rotation)))


def place(pxr: Any, xform: Any, position: np.ndarray) -> None:
    """Add a translation [m] of the usual type double3.

    Three whole numbers become one that is off by its last bit: as such they are stored in bytes, on which three.js 0.187 throws
    (findings/three-usdc-integers.sh).
    """
    values = [float(v) for v in position]
    if any(values) and all(v == round(v) for v in values):
        values[int(np.abs(position).argmax())] *= 1 + float(np.finfo(float).eps)
    xform.AddTranslateOp().Set(pxr.Gf.Vec3d(*values))


def add_mesh(pxr: Any, stage: Any, path: str, points: Float[np.ndarray, "n 3"], faces: Int[np.ndarray, "m 3"]) -> Any:
    """Add a mesh of triangles without subdivision, in metres."""
    mesh = pxr.UsdGeom.Mesh.Define(stage, path)
    points = np.ascontiguousarray(points, np.float32)
    mesh.CreatePointsAttr(pxr.Vt.Vec3fArray.FromNumpy(points))
    mesh.CreateFaceVertexCountsAttr(pxr.Vt.IntArray.FromNumpy(np.full(len(faces), 3, np.int32)))
    mesh.CreateFaceVertexIndicesAttr(pxr.Vt.IntArray.FromNumpy(faces.reshape(-1).astype(np.int32)))
    mesh.CreateSubdivisionSchemeAttr(pxr.UsdGeom.Tokens.none)
    mesh.CreateExtentAttr(pxr.Vt.Vec3fArray.FromNumpy(np.array([points.min(0), points.max(0)])))
    return mesh


def add_visual(pxr: Any, stage: Any, path: str, primitives: Sequence[Primitive], source: Mesh) -> tuple[Any, list[int]]:
    """Add a mesh of a link's primitives, with normals, texture coordinates and colours of the corners.

    Return it with the number of its faces of each primitive: those without area are left out.
    """
    kept = [p.triangles[_have_area(p.positions, p.triangles)] for p in primitives]
    corners = np.concatenate([p.positions[faces] for p, faces in zip(primitives, kept, strict=True)])
    points, faces = welded(corners)
    mesh = add_mesh(pxr, stage, path, points, faces)
    sides = [source.materials[p.material].double_sided for p in primitives]
    mesh.CreateDoubleSidedAttr(any(sides))
    shaded = [
        flat_normals(p.positions, f) if p.normals is None else p.normals[f] for p, f in zip(primitives, kept, strict=True)
    ]
    _add_normals(pxr, mesh, np.concatenate(shaded))
    _add_primvars(pxr, mesh, primitives, kept, source)
    return mesh, [len(faces) for faces in kept]


def _have_area(points: Float[np.ndarray, "n 3"], faces: Int[np.ndarray, "m 3"]) -> Bool[np.ndarray, " m"]:
    """Return which faces have an area in single precision."""
    return (face_cross(points.astype(np.float32)[faces]) != 0).any(1)


def welded(corners: Float[np.ndarray, "m 3 3"]) -> tuple[Float32[np.ndarray, "n 3"], Int[np.ndarray, "m 3"]]:
    """Return points and faces such that faces share a point where they are one surface.

    Where a surface touches itself or another one, its copies of a point differ in their last bits, so that no tool merges them
    to an edge of more than two faces.
    """
    points, at = np.unique(corners.reshape(-1, 3).astype(np.float32) + np.float32(0), axis=0, return_inverse=True)
    faces = at.reshape(-1, 3)
    ends = np.stack([faces, np.roll(faces, -1, 1)], -1).reshape(-1, 2)  # edge 3 f + k leads from corner k of face f to the next
    edge = np.sort(ends, 1) @ (len(points), 1)
    order = np.argsort(edge, kind="stable")
    first = np.flatnonzero(np.r_[True, np.diff(edge[order]) != 0])
    pairs = order[first[np.diff(np.r_[first, len(edge)]) == 2][:, None] + (0, 1)]
    pairs = pairs[ends[pairs[:, 0], 0] == ends[pairs[:, 1], 1]]  # with one orientation
    following = np.arange(len(edge)).reshape(-1, 3)[:, [1, 2, 0]].reshape(-1)
    a, b = pairs.T
    joined = np.r_[a, following[a]], np.r_[following[b], b]  # corners of two faces at either end of their edge
    size = len(edge)
    fan = connected_components(coo_array((np.ones(len(joined[0])), joined), shape=(size, size)), directed=False)[1]
    _, one, corner = np.unique(fan, return_index=True, return_inverse=True)
    origin = faces.reshape(-1)[one]  # the point that each fan of faces is a copy of
    order = np.argsort(origin, kind="stable")
    first = np.flatnonzero(np.r_[True, np.diff(origin[order]) != 0])
    copy = np.empty(len(one), np.float32)
    copy[order] = np.arange(len(one)) - np.repeat(first, np.diff(np.r_[first, len(one)]))
    step = np.spacing(np.abs(points).max())  # about 1e-7 of the size
    return points[origin] + np.stack([copy * step, *np.zeros((2, len(copy)), np.float32)], 1), corner.reshape(-1, 3)


def _add_normals(pxr: Any, mesh: Any, normals: np.ndarray) -> None:
    mesh.CreateNormalsAttr(pxr.Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(normals.reshape(-1, 3), np.float32)))
    mesh.SetNormalsInterpolation(pxr.UsdGeom.Tokens.faceVarying)


def flat_normals(points: Float[np.ndarray, "n 3"], faces: Int[np.ndarray, "m 3"]) -> Float[np.ndarray, "m 3 3"]:
    """Return the unit normal of each face, for its three corners; up for a face without area."""
    cross = face_cross(points[faces])
    length = np.linalg.norm(cross, axis=1, keepdims=True)
    normals = np.where(length > 0, cross / np.where(length > 0, length, 1), (0.0, 0.0, 1.0))
    return np.repeat(normals[:, None], 3, axis=1)


def _add_primvars(pxr: Any, mesh: Any, primitives: Sequence[Primitive], faces: Sequence[np.ndarray], source: Mesh) -> None:
    """Add texture coordinates (v up, as in USD), and colours where they count."""
    kinds, vt = pxr.Sdf.ValueTypeNames, pxr.Vt

    def add(name: str, kind: Any, values: Sequence[np.ndarray], array: Any) -> None:
        """Add a value per corner, equal ones once, the most frequent first. values: (n, k) of each primitive, or (n,)."""
        at_corners = np.concatenate([v[f] for v, f in zip(values, faces, strict=True)]).astype(np.float32)
        flat = at_corners.reshape(3 * len(at_corners), -1)
        known, inverse, counts = np.unique(flat, axis=0, return_inverse=True, return_counts=True)
        order = np.argsort(-counts, kind="stable")
        known, indices = known[order], np.argsort(order)[inverse.reshape(-1)]
        primvar = pxr.UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(name, kind, pxr.UsdGeom.Tokens.faceVarying)
        primvar.Set(array.FromNumpy(known if known.shape[1] > 1 else known[:, 0]))
        primvar.SetIndices(vt.IntArray.FromNumpy(indices.astype(np.int32)))

    uv = [p.uv for p in primitives if p.uv is not None]
    if len(uv) == len(primitives):
        add("st", kinds.TexCoord2fArray, uv, vt.Vec2fArray)
    more = [p.more_uv for p in primitives if p.more_uv is not None]
    for k in range(more[0].shape[1] // 2 if more else 0):
        add(f"st{k + 1}", kinds.TexCoord2fArray, [m[:, 2 * k : 2 * k + 2] for m in more], vt.Vec2fArray)
    if any(painted(source, p) for p in primitives):
        colors = [np.ones((len(p.positions), 4)) if p.colors is None else p.colors / 255 for p in primitives]
        add("displayColor", kinds.Color3fArray, [to_linear(c[:, :3]) for c in colors], vt.Vec3fArray)
        if any((c[:, 3] < 1).any() for c in colors):
            add("displayOpacity", kinds.FloatArray, [c[:, 3] for c in colors], vt.FloatArray)


def add_shape(pxr: Any, stage: Any, path: str, shape: Shape) -> Any:
    """Add the geometry of a collision shape, which viewers leave out: a guide, and invisible."""
    match shape:
        case Box():
            geometry = pxr.UsdGeom.Cube.Define(stage, path)
            geometry.CreateSizeAttr(1.0)
            geometry.CreateExtentAttr([(-0.5, -0.5, -0.5), (0.5, 0.5, 0.5)])
            place(pxr, geometry, shape.center)
            geometry.AddOrientOp().Set(quat(pxr, shape.rotation))
            geometry.AddScaleOp().Set(vec(pxr, shape.size))
        case Cylinder():
            geometry = pxr.UsdGeom.Cylinder.Define(stage, path)
            geometry.CreateAxisAttr(pxr.UsdGeom.Tokens.z)
            geometry.CreateRadiusAttr(float(shape.radius))
            geometry.CreateHeightAttr(float(shape.length))
            corner = np.array([shape.radius, shape.radius, shape.length / 2])
            geometry.CreateExtentAttr([vec(pxr, -corner), vec(pxr, corner)])
            place(pxr, geometry, shape.center)
            geometry.AddOrientOp().Set(quat(pxr, shape.rotation))
        case Hull():
            faces = shape.faces[_have_area(shape.vertices, shape.faces)]
            geometry = add_mesh(pxr, stage, path, shape.vertices, faces)
            _add_normals(pxr, geometry, flat_normals(shape.vertices, faces))
        case _:
            assert_never(shape)
    geometry.CreatePurposeAttr(pxr.UsdGeom.Tokens.guide)
    geometry.CreateVisibilityAttr(pxr.UsdGeom.Tokens.invisible)
    return geometry
