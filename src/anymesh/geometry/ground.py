"""The ground on which an object stands, if its file contains one."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool

from anymesh.geometry.topology import components
from anymesh.types import Mesh

MIN_GROUND_RATIO = 1.2  # minimum sides of a ground, relative to those of what stands on it
MAX_GROUND_HEIGHT_RATIO = 0.05  # of the diagonal of what stands on it: maximum height of a ground


def ground_faces(mesh: Mesh) -> Bool[np.ndarray, " F"]:
    """Return which faces are the ground: the level component below all others, if it reaches beyond them on all sides."""
    parts = components(mesh.vertices, mesh.faces)
    low, high = np.full((parts.count, 3), np.inf), np.full((parts.count, 3), -np.inf)
    np.minimum.at(low, parts.label, mesh.triangles.min(1))
    np.maximum.at(high, parts.label, mesh.triangles.max(1))
    widest = int(np.prod((high - low)[:, :2], axis=1).argmax())
    others = np.arange(len(low)) != widest
    if not others.any():
        return np.zeros(len(parts.label), bool)
    bottom, top = low[others].min(0), high[others].max(0)
    sides, height = high[widest] - low[widest], MAX_GROUND_HEIGHT_RATIO * np.linalg.norm(top - bottom)
    beyond = (low[widest, :2] < bottom[:2]).all() and (high[widest, :2] > top[:2]).all()
    wide = (sides[:2] >= MIN_GROUND_RATIO * (top - bottom)[:2]).all()
    level = sides[2] <= height and bottom[2] >= low[widest, 2] - height
    return (parts.label == widest) & bool(beyond and wide and level)
