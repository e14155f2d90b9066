"""Cache of answers on disk, keyed by the request, so that the same question is paid only once."""

from __future__ import annotations

import hashlib
import json
import logging
from pathlib import Path
from typing import Any

from anymesh.prompted.models.vision import Reply, Request, VisionModel
from anymesh.runtime import write_whole

log = logging.getLogger("anymesh")
FORMAT = "anymesh-answer-1"  # part of the key; change it when the contents of requests change, to invalidate old answers


def request_key(model_name: str, request: Request) -> str:
    """Compute the SHA-256 of everything that affects the answer: model, texts, schema, pictures and token limit.

    The kind of the question is not included, since it is for readers only.
    """
    pictures = [[picture.caption, hashlib.sha256(picture.png).hexdigest()] for picture in request.pictures]
    parts = [FORMAT, model_name, request.system, request.text, request.schema, pictures, request.max_tokens]
    return hashlib.sha256(json.dumps(parts, sort_keys=True, default=dict).encode()).hexdigest()


class Cached:
    """Wrapper that returns cached answers from `folder`, or asks the model and stores its answer; one file per question.

    A hit costs nothing; its token counts are those of the original call. Only answers that are JSON objects are stored, so that
    an empty, refused or truncated answer is not repeated forever.
    Unreadable files are ignored. Processes may share the folder, since files are written atomically.
    """

    def __init__(self, model: VisionModel, folder: Path) -> None:
        self.name = model.name
        self._model, self._folder = model, folder

    def ask(self, request: Request) -> Reply:
        key = request_key(self.name, request)
        path = self._folder / f"{key}.json"
        kept = read_answer(path)
        if kept is not None and kept["key"] == key:
            return kept_reply(kept)
        reply = self._model.ask(request)
        if _is_object(reply.text):
            self._keep(path, key, request.kind, reply)
        return reply

    def _keep(self, path: Path, key: str, kind: str, reply: Reply) -> None:
        record = {
            "kind": kind,
            "key": key,
            "model": self.name,
            "answer": reply.text,
            "input_tokens": reply.input_tokens,
            "output_tokens": reply.output_tokens,
        }
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            write_whole(path, json.dumps(record, indent=1).encode())
        except OSError as error:  # a full disk must not lose an answer that is already paid
            log.warning("the answer to %r is not kept in %s: %s", kind, self._folder, error.strerror)


def read_answer(path: Path) -> dict[str, Any] | None:
    """Read the record of one answer from the cache or a transcript; None if it is missing or invalid."""
    try:
        record = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return None
    wanted = {"kind": str, "key": str, "model": str, "answer": str, "input_tokens": int, "output_tokens": int}
    if not isinstance(record, dict) or not all(isinstance(record.get(name), kind) for name, kind in wanted.items()):
        return None
    return record


def kept_reply(kept: dict[str, Any]) -> Reply:
    """Return the reply of a stored record, marked as cached and free of cost."""
    return Reply(kept["answer"], kept["model"], kept["input_tokens"], kept["output_tokens"], cost=0.0, cached=True)


def _is_object(text: str) -> bool:
    try:
        return isinstance(json.loads(text), dict)
    except (ValueError, RecursionError):
        return False
