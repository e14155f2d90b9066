"""Views drawn by hand: the face of each pixel is given."""

from __future__ import annotations

import numpy as np

from anymesh.rendering.render import View
from anymesh.types.camera import Camera


def drawn_view(face: np.ndarray, depth: np.ndarray | float = 1.0) -> View:
    """Return a view with this face per pixel (-1 for none), and this depth [m]."""
    height, width = face.shape
    camera = Camera.looking_at(np.array([0.0, -1, 0]), np.zeros(3), np.deg2rad(60.0), width, height)
    normal = np.broadcast_to([0.0, -1, 0], (height, width, 3)).copy()
    far = np.broadcast_to(np.asarray(depth, float), face.shape).copy()
    return View(camera, far, normal, face, lambda: np.full((height, width, 3), 255, np.uint8))


def blocks(size: int, *rectangles: tuple[int, int, int, int]) -> np.ndarray:
    """Return a picture of (column, row, width, height) rectangles, face k for the k-th, later ones in front."""
    face = np.full((size, size), -1)
    for k, (column, row, width, height) in enumerate(rectangles):
        face[row : row + height, column : column + width] = k
    return face
