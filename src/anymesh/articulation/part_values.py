"""Named features of a part at rest, the same for all of its motions: shape, handle, and how it is fitted into its parent."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.articulation.contact_metrics import MIN_GAP_FACTOR
from anymesh.config import ALONG_COSINE, LEVEL_COSINE
from anymesh.motion.part_context import PartContext
from anymesh.motion.part_shape import MAX_LENGTH_RATIO, shape_features
from anymesh.types import JointType, Motion

# [deg] rotations about its axis; a body of revolution looks the same after all of them
ASYMMETRY_ANGLES_DEG = (37, 90, 141, 200, 285)
RIM_RAYS = 300  # rays from the rim of a round part
ROUND_RIM_RATIO = 0.85  # of the radius: samples farther from the axis belong to the rim of a round part


def part_values(context: PartContext, contact: Float[np.ndarray, "n 3"]) -> dict[str, float]:
    """Return the features of a part. contact: its points in contact with the parent [m]."""
    spread = np.sort(contact.std(0))[::-1] if len(contact) > 1 else np.zeros(3)
    return {
        **shape_features(context),
        "log2 height over width": _face_aspect(context),
        "back contact": _back_contact(context),
        "free rim": _free_rim(context) if context.is_round else 0.0,
        "covers an opening": _covers_opening(context) if context.is_round else 0.0,
        "rotational asymmetry": min(_rotational_asymmetry(context), MAX_LENGTH_RATIO) if context.is_round else 1.0,
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
