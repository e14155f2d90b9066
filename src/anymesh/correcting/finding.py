"""Lookup of parts and joints by name, with errors that list the valid names."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from jaxtyping import Float

from anymesh.correcting.corrections import CorrectionError
from anymesh.types import Asset, Joint

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
    """Replace the joint with the same child; warnings about its uncertainty are removed."""
    joints = tuple(joint if j.child == joint.child else j for j in asset.joints)
    return replace(asset, joints=joints, warnings=without_doubts(asset.warnings, {joint.name}))


def without_doubts(warnings: tuple[str, ...], joints: set[str]) -> tuple[str, ...]:
    """Return the warnings that are not about these joints."""
    begin = tuple(UNSURE.format(name) for name in sorted(joints))
    return tuple(w for w in warnings if not (begin and w.startswith(begin)))


def box_middle(asset: Asset, name: str) -> Float[np.ndarray, " 3"]:
    """Return the centre of a part's axis-aligned box [m, asset frame]."""
    corners = asset.mesh.triangles[asset.segmentation.faces(part_number(asset, name))].reshape(-1, 3)
    return (corners.min(0) + corners.max(0)) / 2
