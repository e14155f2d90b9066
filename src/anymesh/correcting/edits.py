"""Application of corrections to an asset. The given asset is never changed; results are valid trees."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from jaxtyping import Float, Int

from anymesh.correcting.corrections import (
    ChangeParent,
    ChangeType,
    ChooseMotion,
    Confirm,
    Correction,
    CorrectionError,
    FaceSet,
    FlipSign,
    MergeParts,
    MoveFaces,
    Relabel,
    RemovePart,
    Rename,
    SetAxis,
    SetLimits,
    SetLoop,
    SetMimic,
    SetScrew,
    SplitComponents,
    SplitPart,
    Vector,
)
from anymesh.correcting.tree import (
    UNSURE,
    box_middle,
    coupled,
    hanging_on,
    joint_of_part,
    loops_of,
    part_number,
    renamed_joint,
    with_joint,
    without_doubts,
)
from anymesh.geometry.topology import components
from anymesh.names import legal_name
from anymesh.types import MOVING, Asset, Joint, JointType, Loop, Mimic, Part, Segmentation
from anymesh.types.motion import leaders

UNSURE_PART = "part {}: low confidence"  # begin of a warning about one part
BY_HAND = "corrected by hand"  # prefix of the reason of a corrected joint
CONFIRMED = "confirmed by hand"  # prefix of the reason of a joint that a person calls right
CERTAIN = 1.0  # confidence of manual corrections
USUAL_TURN = (0.0, float(np.pi / 2))  # [rad] default limits of a hinge
USUAL_CONE = (0.0, float(np.pi / 6))  # [rad] default limits of a ball; an estimate
UNCOUPLED = {"mimic": None, "pitch": 0.0}  # of a joint of another type
USUAL_SLIDE = 0.5  # default travel of a slide, as a share of the part's extent along the axis
MAX_LIMIT, MIN_RANGE = 1e6, 1e-6  # [rad or m] of a joint that engines accept
JOINT = "_joint"  # suffix of a joint's name after that of its part
MAX_COMPONENTS = 40  # a part with more components is a triangle soup, not parts that were joined by mistake


def change_type(asset: Asset, c: ChangeType) -> Asset:
    joint = joint_of_part(asset, c.part)
    if joint.type is c.type:
        raise CorrectionError(f"the joint of {c.part!r} is {c.type} already")
    changed = replace(
        joint,
        type=c.type,
        limits=_limits_for(asset, joint, c.type),
        origin=_origin_on_part(asset, c.part, joint.axis, joint.origin, c.type),
        **UNCOUPLED,
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
        case JointType.BALL:
            return USUAL_CONE
        case _:
            return None


def choose_motion(asset: Asset, c: ChooseMotion) -> Asset:
    axis = _unit(c.axis)
    changed = replace(
        joint_of_part(asset, c.part),
        type=c.type,
        axis=axis,
        origin=_origin_on_part(asset, c.part, axis, np.array(c.origin, float), c.type),
        limits=c.limits,
        **{**UNCOUPLED, "pitch": c.pitch},
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
    if joint.type in (JointType.FIXED, JointType.FREE):
        raise CorrectionError(f"the joint of {c.part!r} is {joint.type} and has no limits; change its type first")
    if joint.mimic is not None:
        raise CorrectionError(f"{c.part!r} follows {joint.mimic.joint!r}, whose limits give its own; set those, or mimic none")
    if not -MAX_LIMIT <= c.lower <= 0 <= c.upper <= MAX_LIMIT:
        raise CorrectionError(
            f"limits must include the rest pose 0 and lie within {MAX_LIMIT:g}, found {c.lower:g}..{c.upper:g}"
        )
    if c.upper - c.lower < MIN_RANGE:
        raise CorrectionError(f"limits must contain a range of {MIN_RANGE:g} or more, found {c.lower:g}..{c.upper:g}")
    type_ = JointType.REVOLUTE if joint.type is JointType.CONTINUOUS else joint.type
    return with_joint(asset, replace(joint, type=type_, limits=(float(c.lower), float(c.upper)), **_reason("limits")))


def set_screw(asset: Asset, c: SetScrew) -> Asset:
    joint = joint_of_part(asset, c.part)
    if abs(c.pitch) > MAX_LIMIT:
        raise CorrectionError(f"a screw moves by at most {MAX_LIMIT:g} m a turn, found {c.pitch:g}")
    turning = joint.type in (JointType.REVOLUTE, JointType.CONTINUOUS, JointType.SCREW)
    values: dict[str, Any] = {"limits": joint.limits if turning else None, "mimic": None, "pitch": float(c.pitch)}
    return with_joint(asset, replace(joint, type=JointType.SCREW, **values, **_reason(f"screw of {c.pitch:g} m a turn")))


def set_mimic(asset: Asset, c: SetMimic) -> Asset:
    joint = joint_of_part(asset, c.part)
    if c.leader is None:
        return with_joint(asset, replace(joint, mimic=None, **_reason("follows none")))
    lead = joint_of_part(asset, c.leader)
    if lead.type not in MOVING:
        raise CorrectionError(f"{c.leader!r} is {lead.type} and cannot lead; valid are {', '.join(MOVING)}")
    mimic = Mimic(lead.name, float(c.ratio))
    leaders([replace(joint, mimic=mimic) if j is joint else j for j in asset.joints])  # raises for a circle
    return with_joint(asset, replace(joint, mimic=mimic, **_reason(f"follows {c.leader}")))


def set_loop(asset: Asset, c: SetLoop) -> Asset:
    joint = joint_of_part(asset, c.part)
    if c.other is None:
        kept = tuple(loop for loop in asset.loops if c.part not in (loop.first, loop.second))
        if len(kept) == len(asset.loops):
            raise CorrectionError(f"{c.part!r} is on no loop")
        return replace(asset, loops=kept)
    part_number(asset, c.other)
    _check_point(np.array(c.origin, float))
    taken = {j.name for j in asset.joints} | {loop.name for loop in asset.loops}
    plain = f"{c.part}_{c.other}_loop"
    name = next(n for n in (plain, *(f"{plain}_{k}" for k in range(2, len(taken) + 3))) if n not in taken)
    loop = Loop(name, c.part, c.other, np.array(c.origin, float), joint.axis, c.type)
    return with_joint(replace(asset, loops=(*asset.loops, loop)), replace(joint, **_reason(f"joined to {c.other}")))


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
    return {"confidence": CERTAIN, "reason": f"{BY_HAND}: {what}", "others": ()}


def _unit(axis: Vector) -> Float[np.ndarray, " 3"]:
    direction = np.array(axis, float)
    length = float(np.linalg.norm(direction))
    if not (np.isfinite(length) and length > 1e-9):
        raise CorrectionError(f"an axis needs a direction, found {tuple(axis)}")
    return direction / length + 0.0


def _origin_on_part(asset: Asset, part: str, axis: np.ndarray, point: np.ndarray, type_: JointType) -> Float[np.ndarray, " 3"]:
    """Return the point of the axis level with the part's centre; for a slide the centre itself (docs/conventions.md)."""
    _check_point(point)
    middle = box_middle(asset, part)
    return middle if type_ is JointType.PRISMATIC else point + ((middle - point) @ axis) * axis


def _check_point(point: np.ndarray) -> None:
    if not (np.abs(point) <= MAX_LIMIT).all():
        raise CorrectionError(f"a point on the axis must be finite, up to {MAX_LIMIT:g} m, found {point.tolist()}")


def merge_parts(asset: Asset, c: MergeParts) -> Asset:
    gone, kept = part_number(asset, c.part), part_number(asset, c.into)
    if gone == kept:
        raise CorrectionError(f"{c.part!r} cannot be merged into itself")
    if gone == 0 or c.into in hanging_on(asset, c.part):
        raise CorrectionError(f"{c.part!r} carries {c.into!r}; merge {c.into!r} into {c.part!r} instead")
    face_part = np.where(asset.segmentation.face_part == gone, kept, asset.segmentation.face_part)
    face_part = face_part - (face_part > gone)
    parts = tuple(p for p in asset.segmentation.parts if p.name != c.part)
    lost = next(j for j in asset.joints if j.child == c.part)
    joints = [replace(j, parent=c.into) if j.parent == c.part else j for j in asset.joints if j is not lost]
    return replace(
        asset,
        segmentation=Segmentation(face_part, parts),
        joints=coupled(joints),
        loops=loops_of(asset.loops, {c.part: c.into}),
        warnings=without_doubts(asset.warnings, {lost.name}),
    )


def remove_part(asset: Asset, c: RemovePart) -> Asset:
    return merge_parts(asset, MergeParts(c.part, joint_of_part(asset, c.part).parent))


def confirm(asset: Asset, c: Confirm) -> Asset:
    joint, part = joint_of_part(asset, c.part), asset.segmentation.parts[part_number(asset, c.part)]
    if joint.reason.startswith(CONFIRMED):
        raise CorrectionError(f"the joint of {c.part!r} is confirmed already")
    sure = with_joint(asset, replace(joint, confidence=CERTAIN, reason=f"{CONFIRMED}: {joint.reason}", others=()))
    begin = UNSURE_PART.format(c.part)
    sure = replace(sure, warnings=tuple(w for w in sure.warnings if not w.startswith(begin)))
    return _with_part(sure, c.part, replace(part, confidence=CERTAIN))


def split_part(asset: Asset, c: SplitPart) -> Asset:
    number, faces = part_number(asset, c.part), _faces(asset, c.faces)
    mine = asset.segmentation.face_part == number
    if not mine[faces].all():
        raise CorrectionError(f"{int((~mine[faces]).sum())} of {len(faces)} faces are not of {c.part!r}; choose faces of it")
    if len(faces) == int(mine.sum()):
        raise CorrectionError(f"these are all faces of {c.part!r}; a split must leave some of them")
    return _with_new_parts(asset, c.part, [faces], [_new_name(asset, c.name)], c.label)


def split_components(asset: Asset, c: SplitComponents) -> Asset:
    groups = components_of(asset, c.part)
    if not 2 <= len(groups) <= MAX_COMPONENTS:
        raise CorrectionError(
            f"{c.part!r} has {len(groups)} connected components; 2 to {MAX_COMPONENTS} can be split, choose faces instead"
        )
    names: list[str] = []
    for _ in groups[1:]:
        names.append(_new_name(asset, f"{c.part}_piece", names))
    label = asset.segmentation.parts[part_number(asset, c.part)].label
    return _with_new_parts(asset, c.part, groups[1:], names, label)


def components_of(asset: Asset, part: str) -> list[Int[np.ndarray, " _"]]:
    """Return the face indices of each connected component of a part, largest surface first."""
    faces = asset.segmentation.faces(part_number(asset, part))
    label = components(asset.mesh.vertices, asset.mesh.faces[faces]).label
    area = np.bincount(label, asset.mesh.face_areas[faces])
    return [faces[label == k] for k in np.argsort(-area, kind="stable")]


def move_faces(asset: Asset, c: MoveFaces) -> Asset:
    number, faces = part_number(asset, c.into), _faces(asset, c.faces)
    face_part = asset.segmentation.face_part.copy()
    if (face_part[faces] == number).all():
        raise CorrectionError(f"these faces are of {c.into!r} already")
    face_part[faces] = number
    emptied = [p.name for k, p in enumerate(asset.segmentation.parts) if not (face_part == k).any()]
    if emptied:
        raise CorrectionError(f"this would leave {', '.join(emptied)} without a face; merge it into {c.into!r} instead")
    return replace(asset, segmentation=Segmentation(face_part, asset.segmentation.parts))


def relabel(asset: Asset, c: Relabel) -> Asset:
    label = c.label.strip()
    if not label or not label.isprintable():
        raise CorrectionError(f"a label needs printable letters, found {c.label!r}")
    part = asset.segmentation.parts[part_number(asset, c.part)]
    if part.label == label:
        raise CorrectionError(f"{c.part!r} is labelled {label!r} already")
    return _with_part(asset, c.part, replace(part, label=label, confidence=1.0, reason=f"{BY_HAND}: label"))


def rename(asset: Asset, c: Rename) -> Asset:
    part = asset.segmentation.parts[part_number(asset, c.part)]
    others = {p.name.lower() for p in asset.segmentation.parts if p.name != c.part}
    if legal_name(c.name) != c.name or c.name.lower() in others or c.name == c.part:
        raise CorrectionError(f"the name {c.name!r} is not legal, or taken; valid is {_new_name(asset, c.name)!r}")
    return _with_joint_name(_with_part(asset, c.part, replace(part, name=c.name)), f"{c.part}{JOINT}", f"{c.name}{JOINT}")


def _with_joint_name(asset: Asset, old: str, new: str) -> Asset:
    """Rename a joint that is named after its part, and its warnings, unless another joint has the new name."""
    if new.lower() in {j.name.lower() for j in asset.joints}:
        return asset
    joints = tuple(renamed_joint(j, old, new) for j in asset.joints)
    begin, now = UNSURE.format(old), UNSURE.format(new)
    warnings = tuple(now + w.removeprefix(begin) if w.startswith(begin) else w for w in asset.warnings)
    return replace(asset, joints=joints, warnings=warnings)


def _with_part(asset: Asset, name: str, part: Part) -> Asset:
    parts = tuple(part if p.name == name else p for p in asset.segmentation.parts)
    joints, loops = _renamed(asset.joints, {name: part.name}), loops_of(asset.loops, {name: part.name})
    return replace(asset, segmentation=Segmentation(asset.segmentation.face_part, parts), joints=joints, loops=loops)


def _renamed(joints: tuple[Joint, ...], new: Mapping[str, str]) -> tuple[Joint, ...]:
    return tuple(replace(j, parent=new.get(j.parent, j.parent), child=new.get(j.child, j.child)) for j in joints)


def _with_new_parts(asset: Asset, of: str, groups: list[np.ndarray], names: list[str], label: str) -> Asset:
    """Make groups of faces of one part into new parts, at the end of the list, fixed to it."""
    face_part, parts = asset.segmentation.face_part.copy(), list(asset.segmentation.parts)
    for faces, name in zip(groups, names, strict=True):
        face_part[faces] = len(parts)
        parts.append(Part(name, label, 1.0, f"{BY_HAND}: split from {of}"))
    grown = replace(asset, segmentation=Segmentation(face_part, tuple(parts)), joints=(*asset.joints, *_fixed(names, of)))
    joints = tuple(replace(j, origin=box_middle(grown, j.child)) if j.child in names else j for j in grown.joints)
    return replace(grown, joints=joints)


def _fixed(names: list[str], parent: str) -> tuple[Joint, ...]:
    up, reason = np.array([0.0, 0, 1]), f"{BY_HAND}: split from {parent}, fixed to it until a motion is chosen"
    return tuple(Joint(f"{n}{JOINT}", JointType.FIXED, parent, n, np.zeros(3), up, None, 1.0, reason) for n in names)


def _new_name(asset: Asset, wanted: str, also: Sequence[str] = ()) -> str:
    """Return an unused legal name for a part, whose joint's name is unused as well."""
    taken = {p.name.lower() for p in asset.segmentation.parts} | {name.lower() for name in also}
    taken |= {j.name.lower()[: -len(JOINT)] for j in asset.joints if j.name.lower().endswith(JOINT)}
    plain = legal_name(wanted)
    return next(n for n in (plain, *(f"{plain}_{k}" for k in range(2, len(taken) + 3))) if n.lower() not in taken)


def _faces(asset: Asset, faces: FaceSet) -> Int[np.ndarray, " n"]:
    numbers = faces.numbers
    count = len(asset.mesh.faces)
    if len(numbers) == 0:
        raise CorrectionError("no face is chosen; choose at least one")
    if numbers[0] < 0 or numbers[-1] >= count:
        raise CorrectionError(f"face numbers must lie in 0..{count - 1}, found {numbers[0]}..{numbers[-1]}")
    return numbers


EDITS: dict[type, Callable[[Asset, Any], Asset]] = {
    ChangeType: change_type,
    ChooseMotion: choose_motion,
    SetAxis: set_axis,
    FlipSign: flip_sign,
    SetLimits: set_limits,
    SetScrew: set_screw,
    SetMimic: set_mimic,
    SetLoop: set_loop,
    ChangeParent: change_parent,
    MergeParts: merge_parts,
    SplitPart: split_part,
    SplitComponents: split_components,
    MoveFaces: move_faces,
    Relabel: relabel,
    Rename: rename,
    Confirm: confirm,
    RemovePart: remove_part,
}


def apply(asset: Asset, correction: Correction) -> Asset:
    """Return the asset with one correction applied. Raise CorrectionError, with valid values, if it is not applicable."""
    try:
        return EDITS[type(correction)](asset, correction)
    except ValueError as error:  # an invalid value in a data class
        raise CorrectionError(str(error)) from error
