"""What can be chosen in an asset, and what a correction changed, as rows for a table or JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from jaxtyping import Int

from anymesh.correcting.corrections import ChooseMotion, CorrectionError
from anymesh.correcting.edits import apply, components_of
from anymesh.correcting.motions import motion_words, ranked_motions, told_apart
from anymesh.correcting.picking import PickedPart
from anymesh.correcting.proposals import unsure
from anymesh.correcting.tree import joint_of_part, part_number
from anymesh.names import listed
from anymesh.pipeline.results import JointVerdict, verdict
from anymesh.types import Asset, Joint
from anymesh.types.motion import extent

MAX_REGIONS = 200  # regions that are listed


def named_part(asset: Asset, name: str) -> str:
    """Return the part with this name, or that the joint with this name carries. Raise CorrectionError with all valid names."""
    parts = [p.name for p in asset.segmentation.parts]
    joints = {j.name: j.child for j in asset.joints}
    if name in parts:
        return name
    if name in joints:
        return joints[name]
    raise CorrectionError(f"there is no part or joint {name!r}; the parts are {listed(parts)}")


def regions_of(asset: Asset, part: str) -> list[Int[np.ndarray, " n"]]:
    """Return the regions of a part: its connected components if there are several, then the patches of each that has several.

    Each of the two kinds begins with the largest surface.
    """
    pieces, area = components_of(asset, part), asset.mesh.face_areas
    faces = asset.segmentation.faces(part_number(asset, part))
    label = PickedPart(asset, int(faces[0])).patches()
    patches = []
    for piece in pieces:
        of = label[np.searchsorted(faces, piece)]
        patches += [piece[of == k] for k in np.unique(of)] if len(np.unique(of)) > 1 else []
    patches.sort(key=lambda patch: -float(area[patch].sum()))
    return [*(pieces if len(pieces) > 1 else []), *patches] or pieces


def motion_rows(asset: Asset, part: str, motions: Sequence[ChooseMotion] | None = None) -> list[dict[str, Any]]:
    """Return one row per free motion of a part, the likeliest first: number, motion in words, range, share, reason.

    motions: as from `ranked_motions`, if they are known.
    """
    motions = ranked_motions(asset, named_part(asset, part)) if motions is None else motions
    joints = [_joint_after(asset, motion) for motion in motions]
    return [
        {"number": k, "motion": words, "range": extent(joint), "share": motion.confidence, "reason": motion.reason}
        for k, (words, joint, motion) in enumerate(zip(told_apart(asset, motions), joints, motions, strict=True), 1)
    ]


def _joint_after(asset: Asset, motion: ChooseMotion) -> Joint:
    return joint_of_part(apply(asset, motion), motion.part)


def region_rows(asset: Asset, part: str) -> list[dict[str, Any]]:
    """Return one row per region of a part: number, kind (piece, or patch of one), faces, size and middle [m]."""
    count = len(components_of(asset, named_part(asset, part)))
    rows = []
    for k, faces in enumerate(regions_of(asset, named_part(asset, part))[:MAX_REGIONS], 1):
        corners = asset.mesh.triangles[faces].reshape(-1, 3)
        low, high = corners.min(0), corners.max(0)
        sides, middle = ([round(float(v), 4) for v in values] for values in (high - low, (low + high) / 2))
        kind = "piece" if 1 < count >= k else "patch"
        rows.append({"number": k, "kind": kind, "faces": len(faces), "size": sides, "middle": middle})
    return rows


def part_rows(asset: Asset, precision: float = 0.0) -> list[dict[str, Any]]:
    """Return one row per joint: part, joint, motion in words, range, parent, confidence, verdict, why.

    The verdict is sure, check, guess, or proposed for a joint that is not written since its probability is below the precision.
    """
    rows, left = [], unsure(asset, precision)
    for j in asset.joints:
        sure = verdict(asset.segmentation, j, asset.warnings)
        if j.child in left:
            sure = JointVerdict("proposed", f"not written: right with probability {left[j.child]:.2f}; {sure.why}".rstrip("; "))
        motion = motion_words(asset, j) + coupling_words(asset, j)
        row = {"part": j.child, "joint": j.name, "motion": motion, "range": extent(j), "parent": j.parent}
        rows.append(row | {"confidence": j.confidence, "verdict": sure.word, "why": sure.why})
    return rows


def coupling_words(asset: Asset, joint: Joint) -> str:
    """Describe what a part follows and what loops join it to, "" for nothing."""
    words, mimic = "", joint.mimic
    if mimic is not None:
        words = f", follows {next(j.child for j in asset.joints if j.name == mimic.joint)} by {mimic.ratio:.4g}"
    ends = [(loop.first, loop.second) for loop in asset.loops if joint.child in (loop.first, loop.second)]
    joined = [second if first == joint.child else first for first, second in ends]
    return words + (f", joined to {', '.join(joined)}" if joined else "")


def changed_rows(before: Asset, after: Asset) -> list[dict[str, Any]]:
    """Return the rows of the joints that differ, with `change`: changed, new, was A (renamed), or removed, now of B."""
    old = {row["part"]: (row, _facts(before, row["part"])) for row in part_rows(before)}
    rows, names = [], {p.name for p in after.segmentation.parts}
    for row in part_rows(after):
        name = row["part"]
        was = name if name in old else _mostly(after, before, name)
        if name not in old:
            rows.append(row | {"change": f"was {was}" if was in old and was not in names else "new"})
        elif old[name] != (row, _facts(after, name)):
            rows.append(row | {"change": "changed"})
    kept = {row["change"].removeprefix("was ") for row in rows}
    for name in (n for n in old if n not in names and n not in kept):
        rows.append(old[name][0] | {"motion": "", "range": "", "change": f"removed, now of {_mostly(before, after, name)}"})
    return rows


def _facts(asset: Asset, part: str) -> tuple[Any, ...]:
    """Return what a correction may change of a part."""
    number, joint = part_number(asset, part), joint_of_part(asset, part)
    facts = (
        asset.segmentation.parts[number].label,
        asset.segmentation.faces(number).tobytes(),
        joint.name,
        joint.type,
        joint.parent,
    )
    joined = tuple(loop.name for loop in asset.loops if part in (loop.first, loop.second))
    return (*facts, *joint.axis, *joint.origin, joint.limits, joint.confidence, joint.reason, joint.mimic, joint.pitch, *joined)


def _mostly(asset: Asset, other: Asset, part: str) -> str:
    """Return the part of another state of the asset that has most of the faces of a part."""
    theirs = other.segmentation.face_part[asset.segmentation.faces(part_number(asset, part))]
    return other.segmentation.parts[int(np.bincount(theirs).argmax())].name
