"""Named features of a part's shape, place and handle, which part candidates and the motions of parts share.

Lengths are relative to the object's diagonal, ratios of lengths are limited.
"""

from __future__ import annotations

import numpy as np

from anymesh.motion.part_context import PartContext

MAX_LENGTH_RATIO = 4.0  # upper limit of ratios of lengths
MAX_HEIGHT_OVER_RADIUS = 8.0


def shape_features(context: PartContext) -> dict[str, float]:
    """Return the features of a part that need only its own shape and the object's bounds."""
    core, outline = context.body_obb, context.outline
    length, width, thickness = core.half
    low, high = context.bounds
    extent, middle = np.maximum(high - low, 1e-12), context.part.bounds.mean(0)
    box_area = 8 * float(length * width + width * thickness + length * thickness)
    return {
        "size": context.part.box.diagonal / context.diagonal,
        "thinness": float(thickness / max(width, 1e-12)),
        "width over length": float(width / max(length, 1e-12)),
        "thickness": float(2 * thickness / context.diagonal),
        "roundness": outline.roundness,
        "height over radius": min(outline.height / max(outline.radius, 1e-12), MAX_HEIGHT_OVER_RADIUS),
        "opening direction up": float(context.opening_direction[2]),
        "visibility": context.visibility,
        "height": float((middle[2] - low[2]) / extent[2]),
        "horizontal offset": float(np.linalg.norm(((middle - low) / extent * 2 - 1)[:2])),
        "object height": float(np.clip(extent[2] / extent[:2].max(), 0, MAX_LENGTH_RATIO)),
        "solid": float(context.part.solid @ context.part.areas / max(context.part.area, 1e-300)),
        "area over box": float(np.clip(context.part.area / max(box_area, 1e-300), 0, MAX_LENGTH_RATIO)),
        "insertion depth": min(context.insertion_depth, MAX_LENGTH_RATIO),
        **_handle(context),
    }


def _handle(context: PartContext) -> dict[str, float]:
    handle = context.handle
    if handle is None:
        return {"handle": 0.0, "handle size": 0.0, "handle off the middle": 0.0, "bar handle": 0.0}
    return {
        "handle": 1.0,
        "handle size": handle.size,
        "handle off the middle": max(abs(a) for a in handle.across),
        "bar handle": float(handle.along is not None),
    }
