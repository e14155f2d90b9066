"""Named features of a hinge line: its place in the part, the contact and the handle, and how round the part is about it."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.articulation.adjacent_panels import outer_side, pair_side
from anymesh.config import ALONG_COSINE
from anymesh.geometry.circles import share_in_place
from anymesh.motion.part_context import MAX_LENGTH_RATIO, PartContext
from anymesh.scoring.classifier import MISSING
from anymesh.types import Motion


def line_features(
    context: PartContext, motion: Motion, contact: Float[np.ndarray, "n 3"], adjacent: Float[np.ndarray, "2 2"]
) -> dict[str, float]:
    """Return the features of a hinge line.

    contact: (n, 3) the part's points in contact [m]; adjacent: as from `adjacent_sides`.
    """
    core, points, axis = context.body_obb, context.part.samples.points, motion.axis
    local = np.abs(core.local(motion.origin[None])[0] / np.maximum(core.half, 1e-9))
    local = np.minimum(local, MAX_LENGTH_RATIO) * (np.abs(core.axes @ axis) < ALONG_COSINE)
    off = motion.distance(points)
    reach, length = max(float(off.max()), 1e-9), max(float(np.ptp(points @ axis)), 1e-9)
    outline = context.outline_about(axis)
    held = motion.distance(contact)
    low, high = context.parent.bounds
    beside = np.abs(np.minimum(motion.origin - low, high - motion.origin))[np.abs(axis) < ALONG_COSINE]
    return {
        "off along length": float(local[0]),
        "off along width": float(local[1]),
        "off along thickness": float(local[2]),
        "off the part": float(off.min() / max(context.part.box.diagonal, 1e-12)),
        "balance": float(motion.distance(context.part.centroid[None])[0] / reach),
        "round about the axis": outline.roundness,
        "circle off the axis": min(
            float(motion.distance(outline.center[None])[0] / max(outline.radius, 1e-9)), MAX_LENGTH_RATIO
        ),
        "contact along the line": float(np.clip(np.ptp(contact @ axis) / length, 0, 1)),
        "contact off the line": float(held.mean() / reach),
        "contact middle off the line": float(motion.distance(contact.mean(0)[None])[0] / reach),
        "contact turns in place": share_in_place(context.contact_surfaces[0], axis, motion.origin),
        "off the parent's border": float(beside.min() / context.diagonal) if len(beside) else MISSING,
        "log2 reach over length": float(np.log2(reach / length)),
        "contact proximity": 1 - float(np.median(held)) / reach,
        "above": _height(context, motion),
        "pair": pair_side(context, motion, adjacent),
        "outer": outer_side(context, motion),
        **_handle_place(context, motion, reach),
    }  # fmt: skip


def _height(context: PartContext, motion: Motion) -> float:
    """Return the height of a line between the lowest (-1) and the highest (1) point of the part."""
    low, high = context.part.bounds[:, 2]
    return float(np.clip(2 * (motion.origin[2] - low) / max(high - low, 1e-9) - 1, -1, 1))


def _handle_place(context: PartContext, motion: Motion, reach: float) -> dict[str, float]:
    """Return where the handle is relative to a line.

    Its distance, over the part's reach; its offset from the middle of the line, 0..1: small for flaps, large for doors; and
    whether a bar runs along the line.
    """
    handle = context.handle
    if handle is None:
        return {"handle distance": MISSING, "handle off the hinge's middle": 0.0, "bar handle along": MISSING}
    core, bar, off = context.body_obb, MISSING, 0.0
    at = core.center.copy()
    for axis, where in zip(context.face_axes, handle.across, strict=True):
        at += where * core.half[axis] * core.axes[axis]
        off = max(off, abs(where)) if abs(core.axes[axis] @ motion.axis) > ALONG_COSINE else off
    if handle.along is not None:
        bar = abs(float(core.axes[context.face_axes[handle.along]] @ motion.axis))
    distance = min(float(motion.distance(at[None])[0] / reach), MAX_LENGTH_RATIO)
    return {"handle distance": distance, "handle off the hinge's middle": off, "bar handle along": bar}


NO_LINE = dict.fromkeys(
    (
        "off along length", "off along width", "off along thickness", "off the part", "balance", "round about the axis",
        "circle off the axis", "contact along the line", "contact off the line",
        "contact middle off the line", "contact turns in place", "off the parent's border",
        "log2 reach over length", "contact proximity", "above", "pair", "outer",
        "handle distance", "handle off the hinge's middle", "bar handle along",
    ),
    MISSING,
)  # fmt: skip
