"""Facts of a part that do not depend on a motion: its shape, its handle, and how it is fitted into its parent."""

from __future__ import annotations

import numpy as np

from anymesh.articulation.motion_question import PartFacts
from anymesh.config import ALONG_COSINE
from anymesh.motion.part_context import PartContext
from anymesh.types import JointType, Motion

# [deg] rotations about its axis; a body of revolution looks the same after all of them
ASYMMETRY_ANGLES_DEG = (37, 90, 141, 200, 285)


def part_facts(around: PartContext, name: str, label: str, two_pivot: bool) -> PartFacts:
    """Compute the facts of a part that do not depend on a motion."""
    core = around.body_obb
    extents = 2 * core.half / around.diagonal
    return PartFacts(
        name=name,
        label=label,
        extents=(float(extents[0]), float(extents[1]), float(extents[2])),
        thinness=float(core.half[2] / max(core.half[1], 1e-12)),
        roundness=around.outline.roundness,
        flatness=around.outline.height / max(around.outline.radius, 1e-9),
        opening_direction=around.opening_direction,
        visibility=around.visibility,
        insertion_depth=around.insertion_depth,
        size=around.part.box.diagonal / around.diagonal,
        diagonal=around.diagonal,
        handle=around.handle,
        two_pivot=two_pivot,
        tall=_face_aspect(around),
        height=float((around.part.bounds.mean(0)[2] - around.bounds[0, 2]) / max(np.ptp(around.bounds[:, 2]), 1e-9)),
        back_contact=_back_contact(around),
        free_rim=_free_rim(around) if around.outline.roundness > 0.5 else 0.0,
        covers_opening=_covers_opening(around) if around.outline.roundness > 0.5 else 0.0,
        rotational_asymmetry=_rotational_asymmetry(around) if around.outline.roundness > 0.5 else 1.0,
    )


def _face_aspect(around: PartContext) -> float:
    if abs(around.opening_direction[2]) > 0.8:
        return 0.0
    across = np.cross(around.opening_direction, (0.0, 0.0, 1.0))
    width = float(np.ptp(around.part.corners @ (across / np.linalg.norm(across))))
    return float(np.log2(max(float(np.ptp(around.part.bounds[:, 2])), 1e-9) / max(width, 1e-9)))


def _back_contact(around: PartContext) -> float:
    """Return the share of the back that is in contact with the parent, or inside it."""
    back = around.part.samples.normals @ around.opening_direction < -ALONG_COSINE
    near = around.gap < max(2 * around.config.connecting * around.tolerance_length, 1.5 * float(around.gap.min()))
    return float(near[back].mean()) if back.sum() > 3 else 0.0


def _free_rim(around: PartContext) -> float:
    """Return the share of a round part's rim that is free for two radii, radially."""
    outline, points = around.outline, around.part.samples.points
    arm = points - outline.center
    arm -= (arm @ outline.axis)[:, None] * outline.axis
    radius = np.linalg.norm(arm, axis=1)
    rim = np.flatnonzero(radius > 0.85 * outline.radius)[:300]
    if len(rim) < 3:
        return 0.0
    away = arm[rim] / radius[rim, None]
    start = points[rim] + 0.02 * outline.radius * away
    return float((around.rest.scene.first_hit(start, 2 * outline.radius * away, 1.0).face < 0).mean())


def _rotational_asymmetry(around: PartContext) -> float:
    """Return the maximum distance of a round part from its rotated copies, over its radius: knobs have markings or handles."""
    outline, points = around.outline, around.part.samples.points[::4]
    off = 0.0
    for turn in np.deg2rad(ASYMMETRY_ANGLES_DEG):
        T = Motion(JointType.REVOLUTE, outline.axis, outline.center, "").transform(turn)
        turned = points @ T[:3, :3].T + T[:3, 3]
        off = max(off, float(np.percentile(around.part.tree.distance(turned), 99)))
    return off / max(outline.radius, 1e-9)


def _covers_opening(around: PartContext) -> float:
    """Return the share of a round part's rim near the parent, times the share of its back with an opening behind it."""
    outline, points = around.outline, around.part.samples.points
    arm = points - outline.center
    radius = np.linalg.norm(arm - (arm @ outline.axis)[:, None] * outline.axis, axis=1)
    rim, back = radius > 0.85 * outline.radius, radius < 0.6 * outline.radius
    if rim.sum() < 3 or back.sum() < 3:
        return 0.0
    supported = float((around.gap[rim] < 0.1 * outline.radius).mean())
    rays = np.repeat(-around.opening_direction[None] * 0.5 * outline.radius, int(back.sum()), 0)
    empty = float((around.rest.scene.first_hit(points[back], rays, 1.0).face < 0).mean())
    return supported * empty
