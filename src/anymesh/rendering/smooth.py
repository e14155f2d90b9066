"""Corner normals for shading: smooth across flat edges, sharp across creases."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from anymesh.geometry.topology import edge_pairs, label_connected, weld, without_cracks
from anymesh.types import Mesh

CREASE_ANGLE = float(np.deg2rad(35))  # [rad] faces that meet at a larger angle form a crease; wheels of 11 sides are round
COPLANAR = 1 - 1e-6  # cosine between faces in one plane, whose normals need no averaging
SMOOTHED_FACES = 20_000  # above this number of faces, facets are too small to be seen and flat shading is enough


def smoothed(mesh: Mesh) -> Mesh:
    """Return the mesh with corner normals for shading: those of the file, or averages over smooth edges.

    No normals are added where flat shading is enough: to meshes with many faces, and to meshes without smooth edges.
    """
    if mesh.corner_normal is not None or len(mesh.faces) > SMOOTHED_FACES:
        return mesh
    vertices = without_cracks(mesh.vertices, mesh.faces)
    pairs = edge_pairs(vertices, mesh.faces)
    cosine = np.einsum("ij,ij->i", mesh.face_normals[pairs.faces[:, 0]], mesh.face_normals[pairs.faces[:, 1]])
    smooth = pairs.aligned & (cosine > np.cos(CREASE_ANGLE))
    if not (smooth & (cosine < COPLANAR)).any():
        return mesh
    welded = weld(vertices)
    faces, ends = pairs.faces[smooth], welded[pairs.vertices[smooth]]
    corners = [3 * faces + (welded[mesh.faces][faces] == end[:, None, None]).argmax(2) for end in ends.T]
    group = label_connected(3 * len(mesh.faces), np.concatenate(corners))
    weight = np.repeat(mesh.face_cross, 3, axis=0)
    total = np.stack([np.bincount(group, weight[:, k]) for k in range(3)], 1)[group]
    length = np.linalg.norm(total, axis=1, keepdims=True)
    normal = np.divide(total, length, out=np.zeros_like(total), where=length > 0).astype(np.float32)
    return replace(mesh, corner_normal=normal.reshape(-1, 3, 3))
