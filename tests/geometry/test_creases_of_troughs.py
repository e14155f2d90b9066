"""Test which folds of a sheet bound regions: those inwards by more than the angle of a crease, at any size."""

from __future__ import annotations

import numpy as np
import pytest

from anymesh.config import PatchConfig
from anymesh.geometry.creases import convex_regions


def trough(degrees: float, size: int = 8) -> np.ndarray:
    """Return a sheet of 2 x 1 in squares, which faces up and folds upwards along the middle."""
    i, j = (g.reshape(-1) for g in np.meshgrid(np.arange(-size, size), np.arange(size), indexing="ij"))
    rise = np.tan(np.deg2rad(degrees))
    a, b, c, d = (np.c_[x, y, rise * np.maximum(x, 0)] / size for x, y in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
    return np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


@pytest.mark.parametrize(("scale", "diagonal"), [(1.0, 2.3), (1e-3, 2.3), (50.0, 2.3), (1.0, 12.0)])
@pytest.mark.parametrize(("degrees", "upwards", "count"), [(24, True, 1), (26, True, 2), (45, True, 2), (45, False, 1)])
def test_a_fold_inwards_by_more_than_twenty_five_degrees_is_a_crease(
    degrees: float, upwards: bool, count: int, scale: float, diagonal: float
) -> None:
    """The surface that defines the angle is beside the fold, and within a hundredth of the diagonal for a large object."""
    triangles = scale * trough(degrees)
    region = convex_regions(triangles if upwards else triangles[:, ::-1], scale * diagonal, PatchConfig())
    assert len(set(region.tolist())) == count
    right = triangles[:, :, 0].mean(1) > 0
    assert len(set(region[right].tolist())) == len(set(region[~right].tolist())) == 1
