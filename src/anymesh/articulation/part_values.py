"""Named features of a part at rest, the same for all of its motions: shape, handle, and how it is fitted into its parent."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.config import LEVEL_COSINE
from anymesh.motion.part_context import PartContext, shape_features


def part_values(context: PartContext, contact: Float[np.ndarray, "n 3"]) -> dict[str, float]:
    """Return the features of a part. contact: its points in contact with the parent [m]."""
    spread = np.sort(contact.std(0))[::-1] if len(contact) > 1 else np.zeros(3)
    return {
        **shape_features(context),
        "log2 height over width": _face_aspect(context),
        "contact share": float(len(contact) / len(context.gap)),
        "contact length": float(spread[0] / max(context.part.box.diagonal, 1e-12)),
        "contact width": float(spread[1] / max(context.part.box.diagonal, 1e-12)),
        "log10 gap": float(np.log10(max(float(context.gap.min()) / context.diagonal, 1e-4))),
        "parts": float(np.log1p(len(context.other_parts))),
    }


def _face_aspect(context: PartContext) -> float:
    """Return the binary logarithm of the height over the width of the part's face, 0 for a level face."""
    if abs(context.opening_direction[2]) > LEVEL_COSINE:
        return 0.0
    across = np.cross(context.opening_direction, (0.0, 0.0, 1.0))
    width = float(np.ptp(context.part.corners @ (across / np.linalg.norm(across))))
    return float(np.log2(max(float(np.ptp(context.part.bounds[:, 2])), 1e-9) / max(width, 1e-9)))
