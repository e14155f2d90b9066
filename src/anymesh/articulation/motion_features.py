"""Named geometric features of a part's motion: the input of the motion classifier.

Lengths are relative to the part's own size or the object's diagonal, shares are 0..1, angles are in half turns. A feature that
does not apply to a motion (the support of a slide) is MISSING.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float

from anymesh.articulation.contact_metrics import CONTACT_RATIO, CONTACT_TOLERANCE_FACTOR
from anymesh.articulation.motion_question import Candidate, PartFacts
from anymesh.config import ALONG_COSINE
from anymesh.geometry.revolution import share_in_place
from anymesh.motion.part_context import PartContext
from anymesh.scoring.classifier import MISSING
from anymesh.types import JointType, Motion

MAX_CENTRAL_RATIO = 0.2  # maximum distance of the center from an axis, over the reach, of a rotation about its own center
MISFIT_ANGLES_RAD = np.deg2rad((60.0, 72.0, 90.0, 120.0, 180.0))
MISFIT_POINTS = 60  # sample points of the part for the rotations
SECTORS = 12  # angular sectors of a full turn
VIEW_POINTS = 80  # sample points of the part for visibility rays
MAX_RATIO = 4.0  # upper limit of ratios of lengths


def motion_features(around: PartContext, facts: PartFacts, candidates: Sequence[Candidate]) -> list[dict[str, float]]:
    """Return the features of each candidate; the keys are the same for all."""
    contact = _contact_points(around)
    part = part_values(around, facts, contact)
    ways = np.array([_opening_direction(around, c) for c in candidates]).reshape(-1, 3)
    ahead, behind = _visible(around, ways), _visible(around, -ways)
    away = ways @ (around.part.samples.middle - around.center) / around.diagonal
    lines: dict[int, dict[str, float]] = {}  # shared by both opening directions about an axis
    for c in candidates:
        if id(c.motion) not in lines:
            lines[id(c.motion)] = NO_LINE if c.motion.kind is JointType.PRISMATIC else _line(around, c.motion, contact)
    return [
        part
        | _values(around, facts, c)
        | lines[id(c.motion)]
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


def _values(around: PartContext, facts: PartFacts, c: Candidate) -> dict[str, float]:
    slides, axis, core = c.motion.kind is JointType.PRISMATIC, c.motion.axis, around.body_obb
    unit = max(facts.size * around.diagonal / around.tolerance_length if slides else np.pi, 1e-9)
    extent = float(np.ptp(around.part.corners @ axis)) / around.tolerance_length
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
        "initial slope": _rises(around, c),
    }
    slide = {
        "guided": c.guided,
        "depth": min(c.depth, MAX_RATIO),
        "overlap gain": c.overlap_gain,
        "captured": float(c.captured),
        "room over extent": min((c.opening + c.closing) / max(extent, 1e-9), 8.0),
    }
    return {
        "prismatic": float(slides),
        "along length": abs(float(axis @ core.axes[0])),
        "along width": abs(float(axis @ core.axes[1])),
        "along thickness": abs(float(axis @ core.axes[2])),
        "along opening direction": abs(float(axis @ around.opening_direction)),
        "vertical": c.vertical,
        "upwards": float(c.opening_sign * axis[2]) if slides else MISSING,
        "opening": min(c.opening / unit, MAX_RATIO),
        "closing": min(c.closing / unit, MAX_RATIO),
        "free both ways": min(c.opening, c.closing) / unit,
        "outward": c.outward,
        "contact retention": c.contact_retention,
        **(dict.fromkeys(turn, MISSING) if slides else turn),
        **(slide if slides else dict.fromkeys(slide, MISSING)),
    }


def _rises(around: PartContext, c: Candidate) -> float:
    """Return the sine of the initial slope of the center's motion; negative if it goes down."""
    moves = c.opening_sign * np.cross(c.motion.axis, around.part.samples.middle - c.motion.origin)
    return float(moves[2] / max(float(np.linalg.norm(moves)), 1e-9))


def _line(around: PartContext, motion: Motion, contact: Float[np.ndarray, "n 3"]) -> dict[str, float]:
    """Return the features of a hinge line that are the same for both opening directions."""
    core, points, axis = around.body_obb, around.part.samples.points, motion.axis
    local = np.abs(core.local(motion.origin[None])[0] / np.maximum(core.half, 1e-9))
    local = np.minimum(local, MAX_RATIO) * (np.abs(core.axes @ axis) < ALONG_COSINE)
    off = motion.distance(points)
    reach, length = max(float(off.max()), 1e-9), max(float(np.ptp(points @ axis)), 1e-9)
    balance = float(motion.distance(around.part.samples.middle[None])[0] / reach)
    outline = around.outline_about(axis)
    low, high = around.parent.bounds
    beside = np.abs(np.minimum(motion.origin - low, high - motion.origin))[np.abs(axis) < ALONG_COSINE]
    return {
        "off along length": float(local[0]),
        "off along width": float(local[1]),
        "off along thickness": float(local[2]),
        "off the part": float(off.min() / max(around.part.box.diagonal, 1e-12)),
        "balance": balance,
        "round about the axis": outline.roundness,
        "circle off the axis": min(
            float(motion.distance(outline.center[None])[0] / max(outline.radius, 1e-9)), MAX_RATIO
        ),
        "rotational misfit": _misfit(around, motion, reach) if balance < MAX_CENTRAL_RATIO else MISSING,
        "contact along the line": float(np.clip(np.ptp(contact @ axis) / length, 0, 1)),
        "contact off the line": float(motion.distance(contact).mean() / reach),
        "contact middle off the line": float(motion.distance(contact.mean(0)[None])[0] / reach),
        "contact around the axis": _coverage(contact, motion),
        "contact turns in place": share_in_place(around.contact_surfaces[0], axis, motion.origin),
        "off the parent's border": float(beside.min() / around.diagonal) if len(beside) else MISSING,
        "barrel near": float(any(motion.distance(b.box.center[None])[0] < 0.05 * reach for b in around.barrel_candidates)),
        **_handle_place(around, motion, reach),
    }  # fmt: skip


def _misfit(around: PartContext, motion: Motion, reach: float) -> float:
    """Return the smallest distance of a part from itself rotated by MISFIT_ANGLES_RAD, over its reach: 0 for propellers."""
    points = around.part.samples.points
    points = points[:: max(1, len(points) // MISFIT_POINTS)]
    turned = np.concatenate([points @ T[:3, :3].T + T[:3, 3] for T in motion.transforms(MISFIT_ANGLES_RAD)])
    off = around.part.tree.distance(turned).reshape(len(MISFIT_ANGLES_RAD), -1)
    return float(min(np.quantile(off, 0.9, axis=1).min() / reach, 1.0))


def _coverage(points: Float[np.ndarray, "n 3"], motion: Motion) -> float:
    """Return the share of angular sectors about an axis that contain points: 1 for a ring, small for a hinge line."""
    helper = np.eye(3)[np.abs(motion.axis).argmin()]
    u = np.cross(motion.axis, helper)
    v = np.cross(motion.axis, u)
    arm = points - motion.origin
    angle = np.arctan2(arm @ v, arm @ u)
    return len(np.unique(np.floor(angle / (2 * np.pi) * SECTORS))) / SECTORS


def _handle_place(around: PartContext, motion: Motion, reach: float) -> dict[str, float]:
    """Return the distance of the handle from a line, over the part's reach, and whether a bar handle runs along it."""
    handle = around.handle
    if handle is None:
        return {"handle distance": MISSING, "bar handle along": MISSING}
    at, along = around.body_obb.center.copy(), MISSING
    for axis, where in zip(around.face_axes, handle.across, strict=True):
        at += where * around.body_obb.half[axis] * around.body_obb.axes[axis]
    if handle.along is not None:
        along = abs(float(around.body_obb.axes[around.face_axes[handle.along]] @ motion.axis))
    return {"handle distance": min(float(motion.distance(at[None])[0] / reach), MAX_RATIO), "bar handle along": along}


NO_LINE = dict.fromkeys(
    (
        "off along length", "off along width", "off along thickness", "off the part", "balance", "round about the axis",
        "circle off the axis", "rotational misfit", "contact along the line", "contact off the line",
        "contact middle off the line", "contact around the axis", "contact turns in place", "off the parent's border",
        "barrel near", "handle distance", "bar handle along",
    ),
    MISSING,
)  # fmt: skip
