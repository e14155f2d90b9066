"""Manual corrections of an asset: typed corrections, a history with undo, a replayable log, and safe saving."""

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
    SplitComponents,
    SplitPart,
)
from anymesh.correcting.edits import apply
from anymesh.correcting.history import History, HistoryEntry, Opened, StaleError, open_asset, save_asset
from anymesh.correcting.motions import ranked_motions

__all__ = [
    "ChangeParent",
    "ChangeType",
    "ChooseMotion",
    "Confirm",
    "Copy",
    "Correction",
    "CorrectionError",
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
    "SplitComponents",
    "SplitPart",
    "StaleError",
    "apply",
    "copies_of",
    "open_asset",
    "ranked_motions",
    "same_for_copies",
    "save_asset",
]
