"""Listing and answering of open questions in folders, for `anymesh answer` and the tools of agents."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from anymesh.errors import OptionError
from anymesh.prompted.answerers.file_answerer import check_answer, open_questions
from anymesh.prompted.answerers.question_files import QuestionFolder, find_questions, is_left_to_geometry
from anymesh.prompted.questions.asking import BadAnswerError
from anymesh.prompted.questions.shorthand import answer_text


@dataclass(frozen=True)
class Recorded:
    """A recorded answer. whole: checked by the question itself, not only by its schema; left: number of open questions."""

    question: QuestionFolder
    whole: bool
    left: int

    def words(self) -> str:
        """Return the message for the user."""
        rest = "" if self.whole else " (by its schema; the run checks the rest)"
        more = f"; {self.left} more open" if self.left else "; run the command that asked again to resume"
        return f"{self.question.path.name}: the answer is valid{rest}{more}"


def open_in(folder: Path) -> list[QuestionFolder]:
    """Find the open questions in a folder of one question, one object, or many objects.

    Raise OptionError if there is no question at all, open or answered.
    """
    questions = find_questions(folder)
    if not questions:
        raise OptionError(f"{folder} has no questions; `anymesh articulate MESH -o DIR --answerer files:{folder}` creates them")
    return open_questions(questions)


def record_answer(folder: Path, answer: str) -> Recorded:
    """Check an answer (JSON, the short form, or the word geometry) to the open question in a folder, and write it.

    In the folder of a single answered question, the answer is replaced. Raise OptionError if the answer is not valid, and is
    then not written, or if no question or several are open.
    """
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
        whole = check_answer(question, text)
    except BadAnswerError as error:
        raise OptionError(f"{question.path.name}: this is not a valid answer: {error}") from None
    question.write_answer(text)
    return Recorded(question, whole, len(open_questions(find_questions(folder))))
