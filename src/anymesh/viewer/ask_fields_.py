"""Fields of one question on the page (viser); clicks in the scene update them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np

from anymesh.types.motion import BASE
from anymesh.viewer.ask_forms import ArrowsForm, Form, KindsForm, LabelRow, MotionsForm, PartsForm, PointsForm, RecognizeForm
from anymesh.viewer.ask_marks import MarksForm
from anymesh.viewer.ask_words import (
    FITS,
    KINDS,
    MOVES,
    NONE_OF_THESE,
    chosen_points,
    group_name,
    label_words,
    marks_table,
    motion_words,
)
from anymesh.viewer.panels import SMALL

NO_FRONT = "none"


@dataclass(frozen=True)
class Choices:
    """Callbacks for a person's actions on a question, called with the page's lock held.

    changed: the scene must follow the form; again: the panel must be rebuilt as well; look: at the part (True) or the whole
    object; azimuth: returns the azimuth of a tab's camera [deg], given the event of its click.
    """

    answer: Callable[[], None]
    leave: Callable[[], None]
    leave_rest: Callable[[], None]
    changed: Callable[[], None]
    again: Callable[[], None]
    look: Callable[[bool], None]
    azimuth: Callable[[Any], float]


class Fields:
    """The fields of a form, added to the open container."""

    def __init__(self, gui: Any, act: Callable[[Callable[[], None]], None], form: Form, choices: Choices) -> None:
        self._gui, self._act, self._choices = gui, act, choices
        self.follow: Callable[[], None] = lambda: None  # shows changes by clicks in the scene
        match form:
            case RecognizeForm():
                self._recognize(form)
            case MarksForm():
                self._marks(form)
            case KindsForm():
                self._kinds(form)
            case PointsForm():
                self._points(form)
            case ArrowsForm():
                count = len(form.tables[form.step].directions)
                self._numbers(form, "Arrow", [str(k + 1) for k in range(count)], lambda: f"Arrow {form.chosen[form.step]}.")
            case MotionsForm():
                self._motions(form)
        if isinstance(form, PartsForm):
            self._see_through(form)

    def _see_through(self, form: PartsForm) -> None:
        box = self._gui.add_checkbox("See through", form.see_through.get(form.step, False), hint="The rest of the object")

        def put(value: bool) -> None:
            form.see_through[form.step] = value
            self._choices.changed()

        box.on_update(lambda event: self._act(lambda: put(box.value)) if event.client is not None else None)

    def _bound(self, form: Form, handle: Any, store: Callable[[Any], None]) -> Any:
        """Store a person's input to a field in the form."""

        def changed(event: Any) -> None:
            if event.client is not None:
                form.touched = True
                store(handle.value)

        handle.on_update(lambda event: self._act(lambda: changed(event)))
        return handle

    def _recognize(self, form: RecognizeForm) -> None:
        gui = self._gui
        self._bound(form, gui.add_text("Object", form.category), lambda v: setattr(form, "category", v))
        size = gui.add_number("Longest side [m]", round(form.longest, 3), min=0.002, max=200.0, step=0.001)
        self._bound(form, size, lambda v: setattr(form, "longest", float(v)))
        fronts = [
            NO_FRONT,
            *(f"{k}: {p.caption.partition(': ')[2] or p.caption}" for k, p in enumerate(form.question.pictures, 1)),
        ]
        front = gui.add_dropdown("Front", fronts, initial_value=fronts[min(form.front, len(fronts) - 1)])
        self._bound(form, front, lambda v: setattr(form, "front", fronts.index(v)))
        mine = gui.add_button("I look at its front now", color="gray")

        def look(event: Any) -> None:
            form.look_from(self._choices.azimuth(event))
            front.value = fronts[form.front]

        mine.on_click(lambda event: self._act(lambda: look(event)))
        for row in form.rows:
            self._label_row(form, row)
        more = gui.add_button("Add a kind of part that moves", color="gray")

        def add() -> None:
            form.rows.append(LabelRow())
            form.touched, form.open_row = True, len(form.rows) - 1
            self._choices.again()

        more.on_click(lambda _: self._act(add))

    def _label_row(self, form: RecognizeForm, row: LabelRow) -> None:
        gui, words = self._gui, {v.value: k for k, v in MOVES.items()}
        with gui.add_folder(label_words(row), expand_by_default=form.rows.index(row) == form.open_row):
            self._bound(form, gui.add_text("Kind of part", row.label), lambda v: setattr(row, "label", v))
            moves = gui.add_dropdown("Moves", tuple(MOVES), initial_value=words[row.moves])
            self._bound(form, moves, lambda v: setattr(row, "moves", MOVES[v].value))
            over = tuple(dict.fromkeys((BASE, row.parent, *(r.label for r in form.rows))))
            parent = gui.add_dropdown("Mounted on", over, initial_value=row.parent)
            self._bound(form, parent, lambda v: setattr(row, "parent", v))
            limits = gui.add_vector2("From, to [° or cm]", (row.lower, row.upper), step=0.1)

            def set_limits(value: Any) -> None:
                row.lower, row.upper = (float(v) for v in value)

            self._bound(form, limits, set_limits)
            gone = gui.add_button("Remove", color="gray")

        def remove() -> None:
            form.rows.remove(row)
            form.touched, form.open_row = True, -1
            self._choices.again()

        gone.on_click(lambda _: self._act(remove))

    def _marks(self, form: MarksForm) -> None:
        gui, names = self._gui, {group_name(g): g for g in form.groups}
        current = gui.add_dropdown("Clicks are for", tuple(names), initial_value=group_name(form.current))
        more = gui.add_button_group("One more", tuple(form.question.labels))
        table = gui.add_html(marks_table(form))
        now = ", ".join(map(str, sorted(form.groups[form.current])))
        typed = gui.add_text("Regions", now, hint="The numbers of this part's regions, as in the pictures of a model")
        unsure = gui.add_checkbox("Not sure", form.current in form.unsure, hint="Of the regions of this part")
        hide = gui.add_checkbox("Hide others", form.hide_given, hint="Parts that are done, to reach what lies behind them")

        def follow() -> None:
            table.content = marks_table(form)
            typed.value = ", ".join(map(str, sorted(form.groups[form.current])))
            unsure.value = form.current in form.unsure
            self._choices.changed()

        def take(name: str) -> None:
            form.current = names[name]
            follow()

        def type_in(text: str) -> None:
            form.set_marks(text)
            table.content = marks_table(form)
            self._choices.changed()

        def add(label: str) -> None:
            form.add(label)
            self._choices.again()

        def set_hidden(value: bool) -> None:
            form.hide_given = value
            self._choices.changed()

        def doubt(value: bool) -> None:
            (form.unsure.add if value else form.unsure.discard)(form.current)

        self.follow = follow
        current.on_update(lambda event: self._act(lambda: take(current.value)) if event.client is not None else None)
        self._bound(form, typed, type_in)
        self._bound(form, unsure, doubt)
        hide.on_update(lambda event: self._act(lambda: set_hidden(hide.value)) if event.client is not None else None)
        more.on_click(lambda event: self._act(lambda: add(event.target.value)))

    def _kinds(self, form: KindsForm) -> None:
        gui, row, words = self._gui, form.rows[form.step], {v.value: k for k, v in KINDS.items()}
        joint = gui.add_dropdown("Joint", tuple(KINDS), initial_value=words[row.joint])
        self._bound(form, joint, lambda v: setattr(row, "joint", KINDS[v].value))
        self._bound(form, gui.add_checkbox("Turns endlessly", row.endless), lambda v: setattr(row, "endless", bool(v)))
        if form.labels:
            label = gui.add_dropdown("It is a", form.labels, initial_value=row.label)
            self._bound(form, label, lambda v: setattr(row, "label", v))

    def _points(self, form: PointsForm) -> None:
        shown = self._gui.add_text("Points chosen", chosen_points(form) or "none", disabled=True)

        def follow() -> None:
            shown.value = chosen_points(form) or "none"

        self.follow = follow

    def _motions(self, form: MotionsForm) -> None:
        table = form.table
        names = [*(str(k + 1) for k in range(len(table.motions))), NONE_OF_THESE]
        self._numbers(form, "Motion", names, lambda: motion_words(table, form.chosen[form.step]))
        if form.ask_fit:
            words = {v.value: k for k, v in FITS.items()}
            fit = self._gui.add_dropdown("The coloured part", tuple(FITS), initial_value=words[form.fits[form.step]])
            self._bound(form, fit, lambda v: form.fits.__setitem__(form.step, FITS[v].value))

    def _numbers(self, form: ArrowsForm | MotionsForm, name: str, names: list[str], describe: Callable[[], str]) -> None:
        """Add numbered buttons, one of which is chosen."""
        buttons = self._gui.add_button_group(name, names)

        def line() -> str:
            return f"<div {SMALL}><b>{escape(describe())}</b></div>"

        words = self._gui.add_html(line())

        def choose(value: str) -> None:
            form.choose(0 if value == NONE_OF_THESE else int(value))
            words.content = line()
            self._choices.changed()

        buttons.on_click(lambda event: self._act(lambda: choose(event.target.value)))


def azimuth_of(camera: Any) -> float:
    """Return the azimuth [deg] of a tab's camera, as in `viewpoints.away`."""
    x, y, _ = np.asarray(camera.position, float) - np.asarray(camera.look_at, float)
    return float(np.rad2deg(np.arctan2(x, -y)))
