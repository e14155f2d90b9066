"""Wire format of Meshy's tasks: retexturing, text to 3D and image to 3D.

Sources: the service's pages "Retexture API", "Text to 3D API", "Image to 3D API" and "Errors" (2026-11); for credits and
fields of the newest models its own clients, github.com/meshy-dev (meshy-mcp-server, which states the price page of
2026-10-05, and meshy-cookbook, recipes 01 and 07 with measured runs of 2026-09).
"""

from __future__ import annotations

import json
import os
import re
from dataclasses import dataclass
from typing import Any

from anymesh.errors import MAX_QUOTE, SECRET, ModelError
from anymesh.finishing.web import Answer, Call, LostError, exchange
from anymesh.prompted.models.retry import TransientError

KEY, BASE = "MESHY_API_KEY", "MESHY_BASE_URL"
TASK_ID = re.compile(r"[A-Za-z0-9_-]{1,100}")
LARGEST = 1 << 29  # [bytes] limit of a result
WRITTEN = ("text/", "application/json", "application/xml")  # content types that are no model
PRICED = "2026-10-05, github.com/meshy-dev/meshy-mcp-server"  # date and source of the credits of generation


@dataclass(frozen=True)
class TaskKind:
    """Kind of paid task.

    name: with its article, as in messages; path: of its endpoint; credits: approximate price of a task (the price of a credit
    depends on the plan); type: as stated in task objects.
    """

    name: str
    path: str
    credits: int
    type: str


RETEXTURE = TaskKind("a retexture", "/openapi/v1/retexture", 10, "retexture")  # credits checked on 2026-11-21
PREVIEW = TaskKind("a text-to-3D preview", "/openapi/v2/text-to-3d", 20, "text-to-3d-preview")  # of 2026-10-05, as below
REFINE = TaskKind("a text-to-3D refinement", "/openapi/v2/text-to-3d", 10, "text-to-3d-refine")
IMAGE = TaskKind("an image-to-3D task", "/openapi/v1/image-to-3d", 30, "image-to-3d")
IMAGE_SHAPE = TaskKind("an image-to-3D task without texture", "/openapi/v1/image-to-3d", 20, "image-to-3d")


class RefusedError(ModelError):
    """Refusal of a request by the service. status: of HTTP."""

    def __init__(self, message: str, status: int) -> None:
        super().__init__(message)
        self.status = status


@dataclass(frozen=True)
class Task:
    """State of a task.

    status: PENDING, IN_PROGRESS, SUCCEEDED, FAILED, EXPIRED or CANCELED; error: message of a failure with secrets removed; url:
    of the GLB, signed, hence in no message; seed: drawn by the service.
    """

    id: str
    status: str
    progress: int
    error: str
    credits: float
    url: str | None
    seed: int | None = None

    def __repr__(self) -> str:
        return f"Task({self.id!r}, {self.status!r})"


def read_key() -> str:
    """Read the key from the environment, at each call. Raise ModelError if there is none."""
    key = os.environ.get(KEY, "").strip()
    if not key:
        raise ModelError(f"no key for meshy: set the environment variable {KEY}")
    return key


def create_task(kind: TaskKind, body: bytes, timeout: float) -> str:
    """Create a paid task and return its id. Raise LostError if it may have been created although no answer arrived."""
    made = _mapping(_call(kind, "POST", "", timeout, body)).get("result")
    if not (isinstance(made, str) and TASK_ID.fullmatch(made)):
        raise LostError("meshy: the service accepted the task without a valid id")
    return made


def get_task(kind: TaskKind, task: str, timeout: float) -> Task:
    """Return the state of a task. Raise RefusedError with status 404 if there is none of that id."""
    return _task(_mapping(_call(kind, "GET", f"/{task}", timeout)), task)


def download_glb(url: str, timeout: float) -> bytes:
    """Download a GLB. Raise TransientError for another HTTP status, which may be retried, ModelError for other content."""
    answer = exchange(Call("meshy's result", "GET", url, timeout=timeout, max_bytes=LARGEST, redirects=True))
    if answer.status != 200:
        raise TransientError(f"meshy's result: HTTP {answer.status}")
    kind, size = answer.headers.get("content-type", "").lower(), len(answer.body)
    if kind.startswith(WRITTEN):
        raise ModelError(f"meshy's result: found content of type {kind[:60]!r}, valid is a GLB")
    if answer.body[:4] != b"glTF" or int.from_bytes(answer.body[8:12], "little") != size:
        raise ModelError(f"meshy's result is not a complete GLB: {size} bytes that start with {answer.body[:12]!r}")
    return answer.body


def _call(kind: TaskKind, method: str, rest: str, timeout: float, body: bytes | None = None) -> Any:
    base = os.environ.get(BASE, "").strip().rstrip("/") or "https://api.meshy.ai"
    headers = {"Authorization": f"Bearer {read_key()}", "Content-Type": "application/json"}
    answer = exchange(Call("meshy", method, base + kind.path + rest, headers, body, timeout))
    if answer.status not in (200, 201, 202):
        raise _refusal(kind, answer)
    content = _json(answer)
    if content is None:
        raise LostError("meshy: the answer is not JSON")
    return content


def _refusal(kind: TaskKind, answer: Answer) -> ModelError:
    message, content = f"meshy: HTTP {answer.status}", _json(answer)
    if answer.status in (401, 403):  # the service's message is about the key and may contain parts of it
        return RefusedError(f"{message}, the key in {KEY} is missing or refused", answer.status)
    message += safe(_mapping(content).get("message"))
    if answer.status in (408, 425, 429, 503):
        return TransientError(message, answer.retry_after)
    if answer.status >= 500:  # a request may have been carried out despite a gateway error
        return LostError(message, answer.retry_after)
    if answer.status == 402:
        message += f"; the account has too few credits, {kind.name} takes about {kind.credits}"
    return RefusedError(message, answer.status)


def safe(words: object) -> str:
    """Return the service's message in one short line without anything that resembles a key or data; may be empty."""
    if not isinstance(words, str) or not words.strip():
        return ""
    line = " ".join(words.split()).replace(read_key(), "[removed]")
    return f", it says: {SECRET.sub('[removed]', line)[:MAX_QUOTE]}"


def _task(record: dict[str, Any], task: str) -> Task:
    progress, spent, url = record.get("progress"), record.get("consumed_credits"), _mapping(record.get("model_urls")).get("glb")
    seed = record.get("seed")
    return Task(
        id=task,
        status=str(record.get("status"))[:40],
        progress=progress if isinstance(progress, int) else 0,
        error=safe(_mapping(record.get("task_error")).get("message")),
        credits=float(spent) if isinstance(spent, int | float) else 0.0,
        url=url if isinstance(url, str) else None,
        seed=seed if isinstance(seed, int) else None,
    )


def _mapping(value: object) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}


def _json(answer: Answer) -> Any:
    try:
        return json.loads(answer.body)
    except (ValueError, RecursionError):
        return None
