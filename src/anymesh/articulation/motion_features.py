"""Named geometric features of a part's motion: the input of the motion classifiers.

Lengths are relative to the part's own size or the object's diagonal, shares are 0..1, angles are in half turns. A feature that
does not apply to a motion (the support of a slide) is MISSING.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float

from anymesh.articulation.candidate_motions import Candidate, contact_points
from anymesh.articulation.evidence import initial_direction, sides
from anymesh.config import ACROSS_COSINE, ALONG_COSINE, LEVEL_COSINE
from anymesh.geometry.boxes import OrientedBox
from anymesh.geometry.circles import share_in_place
from anymesh.motion.part_context import MAX_LENGTH_RATIO, PartContext, shape_features
from anymesh.scoring.classifier import MISSING
from anymesh.types import JointType, Motion

MAX_SIZE_DIFFERENCE = 0.25  # maximum relative difference of the sides of similar panels
MAX_GAP_RATIO = 0.15  # of a panel's side: maximum gap between adjacent panels, and maximum offset along the common side
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
VIEW_POINTS = 80  # sample points of the part for visibility rays
MAX_ROOM = 8.0  # upper limit of the free travel over the part's extent
# features of the sweep and of the opening direction; the others are known of a part at rest
SWEPT_FEATURES = (
    "opening", "closing", "free both ways", "outward", "contact retention", "initial slope", "upwards", "guided", "captured",
    "room over extent", "visible ahead", "visible behind", "away from the middle",
)  # fmt: skip
Features = dict[str, float]


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
    for axis, beside in zip(context.face_axes, adjacent, strict=True):
        if abs(core.axes[axis] @ motion.axis) < ACROSS_COSINE:
            side = float(np.clip(arm @ core.axes[axis] / max(float(core.half[axis]), 1e-9), -1, 1))
            total -= side * float(np.clip(beside[1] - beside[0], -1, 1))
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
    (low, high), (bottom, top) = context.parent.bounds, context.part.bounds[:, 2]
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
        "above": float(np.clip(2 * (motion.origin[2] - bottom) / max(top - bottom, 1e-9) - 1, -1, 1)),  # of the part, -1 to 1
        "pair": pair_side(context, motion, adjacent),
        "outer": outer_side(context, motion),
        **_handle_place(context, motion, reach),
    }  # fmt: skip


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


def unswept_features(context: PartContext, candidates: Sequence[Candidate]) -> list[Features]:
    """Return the features that need no sweep and are the same for both opening directions of a motion.

    candidates: all motions proposed for the part, one each.
    """
    contact = contact_points(context)
    two_pivots = any(c.role == "two_pivot" for c in candidates)
    part, adjacent = part_values(context, contact) | {"two pivots": float(two_pivots)}, adjacent_sides(context)
    return [part | _unswept(context, c, contact, adjacent) for c in candidates]


def swept_features(context: PartContext, candidates: Sequence[Candidate]) -> list[Features]:
    """Return the features of the sweep and of the opening direction of each swept candidate."""
    ways = np.array([c.opening_sign * initial_direction(context, c.motion) for c in candidates]).reshape(-1, 3)
    ahead, behind = _visible_both_ways(context, ways)
    away = ways @ (context.part.centroid - context.center) / context.diagonal
    return [
        _swept(context, c, way) | {"visible ahead": float(a), "visible behind": float(b), "away from the middle": float(m)}
        for c, way, a, b, m in zip(candidates, ways, ahead, behind, away, strict=True)
    ]


def motion_features(context: PartContext, candidates: Sequence[Candidate]) -> list[Features]:
    """Return all features of swept candidates, two for each motion; the keys are the same for all."""
    rest = unswept_features(context, candidates[::2])
    return [rest[k // 2] | way for k, way in enumerate(swept_features(context, candidates))]


def _visible_both_ways(
    context: PartContext, ways: Float[np.ndarray, "h 3"]
) -> tuple[Float[np.ndarray, " h"], Float[np.ndarray, " h"]]:
    """Return the visible shares of the part ahead and behind; their mean for a motion without a direction."""
    length = np.linalg.norm(ways, axis=1)
    unit = np.where(length[:, None] > 0, ways / np.maximum(length, 1e-300)[:, None], [0.0, 0.0, 1.0])
    points = context.part.samples.points
    some = points[:: max(1, len(points) // VIEW_POINTS)]
    ahead, behind = context.sees(some, unit).mean(1), context.sees(some, -unit).mean(1)
    mean, half = (ahead + behind) / 2, length * (ahead - behind) / 2
    return mean + half, mean - half


def _unswept(
    context: PartContext, c: Candidate, contact: Float[np.ndarray, "n 3"], adjacent: Float[np.ndarray, "2 2"]
) -> Features:
    slides, axis, core = c.motion.kind is JointType.PRISMATIC, c.motion.axis, context.body_obb
    turn = {
        "hinge support": c.hinge_support,
        "support opposite": c.support_opposite,
        "another part along": c.sibling,
        "handle side": c.handle_side,
    }
    return {
        "prismatic": float(slides),
        "along length": abs(float(axis @ core.axes[0])),
        "along width": abs(float(axis @ core.axes[1])),
        "along thickness": abs(float(axis @ core.axes[2])),
        "along opening direction": abs(float(axis @ context.opening_direction)),
        "vertical": c.vertical,
        "depth": _inserted(context, c) if slides else MISSING,
        **(dict.fromkeys(turn, MISSING) if slides else turn),
        **(NO_LINE if slides else line_features(context, c.motion, contact, adjacent)),
    }


def _inserted(context: PartContext, c: Candidate) -> float:
    """Return the depth of the part inside its parent along a slide, over its smallest side across."""
    across = min(float(np.ptp(context.part.corners @ d)) for d in sides(context, c.motion))
    return min(context.depth_in_parent(c.motion.axis) / max(across, 1e-9), MAX_LENGTH_RATIO)


def _swept(context: PartContext, c: Candidate, way: Float[np.ndarray, " 3"]) -> Features:
    slides, axis = c.motion.kind is JointType.PRISMATIC, c.motion.axis
    unit = max(context.part.box.diagonal / context.tolerance_length if slides else np.pi, 1e-9)
    extent = float(np.ptp(context.part.corners @ axis)) / context.tolerance_length
    slide = {
        "guided": c.guided,
        "captured": float(c.captured),
        "room over extent": min((c.opening + c.closing) / max(extent, 1e-9), MAX_ROOM),
        "upwards": float(c.opening_sign * axis[2]),
    }
    return {
        "opening": min(c.opening / unit, MAX_LENGTH_RATIO),
        "closing": min(c.closing / unit, MAX_LENGTH_RATIO),
        "free both ways": min(c.opening, c.closing) / unit,
        "outward": c.outward,
        "contact retention": c.contact_retention,
        "initial slope": MISSING if slides else float(way[2]),
        **(slide if slides else dict.fromkeys(slide, MISSING)),
    }
