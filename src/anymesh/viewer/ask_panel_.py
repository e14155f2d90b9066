"""Panel for answering one question: instructions, fields, and buttons to answer or to leave it to geometry."""

from __future__ import annotations

from collections.abc import Callable
from html import escape
from typing import Any

from anymesh.viewer.ask_fields_ import Choices, Fields
from anymesh.viewer.ask_forms import Form, PartsForm
from anymesh.viewer.ask_words import guide, place, title
from anymesh.viewer.panels import SMALL

REFUSED, NOTE = "#c92a2a", "#1864ab"
CLOSE, WHOLE = "The part", "The object"
LEAVE, LEAVE_REST = "Leave this one", "Leave all"


class AskPanel:
    """Shows one form at a time in a container of the page."""

    def __init__(self, gui: Any, act: Callable[[Callable[[], None]], None]) -> None:
        self._gui, self._act = gui, act
        self._outer = gui.add_folder(None)
        self._inner: Any = None
        self._note: Any = None
        self._fields: Fields | None = None

    def close(self) -> None:
        """Remove the question from the page."""
        if self._inner is not None:
            self._inner.remove()
        self._inner = self._fields = None

    def show(self, form: Form, number: int, note: str, choices: Choices) -> None:
        """Show the current state of a form. number: of the question; note: information about it."""
        self.close()
        gui = self._gui
        with self._outer:
            self._inner = gui.add_folder(f"Question {number}: {title(form)}")
        with self._inner:
            gui.add_html(f"<div {SMALL}>{escape(guide(form))}</div>")
            self._note = gui.add_html(_line(note, NOTE))
            if isinstance(form, PartsForm):
                self._add_steps(form, choices)
            self._fields = Fields(gui, self._act, form, choices)
            count = len(form.parts) if isinstance(form, PartsForm) else 1
            answer = gui.add_button("Answer" if count < 2 else f"Answer for all {count} parts", color="green")
            leave = gui.add_button_group("To geometry", (LEAVE, LEAVE_REST))
        answer.on_click(lambda _: self._act(choices.answer))
        ways = {LEAVE: choices.leave, LEAVE_REST: choices.leave_rest}
        leave.on_click(lambda event: self._act(ways[event.target.value]))

    def follow(self) -> None:
        """Update the fields after clicks in the scene."""
        if self._fields is not None:
            self._fields.follow()

    def refuse(self, why: str) -> None:
        """Show why an answer is not accepted."""
        if self._note is not None:
            self._note.content = _line(f"Not yet: {why}", REFUSED)

    def _add_steps(self, form: PartsForm, choices: Choices) -> None:
        """Add the current part, and the navigation to the others."""
        self._gui.add_html(f"<div {SMALL}><b>{escape(place(form))}</b></div>")
        look = self._gui.add_button_group("Look at", (CLOSE, WHOLE))
        look.on_click(lambda event: self._act(lambda: choices.look(event.target.value == CLOSE)))
        if len(form.parts) < 2:
            return
        steps = self._gui.add_button_group("Go to", ("← Part before", "Next part →"))

        def go(way: str) -> None:
            form.go(1 if way.startswith("Next") else -1)
            choices.again()

        steps.on_click(lambda event: self._act(lambda: go(event.target.value)))


def _line(text: str, color: str) -> str:
    if not text:
        return ""
    style = f"border-left:3px solid {color};padding-left:0.5em"
    return f'<div {SMALL}><div role="status" style="{style}">{escape(text)}</div></div>'
