"""Convex decomposition of closed solids, by CoACD (MIT).

Call it in a child process, since it may crash (docs/decisions.md).
"""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int

from anymesh.errors import MissingExtraError

# several times faster than the defaults, with the same number of pieces
SEARCH = {"mcts_iterations": 20, "mcts_nodes": 10, "resolution": 200}


def decompose(
    vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], *, concavity: float, seed: int = 0, remesh: bool = False
) -> list[Float[np.ndarray, "n 3"]]:
    """Return the corner points of convex pieces of a closed solid.

    concavity: maximum distance of a piece from the surface, relative to half the longest side (CoACD's threshold); remesh:
    first make one closed solid of the input, which thickens thin walls. The same input gives the same pieces.
    """
    try:
        import coacd
    except ImportError:
        raise MissingExtraError("coacd is missing; it comes with articulate-anymesh, install that again") from None
    coacd.set_log_level("off")
    mesh = coacd.Mesh(vertices, faces)
    how = {"threshold": concavity, "preprocess_mode": "on" if remesh else "off", "seed": seed, **SEARCH}
    pieces = coacd.run_coacd(mesh, **how)  # ty: ignore[invalid-argument-type]
    return [np.asarray(points, float) for points, _ in pieces]
