"""Answers kept on disk by what was asked, so that the same question is paid once."""

from __future__ import annotations

import hashlib
import json
import logging
import os
import sys
import tempfile
from pathlib import Path
from typing import Any

from anymesh.models.vision import Reply, Request, VisionModel

log = logging.getLogger("anymesh")
FORMAT = "anymesh-answer-1"  # in the key, so that a change of what is sent forgets the old answers


def request_key(model_name: str, request: Request) -> str:
    """SHA-256 over all that changes the answer: the model, the words, the schema, the pictures and the most tokens.

    The question's kind does not: it is for people who read.
    """
    pictures = [[picture.caption, hashlib.sha256(picture.png).hexdigest()] for picture in request.pictures]
    parts = [FORMAT, model_name, request.system, request.text, request.schema, pictures, request.max_tokens]
    return hashlib.sha256(json.dumps(parts, sort_keys=True, default=dict).encode()).hexdigest()


def cache_folder(kind: str = "answers") -> Path:
    """Where a kind of thing is kept, in $ANYMESH_CACHE or where this system's programs keep what they can do without.

    Not created.
    """
    if own := os.environ.get("ANYMESH_CACHE"):
        return Path(own) / kind
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or str(Path.home() / "AppData" / "Local")
    elif sys.platform == "darwin":
        base = str(Path.home() / "Library" / "Caches")
    else:
        base = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    return Path(base) / "anymesh" / kind


class Cached:
    """Answers from `folder` where it can, else from the model, and keeps that: one file per question.

    A hit costs nothing; its tokens are those of the first time. Kept is only an answer that is a JSON object: an empty,
    refused or truncated one must not be the answer for ever. A file that cannot be read is as good as none, and processes
    may share the folder: a file appears whole or not at all.
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
        except OSError as error:  # a full disk must not lose an answer that is paid
            log.warning("the answer to %r is not kept in %s: %s", kind, self._folder, error.strerror)


def read_answer(path: Path) -> dict[str, Any] | None:
    """The record of one answer, of the cache or of a transcript; None when it is missing or not one."""
    try:
        found = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return None
    wanted = {"kind": str, "key": str, "model": str, "answer": str, "input_tokens": int, "output_tokens": int}
    if not isinstance(found, dict) or not all(isinstance(found.get(name), kind) for name, kind in wanted.items()):
        return None
    return found


def kept_reply(kept: dict[str, Any]) -> Reply:
    """A record as the reply that it is now."""
    return Reply(kept["answer"], kept["model"], kept["input_tokens"], kept["output_tokens"], cost=0.0, cached=True)


def write_whole(path: Path, content: bytes) -> None:
    """Writes a file so that others see it whole or not at all."""
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.stem[:20]}-", suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        Path(temporary).replace(path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def _is_object(text: str) -> bool:
    try:
        return isinstance(json.loads(text), dict)
    except (ValueError, RecursionError):
        return False
