"""Triangulation of outlines with holes, by manifold3d (Apache-2.0)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float, Int

from anymesh.errors import MissingExtraError


def triangulate(outlines: Sequence[Float[np.ndarray, "_ 2"]]) -> Int[np.ndarray, "m 3"]:
    """Return counterclockwise triangles over the concatenated points of outlines; no points are added or omitted.

    outlines: counterclockwise, holes clockwise. Each of their edges bounds one triangle, and each inner edge two, for any
    shape. Raise MissingExtraError without manifold3d.
    """
    try:
        from manifold3d import triangulate as cut
    except ImportError:
        raise MissingExtraError("manifold3d is missing; it is a dependency of articulate-anymesh; reinstall that") from None
    return np.asarray(cut([np.ascontiguousarray(o, np.float64) for o in outlines]), np.int64).reshape(-1, 3)
