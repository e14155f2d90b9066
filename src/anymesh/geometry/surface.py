"""The surface of a mesh as geometry sees it: without copies of faces, wound outwards, in connected components."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.geometry.copies import originals, without_copies
from anymesh.geometry.distance_ import winding_number
from anymesh.geometry.topology import MAX_CRACK_RATIO, Components, components, weld, without_cracks
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.geometry.winding import seen_from_behind
from anymesh.types import Mesh
from anymesh.types.triangles import normals_and_areas


@dataclass(frozen=True, eq=False)
class MeshSurface:
    """The faces of an object without copies, and the connected components of its welded surface.

    shape: K faces, wound so that those of a component agree and face outwards; components: of these faces; copy: (F,) face of
    the mesh that each one copies, itself for the K; row: (F,) index of that one among the K.
    """

    shape: TriangleSet
    components: Components
    void: Bool[np.ndarray, " c"]  # components that are walls of a closed cavity in another one
    vertices: Float[np.ndarray, "V 3"]
    diagonal: float
    copy: Int[np.ndarray, " F"]
    row: Int[np.ndarray, " F"]


def mesh_surface(mesh: Mesh, seed: int = 0) -> MeshSurface:
    """Orient the faces of a mesh and find its components; the mesh is not modified.

    Neither winding nor copies of faces count, which careless exports make at will. Open components face the side from which
    more of the outside is seen.
    """
    copy, parts = without_copies(mesh.vertices, mesh.faces)
    kept = originals(copy)
    row = np.searchsorted(kept, copy)
    void = _voids(mesh.triangles[kept], mesh.face_areas[kept], parts)
    flip = parts.flip ^ void[parts.label]
    shape = _wound(mesh, kept, flip, parts, seed)
    behind = seen_from_behind(shape, parts.label, ~shape.solid)
    if behind.any():
        flip = flip ^ behind
        shape = _wound(mesh, kept, flip, parts, seed)
    f, g = parts.edges.faces.T
    edges = replace(parts.edges, aligned=parts.edges.aligned ^ flip[f] ^ flip[g])
    return MeshSurface(shape, replace(parts, edges=edges), void, mesh.vertices, mesh.diagonal, copy, row)


def _wound(mesh: Mesh, kept: Int[np.ndarray, " K"], flip: Bool[np.ndarray, " K"], parts: Components, seed: int) -> TriangleSet:
    """Return some faces of a mesh, some of them reversed."""
    triangles = mesh.triangles[kept]
    triangles[flip] = triangles[flip, ::-1]
    return TriangleSet(triangles, normals_and_areas(triangles)[0], parts.solid[parts.label], kept, seed)


def _voids(triangles: Float[np.ndarray, "K 3 3"], areas: Float[np.ndarray, " K"], parts: Components) -> Bool[np.ndarray, " c"]:
    """Return which components are mostly inverted and lie within a solid one: walls of its cavities.

    If all others lie in the bounds of inverted solids, the object is inside out, and these are its cavities. Only the winding
    tells a cavity from a solid inside: if each face is wound by chance, there is none.
    """
    void = np.zeros(parts.count, bool)
    turned = np.bincount(parts.label, np.where(parts.flip, areas, -areas), parts.count) > 0
    solid, inverted = np.flatnonzero(parts.solid & ~turned), np.flatnonzero(parts.solid & turned)
    if not (len(solid) and len(inverted)):
        return void
    order = np.argsort(parts.label, kind="stable")
    start = np.searchsorted(parts.label[order], np.arange(parts.count + 1))
    triangles = np.where(parts.flip[order][:, None, None], triangles[order][:, ::-1], triangles[order])
    low = np.minimum.reduceat(triangles.min(1), start[:-1])
    high = np.maximum.reduceat(triangles.max(1), start[:-1])
    if all(((low[inverted] < low[s]) & (high[inverted] > high[s])).all(1).any() for s in solid):
        solid, inverted = inverted, solid
    points = triangles[start[inverted]].mean(1)  # one on each inverted component
    for s in solid:
        there = np.flatnonzero(~void[inverted] & ((points > low[s]) & (points < high[s])).all(1))
        if len(there):
            corners = triangles[start[s] : start[s + 1]].reshape(-1, 3)
            _, first, index = np.unique(weld(corners), return_index=True, return_inverse=True)
            void[inverted[there]] = winding_number(points[there], corners[first], index.reshape(-1, 3)) > 0.5
    return void


def plain_triangles(
    triangles: Float[np.ndarray, "F 3 3"], diagonal: float
) -> tuple[Float[np.ndarray, "K 3 3"], Int[np.ndarray, " K"]]:
    """Return some triangles without copies and cracks, wound outwards, and which they are.

    diagonal: of the object that they are part of [m].
    """
    vertices, faces, kept, parts = _plain(triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3), diagonal)
    return vertices[np.where(parts.flip[:, None], faces[:, ::-1], faces)], kept


def open_surface(
    vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], diagonal: float
) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, " K"]]:
    """Return vertices without cracks, and the faces that are no copies and belong to no closed surface, however it is wound.

    diagonal: of the object that they are part of [m].
    """
    closed, _, kept, parts = _plain(vertices, faces, diagonal)
    return closed, kept[~parts.solid[parts.label]]


def _plain(
    vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], diagonal: float
) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "K 3"], Int[np.ndarray, " K"], Components]:
    """Return vertices without cracks, the faces that are no copies, their indices, and their components."""
    first, parts = without_copies(vertices, faces)
    kept = originals(first)
    closed, faces = without_cracks(vertices, faces[kept], MAX_CRACK_RATIO * diagonal), faces[kept]
    return closed, faces, kept, parts if closed is vertices else components(closed, faces)
