"""An open question of a folder, with a person's current answers."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path

from anymesh.errors import InputError
from anymesh.prompted.answerers.file_answerer import check_answer
from anymesh.prompted.answerers.question_files import CHECK, LEAVE, QuestionFolder, QuestionStore
from anymesh.prompted.questions.asking import BadAnswerError
from anymesh.prompted.questions.saved_question import unpack_question
from anymesh.viewer.ask_forms import Form, form_of

WAITING = "Geometry is working out a suggestion; you need not wait for it."
SUGGESTED = "Filled in as geometry would answer; change what is wrong."


def find_open_question(folder: Path) -> QuestionFolder | None:
    """Return the question that a run waits for: the last one without an answer, or with a refused one."""
    if not folder.is_dir():
        return None
    asked = [q for q in QuestionStore(folder).questions() if not q.outdated]
    waiting = [q for q in asked if q.answer() is None or q.refusal() is not None]
    return waiting[-1] if waiting else None


@dataclass
class OpenQuestion:
    """A question with its form. note: information for the person."""

    folder: QuestionFolder
    form: Form
    note: str = field(default=WAITING)
    _suggested: bool = False

    @classmethod
    def of(cls, folder: QuestionFolder) -> OpenQuestion | None:
        """Open a question; None if it cannot be answered on the object itself."""
        try:
            question = unpack_question((folder.path / CHECK).read_bytes(), folder.pictures())
        except (OSError, InputError):
            return None
        form = form_of(question)
        if form is None:
            return None
        asked = cls(folder, form)
        asked.take_suggestion()
        refusal = folder.refusal()
        if refusal is not None:
            asked.note = " ".join(refusal.removeprefix("# Refused").split())
        return asked

    def take_suggestion(self) -> bool:
        """Fill in geometry's suggestion once available, unless the person has started; return whether it became available."""
        text = None if self._suggested else self.folder.suggestion()
        if text is None:
            return False
        self._suggested = True
        if self.form.touched:
            self.note = ""
        else:
            self.form.fill(json.loads(text))
            self.note = SUGGESTED
        return True

    def submit(self) -> str:
        """Record the answer if it is valid; return why it is not, or an empty string."""
        text = json.dumps(self.form.answer())
        try:
            check_answer(self.folder, text)
        except BadAnswerError as error:
            return str(error)
        self.folder.write_answer(text)
        return ""

    def leave(self) -> None:
        """Leave the question to geometry."""
        self.folder.write_answer(LEAVE)
