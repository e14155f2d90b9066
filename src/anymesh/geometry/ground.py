"""The ground on which an object stands, if its file contains one."""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool

from anymesh.geometry.connected import label_connected
from anymesh.geometry.topology import weld
from anymesh.types import Mesh

MIN_GROUND_RATIO = 1.2  # minimum sides of a ground, relative to those of what stands on it
MAX_GROUND_HEIGHT_RATIO = 0.05  # of the diagonal of what stands on it: maximum height of a ground


def ground_faces(mesh: Mesh) -> Bool[np.ndarray, " F"]:
    """Return which faces are the ground: the level component below all others, if it reaches beyond them on all sides."""
    welded = weld(mesh.vertices)[mesh.faces]
    corner = label_connected(int(welded.max()) + 1, np.concatenate([welded[:, :2], welded[:, 1:]]))[welded[:, 0]]
    _, component = np.unique(corner, return_inverse=True)
    low, high = np.full((component.max() + 1, 3), np.inf), np.full((component.max() + 1, 3), -np.inf)
    np.minimum.at(low, component, mesh.triangles.min(1))
    np.maximum.at(high, component, mesh.triangles.max(1))
    widest = int(np.prod((high - low)[:, :2], axis=1).argmax())
    others = np.arange(len(low)) != widest
    nothing = np.zeros(len(component), bool)
    if not others.any():
        return nothing
    bottom, top = low[others].min(0), high[others].max(0)
    sides, height = high[widest] - low[widest], MAX_GROUND_HEIGHT_RATIO * np.linalg.norm(top - bottom)
    beyond = (low[widest, :2] < bottom[:2]).all() and (high[widest, :2] > top[:2]).all()
    wide = (sides[:2] >= MIN_GROUND_RATIO * (top - bottom)[:2]).all()
    level = sides[2] <= height and bottom[2] >= low[widest, 2] - height
    return component == widest if beyond and wide and level else nothing
