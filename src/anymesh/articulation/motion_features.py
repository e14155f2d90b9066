"""Named geometric features of a part's motion: the input of the motion classifier.

Lengths are relative to the part's own size or the object's diagonal, shares are 0..1, angles are in half turns. A feature that
does not apply to a motion (the support of a slide) is MISSING.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float

from anymesh.articulation.contact_metrics import CONTACT_RATIO, CONTACT_TOLERANCE_FACTOR
from anymesh.articulation.line_features import MAX_RATIO, NO_LINE, line_features
from anymesh.articulation.motion_question import Candidate, PartFacts
from anymesh.motion.part_context import PartContext
from anymesh.scoring.classifier import MISSING
from anymesh.types import JointType

VIEW_POINTS = 80  # sample points of the part for visibility rays
# features of the sweep and of the opening direction; the others are known of a part at rest
SWEPT_FEATURES = (
    "opening", "closing", "free both ways", "outward", "contact retention", "initial slope", "upwards", "guided",
    "overlap gain", "captured", "room over extent", "visible ahead", "visible behind", "away from the middle",
)  # fmt: skip


def unswept_features(around: PartContext, facts: PartFacts, candidates: Sequence[Candidate]) -> list[dict[str, float]]:
    """Return the features that need no sweep and are the same for both opening directions of a motion."""
    contact = _contact_points(around)
    part = part_values(around, facts, contact)
    return [part | _unswept(around, c, contact) for c in candidates]


def motion_features(around: PartContext, facts: PartFacts, candidates: Sequence[Candidate]) -> list[dict[str, float]]:
    """Return the features of each swept candidate; the keys are the same for all."""
    contact = _contact_points(around)
    part = part_values(around, facts, contact)
    ways = np.array([_opening_direction(around, c) for c in candidates]).reshape(-1, 3)
    ahead, behind = _visible(around, ways), _visible(around, -ways)
    away = ways @ (around.part.samples.middle - around.center) / around.diagonal
    motions: dict[int, dict[str, float]] = {}  # shared by both opening directions
    for c in candidates:
        if id(c.motion) not in motions:
            motions[id(c.motion)] = _unswept(around, c, contact)
    return [
        part
        | motions[id(c.motion)]
        | _swept(around, facts, c)
        | {"visible ahead": float(a), "visible behind": float(b), "away from the middle": float(m)}
        for c, a, b, m in zip(candidates, ahead, behind, away, strict=True)
    ]


def _contact_points(around: PartContext) -> Float[np.ndarray, "n 3"]:
    """Return the part's samples near the parent, or the nearest ones if none is near [m]."""
    gap = around.gap
    return around.part.samples.points[
        gap <= max(CONTACT_RATIO * around.tolerance_length, CONTACT_TOLERANCE_FACTOR * float(gap.min()))
    ]


def _opening_direction(around: PartContext, c: Candidate) -> Float[np.ndarray, " 3"]:
    """Return the initial unit direction of the part's center; meaningless for a rotation about the center."""
    axis = c.opening_sign * c.motion.axis
    if c.motion.kind is JointType.PRISMATIC:
        return axis
    moves = np.cross(axis, around.part.samples.middle - c.motion.origin)
    return moves / max(float(np.linalg.norm(moves)), 1e-9)


def _visible(around: PartContext, ways: Float[np.ndarray, "h 3"]) -> Float[np.ndarray, " h"]:
    """Return the share of the part's surface with a free view past the rest along each direction."""
    samples = around.part.samples
    points = samples.points[:: max(1, len(samples.points) // VIEW_POINTS)]
    start = (points[None] + 1e-4 * around.diagonal * ways[:, None]).reshape(-1, 3)
    rays = np.repeat(4 * around.diagonal * ways, len(points), 0)
    return (around.rest.scene.first_hit(start, rays, 1.0).face < 0).reshape(len(ways), -1).mean(1)


def part_values(around: PartContext, facts: PartFacts, contact: Float[np.ndarray, "n 3"]) -> dict[str, float]:
    """Return the features of the part itself."""
    handle = facts.handle
    extents = np.array(facts.extents)
    low, high = around.bounds
    extent = np.maximum(high - low, 1e-12)
    spread = np.sort(contact.std(0))[::-1] if len(contact) > 1 else np.zeros(3)
    return {
        "size": facts.size,
        "thinness": facts.thinness,
        "width over length": float(extents[1] / max(extents[0], 1e-9)),
        "thickness": float(extents[2]),
        "roundness": facts.roundness,
        "height over radius": min(facts.flatness, 8.0),
        "opening direction up": float(around.opening_direction[2]),
        "visibility": facts.visibility,
        "insertion depth": min(facts.insertion_depth, MAX_RATIO),
        "log2 height over width": facts.tall,
        "height": facts.height,
        "back contact": facts.back_contact,
        "free rim": facts.free_rim,
        "covers an opening": facts.covers_opening,
        "rotational asymmetry": min(facts.rotational_asymmetry, MAX_RATIO),
        "two pivots": float(facts.two_pivot),
        "handle": float(handle is not None),
        "handle size": handle.size if handle else 0.0,
        "handle off the middle": max(abs(a) for a in handle.across) if handle else 0.0,
        "bar handle": float(handle is not None and handle.along is not None),
        "contact share": float(len(contact) / len(around.gap)),
        "contact length": float(spread[0] / max(around.part.box.diagonal, 1e-12)),
        "contact width": float(spread[1] / max(around.part.box.diagonal, 1e-12)),
        "log10 gap": float(np.log10(max(float(around.gap.min()) / around.diagonal, 1e-5))),
        "parts": float(np.log1p(len(around.siblings))),
        "object height": float(np.clip(extent[2] / extent[:2].max(), 0, MAX_RATIO)),
        "solid": float(around.part.solid @ around.part.areas / max(around.part.area, 1e-300)),
        "horizontal offset": float(np.linalg.norm(((around.part.bounds.mean(0) - low) / extent * 2 - 1)[:2])),
        "area over box": float(np.clip(around.part.area / max(_box_area(around), 1e-300), 0, MAX_RATIO)),
    }


def _box_area(around: PartContext) -> float:
    a, b, c = around.body_obb.half
    return 8 * float(a * b + b * c + a * c)


def _unswept(around: PartContext, c: Candidate, contact: Float[np.ndarray, "n 3"]) -> dict[str, float]:
    slides, axis, core = c.motion.kind is JointType.PRISMATIC, c.motion.axis, around.body_obb
    turn = {
        "hinge support": c.hinge_support,
        "support opposite": c.support_opposite,
        "another part along": c.sibling,
        "handle side": c.handle_side,
        "handle off the hinge's middle": c.handle_off,
        "above": c.above,
        "pair": c.pair,
        "outer": c.outer,
        "log2 reach over length": c.reach,
        "contact proximity": c.contact_proximity,
        "thick at the line": c.thick,
    }
    return {
        "prismatic": float(slides),
        "along length": abs(float(axis @ core.axes[0])),
        "along width": abs(float(axis @ core.axes[1])),
        "along thickness": abs(float(axis @ core.axes[2])),
        "along opening direction": abs(float(axis @ around.opening_direction)),
        "vertical": c.vertical,
        "depth": min(c.depth, MAX_RATIO) if slides else MISSING,
        **(dict.fromkeys(turn, MISSING) if slides else turn),
        **(NO_LINE if slides else line_features(around, c.motion, contact)),
    }


def _swept(around: PartContext, facts: PartFacts, c: Candidate) -> dict[str, float]:
    slides, axis = c.motion.kind is JointType.PRISMATIC, c.motion.axis
    unit = max(facts.size * around.diagonal / around.tolerance_length if slides else np.pi, 1e-9)
    extent = float(np.ptp(around.part.corners @ axis)) / around.tolerance_length
    slide = {
        "guided": c.guided,
        "overlap gain": c.overlap_gain,
        "captured": float(c.captured),
        "room over extent": min((c.opening + c.closing) / max(extent, 1e-9), 8.0),
        "upwards": float(c.opening_sign * axis[2]),
    }
    return {
        "opening": min(c.opening / unit, MAX_RATIO),
        "closing": min(c.closing / unit, MAX_RATIO),
        "free both ways": min(c.opening, c.closing) / unit,
        "outward": c.outward,
        "contact retention": c.contact_retention,
        "initial slope": MISSING if slides else _rises(around, c),
        **(slide if slides else dict.fromkeys(slide, MISSING)),
    }


def _rises(around: PartContext, c: Candidate) -> float:
    """Return the sine of the initial slope of the center's motion; negative if it goes down."""
    moves = c.opening_sign * np.cross(c.motion.axis, around.part.samples.middle - c.motion.origin)
    return float(moves[2] / max(float(np.linalg.norm(moves)), 1e-9))
