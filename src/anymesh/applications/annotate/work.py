"""Annotation of one object in a worker process."""

from __future__ import annotations

import errno
import hashlib
import json
import os
import re
import time
from contextlib import suppress
from dataclasses import replace
from functools import cache
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Any

from anymesh.applications.annotate.inputs import OBJAVERSE
from anymesh.applications.annotate.states import AttemptOutcome, Job, Result
from anymesh.errors import (
    AnymeshError,
    BudgetError,
    InputError,
    MissingExtraError,
    ModelError,
    OpenQuestionError,
    OptionError,
    failed_stage,
)
from anymesh.pipeline.options import Limit, Spent
from anymesh.prompted.models.retry import UnavailableError
from anymesh.runtime import read_json, write_whole

if TYPE_CHECKING:
    from anymesh.prompted.models.budget import Limiter

STORAGE = {getattr(errno, name, errno.ENOSPC) for name in "ENOSPC EROFS EDQUOT EIO ENODEV ESTALE EACCES EPERM".split()}
FILES = "files:"
LONGEST = 500  # maximum number of characters of an error


def annotate_object(job: Job) -> AttemptOutcome:
    """Annotate an object; only MemoryError is raised, which the worker handles as a limit."""
    begin = time.perf_counter()
    _prepare(job)
    try:
        outcome = _annotated(job)
    except MemoryError:
        raise
    except Exception as error:
        outcome = failure(error)
    return replace(outcome, seconds=time.perf_counter() - begin, memory=_peak_memory())


def _annotated(job: Job) -> AttemptOutcome:
    from anymesh.pipeline import articulate

    mesh, out = local_mesh(job.source), job.out
    if not job.redo and (made := asset_columns(out)) and made["sha256"] == _digest(mesh):
        return AttemptOutcome(Result.DONE, record=made)  # its run ended between the last file and the ledger
    options = dict(job.options)
    if str(options.get("answerer", "")).startswith(FILES):
        options["answerer"] = f"{options['answerer']}/{out.name}"
    if job.metered:
        options |= {"spent": ObjectAccount(job.spent, job.spending), "limiter": _limiter(*job.rate) if any(job.rate) else None}
    out.parent.mkdir(parents=True, exist_ok=True)
    articulate(mesh, out, force=out.exists(), **options)
    made = asset_columns(out)
    if made is None:
        raise InputError(f"{out} was removed during processing")
    return AttemptOutcome(Result.DONE, record=made)


@cache
def _limiter(requests: int | None, tokens: int | None) -> Limiter:
    """Return the limiter of this process, for all its objects."""
    from anymesh.prompted.models.budget import Limiter, Rate

    return Limiter(Rate(requests, tokens))


class ObjectAccount:
    """Calls of one object and their cost [USD], on top of what its collection had spent when the object began.

    The object's own share is kept in a file, which the driver of the run reads even if this process is killed. A call in
    progress counts at its upper bound.
    """

    def __init__(self, before: tuple[int, float], file: Path) -> None:
        self._before, self._file = before, file
        calls, cost = read_spending(file)  # of a start of the same attempt on a machine that was lost
        self._spent = Spent(before[0] + calls, before[1] + cost)
        self._open: dict[int, float] = {}
        self._lock = Lock()

    @property
    def calls(self) -> int:
        """Number of calls answered so far."""
        return self._spent.calls

    @property
    def cost(self) -> float:
        """Their cost [USD, of known prices]."""
        return self._spent.cost

    def hold(self, kind: str, most: float, limit: Limit) -> int:
        """Reserve a call of at most `most` [USD] and return the reservation's number. Raise BudgetError beyond the limit."""
        with self._lock:
            number = self._spent.hold(kind, most, limit)
            self._open[number] = most
            self._write()
        return number

    def settle(self, hold: int, cost: float | None) -> None:
        """Replace a reservation by the cost of the call; None for a call that failed and was not billed."""
        with self._lock:
            self._spent.settle(hold, cost)
            del self._open[hold]
            self._write()

    def _write(self) -> None:
        calls, cost = self.calls - self._before[0] + len(self._open), self.cost - self._before[1] + sum(self._open.values())
        self._file.parent.mkdir(parents=True, exist_ok=True)
        write_whole(self._file, json.dumps({"calls": calls, "cost_usd": cost}).encode())


def read_spending(file: Path) -> tuple[int, float]:
    """Return the calls and their cost [USD] that an account wrote; 0 if there is no file."""
    record = read_json(file) or {}
    return int(record.get("calls", 0)), float(record.get("cost_usd", 0.0))


def asset_columns(folder: Path) -> dict[str, Any] | None:
    """Return the columns of the ledger for a finished asset; None if there is none, or if it is incomplete."""
    asset = read_json(folder / "asset.json")
    if asset is None:
        return None
    try:
        joints = asset["joints"]
        return {
            "confidence": min((float(j["confidence"]) for j in joints), default=None),
            "parts": len(asset["parts"]) - 1,
            "joints": len(joints),
            "faces": sum(int(p["face_count"]) for p in asset["parts"]),
            "warnings": len(asset["warnings"]),
            "bytes": sum(p.lstat().st_size for p in folder.rglob("*") if p.is_file()),
            "sha256": str(asset["source"]["sha256"]),
            **{key: asset["source"].get("credits", {}).get(key) for key in ("license", "author")},
            "stage_seconds": json.dumps(read_json(folder / str(asset["timing"])) or {}),
        }
    except (KeyError, TypeError, ValueError, OSError):
        return None


def local_mesh(source: str) -> Path:
    """Return the file of a mesh, fetched if it is not on this machine. Raise InputError or UnavailableError."""
    if not source.startswith(OBJAVERSE):
        return Path(source)
    from anymesh.applications.annotate.objaverse_ import fetch

    return fetch(source.removeprefix(OBJAVERSE))


def _digest(mesh: Path) -> str:
    with mesh.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def failure(error: Exception) -> AttemptOutcome:
    """Convert an error to the outcome of an attempt, in one line without keys."""
    from anymesh.errors import redacted

    name, code = type(error).__name__, getattr(error, "exit_code", 0)
    stage = failed_stage(error) or ""
    if _is_storage(error):
        return AttemptOutcome(Result.STORAGE, name, _line(error), stage, exit_code=4)
    match error:
        case OpenQuestionError():
            return AttemptOutcome(Result.WAITING, name, "; ".join(map(str, error.folders))[:LONGEST], exit_code=code)
        case BudgetError():
            return AttemptOutcome(Result.BUDGET, name, _line(error), exit_code=code)
        case MissingExtraError():
            return AttemptOutcome(Result.STOPPED, name, _line(error), exit_code=code)
        case ModelError():
            result = Result.OUTAGE if isinstance(error, UnavailableError) else Result.FAILED
            return AttemptOutcome(result, name, _line(error), stage, exit_code=code)
        case InputError() | OptionError() | AnymeshError():
            return AttemptOutcome(Result.REFUSED, name, _line(error), stage, exit_code=code)
        case _:
            return AttemptOutcome(Result.FAILED, name, redacted(str(error)), stage, exit_code=70)


def _is_storage(error: BaseException | None) -> bool:
    while error is not None:
        if isinstance(error, OSError) and error.errno in STORAGE:
            return True
        error = error.__cause__
    return False


def _line(error: BaseException) -> str:
    from anymesh.errors import SECRET

    keys = re.compile(r"\b(?:sk-|AIza|Bearer )\S+")  # not SECRET alone: paths may be as long as keys
    line = " ".join(str(error).split())
    return keys.sub("[removed]", line if os.sep in line else SECRET.sub("[removed]", line))[:LONGEST]


def _prepare(job: Job) -> None:
    """Pin the process to one core, and reset the memory peak, where the system supports it."""
    if job.core is not None and hasattr(os, "sched_setaffinity"):
        with suppress(OSError):
            os.sched_setaffinity(0, {job.core})
    with suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5")  # resets the peak


def _peak_memory() -> int:
    """Return the peak resident memory [bytes]; 0 if unknown."""
    with suppress(OSError, StopIteration, ValueError):
        lines = Path("/proc/self/status").read_text().splitlines()
        return int(next(line for line in lines if line.startswith("VmHWM")).split()[1]) * 1024
    return 0
