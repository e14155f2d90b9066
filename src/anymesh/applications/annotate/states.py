"""States of an object, results of an attempt, and claims."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
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
    STOPPED = "stopped"  # an option or an extra is wrong for every object, or the run was interrupted


ENDING = (Result.STORAGE, Result.BUDGET, Result.STOPPED)  # results after which a run claims no more objects


@dataclass(frozen=True)
class Claim:
    """The right to work on an object; token: required for recording its result."""

    seq: int
    name: str
    source: str
    options: Mapping[str, Any]
    folder: str
    token: str
    redo: bool


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
