"""Corrections of the assignment of faces to parts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Int

from anymesh.correcting.corrections import (
    CorrectionError,
    FaceSet,
    MergeParts,
    MoveFaces,
    Relabel,
    Rename,
    SplitComponents,
    SplitPart,
)
from anymesh.correcting.finding import box_middle, hanging_on, part_number, without_doubts
from anymesh.correcting.joint_edits import BY_HAND
from anymesh.geometry.topology import components
from anymesh.names import legal_name
from anymesh.types import Asset, Joint, JointType, Part, Segmentation

JOINT = "_joint"  # suffix of a joint's name after that of its part
MAX_COMPONENTS = 40  # a part with more components is a triangle soup, not parts that were joined by mistake


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
    joints = tuple(replace(j, parent=c.into) if j.parent == c.part else j for j in asset.joints if j is not lost)
    return replace(
        asset,
        segmentation=Segmentation(face_part, parts),
        joints=joints,
        warnings=without_doubts(asset.warnings, {lost.name}),
    )


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
    renamed = _with_part(asset, c.part, replace(part, name=c.name))
    return replace(renamed, joints=_renamed(asset.joints, {c.part: c.name}))


def _with_part(asset: Asset, name: str, part: Part) -> Asset:
    parts = tuple(part if p.name == name else p for p in asset.segmentation.parts)
    joints = _renamed(asset.joints, {name: part.name})
    return replace(asset, segmentation=Segmentation(asset.segmentation.face_part, parts), joints=joints)


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
