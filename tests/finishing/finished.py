"""Finished assets whose new faces are known."""

from dataclasses import replace

import numpy as np
from assets import cabinet

from anymesh.finishing.protocol import Finished
from anymesh.types import Asset, Mesh, Segmentation


def grown(asset: Asset, triangles: np.ndarray, part: int) -> Finished:
    """The asset with triangles added to a part; they have no looks yet."""
    mesh, count = asset.mesh, len(triangles)
    first = len(mesh.vertices)

    def rows(a: np.ndarray | None) -> np.ndarray | None:
        return None if a is None else np.concatenate([a, np.zeros((count, *a.shape[1:]), a.dtype)])

    joined = Mesh(
        vertices=np.concatenate([mesh.vertices, triangles.reshape(-1, 3)]),
        faces=np.concatenate([mesh.faces, first + np.arange(3 * count).reshape(-1, 3)]),
        face_node=np.concatenate([mesh.face_node, np.zeros(count, int)]),
        nodes=mesh.nodes,
        face_material=np.concatenate([mesh.face_material, np.full(count, -1)]),
        materials=mesh.materials,
        corner_uv=rows(mesh.corner_uv),
        corner_color=rows(mesh.corner_color),
        corner_normal=rows(mesh.corner_normal),
    )
    parts = np.concatenate([asset.segmentation.face_part, np.full(count, part)])
    source = np.concatenate([np.arange(len(mesh.faces)), np.full(count, -1)])
    return Finished(replace(asset, mesh=joined, segmentation=Segmentation(parts, asset.segmentation.parts)), source)


def quad(*corners) -> np.ndarray:
    """Two triangles."""
    c = np.array(corners, float)
    return c[[[0, 1, 2], [0, 2, 3]]]


def with_wall() -> Finished:
    """The cabinet, with a wall inside the base close to the back of its door."""
    return grown(cabinet(), quad((0.1, 0.005, 0.1), (0.5, 0.005, 0.1), (0.5, 0.005, 0.5), (0.1, 0.005, 0.5)), 0)
