"""Convex decomposition of closed solids, by CoACD (MIT). To be called in a child process: it may crash (docs/decisions.md)."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float, Int

from anymesh.errors import MissingExtraError

SEARCH = {"mcts_iterations": 20, "mcts_nodes": 10, "resolution": 200}  # several times faster than its defaults, as many pieces


def decompose(
    vertices: Float[np.ndarray, "V 3"], faces: Int[np.ndarray, "F 3"], *, concavity: float, seed: int = 0, remesh: bool = False
) -> list[Float[np.ndarray, "n 3"]]:
    """Return the corner points of convex pieces of a closed solid.

    concavity: how far a piece may be from the surface, as a share of half the longest side (CoACD's threshold); remesh: first
    make one closed solid of the input, which thickens thin walls. The same input gives the same pieces.
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
