"""Manual corrections of an asset: typed corrections, a history with undo, a replayable log, and safe saving."""

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
    "open_asset",
    "ranked_motions",
    "save_asset",
]
