"""Manual corrections of an asset: typed corrections, a history with undo, a replayable log, and safe saving."""

from anymesh.correcting.apply import apply
from anymesh.correcting.corrections import (
    ChangeParent,
    ChangeType,
    ChooseMotion,
    Correction,
    CorrectionError,
    FaceSet,
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
from anymesh.correcting.history import History, HistoryEntry
from anymesh.correcting.motions import ranked_motions
from anymesh.correcting.save import Opened, StaleError, open_asset, save_asset

__all__ = [
    "ChangeParent",
    "ChangeType",
    "ChooseMotion",
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
