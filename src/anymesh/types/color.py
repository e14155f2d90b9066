"""Colours for display (sRGB) and for light (linear), both 0..1 (IEC 61966-2-1)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float


def to_linear(srgb: np.ndarray | Sequence[float]) -> Float[np.ndarray, ...]:
    """Convert sRGB channels to linear ones; values outside 0..1 are clipped."""
    c = np.clip(np.asarray(srgb, np.float64), 0, 1)
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


def to_srgb(linear: np.ndarray | Sequence[float]) -> Float[np.ndarray, ...]:
    """Convert linear channels to sRGB ones; values outside 0..1 are clipped."""
    c = np.clip(np.asarray(linear, np.float64), 0, 1)
    return np.where(c <= 0.0031308, 12.92 * c, 1.055 * np.maximum(c, 1e-9) ** (1 / 2.4) - 0.055)
