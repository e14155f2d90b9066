"""Boards and trays, as closed surfaces."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float

_CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
_QUADS = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
_TOP = 5  # index of the quad that faces the last axis


def board(
    low: Float[np.ndarray, " 3"], high: Float[np.ndarray, " 3"], axes: Float[np.ndarray, "3 3"]
) -> Float[np.ndarray, "12 3 3"]:
    """Return a box between two corners in the frame of `axes` (rows, unit, right-handed) [m], wound outwards."""
    return _quads(_box(low, high, axes), _QUADS)


def tray(
    low: Float[np.ndarray, " 3"], high: Float[np.ndarray, " 3"], axes: Float[np.ndarray, "3 3"], wall: float
) -> Float[np.ndarray, "28 3 3"]:
    """Return a box as `board` does, hollow and open along the last axis, with walls and a bottom of thickness `wall` [m]."""
    inner_low, inner_high = low + wall, high - np.array([wall, wall, 0.0])
    outer, inner = _box(low, high, axes), _box(inner_low, inner_high, axes)
    shut = [q for k, q in enumerate(_QUADS) if k != _TOP]
    points = np.concatenate([outer, inner])
    rim = _QUADS[_TOP]
    around = [(rim[k], rim[(k + 1) % 4], rim[(k + 1) % 4] + 8, rim[k] + 8) for k in range(4)]
    return np.concatenate(
        [_quads(points, shut), _quads(points, [tuple(8 + c for c in q[::-1]) for q in shut]), _quads(points, around)]
    )


def _box(low: np.ndarray, high: np.ndarray, axes: np.ndarray) -> Float[np.ndarray, "8 3"]:
    return (low + _CORNERS * (high - low)) @ axes


def _quads(points: np.ndarray, quads: Sequence[tuple[int, ...]]) -> Float[np.ndarray, "n 3 3"]:
    return points[np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])]
