"""Annotation of one object in a worker process, with its outcome as plain values."""

from __future__ import annotations

import errno
import os
import re
import time
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from anymesh.applications.annotate.requests import OBJAVERSE
from anymesh.applications.annotate.states import AttemptOutcome, Result
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
from anymesh.prompted.models.retry import UnavailableError

STORAGE = {getattr(errno, name, errno.ENOSPC) for name in "ENOSPC EROFS EDQUOT EIO ENODEV ESTALE EACCES EPERM".split()}
FILES = "files:"
LONGEST = 500  # maximum number of characters of an error


@dataclass(frozen=True)
class Job:
    """An object for a worker. out: its folder; collection: the output with the ledger; options: of `articulate`.

    rate: requests and tokens per minute; core: that the process is pinned to, None for any; metered: whether a model's calls
    are counted in the ledger;
    bridge: socket of the process with the ledger, None if it is opened directly.
    """

    name: str
    source: str
    out: str
    collection: str
    token: str
    options: Mapping[str, Any] = field(default_factory=dict)
    redo: bool = False
    rate: tuple[int | None, int | None] = (None, None)
    core: int | None = None
    metered: bool = False
    bridge: str | None = None

    def as_dict(self) -> dict[str, Any]:
        """Return plain values, for another process."""
        return asdict(self)


def annotate_object(job: dict[str, Any]) -> dict[str, Any]:
    """Annotate an object; return an AttemptOutcome as a dictionary.

    Only MemoryError is raised, which the worker handles as a limit.
    """
    what, begin = Job(**job), time.perf_counter()
    _prepare(what)
    try:
        outcome = _annotated(what)
    except MemoryError:
        raise
    except Exception as error:
        outcome = failure(error)
    record = asdict(outcome) | {"seconds": time.perf_counter() - begin, "memory": _peak_memory()}
    return record | {"result": str(outcome.result)}


def _annotated(job: Job) -> AttemptOutcome:
    from anymesh.applications.annotate.results import asset_columns
    from anymesh.pipeline import articulate

    mesh = local_mesh(job.source)
    out = Path(job.out)
    if not job.redo and (made := asset_columns(out)) and made["sha256"] == _digest(mesh):
        return AttemptOutcome(Result.DONE, record=made)  # its run ended between the last file and the ledger
    options = dict(job.options)
    if str(options.get("answerer", "")).startswith(FILES):
        options["answerer"] = f"{options['answerer']}/{out.name}"
    out.parent.mkdir(parents=True, exist_ok=True)
    articulate(mesh, out, force=out.exists(), **options, **_metered(job))
    made = asset_columns(out)
    if made is None:
        raise InputError(f"{out} was removed during processing")
    return AttemptOutcome(Result.DONE, record=made)


def _metered(job: Job) -> dict[str, Any]:
    if not job.metered:
        return {}
    if job.bridge is not None:
        from anymesh.applications.annotate.bridge import RemoteMeter

        remote = RemoteMeter(job.bridge, job.name, job.token)
        return {"spent": remote, "limiter": remote if any(job.rate) else None}
    from anymesh.applications.annotate.accounts import open_account
    from anymesh.prompted.models.rates import Rate

    rate = Rate(*job.rate) if any(job.rate) else None
    account, limiter = open_account(Path(job.collection), job.name, job.token, rate)
    return {"spent": account, "limiter": limiter}


def local_mesh(source: str) -> Path:
    """Return the file of a mesh, fetched if it is not on this machine. Raise InputError or UnavailableError."""
    if not source.startswith(OBJAVERSE):
        return Path(source)
    from anymesh.applications.annotate.objaverse_ import fetch

    return fetch(source.removeprefix(OBJAVERSE))


def _digest(mesh: Path) -> str:
    import hashlib

    with mesh.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def failure(error: Exception) -> AttemptOutcome:
    """Convert an error to the outcome of an attempt, in one line without keys."""
    from anymesh.defects import redacted

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
    from anymesh.prompted.models.error_redaction import SECRET

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
