"""Corrections of one joint."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from jaxtyping import Float

from anymesh.correcting.corrections import (
    ChangeParent,
    ChangeType,
    ChooseMotion,
    CorrectionError,
    FlipSign,
    SetAxis,
    SetLimits,
    Vector,
)
from anymesh.correcting.finding import box_middle, hanging_on, joint_of_part, part_number, with_joint
from anymesh.types import Asset, Joint, JointType

BY_HAND = "corrected by hand"  # prefix of the reason of a corrected joint
CERTAIN = 1.0  # confidence of manual corrections
USUAL_TURN = (0.0, float(np.pi / 2))  # [rad] default limits of a hinge
USUAL_SLIDE = 0.5  # default travel of a slide, as a share of the part's extent along the axis
MAX_LIMIT, MIN_RANGE = 1e6, 1e-6  # [rad or m] of a joint that engines accept


def change_type(asset: Asset, c: ChangeType) -> Asset:
    joint = joint_of_part(asset, c.part)
    if joint.type is c.type:
        raise CorrectionError(f"the joint of {c.part!r} is {c.type} already")
    changed = replace(
        joint,
        type=c.type,
        limits=_limits_for(asset, joint, c.type),
        origin=_origin_on_part(asset, c.part, joint.axis, joint.origin, c.type),
        **_reason(f"type {c.type}"),
    )
    return with_joint(asset, changed)


def _limits_for(asset: Asset, joint: Joint, type_: JointType) -> tuple[float, float] | None:
    match type_:
        case JointType.REVOLUTE:
            return USUAL_TURN
        case JointType.PRISMATIC:
            corners = asset.mesh.triangles[asset.segmentation.faces(part_number(asset, joint.child))].reshape(-1, 3)
            return (0.0, max(USUAL_SLIDE * float(np.ptp(corners @ joint.axis)), 1e-3 * asset.mesh.diagonal))
        case JointType.CONTINUOUS | JointType.FIXED:
            return None


def choose_motion(asset: Asset, c: ChooseMotion) -> Asset:
    axis = _unit(c.axis)
    changed = replace(
        joint_of_part(asset, c.part),
        type=c.type,
        axis=axis,
        origin=_origin_on_part(asset, c.part, axis, np.array(c.origin, float), c.type),
        limits=c.limits,
        **_reason(c.reason),
    )
    return with_joint(asset, changed)


def set_axis(asset: Asset, c: SetAxis) -> Asset:
    joint, axis = joint_of_part(asset, c.part), _unit(c.axis)
    origin = _origin_on_part(asset, c.part, axis, np.array(c.origin, float), joint.type)
    return with_joint(asset, replace(joint, axis=axis, origin=origin, **_reason(f"axis {c.how}")))


def flip_sign(asset: Asset, c: FlipSign) -> Asset:
    joint = joint_of_part(asset, c.part)
    return with_joint(asset, replace(joint, axis=0.0 - joint.axis, **_reason("positive the other way")))


def set_limits(asset: Asset, c: SetLimits) -> Asset:
    joint = joint_of_part(asset, c.part)
    if joint.type is JointType.FIXED:
        raise CorrectionError(f"the joint of {c.part!r} is fixed and has no limits; change its type first")
    if not -MAX_LIMIT <= c.lower <= 0 <= c.upper <= MAX_LIMIT:
        raise CorrectionError(
            f"limits must include the rest pose 0 and lie within {MAX_LIMIT:g}, found {c.lower:g}..{c.upper:g}"
        )
    if c.upper - c.lower < MIN_RANGE:
        raise CorrectionError(f"limits must contain a range of {MIN_RANGE:g} or more, found {c.lower:g}..{c.upper:g}")
    type_ = JointType.REVOLUTE if joint.type is JointType.CONTINUOUS else joint.type
    return with_joint(asset, replace(joint, type=type_, limits=(float(c.lower), float(c.upper)), **_reason("limits")))


def change_parent(asset: Asset, c: ChangeParent) -> Asset:
    joint = joint_of_part(asset, c.part)
    part_number(asset, c.parent)
    below = hanging_on(asset, c.part)
    if c.parent == c.part or c.parent in below:
        free = [p.name for p in asset.segmentation.parts if p.name != c.part and p.name not in below]
        raise CorrectionError(f"{c.part!r} cannot be a child of {c.parent!r}, which it carries; valid are {', '.join(free)}")
    if c.parent == joint.parent:
        raise CorrectionError(f"{c.part!r} is already a child of {c.parent!r}")
    return with_joint(asset, replace(joint, parent=c.parent, **_reason(f"parent {c.parent}")))


def _reason(what: str) -> dict[str, object]:
    return {"confidence": CERTAIN, "reason": f"{BY_HAND}: {what}"}


def _unit(axis: Vector) -> Float[np.ndarray, " 3"]:
    direction = np.array(axis, float)
    length = float(np.linalg.norm(direction))
    if not (np.isfinite(length) and length > 1e-9):
        raise CorrectionError(f"an axis needs a direction, found {tuple(axis)}")
    return direction / length + 0.0


def _origin_on_part(asset: Asset, part: str, axis: np.ndarray, point: np.ndarray, type_: JointType) -> Float[np.ndarray, " 3"]:
    """Return the point of the axis level with the part's centre; for a slide the centre itself (docs/conventions.md)."""
    if not (np.abs(point) <= MAX_LIMIT).all():
        raise CorrectionError(f"a point on the axis must be finite, up to {MAX_LIMIT:g} m, found {point.tolist()}")
    middle = box_middle(asset, part)
    return middle if type_ is JointType.PRISMATIC else point + ((middle - point) @ axis) * axis


__all__ = ["BY_HAND", "change_parent", "change_type", "choose_motion", "flip_sign", "set_axis", "set_limits"]
