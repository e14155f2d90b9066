"""Named geometric features of a part's motion: the input of the motion classifiers.

Lengths are relative to the part's own size or the object's diagonal, shares are 0..1, angles are in half turns. A feature that
does not apply to a motion (the support of a slide) is MISSING.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float

from anymesh.articulation.adjacent_panels import adjacent_sides
from anymesh.articulation.contact_metrics import contact_points
from anymesh.articulation.evidence import initial_direction, sides
from anymesh.articulation.line_features import NO_LINE, line_features
from anymesh.articulation.motion_question import Candidate
from anymesh.articulation.part_values import part_values
from anymesh.motion.part_context import MAX_LENGTH_RATIO, PartContext
from anymesh.scoring.classifier import MISSING
from anymesh.types import JointType

VIEW_POINTS = 80  # sample points of the part for visibility rays
MAX_ROOM = 8.0  # upper limit of the free travel over the part's extent
# features of the sweep and of the opening direction; the others are known of a part at rest
SWEPT_FEATURES = (
    "opening", "closing", "free both ways", "outward", "contact retention", "initial slope", "upwards", "guided", "captured",
    "room over extent", "visible ahead", "visible behind", "away from the middle",
)  # fmt: skip
Features = dict[str, float]


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
