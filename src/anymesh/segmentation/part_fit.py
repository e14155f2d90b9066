"""Fit of a part candidate in the object: clearance at its rim, walls beside it, pivots."""

from __future__ import annotations

import numpy as np

from anymesh.config import ALONG_COSINE, FACING_COSINE, SegmentationConfig
from anymesh.motion.part_context import PartContext

RIM = 0.75  # samples beyond this share of the half extent belong to a rim


def on_axis(context: PartContext) -> bool:
    """Return whether the rest has surface on the axis of the round outline, within 5 % of the object's diagonal of an end."""
    outline = context.outline
    ends = outline.center + np.array([[-0.5], [0.5]]) * outline.height * outline.axis
    rays = np.array([[-1.0], [1.0]]) * outline.axis * 0.05 * context.diagonal
    return bool((context.rest.scene.first_hit(ends - rays, 2 * rays, 1.0).face >= 0).any())


def touching(context: PartContext, tolerance: float) -> tuple[np.ndarray, np.ndarray]:
    """Return which samples are within `tolerance` [m] of the rest, and the rest's normal at the closest point of each."""
    gap, face = context.nearest
    while (gap < tolerance).sum() < min(8, len(gap)):  # as the connecting area grows in the paper
        tolerance *= 2
    return gap < tolerance, context.parent.normals[face]


def fit_of_rim(context: PartContext, config: SegmentationConfig) -> tuple[int, float]:
    """Return how many of the four rims have a clearance to the surface opposite, and the share of the rim that touches it."""
    core = context.body_obb
    samples = context.part.samples
    local = core.local(samples.points) / np.maximum(core.half, 1e-12)
    facing = samples.normals @ core.axes.T
    touch, reach = config.touch * context.diagonal, config.near * context.diagonal
    # start slightly inside, since a ray that starts on a surface would miss it
    start = samples.points - samples.normals * 2 * touch
    hits = context.without_part.scene.first_hit(start, samples.normals * reach, 1.0)
    gap = hits.distance * reach - 2 * touch
    face = np.maximum(hits.face, 0)
    along = np.einsum("ij,ij->i", samples.normals, context.without_part.normals[face])
    gap[(hits.face >= 0) & context.without_part.solid[face] & (along > 0)] = 0  # the rim lies inside the surface opposite
    gap[(np.abs(along) < FACING_COSINE) & (gap > touch)] = np.inf  # ignore slopes and fillets beside the rim
    sides, touched, count = 0, 0, 0
    for axis in context.face_axes:
        for sign in (1, -1):
            rim = (sign * local[:, axis] > RIM) & (sign * facing[:, axis] > ALONG_COSINE)
            if rim.sum() < 3:
                continue
            clear = (gap[rim] > touch) & np.isfinite(gap[rim])
            sides += int(clear.mean() > 0.5)
            touched += int((gap[rim] <= touch).sum())
            count += int(rim.sum())
    return sides, touched / max(count, 1)


def enclosed_share(context: PartContext) -> float:
    """Return the share of the candidate with the rest on at least three of the four sides across the opening direction."""
    points, axes = context.part.samples.points[::20], context.body_obb.axes[context.face_axes]
    rays = np.repeat(np.concatenate([axes, -axes]) * context.diagonal, len(points), 0)
    hit = context.rest.scene.first_hit(np.tile(points, (4, 1)), rays, 1.0).face >= 0
    return float((hit.reshape(4, -1).sum(0) >= 3).mean())


def two_pivots(context: PartContext, near: np.ndarray, normals: np.ndarray) -> float:
    """Return how far the candidate is supported at two far ends by surfaces that face along the line between them, 0..1.

    Such contacts are pivots, as opposed to the feet of a fixed handle.
    """
    points = context.part.samples.points
    if near.sum() < 4:
        near = context.gap < max(2 * float(context.gap.min()), 0.004 * context.tolerance_length)
        if near.sum() < 4:
            return 0.0
    held = points[near]
    spread = held - held.mean(0)
    line = np.linalg.svd(spread, full_matrices=False)[2][0]
    t = spread @ line
    reach = float(np.ptp(t))
    parted = float(np.quantile(np.abs(t - (t.max() + t.min()) / 2), 0.05)) / max(reach / 2, 1e-12)  # 1: no contact between
    far = min(reach / max(context.part.box.diagonal, 1e-12), 1.0)
    return far * parted * float(np.abs(normals[near] @ line).mean())
