"""The collision mesh of a link: one light mesh, welded, never flat."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int

from anymesh.export.settings import ExportConfig
from anymesh.geometry.topology import weld
from anymesh.types.triangles import face_cross

POINT = 1e-4  # [m] the side of a link that has no size at all
FLAT = 1e-4  # thinner than this share of its diagonal: no engine makes a hull of it


def collision_mesh(
    triangles: Float[np.ndarray, "n 3 3"], config: ExportConfig
) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "F 3"]]:
    """Vertices and faces of a link for contact: welded, faces without area dropped, simplified when huge.

    A flat link gets the thickness of a shell, and one without any area becomes a small box, since engines refuse both.
    """
    vertices, faces = _joined(triangles, weld(triangles.reshape(-1, 3)))
    if len(faces) > config.collision_faces:
        vertices, faces = _clustered(vertices[faces], config.collision_faces)
    if len(faces) == 0:
        return small_box(triangles, config)
    return _thickened(vertices, faces, config.wall(float(np.linalg.norm(np.ptp(vertices, axis=0)))))


def flat_normal(points: Float[np.ndarray, "n 3"], *, share: float) -> Float[np.ndarray, " 3"] | None:
    """The unit normal of points that lie within `share` of their diagonal of a plane, None when they do not."""
    spread = points - points.mean(0)
    normal = np.linalg.eigh(spread.T @ spread)[1][:, 0]
    if float(np.ptp(spread @ normal)) > share * float(np.linalg.norm(np.ptp(points, axis=0))):
        return None
    return normal if normal[np.abs(normal).argmax()] > 0 else -normal


def _thickened(vertices: np.ndarray, faces: np.ndarray, thickness: float) -> tuple[np.ndarray, np.ndarray]:
    """A flat mesh becomes two sheets, back to back, `thickness` [m] apart; others stay."""
    normal = flat_normal(vertices, share=FLAT)
    if normal is None:
        return vertices, faces
    t = vertices[faces]
    up = face_cross(t) @ normal > 0
    front = np.where(up[:, None], faces, faces[:, ::-1])
    sheets = np.concatenate([vertices + normal * thickness / 2, vertices - normal * thickness / 2])
    return sheets, np.concatenate([front, front[:, ::-1] + len(vertices)])


def _joined(triangles: np.ndarray, number: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """One vertex a number (the first position that has it); faces without area or seen before are dropped."""
    _, first, kind = np.unique(number, return_index=True, return_inverse=True)
    vertices, faces = triangles.reshape(-1, 3)[first], kind.reshape(-1, 3)
    t = vertices[faces]
    faces = faces[np.linalg.norm(face_cross(t), axis=1) > 0]
    turned = np.argmin(faces, axis=1)[:, None]
    faces = np.take_along_axis(faces, (turned + np.arange(3)) % 3, axis=1)
    if len(vertices) < 2**21:  # else three indices do not fit in one number; such a mesh is simplified next anyway
        key = (faces[:, 0] << 42) | (faces[:, 1] << 21) | faces[:, 2]
        faces = faces[np.sort(np.unique(key, return_index=True)[1])]
    used, inverse = np.unique(faces, return_inverse=True)
    return vertices[used], inverse.reshape(-1, 3)


def _clustered(triangles: np.ndarray, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Vertex clustering on a grid coarse enough; a cell keeps the corner nearest its mean."""
    corners = triangles.reshape(-1, 3)
    low = corners.min(0)
    extent = float(np.ptp(corners, axis=0).max())
    cross = face_cross(triangles)
    cells = int(extent * np.sqrt(most / max(float(np.linalg.norm(cross, axis=1).sum()), 1e-12)))  # two faces a cell
    cells = min(max(cells, 8), 256)
    while True:
        grid = np.minimum((corners - low) / extent * cells, cells - 1).astype(np.int64)
        kind = np.unique((grid[:, 0] * cells + grid[:, 1]) * cells + grid[:, 2], return_inverse=True)[1].reshape(-1)
        count = np.bincount(kind)
        mean = np.stack([np.bincount(kind, corners[:, i]) for i in range(3)], 1) / count[:, None]
        order = np.lexsort((((corners - mean[kind]) ** 2).sum(1), kind))
        nearest = order[np.r_[0, np.cumsum(count)[:-1]]]
        vertices, faces = _joined(corners[nearest][kind].reshape(-1, 3, 3), kind)
        if len(faces) <= most or cells <= 4:
            return vertices, faces
        cells = int(cells * 0.8)


def small_box(
    triangles: Float[np.ndarray, "n 3 3"], config: ExportConfig
) -> tuple[Float[np.ndarray, "8 3"], Int[np.ndarray, "12 3"]]:
    """The bounding box of points without area, each side as thick as a wall and at least POINT."""
    corners = triangles.reshape(-1, 3)
    side = max(config.wall(float(np.linalg.norm(np.ptp(corners, axis=0)))), POINT)
    center = (corners.min(0) + corners.max(0)) / 2
    half = np.maximum(np.ptp(corners, axis=0), side) / 2
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return center + signs * half, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
