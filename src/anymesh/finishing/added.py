"""Addition of new faces to an asset, with attributes copied from the nearest existing face of their part."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from jaxtyping import Float, Int

from anymesh.finishing.protocol import Finished
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.types import Asset, Mesh
from anymesh.types.triangles import normals_and_areas


def with_new_faces(
    asset: Asset, added: Mapping[int, Float[np.ndarray, "n 3 3"]], materials: Mapping[int, Int[np.ndarray, " m"]]
) -> Finished:
    """Add triangles (n, 3, 3) [m, asset frame] to parts, by number, including triangles without area.

    materials: part -> faces of the asset from which its new faces take node, material, colour and texture coordinates, each
    from the nearest one.
    Existing faces keep their numbers, vertices and attributes; new ones follow in the order of the parts.
    """
    mesh = asset.mesh
    numbers = [part for part in sorted(added) if len(added[part])]
    if not numbers:
        return Finished(asset, np.arange(len(mesh.faces)))
    triangles = np.concatenate([added[part] for part in numbers])
    like = np.concatenate([_nearest(mesh, added[part], materials[part]) for part in numbers])
    part = np.repeat(numbers, [len(added[part]) for part in numbers])
    joined = replace(
        mesh,
        vertices=np.concatenate([mesh.vertices, triangles.reshape(-1, 3)]),
        faces=np.concatenate([mesh.faces, len(mesh.vertices) + np.arange(3 * len(triangles)).reshape(-1, 3)]),
        face_node=np.concatenate([mesh.face_node, mesh.face_node[like]]),
        face_material=np.concatenate([mesh.face_material, mesh.face_material[like]]),
        corner_uv=_grown(mesh.corner_uv, _nearest_corner(mesh, triangles, like)),
        corner_color=_grown(mesh.corner_color, _nearest_corner(mesh, triangles, like)),
        corner_normal=_with_normals(mesh, triangles),
    )
    segmentation = replace(asset.segmentation, face_part=np.concatenate([asset.segmentation.face_part, part]))
    source = np.concatenate([np.arange(len(mesh.faces)), np.full(len(triangles), -1)])
    return Finished(replace(asset, mesh=joined, segmentation=segmentation), source)


def _nearest(mesh: Mesh, triangles: np.ndarray, faces: np.ndarray) -> Int[np.ndarray, " n"]:
    """Return for each triangle the nearest of some faces to its centroid."""
    return faces[distance_to_mesh(triangles.mean(1), mesh.vertices, mesh.faces[faces])[1]]


def _nearest_corner(mesh: Mesh, triangles: np.ndarray, like: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the face and corner whose attributes a new face takes at all its corners, so that it has a single colour."""
    off = np.linalg.norm(mesh.triangles[like] - triangles.mean(1)[:, None], axis=2)
    return like, off.argmin(1)


def _grown(rows: np.ndarray | None, at: tuple[np.ndarray, np.ndarray]) -> np.ndarray | None:
    return None if rows is None else np.concatenate([rows, np.repeat(rows[at][:, None], 3, axis=1)])


def _with_normals(mesh: Mesh, triangles: np.ndarray) -> np.ndarray | None:
    if mesh.corner_normal is None:
        return None
    normals = normals_and_areas(triangles)[0].astype(np.float32)
    return np.concatenate([mesh.corner_normal, np.repeat(normals[:, None], 3, axis=1)])
