"""Manual corrections of an asset: typed corrections, operations as text, history with undo, replayable log, safe saving.

The names are loaded on first use, so that the command line can read the operations without libraries.
"""

from typing import TYPE_CHECKING

from anymesh.entry_points import on_first_use

if TYPE_CHECKING:
    from anymesh.correcting.copies import Copy, copies_of, same_for_copies
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
    )
    from anymesh.correcting.editable import EditableAsset, EditableJoint, load
    from anymesh.correcting.edits import apply
    from anymesh.correcting.history import History, HistoryEntry, Opened, StaleError, open_asset, save_asset
    from anymesh.correcting.motions import ranked_motions
    from anymesh.correcting.parsing import corrections_of

_HOMES = {
    **dict.fromkeys(("Copy", "copies_of", "same_for_copies"), "copies"),
    **dict.fromkeys(
        (
            "ChangeParent",
            "ChangeType",
            "ChooseMotion",
            "Confirm",
            "Correction",
            "CorrectionError",
            "FaceSet",
            "FlipSign",
            "MergeParts",
            "MoveFaces",
            "Relabel",
            "RemovePart",
            "Rename",
            "SetAxis",
            "SetLimits",
            "SetLoop",
            "SetMimic",
            "SetScrew",
            "SplitComponents",
            "SplitPart",
        ),
        "corrections",
    ),
    **dict.fromkeys(("EditableAsset", "EditableJoint", "load"), "editable"),
    "apply": "edits",
    **dict.fromkeys(("History", "HistoryEntry", "Opened", "StaleError", "open_asset", "save_asset"), "history"),
    "ranked_motions": "motions",
    "corrections_of": "parsing",
}
__getattr__ = on_first_use(__name__, _HOMES)
__all__ = [
    "ChangeParent",
    "ChangeType",
    "ChooseMotion",
    "Confirm",
    "Copy",
    "Correction",
    "CorrectionError",
    "EditableAsset",
    "EditableJoint",
    "FaceSet",
    "FlipSign",
    "History",
    "HistoryEntry",
    "MergeParts",
    "MoveFaces",
    "Opened",
    "Relabel",
    "RemovePart",
    "Rename",
    "SetAxis",
    "SetLimits",
    "SetLoop",
    "SetMimic",
    "SetScrew",
    "SplitComponents",
    "SplitPart",
    "StaleError",
    "apply",
    "copies_of",
    "corrections_of",
    "load",
    "open_asset",
    "ranked_motions",
    "same_for_copies",
    "save_asset",
]
