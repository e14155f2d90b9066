"""Points on a surface: face, position on it, and colour."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, Int, UInt8

from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.rendering.render import face_colors
from anymesh.types import Mesh

FINE = 4  # a face is sampled at the centroids of FINE squared similar triangles


def _probes() -> Float[np.ndarray, "p 3"]:
    """Return the barycentric weights of these centroids."""
    n, ticks = 3 * FINE, range(FINE)
    upright = [(3 * i + 1, 3 * j + 1) for i in ticks for j in ticks if i + j < FINE]
    turned = [(3 * i + 2, 3 * j + 2) for i in ticks for j in ticks if i + j < FINE - 1]
    return np.array([(n - a - b, a, b) for a, b in upright + turned]) / n


PROBES = _probes()


@dataclass(frozen=True, eq=False)
class Spots:
    """Nearest points on a surface to points of some faces.

    owner: index into the list of these faces; face: of the surface; weights: barycentric weights of its corners; distance: [m];
    area: represented by a point [m2].
    """

    owner: Int[np.ndarray, " n"]
    face: Int[np.ndarray, " n"]
    weights: Float[np.ndarray, "n 3"]
    distance: Float[np.ndarray, " n"]
    area: Float[np.ndarray, " n"]

    def colors(self, mesh: Mesh) -> UInt8[np.ndarray, "n 3"]:
        """Return the sRGB colours of the mesh at the spots."""
        return colors_at(mesh, self.face, self.weights)


def spots_on(mesh: Mesh, faces: Int[np.ndarray, " n"], sources: Int[np.ndarray, " m"]) -> Spots:
    """Return the points on `sources` (face indices) nearest to points spread over `faces`."""
    points = np.einsum("pk,nkd->npd", PROBES, mesh.triangles[faces]).reshape(-1, 3)
    distance, near, closest = distance_to_mesh(points, mesh.vertices, mesh.faces[sources])
    face = sources[near]
    area = np.repeat(mesh.face_areas[faces], len(PROBES)) + 1e-30
    owner = np.repeat(np.arange(len(faces)), len(PROBES))
    return Spots(owner, face, inside(barycentric(closest, mesh.triangles[face])), distance, area)


def barycentric(points: Float[np.ndarray, "n 3"], triangles: Float[np.ndarray, "n 3 3"]) -> Float[np.ndarray, "n 3"]:
    """Compute the barycentric weights of points, projected onto their triangles' planes; 1/3 if a triangle has no area."""
    a, b, c = (triangles[:, k] for k in range(3))
    normal = np.cross(b - a, c - a)
    square = np.einsum("ij,ij->i", normal, normal)
    flat = square <= 1e-300
    scale = np.where(flat, 1.0, square)
    second = np.einsum("ij,ij->i", np.cross(points - a, c - a), normal) / scale
    third = np.einsum("ij,ij->i", np.cross(b - a, points - a), normal) / scale
    weights = np.stack([1 - second - third, second, third], 1)
    weights[flat] = 1 / 3
    return weights


def inside(weights: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Clip barycentric weights to the triangle, to correct rounding."""
    kept = np.clip(weights, 0, 1)
    return kept / kept.sum(1, keepdims=True)


def colors_at(mesh: Mesh, face: Int[np.ndarray, " n"], weights: Float[np.ndarray, "n 3"]) -> UInt8[np.ndarray, "n 3"]:
    """Return sRGB colours at points on a mesh, as in all rendered pictures."""
    return face_colors(points_mesh(mesh, face, weights))


def points_mesh(mesh: Mesh, face: Int[np.ndarray, " n"], weights: Float[np.ndarray, "n 3"]) -> Mesh:
    """Return a mesh with one face per point, whose attributes are constant over the face."""

    def at(rows: np.ndarray | None) -> np.ndarray | None:
        if rows is None:
            return None
        value = np.einsum("nk,nkd->nd", weights, rows[face].astype(np.float64))
        value = np.rint(value) if rows.dtype == np.uint8 else value
        return np.repeat(value.astype(rows.dtype)[:, None], 3, axis=1)

    return replace(
        mesh,
        vertices=np.zeros((1, 3)),
        faces=np.zeros((len(face), 3), np.int64),
        face_node=mesh.face_node[face],
        face_material=mesh.face_material[face],
        corner_uv=at(mesh.corner_uv),
        corner_color=at(mesh.corner_color),
        corner_normal=None,
    )
