"""The task that a run waits for, kept in a file so that a rerun goes on with it instead of paying again."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from anymesh.errors import OutputError
from anymesh.models.cache import write_whole
from anymesh.models.meshy_api import TASK_ID


@dataclass(frozen=True)
class Bought:
    """A paid task that has succeeded. credits: what it took; seed: that the service drew, None where it does not tell."""

    task: str
    credits: float
    seed: int | None = None


@dataclass(frozen=True)
class Pending:
    """request: digest of what was asked; task: its id, None while its creation is not confirmed; known: the tasks that
    there were before it, None when they could not be listed; asked: when its creation was begun [s since 1970]; bought: once it
    has succeeded."""

    request: str
    task: str | None
    known: tuple[str, ...] | None = None
    asked: float = 0.0
    bought: Bought | None = None


def read_pending(path: Path, request: str) -> Pending | None:
    """What the file holds of this very request; None for another one, no file, or one that cannot be read."""
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
    """Raises OutputError where it cannot be written: nothing is bought that a rerun could not find again."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, (json.dumps(asdict(pending), indent=1) + "\n").encode())
    except OSError as error:
        raise OutputError(f"the state of a paid task cannot be kept in {path}: {error.strerror}") from None
