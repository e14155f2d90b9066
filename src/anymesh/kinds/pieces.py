"""Pieces of an object in words, for people."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

THIN = 0.2  # ratio of two sides of a box below which a piece is a panel or a bar
ASIDE = 0.3  # of half of the object's extent: where a piece with its middle further from the object's lies at a side
PLACES_OF_PIECES = (("left", "front", "bottom"), ("right", "back", "top"))  # towards -x, -y, -z and x, y, z


def described(piece: Float[np.ndarray, "2 3"], bounds: Float[np.ndarray, "2 3"], name: str) -> str:
    """Return a piece of an object in words: its shape, its name in the file, where it is, and its size.

    piece, bounds: boxes of the piece and of the object, -y to the front [m].
    """
    sides = np.sort(np.ptp(piece, axis=0))[::-1]
    flat = bool(sides[2] < THIN * sides[1])
    shape = "panel" if flat else "bar" if sides[1] < THIN * sides[0] else "piece"
    off = (piece.sum(0) - bounds.sum(0)) / np.maximum(np.ptp(bounds, axis=0), 1e-12)
    axis = int(np.abs(off).argmax())
    where = f"at the {PLACES_OF_PIECES[int(off[axis] > 0)][axis]}" if abs(off[axis]) > ASIDE else "in the middle"
    size = " x ".join(f"{100 * side:.2g}" if side < 1 else f"{100 * side:.0f}" for side in sides[: 2 if flat else 3])
    return f"the {shape}{f' {name!r}' if name else ''} {where}, {size} cm"
