"""History of corrections with undo and redo, its log as JSON values, and saving that never overwrites someone else's changes.

A history is immutable: every step returns a new one.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import MISSING, dataclass, fields, replace
from pathlib import Path
from typing import Any, get_args

from anymesh.correcting.corrections import Correction, CorrectionError, FaceSet
from anymesh.correcting.edits import apply
from anymesh.errors import OutputError
from anymesh.export import write_asset
from anymesh.pipeline.atomic_folder import CORRECTIONS, locked
from anymesh.pipeline.results import CorrectionResult
from anymesh.pipeline.run_folder import RunFolder, Saved
from anymesh.pipeline.stage_files import CORRECTION, stage_key
from anymesh.rendering.preview import write_preview
from anymesh.runtime import cache_folder, write_json
from anymesh.types import Asset, JointType

# the kinds of corrections, with their names in a log, such as "change_type"
NAMES: dict[type[Correction], str] = {
    kind: re.sub(r"(?<!^)(?=[A-Z])", "_", kind.__name__).lower() for kind in get_args(Correction)
}
KINDS = {name: kind for kind, name in NAMES.items()}


@dataclass(frozen=True)
class HistoryEntry:
    """A correction, its time (ISO 8601), and its author. joined: whether it is undone together with the one before it."""

    correction: Correction
    time: str
    author: str
    joined: bool = False


@dataclass(frozen=True, eq=False)
class History:
    """states: the asset before the first correction and after each; done: one entry per correction; undone: latest last."""

    states: tuple[Asset, ...]
    done: tuple[HistoryEntry, ...] = ()
    undone: tuple[HistoryEntry, ...] = ()

    def __post_init__(self) -> None:
        if len(self.states) != len(self.done) + 1:
            raise ValueError(f"a history needs one state more than corrections, found {len(self.states)}, {len(self.done)}")

    @classmethod
    def of(cls, original: Asset, log: tuple[HistoryEntry, ...] = ()) -> History:
        """Apply a log to an asset. Raise CorrectionError if it is the log of another asset."""
        history = cls((original,))
        for entry in log:
            history = history.do(entry)
        return history

    @property
    def original(self) -> Asset:
        """The asset before any correction."""
        return self.states[0]

    @property
    def asset(self) -> Asset:
        """The current asset."""
        return self.states[-1]

    def do(self, entry: HistoryEntry) -> History:
        """Apply one more correction, and drop undone ones. Raise CorrectionError if it is not applicable."""
        return History((*self.states, apply(self.asset, entry.correction)), (*self.done, entry))

    def do_all(self, corrections: Sequence[Correction], time: str, author: str) -> History:
        """Apply corrections as one step, which is undone at once. Raise CorrectionError if one is not applicable."""
        history = self
        for k, correction in enumerate(corrections):
            history = history.do(HistoryEntry(correction, time, author, joined=k > 0))
        return history

    def undo(self) -> History:
        """Undo the last correction and those that it is joined to; they can be redone."""
        if not self.done:
            raise CorrectionError("there is nothing to undo")
        first = max(k for k, entry in enumerate(self.done) if not (entry.joined and k))
        return History(self.states[: first + 1], self.done[:first], (*self.undone, *reversed(self.done[first:])))

    def redo(self) -> History:
        """Redo the correction that was undone last, with those that were undone together with it."""
        if not self.undone:
            raise CorrectionError("there is nothing to redo")
        history, left = self.do(self.undone[-1]), self.undone[:-1]
        while left and left[-1].joined:
            history, left = history.do(left[-1]), left[:-1]
        return replace(history, undone=left)


def pack_log(log: Sequence[HistoryEntry]) -> list[dict[str, Any]]:
    """Return one object per entry: `correction` (the kind), its fields, `time`, `author`, and `joined` where it is true.

    Face sets are runs [first, one after the last].
    """
    return [pack_entry(entry) for entry in log]


def pack_entry(entry: HistoryEntry) -> dict[str, Any]:
    c = entry.correction
    values = {f.name: _plain(getattr(c, f.name)) for f in fields(c)}
    joined = {"joined": True} if entry.joined else {}
    return {"correction": NAMES[type(c)], **values, "time": entry.time, "author": entry.author, **joined}


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
    kind = KINDS.get(str(record.get("correction")))
    if kind is None:
        raise CorrectionError(f"unknown correction {record.get('correction')!r}; valid are {', '.join(KINDS)}")
    try:
        values = {f.name: _typed(f.name, record[f.name]) for f in fields(kind) if f.name in record or f.default is MISSING}
        return HistoryEntry(kind(**values), record["time"], record["author"], bool(record.get("joined", False)))
    except (KeyError, TypeError, ValueError) as error:
        names = ", ".join(f.name for f in fields(kind))
        raise CorrectionError(f"a correction {record['correction']!r} needs {names}; found {error!r}") from error


def _typed(name: str, value: Any) -> Any:
    if name == "faces":
        return FaceSet(tuple((int(a), int(b)) for a, b in value))
    if name == "type":
        return JointType(value)
    return tuple(float(v) for v in value) if isinstance(value, list) else value


class StaleError(OutputError):
    """The asset was saved by another process after it was opened; saving now would lose its changes."""


@dataclass(frozen=True, eq=False)
class Opened:
    """An asset under correction.

    version: of the saved state on which its history is based; precision: probability from which its joints are written.
    """

    folder: Path
    history: History
    version: str
    precision: float = 0.0


def open_asset(folder: str | Path) -> Opened:
    """Open an output with its corrections. Raise OutputError if the folder is not an output, or lacks a stage."""
    saved = Saved.at(Path(folder))
    version = saved.last_key()
    log = unpack_log(saved.corrections(saved.editing()))
    return Opened(saved.target, History.of(saved.asset(edited=False), log), version, saved.how().precision)


def save_asset(opened: Opened) -> Opened:
    """Save the corrections and write all files again; earlier stages are kept, so that the original stays available.

    Raise StaleError if another process saved, or is saving, this asset since it was opened; then nothing is written.
    """
    with locked(opened.folder) as mine:
        if not mine:
            raise StaleError(f"{opened.folder} is being saved by another process; try again")
        with RunFolder.revise(opened.folder) as run:
            if run.last_key() != opened.version:
                raise StaleError(f"{opened.folder} was saved by someone else since it was opened; open it again to continue")
            _write(run, opened.history)
            version = run.last_key()
    return replace(opened, version=version)


def _write(run: RunFolder, history: History) -> None:
    stage, log, asset = run.editing(), pack_log(history.done), history.asset
    key = stage_key(stage, previous=run.last_key(edited=False), config={"log": log})
    run.save(stage, key, CorrectionResult(asset.segmentation, asset.joints, asset.warnings, tuple(log), asset.loops))
    with run.timed("export"):
        how = run.how()
        write_asset(run.asset(), run.folder, how, cache=cache_folder("shapes"))
        write_preview(how.written(asset), run.folder / "preview.png")
    before = () if stage is CORRECTION else run.corrections(CORRECTION)
    write_json(run.folder / CORRECTIONS, {"asset": asset.name, "corrections": [*before, *log]})
