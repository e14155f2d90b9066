"""State of a paid task, stored in a file so that a rerun resumes it instead of paying again."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from anymesh.errors import OutputError
from anymesh.finishing.meshy_api import TASK_ID
from anymesh.runtime import write_whole


@dataclass(frozen=True)
class Bought:
    """Finished paid task. credits: that it took; seed: drawn by the service, None if not stated."""

    task: str
    credits: float
    seed: int | None = None


@dataclass(frozen=True)
class Pending:
    """Stored state of a paid task.

    request: digest of the request; task: its id, None until its creation is confirmed; known: ids of the tasks that existed
    before it, None if they could not be listed; asked: start time of its creation [s since 1970]; bought: once it has
    succeeded.
    """

    request: str
    task: str | None
    known: tuple[str, ...] | None = None
    asked: float = 0.0
    bought: Bought | None = None


def read_pending(path: Path, request: str) -> Pending | None:
    """Read the state of this request; None if the file is about another one, is missing or cannot be read."""
    try:
        held = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    if not isinstance(held, dict) or held.get("request") != request:
        return None
    task, known, asked = held.get("task"), held.get("known"), held.get("asked")
    valid = task if isinstance(task, str) and TASK_ID.fullmatch(task) else None
    ids = tuple(k for k in known if isinstance(k, str)) if isinstance(known, list) else None
    when = float(asked) if isinstance(asked, int | float) else 0.0
    return Pending(request, valid, ids, when, _bought(valid, held.get("bought")))


def _bought(task: str | None, held: object) -> Bought | None:
    if task is None or not isinstance(held, dict) or not isinstance(held.get("credits"), int | float):
        return None
    seed = held.get("seed")
    return Bought(task, float(held["credits"]), seed if isinstance(seed, int) else None)


def write_pending(path: Path, pending: Pending) -> None:
    """Write the state. Raise OutputError if that fails, so that no task is bought that a rerun could not find."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, (json.dumps(asdict(pending), indent=1) + "\n").encode())
    except OSError as error:
        raise OutputError(f"the state of a paid task cannot be kept in {path}: {error.strerror}") from None
