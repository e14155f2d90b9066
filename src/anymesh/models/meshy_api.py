"""The wire format of Meshy's retexture service (its pages "Retexture API" and "Errors", 2026-11)."""

from __future__ import annotations

import json
import os
import re
from dataclasses import dataclass
from typing import Any

from anymesh.errors import ModelError
from anymesh.models.error_redaction import LONGEST, SECRET
from anymesh.models.retry import TransientError
from anymesh.models.web import Answer, Call, LostError, exchange

KEY, BASE = "MESHY_API_KEY", "MESHY_BASE_URL"
PATH = "/openapi/v1/retexture"
CREDITS = 10  # a task takes, checked on 2026-11-21; what a credit costs depends on the plan
TASK_ID = re.compile(r"[A-Za-z0-9_-]{1,100}")
LARGEST = 1 << 29  # [bytes] of a result
WRITTEN = ("text/", "application/json", "application/xml")  # types of answers that are no model


class RefusedError(ModelError):
    """The service says no. status: of HTTP."""

    def __init__(self, message: str, status: int) -> None:
        super().__init__(message)
        self.status = status


@dataclass(frozen=True)
class Task:
    """status: PENDING, IN_PROGRESS, SUCCEEDED, FAILED, EXPIRED or CANCELED; error: what the service says of a failure, made
    safe; url: of the GLB, signed, so it is in no message."""

    id: str
    status: str
    progress: int
    prompt: str
    error: str
    credits: float
    url: str | None

    def __repr__(self) -> str:
        return f"Task({self.id!r}, {self.status!r})"


def read_key() -> str:
    """From the environment, at each call. Raises ModelError when there is none."""
    found = os.environ.get(KEY, "").strip()
    if not found:
        raise ModelError(f"no key for meshy: set the environment variable {KEY}")
    return found


def create_task(body: bytes, timeout: float) -> str:
    """The id of a new, paid task. Raises LostError where it may have been made though no answer came."""
    made = _said(_call("POST", "", timeout, body)).get("result")
    if not (isinstance(made, str) and TASK_ID.fullmatch(made)):
        raise LostError("meshy: the service took the task and named no valid id")
    return made


def get_task(task: str, timeout: float) -> Task:
    """How it stands with a task. Raises RefusedError with status 404 where there is none of that id."""
    return _task(_said(_call("GET", f"/{task}", timeout)), task)


def list_tasks(timeout: float) -> list[Task]:
    """The latest tasks, the newest first."""
    told = _call("GET", "?page_num=1&page_size=50&sort_by=-created_at", timeout)
    rows = [row for row in told if isinstance(row, dict)] if isinstance(told, list) else []
    return [_task(row, row["id"]) for row in rows if TASK_ID.fullmatch(str(row.get("id")))]


def download_glb(url: str, timeout: float) -> bytes:
    """The bytes of a whole GLB. Raises TransientError for an answer that may become one, ModelError for another content."""
    answer = exchange(Call("meshy's result", "GET", url, timeout=timeout, max_bytes=LARGEST, redirects=True))
    if answer.status != 200:
        raise TransientError(f"meshy's result: HTTP {answer.status}")
    kind, size = answer.headers.get("content-type", "").lower(), len(answer.body)
    if kind.startswith(WRITTEN):
        raise ModelError(f"meshy's result: found content of type {kind[:60]!r}, valid is a GLB")
    if answer.body[:4] != b"glTF" or int.from_bytes(answer.body[8:12], "little") != size:
        raise ModelError(f"meshy's result is no whole GLB: {size} bytes that start with {answer.body[:12]!r}")
    return answer.body


def _call(method: str, rest: str, timeout: float, body: bytes | None = None) -> Any:
    base = os.environ.get(BASE, "").strip().rstrip("/") or "https://api.meshy.ai"
    headers = {"Authorization": f"Bearer {read_key()}", "Content-Type": "application/json"}
    answer = exchange(Call("meshy", method, base + PATH + rest, headers, body, timeout))
    if answer.status not in (200, 201, 202):
        raise _refusal(answer)
    told = _json(answer)
    if told is None:
        raise LostError("meshy: the answer is no JSON")
    return told


def _refusal(answer: Answer) -> ModelError:
    message, told = f"meshy: HTTP {answer.status}", _json(answer)
    if answer.status in (401, 403):  # its words are about the key, and may hold parts of it
        return RefusedError(f"{message}, the key in {KEY} is missing or refused", answer.status)
    message += safe(_said(told).get("message"))
    if answer.status in (408, 425, 429, 503):
        return TransientError(message, answer.retry_after)
    if answer.status >= 500:  # behind a gateway it may have been carried out all the same
        return LostError(message, answer.retry_after)
    if answer.status == 402:
        message += f"; the account has too few credits, a retexture takes about {CREDITS}"
    return RefusedError(message, answer.status)


def safe(words: object) -> str:
    """What the service said, in one short line without anything that looks like a key or like data; may be empty."""
    if not isinstance(words, str) or not words.strip():
        return ""
    line = " ".join(words.split()).replace(read_key(), "[removed]")
    return f", it says: {SECRET.sub('[removed]', line)[:LONGEST]}"


def _task(told: dict[str, Any], task: str) -> Task:
    progress, spent, url = told.get("progress"), told.get("consumed_credits"), _said(told.get("model_urls")).get("glb")
    return Task(
        id=task,
        status=str(told.get("status"))[:40],
        progress=progress if isinstance(progress, int) else 0,
        prompt=str(told.get("text_style_prompt", "")),
        error=safe(_said(told.get("task_error")).get("message")),
        credits=float(spent) if isinstance(spent, int | float) else 0.0,
        url=url if isinstance(url, str) else None,
    )


def _said(value: object) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}


def _json(answer: Answer) -> Any:
    try:
        return json.loads(answer.body)
    except (ValueError, RecursionError):
        return None
