"""Fields of one question on the page (viser), and the panel around them; clicks in the scene update them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np

from anymesh.prompted.questions.prompting import JointAppearance, PartFit
from anymesh.prompted.questions.recognition import MAX_COUNT
from anymesh.types.motion import BASE
from anymesh.viewer.panels import SMALL
from anymesh.viewer.questions.forms import (
    SPLIT,
    ArrowsForm,
    Form,
    Group,
    KindsForm,
    MarksForm,
    MotionsForm,
    PartsForm,
    PointsForm,
)
from anymesh.viewer.questions.label_forms import MOVES, LabelRow, RecognizeForm, RegionsForm, RowsForm
from anymesh.viewer.questions.scene_ import group_color

KINDS = {
    "hinge along an edge (door, lid)": JointAppearance.HINGE_ALONG,
    "turns in the surface (knob, wheel)": JointAppearance.HINGE_INTO,
    "turns, hinge out of sight": JointAppearance.HINGE_HIDDEN,
    "slides in or out (drawer, button)": JointAppearance.SLIDE_OUT,
    "slides along the surface": JointAppearance.SLIDE_ALONG,
    "does not move": JointAppearance.FIXED,
}
FITS = {"is right": PartFit.RIGHT, "is too much": PartFit.TOO_MUCH, "is too little": PartFit.TOO_LITTLE}
NONE_OF_THESE = "None"
NO_FRONT = "none"
REFUSED, NOTE = "#c92a2a", "#1864ab"
CLOSE, WHOLE = "The part", "The object"
LEAVE_ONE, LEAVE_REST = "Leave this one", "Leave all"


def group_name(group: Group) -> str:
    """Return the name of a group of marks."""
    return group[0] if group == SPLIT else f"{group[0]} {group[1]}"


def marks_table(form: MarksForm) -> str:
    """Return a table of the parts with their colours and marks, as HTML."""
    rows = []
    for group, marks in form.groups.items():
        r, g, b = group_color(form, group)
        dot = (
            f'<span style="display:inline-block;width:0.8em;height:0.8em;border-radius:2px;background:rgb({r},{g},{b})"></span>'
        )
        numbers = ", ".join(map(str, sorted(marks))) or "nothing yet"
        name = escape(group_name(group))
        rows.append(f"<div>{dot} {f'<b>{name}</b>' if group == form.current else name}: {numbers}</div>")
    left = len(form.asked) - sum(len(marks & form.asked) for marks in form.groups.values())
    return f"<div {SMALL}>{''.join(rows)}<div>{left} regions belong to no part.</div></div>"


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
            case RegionsForm():
                self._rows(form)
            case MarksForm():
                self._marks(form)
            case KindsForm():
                self._kinds(form)
            case PointsForm():
                self._points(form)
            case ArrowsForm():
                count = len(form.tables[form.step].directions)
                self._numbers(form, "Arrow", [str(k + 1) for k in range(count)])
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
        captions, azimuths = [p.caption.partition(": ")[2] or p.caption for p in form.question.pictures], form.question.azimuths
        if len(captions) < len(azimuths):  # on one sheet
            captions = [f"turned by {azimuth:g} degrees" for azimuth in azimuths]
        fronts = [NO_FRONT, *(f"{k}: {caption}" for k, caption in enumerate(captions, 1))]
        front = gui.add_dropdown("Front", fronts, initial_value=fronts[min(form.front, len(fronts) - 1)])
        self._bound(form, front, lambda v: setattr(form, "front", fronts.index(v)))
        mine = gui.add_button("I look at its front now", color="gray")

        def look(event: Any) -> None:
            form.look_from(self._choices.azimuth(event))
            front.value = fronts[form.front]

        mine.on_click(lambda event: self._act(lambda: look(event)))
        machine = gui.add_checkbox(
            "Machine", form.machine, hint="Aircraft, ship, vehicle, robot, crane: a closer look comes next"
        )
        self._bound(form, machine, lambda v: setattr(form, "machine", bool(v)))
        self._rows(form)

    def _rows(self, form: RowsForm) -> None:
        gui, follow = self._gui, list[Callable[[], None]]()
        for row in form.rows:
            follow.append(self._label_row(form, row, lambda: [f() for f in follow]))
        more = gui.add_button("Add a kind of part that moves", color="gray")

        def add() -> None:
            form.rows.append(LabelRow())
            form.touched, form.open_row = True, len(form.rows) - 1
            self._choices.again()

        more.on_click(lambda _: self._act(add))

    def _label_row(self, form: RowsForm, row: LabelRow, changed: Callable[[], Any]) -> Callable[[], None]:
        """Add the fields of one entry; return what shows the changes. changed: is called after one that others must show."""
        gui, words = self._gui, {v.value: k for k, v in MOVES.items()}

        def over() -> tuple[str, ...]:
            return tuple(dict.fromkeys((BASE, row.parent, *(r.label for r in form.rows))))

        def rename(label: str) -> None:
            form.rename(row, label)
            changed()

        def move(way: str) -> None:
            row.moves = MOVES[way].value
            changed()

        folder = gui.add_folder(row.words, expand_by_default=form.rows.index(row) == form.open_row)
        with folder:
            self._bound(form, gui.add_text("Kind of part", row.label), rename)
            moves = gui.add_dropdown("Moves", tuple(MOVES), initial_value=words[row.moves])
            self._bound(form, moves, move)
            parent = gui.add_dropdown("Mounted on", over(), initial_value=row.parent)
            self._bound(form, parent, lambda v: setattr(row, "parent", v))
            limits = gui.add_vector2("From, to [° or cm]", (row.lower, row.upper), step=0.1)

            def set_limits(value: Any) -> None:
                row.lower, row.upper = (float(v) for v in value)
                changed()

            self._bound(form, limits, set_limits)
            count = gui.add_number("How many (0: unknown)", row.count, min=0, max=MAX_COUNT, step=1)
            self._bound(form, count, lambda v: setattr(row, "count", int(v)))
            gone = gui.add_button("Remove", color="gray")

        def remove() -> None:
            form.remove(row)
            form.touched, form.open_row = True, -1
            self._choices.again()

        def follow() -> None:
            folder.label, mount = row.words, row.parent
            parent.options = over()
            parent.value = mount

        gone.on_click(lambda _: self._act(remove))
        return follow

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

    def _kinds(self, form: KindsForm | MotionsForm) -> None:
        gui, row, words = self._gui, form.rows[form.step], {v.value: k for k, v in KINDS.items()}
        joint = gui.add_dropdown("Joint", tuple(KINDS), initial_value=words[row.joint])
        self._bound(form, joint, lambda v: setattr(row, "joint", KINDS[v].value))
        self._bound(form, gui.add_checkbox("Turns endlessly", row.endless), lambda v: setattr(row, "endless", bool(v)))
        if form.labels:
            label = gui.add_dropdown("It is a", form.labels, initial_value=row.label)
            self._bound(form, label, lambda v: setattr(row, "label", v))

    def _points(self, form: PointsForm) -> None:
        shown = self._gui.add_text("Points chosen", form.words, disabled=True)

        def follow() -> None:
            shown.value = form.words

        self.follow = follow

    def _motions(self, form: MotionsForm) -> None:
        table = form.table
        names = [*(str(k + 1) for k in range(len(table.motions))), NONE_OF_THESE]
        self._numbers(form, "Motion", names)
        if form.rows:
            self._kinds(form)
        if form.leads:
            leaders = form.leaders(form.step)
            names = {number: name for name, number in leaders.items()}
            lead = self._gui.add_dropdown("Moves only with", tuple(leaders), initial_value=names[form.leads[form.step]])
            self._bound(form, lead, lambda v: form.leads.__setitem__(form.step, leaders[v]))
        if form.fits:
            words = {v.value: k for k, v in FITS.items()}
            fit = self._gui.add_dropdown("The coloured part", tuple(FITS), initial_value=words[form.fits[form.step]])
            self._bound(form, fit, lambda v: form.fits.__setitem__(form.step, FITS[v].value))

    def _numbers(self, form: ArrowsForm | MotionsForm, name: str, names: list[str]) -> None:
        """Add numbered buttons, one of which is chosen."""
        buttons = self._gui.add_button_group(name, names)

        def line() -> str:
            return f"<div {SMALL}><b>{escape(form.words)}</b></div>"

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
            self._inner = gui.add_folder(f"Question {number}: {form.title}")
        with self._inner:
            gui.add_html(f"<div {SMALL}>{escape(form.guide)}</div>")
            self._note = gui.add_html(_line(note, NOTE))
            if isinstance(form, PartsForm):
                self._add_steps(form, choices)
            self._fields = Fields(gui, self._act, form, choices)
            count = len(form.parts) if isinstance(form, PartsForm) else 1
            answer = gui.add_button("Answer" if count < 2 else f"Answer for all {count} parts", color="green")
            leave = gui.add_button_group("To geometry", (LEAVE_ONE, LEAVE_REST))
        answer.on_click(lambda _: self._act(choices.answer))
        ways = {LEAVE_ONE: choices.leave, LEAVE_REST: choices.leave_rest}
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
        self._gui.add_html(f"<div {SMALL}><b>{escape(form.place)}</b></div>")
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
