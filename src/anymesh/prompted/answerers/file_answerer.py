"""Answers from files: each question is a folder, and the answer is a file in it."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext, suppress
from pathlib import Path
from threading import Event

from anymesh.errors import InputError, OpenQuestionError
from anymesh.prompted.answerers.question_files import (
    ANSWER,
    CHECK,
    LEFT,
    NAME,
    REFUSED,
    SHEET,
    WORDS,
    QuestionFolder,
    is_left_to_geometry,
    wait_for_answer,
)
from anymesh.prompted.answerers.question_store import QuestionStore
from anymesh.prompted.answerers.vlm_answerer import exchange_of, request_of
from anymesh.prompted.models.vision import Reply, Request
from anymesh.prompted.pictures.sheet import question_sheet
from anymesh.prompted.questions.answer_json import answer_object
from anymesh.prompted.questions.asking import BadAnswerError
from anymesh.prompted.questions.question_words import question_page
from anymesh.prompted.questions.reply_text import reply_object
from anymesh.prompted.questions.saved_question import pack_question, unpack_question
from anymesh.types import Exchange
from anymesh.types.questions import Answer, Question, VisualAnswerer

POLL = 1.0  # [s] interval between checks for an answer


class FileAnswerer:
    """Answerer that reads answers from folders of files.

    wait: wait for a missing answer instead of raising OpenQuestionError; paused: context entered while waiting, so that a time
    limit does not count it; stop: ends all waiting; suggest: write the fallback's answer beside each question that is waited
    for.
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
    ) -> None:
        self.name, self._suggest = NAME, suggest
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
        request = request_of(question)
        folder = self._store.put(request, _files(request, question))
        begin, text = time.monotonic(), folder.answer()
        while True:
            if text is not None:
                try:
                    return self._accept(question, request, folder, text, time.monotonic() - begin)
                except BadAnswerError as error:
                    folder.refuse(str(error))
            if not self._wait or self._stop.is_set():
                raise _open(folder)
            with self._paused():
                if self._suggest and folder.suggestion() is None:
                    folder.write_suggestion(json.dumps(answer_object(question, self._fallback.ask(question))))
                text = wait_for_answer(folder, text, POLL, self._stop)

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
        files[SHEET] = question_sheet(request.pictures).png
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
