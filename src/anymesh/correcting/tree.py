"""The tree of parts and joints under correction: finding and replacing one, with what follows it and what loops join."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float

from anymesh.correcting.corrections import CorrectionError
from anymesh.types import MOVING, Asset, Joint, Loop
from anymesh.types.motion import with_implied_limits

UNSURE = "joint {}:"  # prefix of warnings about one joint


def part_number(asset: Asset, name: str) -> int:
    """Return the index of a part. Raise CorrectionError if there is none with that name."""
    names = [p.name for p in asset.segmentation.parts]
    if name not in names:
        raise CorrectionError(f"there is no part {name!r}; the parts are {', '.join(names)}")
    return names.index(name)


def joint_of_part(asset: Asset, name: str) -> Joint:
    """Return the joint that carries a part. Raise CorrectionError for the root."""
    if part_number(asset, name) == 0:
        raise CorrectionError(f"{name!r} is the root, which has no joint; choose one of its child parts")
    return next(j for j in asset.joints if j.child == name)


def hanging_on(asset: Asset, name: str) -> set[str]:
    """Return all descendants of a part."""
    descendants: set[str] = set()
    waiting = [name]
    while waiting:
        at = waiting.pop()
        below = [j.child for j in asset.joints if j.parent == at]
        descendants.update(below)
        waiting.extend(below)
    return descendants


def with_joint(asset: Asset, joint: Joint) -> Asset:
    """Replace the joint with the same child; warnings about its uncertainty are removed, and what follows it follows."""
    joints = [joint if j.child == joint.child else j for j in asset.joints]
    return replace(asset, joints=coupled(joints), warnings=without_doubts(asset.warnings, {joint.name}))


def coupled(joints: Sequence[Joint]) -> tuple[Joint, ...]:
    """Return the joints with the limits that their leaders imply; what followed a joint that cannot lead follows none."""
    leading = {j.name for j in joints if j.type in MOVING}
    lost = [j.mimic is not None and j.mimic.joint not in leading for j in joints]
    return with_implied_limits([replace(j, mimic=None) if gone else j for j, gone in zip(joints, lost, strict=True)])


def without_doubts(warnings: tuple[str, ...], joints: set[str]) -> tuple[str, ...]:
    """Return the warnings that are not about these joints."""
    begin = tuple(UNSURE.format(name) for name in joints)
    return tuple(w for w in warnings if not w.startswith(begin))


def box_middle(asset: Asset, name: str) -> Float[np.ndarray, " 3"]:
    """Return the centre of a part's axis-aligned box [m, asset frame]."""
    corners = asset.mesh.triangles[asset.segmentation.faces(part_number(asset, name))].reshape(-1, 3)
    return (corners.min(0) + corners.max(0)) / 2


def renamed_joint(joint: Joint, old: str, new: str) -> Joint:
    """Return a joint after one joint was renamed: itself, or the one that it follows."""
    follows = joint.mimic is not None and joint.mimic.joint == old
    mimic = replace(joint.mimic, joint=new) if joint.mimic is not None and follows else joint.mimic
    return replace(joint, name=new if joint.name == old else joint.name, mimic=mimic)


def loops_of(loops: tuple[Loop, ...], new: Mapping[str, str]) -> tuple[Loop, ...]:
    """Return the loops of renamed parts, without those that join a part to itself."""
    ends = [(loop, new.get(loop.first, loop.first), new.get(loop.second, loop.second)) for loop in loops]
    return tuple(replace(loop, first=a, second=b) for loop, a, b in ends if a != b)
