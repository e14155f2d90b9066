"""Relations between adjacent panels: pairs of doors meet in the middle, and their hinges are at the outer sides."""

from __future__ import annotations

import numpy as np

from anymesh.config import ACROSS_COSINE
from anymesh.geometry.boxes import OrientedBox
from anymesh.motion.part_context import PartContext
from anymesh.types import Motion

MAX_SIZE_DIFFERENCE = 0.25  # maximum relative difference of the sides of similar panels
MAX_GAP_RATIO = 0.15  # of a panel's side: maximum gap between adjacent panels, and maximum offset along the common side


def adjacent_sides(context: PartContext) -> np.ndarray:
    """Count the similar panels that adjoin the part in its plane.

    Return an array (2, 2): face axes by signs (-, +).
    """
    core, counts = context.body_obb, np.zeros((2, 2))
    flat = context.face_axes
    thin = next(k for k in range(3) if k not in flat)
    for panel in context.other_parts:
        size, offset = _extent(panel.box, core), core.local(panel.box.center[None])[0]
        mine = 2 * core.half
        if any(abs(size[k] - mine[k]) > MAX_SIZE_DIFFERENCE * max(size[k], mine[k]) for k in flat):
            continue
        if abs(offset[thin]) > max(core.half[thin] + size[thin] / 2, 0.05 * mine[flat].max()) * 0.6:
            continue
        for row, (k, other) in enumerate((flat, flat[::-1])):
            gap = abs(offset[k]) - (mine[k] + size[k]) / 2
            if abs(gap) < MAX_GAP_RATIO * mine[k] and abs(offset[other]) < MAX_GAP_RATIO * mine[other]:
                counts[row, int(offset[k] > 0)] += 1
    return counts


def _extent(box: OrientedBox, frame: OrientedBox) -> np.ndarray:
    """Return the sides of a box along the axes of another one."""
    return 2 * np.abs(frame.axes @ box.axes.T) @ box.half


def pair_side(context: PartContext, motion: Motion, adjacent: np.ndarray) -> float:
    """Return 1 if the panels of a pair meet opposite this hinge, -1 if they meet at the hinge.

    Return 0 if there is no pair, or if the part is the middle one of three.
    """
    core, total = context.body_obb, 0.0
    arm = motion.origin - core.center
    for axis, sides in zip(context.face_axes, adjacent, strict=True):
        if abs(core.axes[axis] @ motion.axis) < ACROSS_COSINE:
            side = float(np.clip(arm @ core.axes[axis] / max(float(core.half[axis]), 1e-9), -1, 1))
            total -= side * float(np.clip(sides[1] - sides[0], -1, 1))
    return float(np.clip(total, -1, 1))


def outer_side(context: PartContext, motion: Motion) -> float:
    """Return 1 for a line at the object's outer side, as the hinges of a cabinet, -1 at its middle, 0 for a central part."""
    core = context.body_obb
    arm, away = motion.origin - core.center, core.center - context.center
    total = 0.0
    for axis in context.face_axes:
        direction = core.axes[axis]
        if abs(direction @ motion.axis) < ACROSS_COSINE:
            side = float(np.clip(arm @ direction / max(float(core.half[axis]), 1e-9), -1, 1))
            reach = float(np.abs(context.bounds - context.center).max(0) @ np.abs(direction))
            total += side * float(np.clip(2 * (away @ direction) / max(reach, 1e-9), -1, 1))
    return float(np.clip(total, -1, 1))
