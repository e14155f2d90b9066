"""Application of one correction to an asset. The given asset is not changed; the result is a valid tree."""

from __future__ import annotations

from typing import assert_never

from anymesh.correcting.corrections import (
    ChangeParent,
    ChangeType,
    ChooseMotion,
    Correction,
    CorrectionError,
    FlipSign,
    MergeParts,
    MoveFaces,
    Relabel,
    Rename,
    SetAxis,
    SetLimits,
    SplitComponents,
    SplitPart,
)
from anymesh.correcting.joint_edits import change_parent, change_type, choose_motion, flip_sign, set_axis, set_limits
from anymesh.correcting.part_edits import merge_parts, move_faces, relabel, rename, split_components, split_part
from anymesh.types import Asset


def apply(asset: Asset, correction: Correction) -> Asset:
    """Return the asset with one correction applied. Raise CorrectionError, with valid values, if it is not applicable."""
    try:
        return _apply(asset, correction)
    except ValueError as error:  # an invalid value in a data class
        raise CorrectionError(str(error)) from error


def _apply(asset: Asset, correction: Correction) -> Asset:
    match correction:
        case ChangeType():
            return change_type(asset, correction)
        case ChooseMotion():
            return choose_motion(asset, correction)
        case SetAxis():
            return set_axis(asset, correction)
        case FlipSign():
            return flip_sign(asset, correction)
        case SetLimits():
            return set_limits(asset, correction)
        case ChangeParent():
            return change_parent(asset, correction)
        case MergeParts():
            return merge_parts(asset, correction)
        case SplitPart():
            return split_part(asset, correction)
        case SplitComponents():
            return split_components(asset, correction)
        case MoveFaces():
            return move_faces(asset, correction)
        case Relabel():
            return relabel(asset, correction)
        case Rename():
            return rename(asset, correction)
        case _ as unreachable:
            assert_never(unreachable)
