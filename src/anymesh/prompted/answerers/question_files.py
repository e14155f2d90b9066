"""Questions as folders of files, which a person, a coding agent or a script may answer.

FOLDER/NN-kind/ holds question.md, sheet.png (all pictures), 01.png and so on, schema.json and question.json. The answer is
written to answer.json beside them, and errors in it are reported in refused.md.
A question is identified by its key, which depends on its words and the bytes of its pictures, not by its number.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from threading import Event
from typing import Any
from weakref import WeakValueDictionary, finalize

from anymesh.errors import OptionError, OutputError
from anymesh.pipeline.atomic_folder import locked
from anymesh.prompted.models.vision import Request, request_key
from anymesh.prompted.pictures.sheet import nearly_equal
from anymesh.runtime import write_whole, writing
from anymesh.types.exchange import Picture

NAME = "files"  # model name in keys and transcripts, the same for every folder
FORMAT = "anymesh-question-1"
QUESTION, ANSWER, REFUSED, SCHEMA, WORDS = "question.json", "answer.json", "refused.md", "schema.json", "question.md"
SHEET, CHECK, OWNER, SUGGESTION, EARLIER = "sheet.png", "check.npz", "object.json", "suggestion.json", "earlier.json"
LEAVE = "geometry"  # an answer.json with this word leaves the question to geometry
LEFT = f"left to {LEAVE}"  # verdict on such a question
LARGEST_ANSWER = 1_000_000  # [bytes]
POLL = 0.1  # [s] interval between checks for an answer
TRIES = 5  # to occupy a folder
MAX_WAIT = 12 * 3600.0  # [s] after which a run no longer waits, so that none is forgotten; an estimate
OCCUPIED = "another run waits for answers in {}; answer its question there, or end that run first"
TYPE_WORDS = {"integer": "a whole number", "number": "a number", "string": "text", "boolean": "true or false"}


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
        return self._text(SUGGESTION)

    def write_suggestion(self, text: str) -> None:
        """Write the answer suggested by geometry."""
        with writing(self.path):
            write_whole(self.path / SUGGESTION, text.encode())

    def earlier(self) -> str | None:
        """Read the answer that was taken back; None if there is none."""
        return self._text(EARLIER)

    def write_earlier(self, text: str) -> None:
        """Write an answer that is filled in when the question is asked again."""
        with writing(self.path):
            write_whole(self.path / EARLIER, text.encode())

    def take_back(self) -> None:
        """Open the question again, and keep its answer as the earlier one unless it was left to geometry."""
        answer = self.answer()
        if answer is not None and not is_left_to_geometry(answer):
            self.write_earlier(answer)
        (self.path / ANSWER).unlink(missing_ok=True)
        self.accept()

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
        return self._text(REFUSED)

    def _text(self, name: str) -> str | None:
        try:
            return (self.path / name).read_text(encoding="utf-8")
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


def wait_for_answer(question: QuestionFolder, seen: str | None, stop: Event) -> str | None:
    """Wait for an answer.json that differs from `seen`.

    Return None once `stop` is set, the question is removed, or MAX_WAIT has passed.
    """
    end = time.monotonic() + MAX_WAIT
    while not stop.wait(POLL) and time.monotonic() < end and question.path.is_dir():
        answer = question.answer()
        if answer is not None and answer != seen:
            return answer
    return None


_OCCUPIED: WeakValueDictionary[Path, QuestionStore] = WeakValueDictionary()  # folders in which this process waits


def is_occupied(folder: Path) -> bool:
    """Return whether another process waits for answers in the folder of an object's questions."""
    if folder.resolve() in _OCCUPIED or not folder.is_dir():
        return False
    with locked(folder) as free:
        return not free


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

    def occupy(self) -> None:
        """Lock the folder until this store is gone: a run waits here. Raise OptionError if another process holds the lock."""
        place, stack = self.folder.resolve(), ExitStack()
        if place in _OCCUPIED:
            return
        for _ in range(TRIES):  # `is_occupied` of another process holds the lock for a moment
            if stack.enter_context(locked(place)):
                _OCCUPIED[place] = self
                finalize(self, stack.close)
                return
            stack.close()
            time.sleep(POLL)
        raise OptionError(OCCUPIED.format(f"files:{self.folder}"))

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
                if (like := next((q for q in self.questions() if q.key != key and _alike(q, question)), None)) is not None:
                    question.write_answer(like.answer() or "")
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


def _alike(answered: QuestionFolder, question: QuestionFolder) -> bool:
    """Return whether an answered question is the same but for rounding in its pictures, as of an object in another size."""
    text = answered.answer()
    names = ("kind", "system", "text", "schema", "pictures")
    if text is None or is_left_to_geometry(text) or any(answered.record[n] != question.record[n] for n in names):
        return False
    return all(nearly_equal(a.png, b.png) for a, b in zip(answered.pictures(), question.pictures(), strict=True))


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


def question_page(request: Request) -> str:
    """Return the content of question.md."""
    captions = [p.caption.removeprefix(f"picture {k}: ") for k, p in enumerate(request.pictures, 1)]
    pictures = "\n".join(
        f"{k}. {caption or 'picture'}\n\n   ![{_plain(caption)}]({k:02d}.png)\n" for k, caption in enumerate(captions, 1)
    )
    sheet = f"All of them on one sheet: ![contact sheet]({SHEET})\n\n" if request.pictures else ""
    return (
        f"# Question: {request.kind}\n\n{request.system}\n\n{request.text}\n\n## Pictures\n\n{sheet}{pictures}\n"
        f"## Answer\n\nWrite `{ANSWER}` into this folder: one JSON object with\n\n{explain_schema(request.schema)}\n\n"
        f"For example, in form only:\n\n```json\n{json.dumps(example_answer(request.schema))}\n```\n\n"
        f"`{SCHEMA}` is its JSON schema. The word `{LEAVE}` alone leaves the question to geometry. "
        "`anymesh answer FOLDER VALUE` writes and checks an answer at once. If an answer is not valid, "
        f"`{REFUSED}` says why, and the question stays open.\n"
    )


def explain_schema(schema: Mapping[str, Any], depth: int = 0) -> str:
    """Describe the properties of an object schema as a Markdown list."""
    lines = []
    for name, part in schema["properties"].items():
        lines.append(f"{'  ' * depth}- `{name}`: {_describe(part)}")
        inner = part["items"] if part["type"] == "array" else part
        if inner["type"] == "object":
            lines.append(explain_schema(inner, depth + 1))
    return "\n".join(lines)


def _describe(schema: Mapping[str, Any]) -> str:
    meaning = f" ({schema['description']})" if "description" in schema else ""
    if schema["type"] == "array":
        inner = schema["items"]
        return f"a list of objects with{meaning}" if inner["type"] == "object" else f"a list, each {_describe(inner)}{meaning}"
    if schema["type"] == "object":
        return f"an object with{meaning}"
    if "enum" in schema:
        return f"one of {', '.join(f'`{value}`' for value in schema['enum'])}{meaning}"
    return TYPE_WORDS[schema["type"]] + meaning


def example_answer(schema: Mapping[str, Any]) -> Any:
    """Make a value of the schema's form."""
    match schema["type"]:
        case "object":
            return {name: example_answer(part) for name, part in schema["properties"].items()}
        case "array":
            return [example_answer(schema["items"])]
        case "string":
            return schema["enum"][0] if "enum" in schema else "..."
        case "boolean":
            return False
        case kind:
            return 1 if kind == "integer" else 1.0


def _plain(caption: str) -> str:
    return " ".join(caption.replace("[", "(").replace("]", ")").split())
