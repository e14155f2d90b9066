"""Questions as folders of files, which a person, a coding agent or a script may answer.

FOLDER/NN-kind/ holds question.md, sheet.png (all pictures), 01.png and so on, schema.json and question.json. The answer is
written to answer.json beside them, and errors in it are reported in refused.md.
A question is identified by its key, which depends on its words and the bytes of its pictures, not by its number.
"""

from __future__ import annotations

import json
from collections.abc import Generator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from threading import Event
from typing import Any

from anymesh.errors import OutputError
from anymesh.runtime import write_whole
from anymesh.types.exchange import Picture

NAME = "files"  # model name in keys and transcripts, the same for every folder
FORMAT = "anymesh-question-1"
QUESTION, ANSWER, REFUSED, SCHEMA, WORDS = "question.json", "answer.json", "refused.md", "schema.json", "question.md"
SHEET, CHECK, OWNER, SUGGESTION = "sheet.png", "check.npz", "object.json", "suggestion.json"
LEAVE = "geometry"  # an answer.json with this word leaves the question to geometry
LEFT = f"left to {LEAVE}"  # verdict on such a question
LARGEST_ANSWER = 1_000_000  # [bytes]


def is_left_to_geometry(text: str) -> bool:
    """Return whether an answer leaves its question to geometry."""
    return text.strip().strip('"') == LEAVE


@dataclass(frozen=True)
class QuestionFolder:
    """One question as files. `record` is the content of its question.json."""

    path: Path
    record: Mapping[str, Any]

    @property
    def key(self) -> str:
        return str(self.record["key"])

    @property
    def kind(self) -> str:
        return str(self.record["kind"])

    @property
    def outdated(self) -> bool:
        """Whether a later run asked another question in its place."""
        return bool(self.record.get("outdated"))

    @property
    def schema(self) -> dict[str, Any]:
        return dict(self.record["schema"])

    def pictures(self) -> tuple[Picture, ...]:
        """Read the pictures. Raise OutputError if one is missing."""
        try:
            return tuple(Picture((self.path / p["file"]).read_bytes(), p["caption"]) for p in self.record["pictures"])
        except (OSError, ValueError) as error:
            raise OutputError(f"{self.path} lacks pictures of its question; run the command that asked it again") from error

    def answer(self) -> str | None:
        """Read answer.json unparsed; None if there is none, or if it is empty because it is still being written."""
        path = self.path / ANSWER
        try:
            if path.stat().st_size > LARGEST_ANSWER:
                return f"({path.stat().st_size} bytes, more than an answer may have)"
            return path.read_text(encoding="utf-8-sig", errors="replace").strip() or None
        except OSError:
            return None

    def write_answer(self, text: str) -> None:
        """Write answer.json, and remove the refusal of an earlier answer."""
        with writing(self.path):
            write_whole(self.path / ANSWER, (text + "\n").encode())
        self.accept()

    def suggestion(self) -> str | None:
        """Read the answer suggested by geometry; None if there is none."""
        try:
            return (self.path / SUGGESTION).read_text(encoding="utf-8")
        except OSError:
            return None

    def write_suggestion(self, text: str) -> None:
        """Write the answer suggested by geometry."""
        with writing(self.path):
            write_whole(self.path / SUGGESTION, text.encode())

    def refuse(self, reason: str) -> None:
        """Write the reason why the answer is not valid to refused.md."""
        text = (
            f"# Refused\n\n{ANSWER} is not a valid answer: {reason}\n\nThe question stays open: correct {ANSWER}; "
            f"{WORDS} says what is asked, {SCHEMA} what it must satisfy.\n"
        )
        if self.refusal() != text:
            with writing(self.path):
                write_whole(self.path / REFUSED, text.encode(errors="backslashreplace"))

    def refusal(self) -> str | None:
        """Read why the answer was refused; None if it was not."""
        try:
            return (self.path / REFUSED).read_text(encoding="utf-8")
        except OSError:
            return None

    def accept(self) -> None:
        """Remove an earlier refusal."""
        (self.path / REFUSED).unlink(missing_ok=True)

    def mark(self, *, outdated: bool) -> QuestionFolder:
        """Record whether the question is still open."""
        if self.outdated == outdated:
            return self
        record = {**self.record, "outdated": outdated}
        with writing(self.path):
            write_whole(self.path / QUESTION, json.dumps(record, indent=1).encode())
        return QuestionFolder(self.path, record)


def read_question(path: Path) -> QuestionFolder | None:
    """Read the folder of one question; None if it is not one."""
    try:
        record = json.loads((path / QUESTION).read_bytes())
    except (OSError, ValueError, RecursionError):
        return None
    wanted = {"key": str, "kind": str, "text": str, "system": str, "schema": dict, "pictures": list}
    if not isinstance(record, dict) or record.get("format") != FORMAT:
        return None
    return QuestionFolder(path, record) if all(isinstance(record.get(n), k) for n, k in wanted.items()) else None


def find_questions(folder: Path) -> list[QuestionFolder]:
    """Find all questions in a folder, which may be that of a question, of an object, or of many objects."""
    questions = (read_question(path.parent) for path in sorted(folder.rglob(QUESTION)))
    return [q for q in questions if q is not None and not q.path.name.startswith(".")]


@contextmanager
def writing(folder: Path) -> Generator[None]:
    """Convert file errors to OutputError."""
    try:
        yield
    except OSError as error:
        raise OutputError(f"cannot write the question to {folder}: {error.strerror or error}") from error


def wait_for_answer(question: QuestionFolder, seen: str | None, every: float, stop: Event | None = None) -> str | None:
    """Wait for an answer.json that differs from `seen`, checking every `every` [s]; return None once `stop` is set."""
    pause = stop or Event()
    while not pause.wait(every):
        answer = question.answer()
        if answer is not None and answer != seen:
            return answer
    return None
