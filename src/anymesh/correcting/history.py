"""History of corrections with undo and redo. It is immutable: every step returns a new history."""

from __future__ import annotations

from dataclasses import dataclass, replace

from anymesh.correcting.apply import apply
from anymesh.correcting.corrections import Correction, CorrectionError
from anymesh.types import Asset


@dataclass(frozen=True)
class HistoryEntry:
    """A correction, its time (ISO 8601), and its author."""

    correction: Correction
    time: str
    author: str


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

    def undo(self) -> History:
        """Undo the last correction, which can be redone."""
        if not self.done:
            raise CorrectionError("there is nothing to undo")
        return History(self.states[:-1], self.done[:-1], (*self.undone, self.done[-1]))

    def redo(self) -> History:
        """Redo the correction that was undone last."""
        if not self.undone:
            raise CorrectionError("there is nothing to redo")
        return replace(self.do(self.undone[-1]), undone=self.undone[:-1])
