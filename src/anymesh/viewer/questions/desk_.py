"""Questions on the live page: the open question of a folder, its panel, scene and clicks."""

from __future__ import annotations

import json
import time
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.errors import InputError
from anymesh.prompted.answerers.file_answerer import check_answer
from anymesh.prompted.answerers.question_files import CHECK, LEAVE, QuestionFolder, QuestionStore
from anymesh.prompted.questions.asking import BadAnswerError
from anymesh.prompted.questions.grounding import WhichMarks
from anymesh.prompted.questions.prompting import WhichArrows, WhichKinds, WhichMotions, WhichPoints
from anymesh.prompted.questions.recognition import Recognize, RecognizeRegions
from anymesh.prompted.questions.saved_question import unpack_question
from anymesh.types import Mesh
from anymesh.types.questions import Question
from anymesh.viewer.panels import Page
from anymesh.viewer.questions.fields_ import AskPanel, Choices, azimuth_of
from anymesh.viewer.questions.forms import SPLIT, ArrowsForm, Form, KindsForm, MarksForm, MotionsForm, PartsForm, PointsForm
from anymesh.viewer.questions.label_forms import RecognizeForm, RegionsForm
from anymesh.viewer.questions.scene_ import QuestionScene, closer_view

WAITING = "Geometry is working out a suggestion; you need not wait for it."
SUGGESTED = "Filled in as geometry would answer; change what is wrong."
AGAIN = "Filled in as you answered before; change what is wrong."


def form_of(question: Question[Any]) -> Form | None:
    """Return the empty form of a question; None if it cannot be answered on the object itself."""
    match question:
        case Recognize():
            return RecognizeForm(question)
        case RecognizeRegions():
            return RegionsForm(question)
        case WhichMarks() if question.face_mark is not None:
            return MarksForm(question, question.face_mark)
        case WhichKinds():
            return KindsForm(question)
        case WhichPoints():
            return PointsForm(question)
        case WhichArrows():
            return ArrowsForm(question)
        case WhichMotions():
            return MotionsForm(question)
    return None


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
        if not asked._take_earlier():
            asked.take_suggestion()
        refusal = folder.refusal()
        if refusal is not None:
            asked.note = " ".join(refusal.removeprefix("# Refused").split())
        return asked

    def _take_earlier(self) -> bool:
        """Fill in the answer that was taken back; return whether there is one."""
        text = self.folder.earlier()
        if text is None:
            return False
        with suppress(ValueError, TypeError, LookupError, AttributeError):
            self.form.fill(json.loads(text))
            self.note, self._suggested = AGAIN, True
        return self._suggested

    def take_marks_of(self, others: Iterable[QuestionFolder]) -> None:
        """Fill in the marks that a person gave in an earlier question about the same regions, for the labels that remain."""
        for other in reversed(list(others)):
            text, form = other.earlier(), self.form
            before = None if text is None else OpenQuestion.of(other)
            if text is None or before is None or not isinstance(form, MarksForm) or not isinstance(before.form, MarksForm):
                continue
            if np.array_equal(form.face_mark, before.form.face_mark):
                parts = [p for p in before.form.answer()["parts"] if p["label"] in form.question.labels]
                form.fill({"parts": parts, "split": sorted(before.form.groups.get(SPLIT, ()))})
                self.note, self._suggested = AGAIN, True
                return

    def keep(self) -> None:
        """Keep what a person has entered, for when the question is asked again."""
        if self.form.touched:
            self.folder.write_earlier(json.dumps(self.form.answer()))

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


class AskDesk:
    """Presents the questions of a folder to a person, one after the other; every call holds the page's lock."""

    def __init__(self, page: Page) -> None:
        self._page = page
        self._scene, self._panel = QuestionScene(page.server), AskPanel(page.gui, page.act)
        self._folder, self._mesh = Path(), None
        self._asked: OpenQuestion | None = None
        self._given: list[tuple[QuestionFolder, bool]] = []  # answered in this run, and whether by the person
        self._leave_rest, self._began = False, 0.0
        page.server.scene.on_click()(lambda event: page.act(lambda: self._clicked(event)))

    @property
    def busy(self) -> bool:
        """Whether a question is on the page."""
        return self._asked is not None

    @property
    def can_go_back(self) -> bool:
        """Whether the person has answered a question of this run."""
        return any(by_person for _, by_person in self._given)

    @property
    def mesh(self) -> Mesh | None:
        """The mesh that is drawn."""
        return self._mesh

    def begin(self, folder: Path) -> None:
        """Start with the questions that a run writes to a folder."""
        self.end()
        self._folder, self._given = folder, []

    def end(self) -> None:
        """Remove everything from the page."""
        self.stop()
        self._mesh, self._leave_rest = None, False
        self._scene.clear()

    def stop(self) -> None:
        """Close the open question, keep what was entered in it, and leave the mesh."""
        if self._asked is not None:
            self._asked.keep()
            self._asked.folder.mark(outdated=True)
            self._close()

    def restart(self) -> None:
        """Ask all questions of this run again, with the answers filled in."""
        self.stop()
        while self._given:
            self._take_back()
        self._leave_rest = False

    def go_back(self) -> None:
        """Open the last question that the person answered again; what was left to geometry after it is asked again."""
        self.stop()
        while self.can_go_back:
            folder, by_person = self._take_back()
            if by_person:
                self._asked = OpenQuestion.of(folder.mark(outdated=False))
                break
        self._leave_rest = False
        self._show()

    def _take_back(self) -> tuple[QuestionFolder, bool]:
        folder, by_person = self._given.pop()
        folder.take_back()
        return folder.mark(outdated=True), by_person

    def show_mesh(self, mesh: Mesh) -> bool:
        """Draw the mesh of the run; return whether it differs from the drawn one."""
        if self._mesh is mesh or _equal(self._mesh, mesh):
            return False
        self._mesh = mesh
        self._scene.show_mesh(mesh)
        return True

    def look(self) -> None:
        """Show a new question, or apply geometry's suggestion to the open one."""
        if self._mesh is None:
            return
        if self._asked is None:
            self._take_up()
        elif self._asked.take_suggestion():
            self._show()

    def tick(self) -> None:
        """Advance the playing motion."""
        if self._asked is not None:
            self._scene.tick(self._asked.form, time.monotonic() - self._began)

    def _take_up(self) -> None:
        """Show the question that the run waits for.

        Questions that cannot be asked on the object, and all questions after "Leave all", are left to geometry.
        """
        folder = find_open_question(self._folder)
        if folder is None:
            return
        asked = OpenQuestion.of(folder)
        if asked is None or self._leave_rest:
            folder.write_answer(LEAVE)
            self._given.append((folder, False))
            return
        if folder.earlier() is None:
            asked.take_marks_of(q for q in QuestionStore(self._folder).questions() if q.outdated and q.kind == folder.kind)
        self._asked = asked
        self._show()

    def _show(self) -> None:
        if self._asked is not None:
            choices = Choices(
                self._answer,
                self._leave,
                self._leave_all,
                self._follow_form,
                self._show,
                self._look_at,
                lambda event: azimuth_of(event.client.camera),
            )
            self._follow_form()
            self._panel.show(self._asked.form, len(self._given) + 1, self._asked.note, choices)

    def _follow_form(self) -> None:
        """Draw the current state of the form."""
        if self._asked is not None and self._mesh is not None:
            self._began = time.monotonic()
            self._scene.show(self._asked.form, self._mesh)

    def _look_at(self, closer: bool) -> None:
        """Turn the cameras to the part in question, or to the whole object."""
        if self._asked is None or self._mesh is None or not isinstance(self._asked.form, PartsForm):
            return
        if not closer:
            self._page.view.look_at(self._mesh)
        else:
            part = self._asked.form.part
            self._page.view.look_from(self._mesh.subset(part.faces), *closer_view(part, self._mesh))

    def _clicked(self, event: Any) -> None:
        if self._asked is None:
            return
        origin, direction = np.array(event.ray_origin, float), np.array(event.ray_direction, float)
        if self._scene.clicked(self._asked.form, origin, direction):
            self._panel.follow()
            self._follow_form()

    def _answer(self) -> None:
        if self._asked is not None:
            refused = self._asked.submit()
            if refused:
                self._panel.refuse(refused)
            else:
                self._done()

    def _leave(self) -> None:
        if self._asked is not None:
            self._asked.leave()
            self._done()

    def _leave_all(self) -> None:
        self._leave_rest = True
        self._leave()

    def _done(self) -> None:
        if self._asked is not None:
            self._given.append((self._asked.folder, True))
        self._close()

    def _close(self) -> None:
        self._asked = None
        self._panel.close()
        if self._mesh is not None:
            self._scene.show_mesh(self._mesh)


def _equal(a: Mesh | None, b: Mesh) -> bool:
    """Return whether two meshes are the same one, loaded twice."""
    return a is not None and np.array_equal(a.vertices, b.vertices) and np.array_equal(a.faces, b.faces)
