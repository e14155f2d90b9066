"""The questions about one object, as numbered folders in its own folder: see `question_files`."""

from __future__ import annotations

import json
import os
import re
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path

from anymesh.errors import OptionError
from anymesh.prompted.answerers.question_files import (
    FORMAT,
    NAME,
    OWNER,
    QUESTION,
    SCHEMA,
    QuestionFolder,
    find_questions,
    read_question,
    writing,
)
from anymesh.prompted.models.cache import request_key
from anymesh.prompted.models.vision import Request
from anymesh.runtime import write_whole


class QuestionStore:
    """The questions about one object, in their own folder. Nothing is written before the first question.

    about: name of the object, None if it is not checked. Raise OptionError if the folder holds the questions of other objects.
    """

    def __init__(self, folder: Path, about: str | None = None) -> None:
        self.folder = Path(folder)
        if self.folder.exists() and not self.folder.is_dir():
            raise OptionError(f"files:{folder}: this is a file; questions need a folder")
        self._about = about
        owner = self.owner()
        if None not in (about, owner) and about != owner:
            raise OptionError(
                f"files:{folder} holds the questions about {owner!r}, and this run is about {about!r}; give each object a "
                "folder of its own, or take several meshes with --batch"
            )
        if owner is None and any(q.path.parent != self.folder for q in find_questions(self.folder)):
            raise OptionError(f"files:{folder} holds the questions of several objects (--batch); name another folder")

    def owner(self) -> str | None:
        """Return the name of the object that the questions are about; None if it is not recorded."""
        try:
            name = json.loads((self.folder / OWNER).read_bytes())["object"]
        except (OSError, ValueError, KeyError, TypeError):
            return None
        return name if isinstance(name, str) else None

    def questions(self) -> Iterator[QuestionFolder]:
        """Iterate over the questions in the order of their numbers."""
        paths = sorted(self.folder.iterdir()) if self.folder.is_dir() else []
        return (q for p in paths if not p.name.startswith(".") and (q := read_question(p)) is not None)

    def find(self, key: str) -> QuestionFolder | None:
        """Return the question with this key; None if there is none."""
        return next((q for q in self.questions() if q.key == key), None)

    def put(self, request: Request, files: Mapping[str, bytes]) -> QuestionFolder:
        """Return the folder of a question, writing it if needed; mark other unanswered questions as outdated.

        files: further files of the folder, by name. Raise OutputError if the folder cannot be written.
        """
        key = request_key(NAME, request)
        question = self.find(key)
        with writing(self.folder):
            if question is None:
                question = self._write(key, request, files)
        for other in list(self.questions()):
            if other.key != key and (other.answer() is None or other.refusal() is not None):
                other.mark(outdated=True)
        return question.mark(outdated=False)

    def _write(self, key: str, request: Request, files: Mapping[str, bytes]) -> QuestionFolder:
        self.folder.mkdir(parents=True, exist_ok=True)
        if self._about is not None and self.owner() is None:
            write_whole(self.folder / OWNER, json.dumps({"object": self._about}).encode())
        record = {
            "format": FORMAT,
            "key": key,
            "kind": request.kind,
            "system": request.system,
            "text": request.text,
            "pictures": [{"file": f"{k:02d}.png", "caption": p.caption} for k, p in enumerate(request.pictures, 1)],
            "schema": dict(request.schema),
        }
        hidden = Path(tempfile.mkdtemp(dir=self.folder, prefix=".question-"))
        try:
            hidden.chmod(0o777 & ~_umask())
            for name, picture in zip((p["file"] for p in record["pictures"]), request.pictures, strict=True):
                (hidden / name).write_bytes(picture.png)
            (hidden / SCHEMA).write_text(json.dumps(record["schema"], indent=2) + "\n")
            (hidden / QUESTION).write_text(json.dumps(record, indent=1))
            for name, content in files.items():
                (hidden / name).write_bytes(content)
            kind = re.sub(r"[^a-z0-9]+", "-", request.kind.lower()).strip("-") or "question"
            path = _move(hidden, self.folder, kind)
        except BaseException:
            shutil.rmtree(hidden, ignore_errors=True)
            raise
        return QuestionFolder(path, record)


def _move(hidden: Path, folder: Path, kind: str) -> Path:
    """Rename a finished folder to the next free number."""
    while True:
        taken = [int(m[0]) for p in folder.iterdir() if (m := re.match(r"\d+(?=-)", p.name))]
        path = folder / f"{max(taken, default=0) + 1:02d}-{kind}"
        try:
            return hidden.rename(path)
        except OSError:
            if not path.exists():
                raise


def _umask() -> int:
    umask = os.umask(0o022)
    os.umask(umask)
    return umask
