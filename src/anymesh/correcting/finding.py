"""Parts and joints of an asset by name, with errors that say what is there."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from jaxtyping import Float

from anymesh.correcting.corrections import CorrectionError
from anymesh.types import Asset, Joint

UNSURE = "joint {}:"  # how a warning about one joint begins


def part_number(asset: Asset, name: str) -> int:
    """The number of a part. CorrectionError when there is none of that name."""
    names = [p.name for p in asset.segmentation.parts]
    if name not in names:
        raise CorrectionError(f"there is no part {name!r}; the parts are {', '.join(names)}")
    return names.index(name)


def joint_of_part(asset: Asset, name: str) -> Joint:
    """The joint that carries a part. CorrectionError for the root."""
    if part_number(asset, name) == 0:
        raise CorrectionError(f"{name!r} is the root, which has no joint; choose one of the parts that hang on it")
    return next(j for j in asset.joints if j.child == name)


def hanging_on(asset: Asset, name: str) -> set[str]:
    """The parts that hang on a part, near and far, without itself."""
    found: set[str] = set()
    waiting = [name]
    while waiting:
        at = waiting.pop()
        below = [j.child for j in asset.joints if j.parent == at]
        found.update(below)
        waiting.extend(below)
    return found


def with_joint(asset: Asset, joint: Joint) -> Asset:
    """The asset with one joint in the place of the one of the same child; a warning that it was unsure goes."""
    joints = tuple(joint if j.child == joint.child else j for j in asset.joints)
    return replace(asset, joints=joints, warnings=without_doubts(asset.warnings, {joint.name}))


def without_doubts(warnings: tuple[str, ...], joints: set[str]) -> tuple[str, ...]:
    """The warnings that do not speak of these joints."""
    begin = tuple(UNSURE.format(name) for name in sorted(joints))
    return tuple(w for w in warnings if not (begin and w.startswith(begin)))


def box_middle(asset: Asset, name: str) -> Float[np.ndarray, " 3"]:
    """The middle of a part's axis-aligned box [m, asset frame]."""
    corners = asset.mesh.triangles[asset.segmentation.faces(part_number(asset, name))].reshape(-1, 3)
    return (corners.min(0) + corners.max(0)) / 2
