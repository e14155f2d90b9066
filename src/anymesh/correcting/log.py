"""Conversion of a log of corrections to and from JSON values."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from typing import Any, assert_never

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
from anymesh.correcting.history import HistoryEntry
from anymesh.types import JointType

KINDS: dict[str, type[Correction]] = {
    "change_type": ChangeType,
    "choose_motion": ChooseMotion,
    "set_axis": SetAxis,
    "flip_sign": FlipSign,
    "set_limits": SetLimits,
    "change_parent": ChangeParent,
    "merge_parts": MergeParts,
    "split_part": SplitPart,
    "split_components": SplitComponents,
    "move_faces": MoveFaces,
    "relabel": Relabel,
    "rename": Rename,
}
NAMES = {kind: name for name, kind in KINDS.items()}


def pack_log(log: Sequence[HistoryEntry]) -> list[dict[str, Any]]:
    """Return one object per entry: `correction` (the kind), its fields, `time` and `author`.

    Face sets are runs [first, one after the last].
    """
    return [pack_entry(entry) for entry in log]


def pack_entry(entry: HistoryEntry) -> dict[str, Any]:
    c = entry.correction
    values = {f.name: _plain(getattr(c, f.name)) for f in fields(c)}
    return {"correction": NAMES[type(c)], **values, "time": entry.time, "author": entry.author}


def _plain(value: Any) -> Any:
    if isinstance(value, FaceSet):
        return [list(run) for run in value.runs]
    if isinstance(value, JointType):
        return str(value)
    return list(value) if isinstance(value, tuple) else value


def unpack_log(records: Sequence[Mapping[str, Any]]) -> tuple[HistoryEntry, ...]:
    """Parse the entries of a log. Raise CorrectionError for one that this version does not know."""
    return tuple(_entry(record) for record in records)


def _entry(record: Mapping[str, Any]) -> HistoryEntry:
    kind = KINDS.get(record.get("correction", ""))
    if kind is None:
        raise CorrectionError(f"unknown correction {record.get('correction')!r}; valid are {', '.join(KINDS)}")
    try:
        values = {f.name: _typed(f.name, record[f.name]) for f in fields(kind)}
        return HistoryEntry(kind(**values), record["time"], record["author"])
    except (KeyError, TypeError, ValueError) as error:
        raise CorrectionError(f"a correction {record['correction']!r} in the log cannot be read: {error!r}") from error


def _typed(name: str, value: Any) -> Any:
    if name == "faces":
        return FaceSet(tuple((int(a), int(b)) for a, b in value))
    if name == "type":
        return JointType(value)
    return tuple(float(v) for v in value) if isinstance(value, list) else value


def describe(c: Correction) -> str:
    """Describe a correction in a few words."""
    match c:
        case MergeParts():
            return f"{c.part} merged into {c.into}"
        case MoveFaces():
            return f"{len(c.faces.numbers)} faces moved to {c.into}"
        case SplitPart():
            return f"{len(c.faces.numbers)} faces split from {c.part} as {c.name}"
        case SplitComponents():
            return f"{c.part} split by its components"
        case ChangeParent():
            return f"{c.part} becomes a child of {c.parent}"
        case ChangeType():
            return f"{c.part} becomes {c.type}"
        case ChooseMotion():
            return f"{c.part}: {c.type}, {c.reason}"
        case SetAxis():
            return f"{c.part}: axis {c.how}"
        case SetLimits():
            return f"{c.part}: limits {c.lower:.4g}..{c.upper:.4g}"
        case FlipSign():
            return f"{c.part}: positive the other way"
        case Relabel():
            return f"{c.part} labelled {c.label}"
        case Rename():
            return f"{c.part} renamed {c.name}"
        case _ as unreachable:
            assert_never(unreachable)
