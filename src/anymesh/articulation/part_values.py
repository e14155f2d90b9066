"""Named features of a part at rest, the same for all of its motions: shape, handle, and how it is fitted into its parent."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.articulation.contact_metrics import MIN_GAP_FACTOR
from anymesh.config import ALONG_COSINE, LEVEL_COSINE
from anymesh.motion.part_context import PartContext
from anymesh.types import JointType, Motion

# [deg] rotations about its axis; a body of revolution looks the same after all of them
ASYMMETRY_ANGLES_DEG = (37, 90, 141, 200, 285)
MAX_LENGTH_RATIO = 4.0  # upper limit of ratios of lengths, of a part and of its motions
MAX_HEIGHT_OVER_RADIUS = 8.0
RIM_RAYS = 300  # rays from the rim of a round part
ROUND_RIM_RATIO = 0.85  # of the radius: samples farther from the axis belong to the rim of a round part


def part_values(context: PartContext, contact: Float[np.ndarray, "n 3"]) -> dict[str, float]:
    """Return the features of a part. contact: its points in contact with the parent [m]."""
    handle, core, outline = context.handle, context.body_obb, context.outline
    length, width, thickness = core.half
    low, high = context.bounds
    extent, middle = np.maximum(high - low, 1e-12), context.part.bounds.mean(0)
    spread = np.sort(contact.std(0))[::-1] if len(contact) > 1 else np.zeros(3)
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
        "insertion depth": min(context.insertion_depth, MAX_LENGTH_RATIO),
        "log2 height over width": _face_aspect(context),
        "height": float((middle[2] - low[2]) / extent[2]),
        "back contact": _back_contact(context),
        "free rim": _free_rim(context) if context.is_round else 0.0,
        "covers an opening": _covers_opening(context) if context.is_round else 0.0,
        "rotational asymmetry": min(_rotational_asymmetry(context), MAX_LENGTH_RATIO) if context.is_round else 1.0,
        "handle": float(handle is not None),
        "handle size": handle.size if handle else 0.0,
        "handle off the middle": max(abs(a) for a in handle.across) if handle else 0.0,
        "bar handle": float(handle is not None and handle.along is not None),
        "contact share": float(len(contact) / len(context.gap)),
        "contact length": float(spread[0] / max(context.part.box.diagonal, 1e-12)),
        "contact width": float(spread[1] / max(context.part.box.diagonal, 1e-12)),
        "log10 gap": float(np.log10(max(float(context.gap.min()) / context.diagonal, 1e-4))),
        "parts": float(np.log1p(len(context.other_parts))),
        "object height": float(np.clip(extent[2] / extent[:2].max(), 0, MAX_LENGTH_RATIO)),
        "solid": float(context.part.solid @ context.part.areas / max(context.part.area, 1e-300)),
        "horizontal offset": float(np.linalg.norm(((middle - low) / extent * 2 - 1)[:2])),
        "area over box": float(np.clip(context.part.area / max(box_area, 1e-300), 0, MAX_LENGTH_RATIO)),
    }


def _face_aspect(context: PartContext) -> float:
    """Return the binary logarithm of the height over the width of the part's face, 0 for a level face."""
    if abs(context.opening_direction[2]) > LEVEL_COSINE:
        return 0.0
    across = np.cross(context.opening_direction, (0.0, 0.0, 1.0))
    width = float(np.ptp(context.part.corners @ (across / np.linalg.norm(across))))
    return float(np.log2(max(float(np.ptp(context.part.bounds[:, 2])), 1e-9) / max(width, 1e-9)))


def _back_contact(context: PartContext) -> float:
    """Return the share of the back that is in contact with the parent, or inside it."""
    back = context.part.samples.normals @ context.opening_direction < -ALONG_COSINE
    near = context.gap < max(
        2 * context.config.connecting * context.tolerance_length, MIN_GAP_FACTOR * float(context.gap.min())
    )
    return float(near[back].mean()) if back.sum() > 3 else 0.0


def _free_rim(context: PartContext) -> float:
    """Return the share of a round part's rim that is free for two radii, radially."""
    outline, points = context.outline, context.part.samples.points
    arm = points - outline.center
    arm -= (arm @ outline.axis)[:, None] * outline.axis
    radius = np.linalg.norm(arm, axis=1)
    rim = np.flatnonzero(radius > ROUND_RIM_RATIO * outline.radius)
    rim = rim[:: max(1, len(rim) // RIM_RAYS)]
    if len(rim) < 3:
        return 0.0
    away = arm[rim] / radius[rim, None]
    start = points[rim] + 0.02 * outline.radius * away
    return float((context.rest.scene.first_hit(start, 2 * outline.radius * away, 1.0).face < 0).mean())


def _rotational_asymmetry(context: PartContext) -> float:
    """Return the maximum distance of a round part from its rotated copies, over its radius: knobs have markings or handles."""
    outline, points = context.outline, context.part.samples.points[::4]
    off = 0.0
    for turn in np.deg2rad(ASYMMETRY_ANGLES_DEG):
        T = Motion(JointType.REVOLUTE, outline.axis, outline.center, "").transform(turn)
        turned = points @ T[:3, :3].T + T[:3, 3]
        off = max(off, float(np.percentile(context.part.tree.distance(turned), 99)))
    return off / max(outline.radius, 1e-9)


def _covers_opening(context: PartContext) -> float:
    """Return the share of a round part's rim near the parent, times the share of its back with an opening behind it."""
    outline, points = context.outline, context.part.samples.points
    arm = points - outline.center
    radius = np.linalg.norm(arm - (arm @ outline.axis)[:, None] * outline.axis, axis=1)
    rim, back = radius > ROUND_RIM_RATIO * outline.radius, radius < 0.6 * outline.radius
    if rim.sum() < 3 or back.sum() < 3:
        return 0.0
    supported = float((context.gap[rim] < 0.1 * outline.radius).mean())
    rays = np.repeat(-context.opening_direction[None] * 0.5 * outline.radius, int(back.sum()), 0)
    empty = float((context.rest.scene.first_hit(points[back], rays, 1.0).face < 0).mean())
    return supported * empty
