"""The task that a retexturing waits for, kept in a file so that a rerun goes on with it instead of paying again."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from anymesh.errors import OutputError
from anymesh.models.cache import write_whole
from anymesh.models.meshy_api import TASK_ID


@dataclass(frozen=True)
class Pending:
    """request: digest of what was asked; task: its id, None while its creation is not confirmed; known: the tasks that
    there were before it, None when they could not be listed."""

    request: str
    task: str | None
    known: tuple[str, ...] | None = None


def read_pending(path: Path, request: str) -> Pending | None:
    """What the file holds of this very request; None for another one, no file, or one that cannot be read."""
    try:
        held = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    if not isinstance(held, dict) or held.get("request") != request:
        return None
    task, known = held.get("task"), held.get("known")
    valid = isinstance(task, str) and TASK_ID.fullmatch(task)
    ids = tuple(k for k in known if isinstance(k, str)) if isinstance(known, list) else None
    return Pending(request, task if valid else None, ids)


def write_pending(path: Path, pending: Pending) -> None:
    """Raises OutputError where it cannot be written: nothing is bought that a rerun could not find again."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, (json.dumps(asdict(pending), indent=1) + "\n").encode())
    except OSError as error:
        raise OutputError(f"the state of a paid task cannot be kept in {path}: {error.strerror}") from None
