"""Answers in files: reading, checking and writing them, also in a short form.

The short form is `1=2 2=0` for a question whose answer is a list with one entry per part. An entry is NAME=VALUE,VALUE,... The
name is the entry's first number or choice (a part's number, or a label). The values fill the other properties in their order. A
list takes all values of its kind. A boolean is false unless its name is given. Missing text is empty, and properties in USUAL
have a usual value. After a name, `#2` gives a second number (`door#2=5,7` with an `instance`).
"""

from __future__ import annotations

import json
import re
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext, suppress
from dataclasses import dataclass
from pathlib import Path
from threading import Event, Thread
from typing import Any

from anymesh.errors import InputError, OpenQuestionError, OptionError, OutputError
from anymesh.prompted.answerers.question_files import (
    ANSWER,
    CHECK,
    LEFT,
    NAME,
    POLL,
    REFUSED,
    SHEET,
    WORDS,
    QuestionFolder,
    QuestionStore,
    find_questions,
    is_left_to_geometry,
    is_occupied,
    question_page,
    wait_for_answer,
)
from anymesh.prompted.answerers.vlm_answerer import exchange_of, request_of
from anymesh.prompted.models.vision import Reply, Request
from anymesh.prompted.pictures.sheet import question_sheet
from anymesh.prompted.questions.asking import BadAnswerError, reply_object
from anymesh.prompted.questions.saved_question import answer_object, pack_question, unpack_question
from anymesh.types import Exchange
from anymesh.types.questions import Answer, Question, VisualAnswerer

ASSIGNMENT = re.compile(r"([^=\s#][^=#]*?)(?:#(-?\d+))?=([^=\s]*)(?=\s|$)")
Schema = Mapping[str, Any]
FOLLOW = 120.0  # [s] to wait for the next question of a run; an estimate
USUAL = {"instance": 1, "part_is": "right", "with": 0}  # values of properties that need not be given


def answer_text(text: str, schema: Schema) -> str:
    """Convert a user's input to the JSON of an answer; JSON is returned unchanged.

    Raise OptionError if the input is not valid.
    """
    text = text.strip()
    if text.startswith(("{", "[", '"')) or not ASSIGNMENT.match(text):
        return text
    lists = [n for n, part in schema["properties"].items() if part["type"] == "array" and part["items"]["type"] == "object"]
    if len(lists) != 1:
        raise OptionError(f"this question takes a JSON object with {list(schema['properties'])}, not the short form")
    items = schema["properties"][lists[0]]["items"]
    rest = ASSIGNMENT.sub("", text).strip()
    if rest:
        raise OptionError(f"the short form is NAME=VALUE,VALUE ..., found {rest[:40]!r} besides")
    answer: dict[str, Any] = {name: _blank(name, part) for name, part in schema["properties"].items() if name != lists[0]}
    answer[lists[0]] = [_assignment(*match.groups(), items) for match in ASSIGNMENT.finditer(text)]
    return json.dumps({name: answer[name] for name in schema["properties"]})


def _assignment(name: str, number: str | None, text: str, items: Schema) -> dict[str, Any]:
    properties = dict(items["properties"])
    named = (item for item in properties.items() if item[1]["type"] == "integer" or "enum" in item[1] or item[0] == "label")
    first, part = next(named, next(iter(properties.items())))  # explanatory text may come before
    entry = {first: _value(name.strip(), part, first)}
    del properties[first]
    integers = [n for n, p in properties.items() if p["type"] == "integer"]
    if number is not None:
        if not integers:
            raise OptionError(f"{name}#{number}: an entry of this question has no second number")
        entry[integers[0]] = int(number)
        del properties[integers[0]]
    values = [v for v in text.split(",") if v]
    for key, part in properties.items():
        entry[key] = _take(key, part, values, defaults=any(p["type"] == "array" for p in properties.values()))
    if values:
        raise OptionError(f"{name}: found {values} besides what {list(items['properties'])} take")
    return {key: entry[key] for key in items["properties"]}


def _take(name: str, schema: Schema, values: list[str], *, defaults: bool) -> Any:
    """Take from the values those of a property.

    defaults: plain numbers go to a list, so that other properties get 0 or 1.
    """
    match schema["type"]:
        case "boolean":
            if name in values:
                values.remove(name)
                return True
            return False
        case "array":
            fitting = [v for v in values if _fits(v, schema["items"])]
            values[:] = [v for v in values if v not in fitting]
            return [_value(v, schema["items"], name) for v in fitting]
        case "string" if "enum" not in schema:
            return ""
        case kind:
            if defaults and kind in ("integer", "number"):
                return USUAL.get(name, 0)
            fitting = next((v for v in values if _fits(v, schema)), None)
            if fitting is None:
                return _blank(name, schema)
            values.remove(fitting)
            return _value(fitting, schema, name)


def _fits(text: str, schema: Schema) -> bool:
    if "enum" in schema:
        return text in schema["enum"]
    pattern = {"integer": r"-?\d+", "number": r"-?\d+(\.\d+)?"}.get(schema["type"], r".*")
    return re.fullmatch(pattern, text) is not None


def _value(text: str, schema: Schema, name: str) -> Any:
    if not _fits(text, schema):
        valid = f"one of {', '.join(schema['enum'])}" if "enum" in schema else f"of type {schema['type']}"
        raise OptionError(f"{name} must be {valid}, found {text[:40]!r}")
    return int(text) if schema["type"] == "integer" else float(text) if schema["type"] == "number" else text


def _blank(name: str, schema: Schema) -> Any:
    match schema["type"]:
        case _ if name in USUAL:
            return USUAL[name]
        case "string" if "enum" not in schema:
            return ""
        case "boolean":
            return False
        case "array":
            return []
        case _:
            raise OptionError(f"the short form lacks {name}; give it, or answer in JSON")


class FileAnswerer:
    """Answerer that reads answers from folders of files.

    wait: wait for a missing answer, with all state in memory, instead of raising OpenQuestionError; paused: context entered
    while waiting, so that a time limit does not count it; stop: ends all waiting; suggest: write the fallback's answer beside
    each question that is waited for, by a thread, so that the run goes on at once when the answer comes first; one: each
    question has one picture, otherwise as many as there are, and a sheet of them.
    """

    warnings: tuple[str, ...] = ()

    def __init__(
        self,
        store: QuestionStore,
        fallback: VisualAnswerer,
        *,
        wait: bool = False,
        paused: Callable[[], AbstractContextManager[None]] = nullcontext,
        stop: Event | None = None,
        suggest: bool = False,
        one: bool = False,
    ) -> None:
        self.name, self._suggest, self._most = NAME, suggest, 1 if one else None
        self._store, self._fallback, self._wait, self._paused = store, fallback, wait, paused
        self._stop = stop or Event()
        self._exchanges: list[Exchange] = []

    @property
    def exchanges(self) -> tuple[Exchange, ...]:
        return tuple(self._exchanges)

    def ask(self, question: Question[Answer]) -> Answer:
        """Return the answer in the question's folder.

        Raise OpenQuestionError if there is no valid answer yet, OutputError if the folder cannot be written.
        """
        request = request_of(question, self._most)
        folder = self._store.put(request, _files(request, question))
        begin, text = time.monotonic(), folder.answer()
        while True:
            if text is not None:
                try:
                    return self._accept(question, request, folder, text, time.monotonic() - begin)
                except BadAnswerError as error:
                    folder.refuse(str(error))
            if not self._wait:
                raise _open(folder)
            self._store.occupy()
            if self._suggest and folder.suggestion() is None:
                Thread(target=self._suggested, args=(question, folder), daemon=True).start()
            with self._paused():
                text = wait_for_answer(folder, text, self._stop)
            if text is None:
                raise _open(folder)

    def _suggested(self, question: Question[Answer], folder: QuestionFolder) -> None:
        text = json.dumps(answer_object(question, self._fallback.ask(question)))
        with suppress(OutputError):  # the folder was removed
            folder.write_suggestion(text)

    def _accept(
        self, question: Question[Answer], request: Request, folder: QuestionFolder, text: str, seconds: float
    ) -> Answer:
        left = is_left_to_geometry(text)
        answer = self._fallback.ask(question) if left else question.parse(reply_object(text, request.schema))
        folder.accept()
        reply = Reply(text, NAME, 0, 0, cost=0.0, seconds=seconds)
        self._exchanges.append(exchange_of(NAME, request, reply, LEFT if left else "accepted"))
        return answer


def check_answer(folder: QuestionFolder, text: str) -> bool:
    """Check an answer by the schema and, if the question was saved completely, by the question itself.

    Return whether the question was checked. Raise BadAnswerError if the answer is not valid.
    """
    if is_left_to_geometry(text):
        return True
    answer = reply_object(text, folder.schema)
    try:
        question = unpack_question((folder.path / CHECK).read_bytes(), folder.pictures())
    except (OSError, InputError):
        return False  # from another version; the resumed run checks the rest
    question.parse(answer)
    return True


def open_questions(questions: Sequence[QuestionFolder]) -> list[QuestionFolder]:
    """Return the questions without a valid answer; a refusal is written beside an answer that is not valid."""
    return [q for q in questions if not q.outdated and not _answered(q)]


def _answered(folder: QuestionFolder) -> bool:
    text = folder.answer()
    if text is None:
        return False
    try:
        check_answer(folder, text)
    except BadAnswerError as error:
        folder.refuse(str(error))
        return False
    folder.accept()
    return True


def still_answered(store: QuestionStore, exchanges: Sequence[Exchange]) -> bool:
    """Return whether the files still hold the answers that a saved stage was made with."""
    asked = {q.key: q for q in store.questions()}
    return all(e.key in asked and asked[e.key].answer() == e.answer for e in exchanges)


def _files(request: Request, question: Question[Answer]) -> dict[str, bytes]:
    """Return the files beside question.json. Without CHECK, `check_answer` uses the schema alone."""
    files = {WORDS: question_page(request).encode()}
    with suppress(TypeError):  # a question from outside this package may hold anything
        files[CHECK] = pack_question(question)
    if request.pictures:
        files[SHEET] = (request.pictures[0] if len(request.pictures) == 1 else question_sheet(request.pictures)).png
    return files


def _open(folder: QuestionFolder) -> OpenQuestionError:
    place = folder.path.parent
    refused = f"the answer to {folder.kind!r} was refused ({folder.path / REFUSED} says why)"
    why = f"the question {folder.kind!r} is open" if folder.refusal() is None else refused
    return OpenQuestionError(
        f"{why}: read {folder.path / WORDS}, answer it by `anymesh answer {_quoted(place)} VALUE` or in {ANSWER} beside it, "
        "then run the same command again to resume",
        [folder.path],
    )


def _quoted(path: Path) -> str:
    return f"'{path}'" if " " in str(path) else str(path)


@dataclass(frozen=True)
class Recorded:
    """A recorded answer. whole: checked by the question itself, not only by its schema; left: number of open questions."""

    question: QuestionFolder
    whole: bool
    left: int

    def words(self, *, waited: bool = False) -> str:
        """Return the message for the user. waited: whether a run waits for it."""
        rest = "" if self.whole else " (by its schema; the run checks the rest)"
        resume = "" if waited else "; run the command that asked again to resume"
        more = f"; {self.left} more open" if self.left else resume
        return f"{self.question.path.name}: the answer is valid{rest}{more}"


def open_in(folder: Path) -> list[QuestionFolder]:
    """Find the open questions in a folder of one question, one object, or many objects.

    Raise OptionError if there is no question at all, open or answered.
    """
    questions = find_questions(folder)
    if not questions:
        raise OptionError(f"{folder} has no questions; `anymesh articulate MESH -o DIR --answerer files:{folder}` creates them")
    return open_questions(questions)


def record_answers(answers: Sequence[tuple[Path, str]]) -> list[Recorded]:
    """Check answers (JSON, the short form, or the word geometry), each to the open question in its folder, and write them.

    In the folder of a single answered question, the answer is replaced. Raise OptionError if an answer is not valid, or if no
    question or several are open in a folder; then nothing is written.
    """
    checked = [_checked(folder, answer) for folder, answer in answers]
    if len({question.path.resolve() for question, _, _ in checked}) < len(checked):
        raise OptionError("found two answers to one question")
    for question, text, _ in checked:
        question.write_answer(text)
    rest = [len(open_questions(find_questions(folder))) for folder, _ in answers]
    return [Recorded(question, whole, left) for (question, _, whole), left in zip(checked, rest, strict=True)]


def _checked(folder: Path, answer: str) -> tuple[QuestionFolder, str, bool]:
    """Return the question that an answer is for, the answer as JSON, and whether it was checked by the question itself."""
    waiting = open_in(folder)
    here = [q for q in find_questions(folder) if q.path == folder]
    if len(waiting) > 1:
        listed = ", ".join(str(q.path) for q in waiting[:8])
        raise OptionError(f"{len(waiting)} questions are open in {folder}; name the one to answer: {listed}")
    if not (waiting or here):
        raise OptionError(f"no question is open in {folder}; name the folder of a question to answer it again")
    question = (waiting or here)[0]
    text = answer.strip() if is_left_to_geometry(answer) else answer_text(answer, question.schema)
    try:
        return question, text, check_answer(question, text)
    except BadAnswerError as error:
        raise OptionError(f"{question.path.name}: this is not a valid answer: {error}") from None


def next_question(place: Path, seconds: float = FOLLOW) -> QuestionFolder | None:
    """Return the open question of the object whose questions are in a folder; wait for it while a run waits for answers there.

    Return None if no question is open and no run waits, or after `seconds` [s].
    """
    end = time.monotonic() + seconds
    while True:
        occupied = is_occupied(place)
        waiting = open_questions(list(QuestionStore(place).questions()))
        if waiting or not occupied or time.monotonic() > end:
            return waiting[0] if waiting else None
        time.sleep(POLL)
