"""Comparison of a mesh returned by an external service with the one that was sent."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, Int

from anymesh.finishing.texture_points import barycentric, inside
from anymesh.geometry.distance_ import distance_to_mesh, distance_to_triangles
from anymesh.geometry.triangle_set import sample_surface
from anymesh.types import Mesh

SAME = 1e-3  # share of the diagonal: tolerance between corners of the same faces
AGREES = 0.01  # share of the diagonal: tolerance between surfaces
MAX_OFF_SHARE = 0.02  # share of either surface that may lie further away
SAMPLES = 4000


def aligned(mesh: Mesh, ours: Mesh) -> Mesh:
    """Move and scale the mesh so that its box has the centre and diagonal of ours, since services centre their input."""
    scale = ours.diagonal / max(mesh.diagonal, 1e-300)
    return replace(mesh, vertices=(mesh.vertices - mesh.bounds.mean(0)) * scale + ours.bounds.mean(0))


def same_faces(mesh: Mesh, ours: Mesh) -> bool:
    """Return whether both have the same corners in the same order."""
    if len(mesh.faces) != len(ours.faces):
        return False
    return bool(np.abs(mesh.triangles - ours.triangles).max() <= SAME * ours.diagonal)


def surface_gap(mesh: Mesh, ours: Mesh) -> float:
    """Compute the larger share of either surface that lies further than AGREES diagonals from the other."""
    shares = []
    for here, there in ((mesh, ours), (ours, mesh)):
        points = sample_surface(here.triangles, SAMPLES, 0).points
        shares.append(float((distance_to_triangles(points, there.triangles) > AGREES * ours.diagonal).mean()))
    return max(shares)


@dataclass(frozen=True, eq=False)
class Nearest:
    """Map from points on our surface to another mesh, to its faces on the same part if there are any."""

    mesh: Mesh
    ours: Mesh
    part: Int[np.ndarray, " F"]  # of our faces
    part_there: Int[np.ndarray, " G"]  # of the other mesh's faces

    def __call__(
        self, face: Int[np.ndarray, " n"], weights: Float[np.ndarray, "n 3"]
    ) -> tuple[Int[np.ndarray, " n"], Float[np.ndarray, "n 3"]]:
        """Return the other mesh's faces nearest to points on ours, and the weights of their corners there."""
        points = np.einsum("nk,nkd->nd", weights, self.ours.triangles[face])
        nearest_faces, there = np.zeros(len(face), np.int64), np.zeros((len(face), 3))
        for part in np.unique(self.part[face]):
            rows = np.flatnonzero(self.part[face] == part)
            of_part = np.flatnonzero(self.part_there == part)
            faces = of_part if len(of_part) else np.arange(len(self.mesh.faces))
            _, near, closest = distance_to_mesh(points[rows], self.mesh.vertices, self.mesh.faces[faces])
            nearest_faces[rows] = faces[near]
            there[rows] = inside(barycentric(closest, self.mesh.triangles[nearest_faces[rows]]))
        return nearest_faces, there


def nearest(mesh: Mesh, ours: Mesh, face_part: Int[np.ndarray, " F"]) -> Nearest:
    """Create the map; a face of the other mesh belongs to the part of ours that is nearest to its centroid."""
    there = face_part[distance_to_mesh(mesh.triangles.mean(1), ours.vertices, ours.faces)[1]]
    return Nearest(mesh, ours, face_part, there)


def has_picture(mesh: Mesh) -> bool:
    """Return whether every face has a base colour texture."""
    pictured = np.array([*("base_color" in m.textures for m in mesh.materials), False])
    return mesh.corner_uv is not None and bool(pictured[mesh.face_material].all())
