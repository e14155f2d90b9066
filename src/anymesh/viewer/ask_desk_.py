"""Questions on the live page: panel, scene and clicks of the open question."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.prompted.answerers.question_files import LEAVE
from anymesh.types import Mesh
from anymesh.viewer.ask_fields_ import Choices, azimuth_of
from anymesh.viewer.ask_forms import PartsForm
from anymesh.viewer.ask_panel_ import AskPanel
from anymesh.viewer.ask_scene_ import QuestionScene
from anymesh.viewer.ask_shapes import closer_view
from anymesh.viewer.open_question import OpenQuestion, find_open_question
from anymesh.viewer.panels_page import Page


class AskDesk:
    """Presents the questions of a folder to a person, one after the other; every call holds the page's lock."""

    def __init__(self, page: Page) -> None:
        self._page = page
        self._scene, self._panel = QuestionScene(page.server), AskPanel(page.gui, page.act)
        self._folder, self._mesh = Path(), None
        self._asked: OpenQuestion | None = None
        self._count, self._leave_rest, self._began = 0, False, 0.0
        page.server.scene.on_click()(lambda event: page.act(lambda: self._clicked(event)))

    @property
    def busy(self) -> bool:
        """Whether a question is on the page."""
        return self._asked is not None

    def begin(self, folder: Path) -> None:
        """Start with the questions that a run writes to a folder."""
        self.end()
        self._folder, self._count, self._leave_rest = folder, 0, False

    def end(self) -> None:
        """Remove everything from the page."""
        self._asked, self._mesh = None, None
        self._panel.close()
        self._scene.clear()

    def show_mesh(self, mesh: Mesh) -> bool:
        """Draw the mesh of the run; return whether it is new."""
        new = self._mesh is not mesh
        if new:
            self._mesh = mesh
            self._scene.show_mesh(mesh)
        return new

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
        self._count += 1
        asked = OpenQuestion.of(folder)
        if asked is None or self._leave_rest:
            folder.write_answer(LEAVE)
            return
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
            self._panel.show(self._asked.form, self._count, self._asked.note, choices)

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
        self._asked = None
        self._panel.close()
        if self._mesh is not None:
            self._scene.show_mesh(self._mesh)
