"""Answers from a recording: the folder of a transcript or a cache, or questions answered in files."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any

from anymesh.errors import ModelError, OptionError
from anymesh.prompted.answerers.question_files import NAME, QuestionFolder, find_questions
from anymesh.prompted.models.cache import kept_reply, read_answer, request_key
from anymesh.prompted.models.vision import Reply, Request


class Replay:
    """Model that returns the recorded answer of each question, without network, key or cost.

    `name` is the recorded model's name, since it is part of the keys; of several models, the one with most answers. If a
    question was recorded more than once, the first answer is used. Raise OptionError if the folder holds no answers.
    """

    def __init__(self, folder: Path) -> None:
        if not folder.is_dir():
            raise OptionError(f"no recording to replay: {folder} is not a folder")
        records = [record for path in sorted(folder.glob("*.json")) if (record := read_answer(path)) is not None]
        records += [_answered(question, text) for question in find_questions(folder) if (text := question.answer()) is not None]
        if not records:
            raise OptionError(
                f"no recording to replay: {folder} holds no recorded answer (NNN_KIND.json, KEY.json, or answered questions)"
            )
        self._folder = folder
        self._records = {record["key"]: record for record in reversed(records)}
        self._names = [name for name, _ in Counter(record["model"] for record in records).most_common()]
        self.name: str = self._names[0]

    def ask(self, request: Request) -> Reply:
        """Return the recorded reply. Raise ModelError if the question was not recorded."""
        for name in self._names:
            if (record := self._records.get(request_key(name, request))) is not None:
                return kept_reply(record)
        raise ModelError(
            f"the recording {self._folder} has no answer to this {request.kind!r} question: the input, the options or the "
            "version differ from those of the recording; record again"
        )


def _answered(question: QuestionFolder, answer: str) -> dict[str, Any]:
    """Convert an answered question's folder to the record of a transcript."""
    record = {"kind": question.kind, "key": question.key, "model": NAME, "answer": answer}
    return {**record, "input_tokens": 0, "output_tokens": 0}
