"""States of an object, the job that a worker gets, and the outcome of an attempt."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any


class State(StrEnum):
    """State of an object in the ledger."""

    PENDING = "pending"
    RUNNING = "running"
    DONE = "done"
    WAITING = "waiting"  # for an answer written by someone else
    QUARANTINED = "quarantined"


class Result(StrEnum):
    """Result of an attempt."""

    DONE = "done"
    REFUSED = "refused"  # the mesh or its options are unusable; another attempt would fail as well
    FAILED = "failed"  # a crash, a limit or a bug; tried again, then quarantined
    LOST = "lost"  # the machine or the run that worked on it is gone
    WAITING = "waiting"  # a question is open
    OUTAGE = "outage"  # a model or a hub is unreachable
    STORAGE = "storage"  # the output cannot be written: full, read-only, missing
    BUDGET = "budget"  # the next call could exceed the budget
    STOPPED = "stopped"  # an option or an extra is wrong for every object


ENDING = (Result.STORAGE, Result.BUDGET, Result.STOPPED)  # results after which a run starts no more objects


@dataclass(frozen=True)
class Job:
    """An object for a worker. seq: its number in the ledger; folder: relative to `collection`, the output with the ledger.

    options: of `articulate`; redo: whether an existing asset was made with other options; metered: whether calls of a model
    are counted; spent: calls and cost [USD] of the collection so far; rate: requests and tokens per minute of one worker;
    core: that the process is pinned to, None for any.
    """

    seq: int
    name: str
    source: str
    folder: str
    collection: str
    options: Mapping[str, Any] = field(default_factory=dict)
    redo: bool = False
    metered: bool = False
    spent: tuple[int, float] = (0, 0.0)
    rate: tuple[int | None, int | None] = (None, None)
    core: int | None = None

    @property
    def out(self) -> Path:
        """Folder of the asset."""
        return Path(self.collection, self.folder)

    @property
    def spending(self) -> Path:
        """File of the calls of the current attempt, and of their cost."""
        return self.out.with_name(f"{self.out.name}.spent.json")


@dataclass(frozen=True)
class AttemptOutcome:
    """Outcome of an attempt. error: one line, with its class; record: columns of the ledger."""

    result: Result
    error_class: str = ""
    error: str = ""
    stage: str = ""
    seconds: float = 0.0  # elapsed [s]
    memory: int = 0  # peak resident [bytes]
    record: Mapping[str, Any] = field(default_factory=dict)
    exit_code: int = 0  # of the command line, for results that end a run
