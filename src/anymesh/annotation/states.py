"""The states of an object, what may become of an attempt, and the claim under which one is made."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any


class State(StrEnum):
    """Of an object in the ledger."""

    PENDING = "pending"
    RUNNING = "running"
    DONE = "done"
    WAITING = "waiting"  # for an answer that somebody else writes
    QUARANTINED = "quarantined"


class Result(StrEnum):
    """What became of an attempt."""

    DONE = "done"
    REFUSED = "refused"  # the mesh or its options cannot be used; another attempt would tell the same
    FAILED = "failed"  # a crash, a limit or a defect; tried again, then quarantined
    LOST = "lost"  # the machine or the run that worked on it is gone
    WAITING = "waiting"  # a question is open
    OUTAGE = "outage"  # a model or a hub cannot be reached
    STORAGE = "storage"  # the output cannot be written: full, read-only, gone
    BUDGET = "budget"  # the next call would pass the budget
    STOPPED = "stopped"  # an option or an extra is wrong for every object, or the run was interrupted


ENDING = (Result.STORAGE, Result.BUDGET, Result.STOPPED)  # after which a run claims nothing more


@dataclass(frozen=True)
class Claim:
    """The right to work on an object; token: under which its result is taken."""

    seq: int
    name: str
    source: str
    options: Mapping[str, Any]
    folder: str
    token: str
    redo: bool


@dataclass(frozen=True)
class AttemptOutcome:
    """What became of an attempt: error in one line, with its class; record: columns of the ledger for what was found."""

    result: Result
    error_class: str = ""
    error: str = ""
    stage: str = ""
    seconds: float = 0.0  # elapsed [s]
    memory: int = 0  # peak resident [bytes]
    record: Mapping[str, Any] = field(default_factory=dict)
    exit_code: int = 0  # of the command line, for what ends a run
