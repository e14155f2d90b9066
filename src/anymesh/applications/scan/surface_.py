"""Surface extraction from a distance field by marching cubes on the observed voxels, with libigl (MPL-2, a core dependency)."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int

from anymesh.applications.scan.fusion import SIDE, Field
from anymesh.errors import InputError

_CUBE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])  # in libigl's order


def extract(field: Field, least: float) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "F 3"]]:
    """Return vertices [m] and outward faces, open where the surface was not observed. least: smallest weight of voxels used.

    Raise InputError if there is no surface.
    """
    import igl

    grid = field.grid
    value, weight = field.distance.reshape(-1), field.weight.reshape(-1)
    candidates = np.flatnonzero((weight >= least) & (np.abs(value) < 1))  # suffices: a truncation exceeds a cube's diagonal
    block, local = np.divmod(candidates, SIDE**3)
    at = grid.blocks[block] * SIDE + np.stack(np.unravel_index(local, (SIDE,) * 3), 1)
    index = np.stack([_index(grid.table, at + corner) for corner in _CUBE], 1)
    index = index[(index >= 0).all(1)]
    index = index[(weight[index] >= least).all(1)]
    inside = (value[index] < 0).sum(1)
    index = index[(inside > 0) & (inside < 8)]
    if len(index) == 0:
        raise InputError("frames were fused, but no surface came out: too few views of the same place, or depth too noisy")
    used, cubes = np.unique(index, return_inverse=True)
    block, local = np.divmod(used, SIDE**3)
    nodes = (grid.blocks[block] * SIDE + np.stack(np.unravel_index(local, (SIDE,) * 3), 1)) * grid.voxel + grid.origin
    level = value[used].astype(np.float64)
    level[np.abs(level) < 1e-3] = -1e-3  # keeps the surface away from the corners of cubes
    vertices, faces = igl.marching_cubes(level, nodes, cubes.reshape(-1, 8).astype(np.int64), 0.0)[:2]
    return np.asarray(vertices, np.float64), np.asarray(faces).astype(np.int64)


def _index(table: np.ndarray, at: Int[np.ndarray, "n 3"]) -> Int[np.ndarray, " n"]:
    """Return the flat index of each voxel, -1 if it is not allocated."""
    block, local = np.divmod(at, SIDE)
    inside = ((block >= 0) & (block < table.shape)).all(1)
    row = np.full(len(at), -1, np.int64)
    row[inside] = table[tuple(block[inside].T)]
    return np.where(row >= 0, row * SIDE**3 + np.ravel_multi_index(tuple(local.T), (SIDE,) * 3), -1)
