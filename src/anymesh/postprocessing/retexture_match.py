"""A mesh that came back from an outside service, held against the one that was sent."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, Int

from anymesh.geometry.distance_ import distance_to_mesh, distance_to_triangles
from anymesh.geometry.sampling import sample_surface
from anymesh.postprocessing.texture_points import barycentric, inside
from anymesh.types import Mesh

SAME = 1e-3  # of the diagonal: corners of the same faces lie this near
AGREES = 0.01  # of the diagonal: surfaces lie this near to each other
MAX_OFF_SHARE = 0.02  # share of either surface that may lie further off
SAMPLES = 4000


def aligned(mesh: Mesh, ours: Mesh) -> Mesh:
    """The mesh moved and scaled so that its box has the middle and the diagonal of ours: services centre what they take."""
    scale = ours.diagonal / max(mesh.diagonal, 1e-300)
    return replace(mesh, vertices=(mesh.vertices - mesh.bounds.mean(0)) * scale + ours.bounds.mean(0))


def same_faces(mesh: Mesh, ours: Mesh) -> bool:
    """Whether both have the same corners in the same order."""
    if len(mesh.faces) != len(ours.faces):
        return False
    return bool(np.abs(mesh.triangles - ours.triangles).max() <= SAME * ours.diagonal)


def surface_gap(mesh: Mesh, ours: Mesh) -> float:
    """The larger share of either surface that lies further than AGREES diagonals from the other."""
    shares = []
    for here, there in ((mesh, ours), (ours, mesh)):
        points = sample_surface(here.triangles, SAMPLES, 0).points
        shares.append(float((distance_to_triangles(points, there.triangles) > AGREES * ours.diagonal).mean()))
    return max(shares)


@dataclass(frozen=True, eq=False)
class Nearest:
    """Places of our surface found on another mesh: on the faces of it that lie on the same part, where there are any."""

    mesh: Mesh
    ours: Mesh
    part: Int[np.ndarray, " F"]  # of our faces
    part_there: Int[np.ndarray, " G"]  # of the other mesh's faces

    def __call__(
        self, face: Int[np.ndarray, " n"], weights: Float[np.ndarray, "n 3"]
    ) -> tuple[Int[np.ndarray, " n"], Float[np.ndarray, "n 3"]]:
        """The other mesh's face nearest to places on ours, and the weights of its corners there."""
        points = np.einsum("nk,nkd->nd", weights, self.ours.triangles[face])
        found, there = np.zeros(len(face), np.int64), np.zeros((len(face), 3))
        for part in np.unique(self.part[face]):
            rows = np.flatnonzero(self.part[face] == part)
            of_part = np.flatnonzero(self.part_there == part)
            faces = of_part if len(of_part) else np.arange(len(self.mesh.faces))
            _, near, closest = distance_to_mesh(points[rows], self.mesh.vertices, self.mesh.faces[faces])
            found[rows] = faces[near]
            there[rows] = inside(barycentric(closest, self.mesh.triangles[found[rows]]))
        return found, there


def nearest(mesh: Mesh, ours: Mesh, face_part: Int[np.ndarray, " F"]) -> Nearest:
    """A face of the other mesh belongs to the part of ours that its middle is nearest to."""
    there = face_part[distance_to_mesh(mesh.triangles.mean(1), ours.vertices, ours.faces)[1]]
    return Nearest(mesh, ours, face_part, there)


def has_picture(mesh: Mesh) -> bool:
    """Whether every face has a colour of a picture."""
    pictured = np.array([*("base_color" in m.textures for m in mesh.materials), False])
    return mesh.corner_uv is not None and bool(pictured[mesh.face_material].all())
